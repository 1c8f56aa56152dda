//! `asperity compile`.

use super::{inference, outputs::TextureOutputs, plot, timings};
use crate::cli::Compile;
use asperity::{
    console::Console,
    diagnostic::{Failures, one},
    output::display,
    pipeline::{Pipeline, PipelineError},
    prompt::{self, Options},
};
use asperity_formats::Asset;

pub(crate) fn run(args: &Compile, console: Console) -> Result<(), Failures> {
    // Before half a second of loading.
    prompt::check(&args.prompt).map_err(one)?;
    let inputs = inference::files(&args.inference);
    let mut outputs = TextureOutputs::open(&inputs, &args.output, args.emit_model.as_deref())?;
    let sheet = outputs.open_if(args.plot.as_deref())?;
    let console = outputs.console(console);
    let author = inference::author(&args.inference)?;
    let options = Options {
        seed: args.seed,
        fidelity: args.fidelity,
        rate_hz: args.rate,
        preview: !args.no_preview,
        preview_px: args.preview_size,
    };
    let authored = author.author(&args.prompt, &options).map_err(one)?;
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
        console.json(&authored.json())
    } else {
        console.text(&format!("{}\n{}", display(&args.output), authored.text()))
    };
    printed.map_err(one)?;
    timings::print(args.timings, &pipeline, console);
    Ok(())
}
