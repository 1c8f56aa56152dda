//! `asperity edit`.

use super::{
    input::{Input, parsed},
    output::{Mixing, failed},
};
use crate::cli::Edit;
use asperity::{
    attributes,
    console::Console,
    diagnostic::Failures,
    edit::{AXES, EditError, History, How, Latents, Made, Sliders, Step, Studio, attributes_line},
    model::Provenance,
    raise::raise,
};
use asperity_formats::Asset;
use serde_json::{Value, json};

/// Steps by which an attribute may miss what was asked for before a user is told.
const NEAR: f64 = 3.0;

pub(crate) fn run(args: &Edit, console: Console) -> Result<(), Failures> {
    let sliders = Sliders {
        rougher: args.rougher.unwrap_or(0.0),
        sharper: args.sharper.unwrap_or(0.0),
        harder: args.harder.unwrap_or(0.0),
        slipperier: args.slipperier.unwrap_or(0.0),
    };
    // Relative wording (`--prompt "less gritty"`) would give latents here as sliders do.
    if sliders.are_still() && !args.undo {
        return Err(failed(EditError::NothingAsked));
    }
    let input = Input::of(&args.file);
    let mixing = Mixing::open(&args.mixed, &[&input], console)?;
    let bytes = input.read()?;
    let asset = parsed(&bytes)?;
    let (author, crc32) = mixing.author()?;
    let studio = Studio::new(&author, crc32);
    let memory = studio.memory(&asset).map_err(failed)?;
    let own = studio.how(&asset);
    let how = How {
        preview: own.preview && mixing.previews(),
        ..own
    };
    let (latents, history) = if args.undo {
        undone(asset.name(), memory.history).map_err(failed)?
    } else {
        let edited = studio
            .edited(&memory.latents, &sliders, &how)
            .map_err(failed)?;
        let mut history = memory.history;
        history.steps.push(Step::new(sliders, &memory.latents));
        (edited, history)
    };
    let before = attributes::of(&raise(&asset));
    let made = compiled(&studio, &asset, &mixing, &latents, history, &how)?;
    let after = made.attributes;
    let moved = AXES.map(|axis| {
        let place = |attributes| studio.scale().place(axis, attributes).unwrap_or(0.0);
        (axis, place(&after) - place(&before))
    });
    let mut warnings = Vec::new();
    for (axis, by) in moved.into_iter().filter(|_| !args.undo) {
        let asked = sliders.along(axis);
        if (by - asked).abs() > NEAR {
            let name = axis.name();
            warnings.push(format!(
                "{name} moved by {by:+.0} of {asked:+.0} steps, the nearest that was found from here"
            ));
        }
    }
    let mut by = serde_json::Map::new();
    for (axis, by_steps) in moved {
        by.insert(axis.name().to_owned(), json!(by_steps));
    }
    let line = moved
        .map(|(axis, by)| format!("{} {by:+.1}", axis.name()))
        .join(", ");
    let before = attributes_line(&before, studio.scale());
    let more = json!({ "moved": Value::Object(by), "undone": args.undo });
    let lines = [("before", before), ("moved", line)];
    mixing.finish(&studio, &made, more, &lines, &warnings)
}

/// The latents before the last edit, and the history without it.
fn undone(name: &str, mut history: History) -> Result<(Latents, History), EditError> {
    let Some(last) = history.steps.pop() else {
        return Err(EditError::NothingToUndo(name.to_owned()));
    };
    let before = last.before().ok_or_else(|| EditError::History {
        name: name.to_owned(),
        message: "the latents before the last edit are damaged".into(),
    })?;
    Ok((before, history))
}

/// Compiles in the way that the asset was, with its name and provenance.
fn compiled(
    studio: &Studio<'_>,
    asset: &Asset<'_>,
    mixing: &Mixing<'_>,
    latents: &Latents,
    history: History,
    how: &How,
) -> Result<Made, Failures> {
    let name = mixing.name(asset.name());
    let provenance: Provenance = raise(asset).provenance;
    studio
        .compile(latents, &name, provenance, history, how)
        .map_err(failed)
}
