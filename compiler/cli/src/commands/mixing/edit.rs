//! `asperity edit`.

use super::{input::Input, output::Mixing};
use crate::cli::Edit as Arguments;
use asperity::{
    attributes,
    edit::{AXES, Edit, EditError, LatentEditor, Sliders, attributes_line},
    pipeline::Request,
    raise::raise,
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    shown::rounded,
};
use serde_json::{Value, json};

/// Steps by which an attribute may miss its target before the user is warned.
const NEAR: f64 = 3.0;

/// The steps of one option, or the others of its opposite.
fn either(up: Option<f64>, down: Option<f64>) -> f64 {
    up.or(down.map(|steps| -steps)).unwrap_or(0.0)
}

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let sliders = Sliders {
        rougher: either(args.rougher, args.smoother),
        sharper: either(args.sharper, args.duller),
        harder: either(args.harder, args.softer),
        slipperier: either(args.slipperier, args.stickier),
    };
    if sliders.are_still() && !args.undo && args.prompt.is_none() {
        return Err(one(EditError::NothingAsked));
    }
    let input = Input::of(&args.file);
    let mixing = Mixing::open(&args.mixed, &[&input], console)?;
    let input = input.read()?;
    let asset = input.asset()?;
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let mut source = editor.remembered(&asset).map_err(one)?;
    // In the way that the asset was, with its name and provenance.
    let request = Request {
        preview_px: mixing.preview_px(editor.request(&asset).preview_px),
        ..editor.request(&asset)
    };
    let (mut asked, mut towards) = (None, None);
    if args.undo {
        source.undo().map_err(one)?;
    } else {
        let edit = match &args.prompt {
            Some(words) => Edit::Words(words.clone()),
            None => Edit::Steps(sliders),
        };
        let done = source.edit(&editor, &edit, &request).map_err(one)?;
        // A blend towards a material moves every attribute: no target is compared.
        asked = done.towards.is_none().then_some(done.sliders);
        towards = done.towards;
    }
    let before = attributes::of(&raise(&asset));
    let request = Request {
        loudness_db: source.history.loudness_db,
        ..request
    };
    source.name = mixing.name(asset.name());
    let mut compiled = mixing.compile(&editor, &source, &request)?;
    let attributes = compiled.attributes();
    let moved = AXES.map(|axis| {
        let place = |attributes| editor.scale().place(axis, attributes).unwrap_or(0.0);
        (axis, place(&attributes) - place(&before))
    });
    for (axis, by) in moved {
        let Some(asked) = asked.map(|asked: Sliders| asked.along(axis)) else {
            continue;
        };
        if (by - asked).abs() > NEAR {
            let name = axis.name();
            compiled.warnings.push(format!(
                "{name} moved by {by:+.0} of {asked:+.0} steps, the nearest that was found from here"
            ));
        }
    }
    let mut by = serde_json::Map::new();
    for (axis, by_steps) in moved {
        by.insert(axis.name().to_owned(), json!(by_steps));
    }
    let line = moved
        .map(|(axis, by)| format!("{} {:+.1}", axis.name(), rounded(by, 1)))
        .join(", ");
    let before = attributes_line(&before, editor.scale());
    let more = json!({ "moved": Value::Object(by), "undone": args.undo, "prompt": args.prompt });
    let mut lines = vec![("before", before), ("moved", line)];
    if let Some(towards) = towards {
        let share = 100.0 * towards.share;
        lines.insert(
            0,
            (
                "towards",
                format!("{share:.0} % of the way to {:?}", towards.thing),
            ),
        );
    }
    mixing.finish(&editor, &compiled, more, &lines)
}
