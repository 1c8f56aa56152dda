//! Words of a command line, for a POSIX shell.

use asperity::sources::latents::{AXES, Axis, Sliders};
use asperity_io::shown::shell_word;
use std::borrow::Cow;

/// The options of `asperity edit` for these sliders.
pub(super) fn options(sliders: &Sliders) -> String {
    let option = |axis: Axis| {
        let steps = sliders.along(axis);
        let (up, down) = match axis {
            Axis::Rough => ("rougher", "smoother"),
            Axis::Sharp => ("sharper", "duller"),
            Axis::Hard => ("harder", "softer"),
            Axis::Slippery => ("slipperier", "stickier"),
        };
        let name = if steps > 0.0 { up } else { down };
        (steps != 0.0).then(|| format!("--{name} {}", steps.abs()))
    };
    let given: Vec<String> = AXES.into_iter().filter_map(option).collect();
    given.join(" ")
}

/// A path as a word of a shell, that no command takes for an option.
pub(super) fn path_word(path: &str) -> Cow<'_, str> {
    if path.starts_with('-') {
        Cow::Owned(shell_word(&format!("./{path}")).into_owned())
    } else {
        shell_word(path)
    }
}

/// A text in quotation marks, even if it is one word: people change it.
pub(super) fn quoted(text: &str) -> String {
    match shell_word(text) {
        quoted if quoted.starts_with('\'') => quoted.into_owned(),
        plain => format!("'{plain}'"),
    }
}
