//! `asperity edit`.

use super::{
    input::{Input, parsed},
    output::{Mixing, failed},
};
use crate::cli::Edit;
use asperity::{
    attributes,
    edit::{
        AXES, EditError, History, How, Latents, Memory, Sliders, Step, Studio, Worded,
        attributes_line,
    },
    pipeline::Request,
    raise::raise,
    sources::latents::FromLatents,
};
use asperity_console::Console;
use asperity_io::diagnostic::Failures;
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
    if sliders.are_still() && !args.undo && args.prompt.is_none() {
        return Err(failed(EditError::NothingAsked));
    }
    let input = Input::of(&args.file);
    let mixing = Mixing::open(&args.mixed, &[&input], console)?;
    let bytes = input.read()?;
    let asset = parsed(&bytes)?;
    let author = mixing.author()?;
    let studio = Studio::new(&author);
    let memory = studio.memory(&asset).map_err(failed)?;
    let own = studio.how(&asset);
    let how = How {
        request: Request {
            preview_px: mixing.preview_px(own.request.preview_px),
            ..own.request
        },
        ..own
    };
    let done = done(args, &sliders, &studio, memory, asset.name(), &how).map_err(failed)?;
    let before = attributes::of(&raise(&asset));
    // In the way that the asset was, with its name and provenance.
    let request = Request {
        loudness_db: done.history.loudness_db,
        ..how.request
    };
    let name = mixing.name(asset.name());
    let provenance = raise(&asset).provenance;
    let source = FromLatents {
        law: how.law,
        ..FromLatents::new(done.latents, name, provenance, done.history)
    };
    let mut compiled = mixing.compile(&studio, &source, &request)?;
    let attributes = compiled.attributes();
    let moved = AXES.map(|axis| {
        let place = |attributes| studio.scale().place(axis, attributes).unwrap_or(0.0);
        (axis, place(&attributes) - place(&before))
    });
    let mut warnings = done.warnings;
    warnings.append(&mut compiled.warnings);
    for (axis, by) in moved {
        let Some(asked) = done.asked.map(|asked| asked.along(axis)) else {
            continue;
        };
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
    let more = json!({ "moved": Value::Object(by), "undone": args.undo, "prompt": args.prompt });
    let mut lines = vec![("before", before), ("moved", line)];
    if let Some(towards) = done.towards {
        lines.insert(0, ("towards", towards));
    }
    compiled.warnings = warnings;
    mixing.finish(&studio, &compiled, more, &lines)
}

/// What an edit comes to.
struct Done {
    latents: Latents,
    history: History,
    /// Steps that every attribute should have moved; `None` where that is not said.
    asked: Option<Sliders>,
    towards: Option<String>,
    warnings: Vec<String>,
}

fn done(
    args: &Edit,
    sliders: &Sliders,
    studio: &Studio<'_>,
    memory: Memory,
    name: &str,
    how: &How,
) -> Result<Done, EditError> {
    let Memory {
        latents,
        mut history,
        ..
    } = memory;
    if args.undo {
        let (latents, history) = undone(name, history)?;
        return Ok(Done {
            latents,
            history,
            asked: None,
            towards: None,
            warnings: Vec::new(),
        });
    }
    let Some(text) = &args.prompt else {
        history.steps.push(Step::new(*sliders, &latents));
        return Ok(Done {
            latents: studio.edited(&latents, sliders, how)?,
            history,
            asked: Some(*sliders),
            towards: None,
            warnings: Vec::new(),
        });
    };
    let Worded {
        latents: edited,
        sliders,
        towards,
        unread,
    } = studio.worded(&latents, text, how)?;
    history
        .steps
        .push(Step::new(sliders, &latents).worded(text));
    let not_read = (!unread.is_empty()).then(|| format!("not understood: {}", unread.join(", ")));
    Ok(Done {
        latents: edited,
        history,
        // After a way to a thing every attribute has moved.
        asked: towards.is_none().then_some(sliders),
        towards: towards.map(|t| format!("{:.0} % of the way to {:?}", 100.0 * t.share, t.thing)),
        warnings: not_read.into_iter().collect(),
    })
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
