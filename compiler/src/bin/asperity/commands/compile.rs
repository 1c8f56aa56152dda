//! `asperity compile`.

use super::{inference, outputs::Outputs, plot};
use crate::failure::{Failures, one};
use crate::{cli::Compile, console};
use asperity::{
    pipeline::{Pipeline, PipelineError},
    prompt::{Options, PromptError},
};
use asperity_formats::Asset;

pub(crate) fn run(args: &Compile, quiet: bool) -> Result<(), Failures> {
    // Before half a second of loading.
    if args.prompt.trim().is_empty() {
        return Err(one(PromptError::Empty));
    }
    let mut outputs = Outputs::with_model(&args.output, args.emit_model.as_deref());
    outputs.check(&[], args.plot.as_deref())?;
    let author = inference::author(&args.inference)?;
    let options = Options {
        seed: args.seed,
        fidelity: args.fidelity,
        rate_hz: args.rate,
        preview: !args.no_preview,
    };
    let authored = author.author(&args.prompt, &options).map_err(one)?;
    if let Some(file) = &args.plot {
        // Verified a moment ago: the bytes parse.
        let asset = Asset::parse(&authored.lowered.bytes)
            .map_err(|cause| one(PipelineError::Verify(cause.into())))?;
        outputs.beside(file, plot::drawn(&asset)?);
    }
    outputs.model(&authored.whole);
    let mut pipeline = Pipeline::default();
    pipeline.merge(&authored.timings);
    outputs.write(&authored.lowered.bytes, &mut pipeline)?;
    if !quiet {
        for warning in authored.warnings() {
            eprintln!("warning: {warning}");
        }
    }
    if args.json {
        console::print(&format!("{:#}\n", authored.json()))?;
    } else {
        console::print(&format!("{}\n{}", args.output.display(), authored.text()))?;
    }
    console::print_timings(args.timings, pipeline.timings());
    Ok(())
}
