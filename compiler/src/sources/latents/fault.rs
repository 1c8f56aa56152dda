//! Faults that several ways to mix or edit textures have.

use asperity_io::diagnostic::Fault;
use std::fmt::Display;

/// Returns the fault of a texture that remembers no latent.
pub(crate) fn no_latent(name: &str) -> Fault {
    Fault::new(
        format!("{name:?} has no latent"),
        "give a texture compiled from a prompt, or encode this one with `asperity encode`",
    )
}

/// Returns the fault of an edit that moves nothing.
pub fn nothing_asked() -> Fault {
    let remedy = "give a slider, such as --rougher 20, words with --prompt, or --undo";
    Fault::new("no edit is given", remedy).usage()
}

/// Returns the fault of an edit in whose words nothing is understood.
pub(crate) fn not_understood(edit: impl Display) -> Fault {
    let what = format!(
        "{edit} names neither a quality to change, such as rough, nor a material to be more like"
    );
    let remedy = "describe a change, as in \"less gritty, more waxy\" or \"more like leather\"";
    Fault::new(what, remedy)
}
