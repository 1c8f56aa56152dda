//! `asperity compile`.

use super::{diffusion, inference, outputs::TextureOutputs, plot, timings};
use crate::cli::Compile;
use asperity::{
    diffusion::framed,
    edit::{EditError, Studio, explain, remember_prompt},
    pipeline::{Pipeline, PipelineError, Request},
    prompt::{self, Options},
};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Failures, one},
    output::display,
};

pub(crate) fn run(args: &Compile, console: Console) -> Result<(), Failures> {
    // Before half a second of loading.
    prompt::check(&args.prompt).map_err(one)?;
    let mut inputs = inference::files(&args.inference);
    inputs.extend(diffusion::files(&args.diffusion));
    let mut outputs = TextureOutputs::open(&inputs, &args.output, args.emit_model.as_deref())?;
    let sheet = outputs.open_if(args.plot.as_deref())?;
    let console = outputs.console(console);
    let author = inference::author(&args.inference)?;
    // One that is painted takes its place.
    let is_drawn = !args.no_preview && args.diffusion.diffusion.is_none();
    let options = Options {
        seed: args.seed,
        request: Request {
            fidelity: args.fidelity,
            rate_hz: args.rate,
            preview_px: is_drawn.then_some(args.preview_size),
            ..Request::default()
        },
    };
    let mut authored = author.author(&args.prompt, &options).map_err(one)?;
    let mut painted = None;
    if let Some(folder) = &args.diffusion.diffusion {
        let drawn = diffusion::drawn(
            folder,
            &args.diffusion,
            framed(args.prompt.trim()),
            args.seed,
            Some(args.preview_size),
            console,
        )?;
        let png = drawn.compact_png().map_err(one)?;
        authored.illustrate(png, &drawn.note).map_err(one)?;
        painted = Some(drawn.note);
    }
    remember_prompt(&author, &mut authored).map_err(|error| one(EditError::from(error)))?;
    let studio = Studio::new(&author, author.model().crc32());
    let explanation = args.explain.then(|| explain(&studio, &args.prompt));
    let explanation = explanation.transpose().map_err(one)?;
    if let Some(file) = sheet {
        // Verified a moment ago: the bytes parse.
        let asset = Asset::parse(&authored.lowered.bytes)
            .map_err(|cause| one(PipelineError::Verify(cause.into())))?;
        outputs.beside(file, plot::drawn(&asset)?);
    }
    outputs.model(&authored.whole);
    let mut pipeline = Pipeline::default();
    pipeline.merge(&authored.timings);
    outputs.write(&authored.lowered.bytes, &mut pipeline)?;
    console.warnings(&authored.warnings(), args.json);
    let printed = if args.json {
        let mut json = authored.json();
        if let Some(explanation) = &explanation {
            // Plain structures of numbers and strings always serialise.
            json["words"] = serde_json::to_value(&explanation.words).unwrap_or_default();
        }
        if let Some(note) = painted {
            json["preview"] = note.into();
        }
        console.json(&json)
    } else {
        let words = explanation
            .as_ref()
            .map_or_else(String::new, |found| found.text());
        let preview = painted.map_or_else(String::new, |note| format!("  preview      {note}\n"));
        let report = format!("{}\n{}{preview}", display(&args.output), authored.text());
        console.report(&report).and_then(|()| console.text(&words))
    };
    printed.map_err(one)?;
    timings::print(args.timings, &pipeline, console);
    Ok(())
}
