//! `asperity compile`.

use super::{inference, plot};
use crate::failure::{Failures, one};
use crate::{cli::Compile, console};
use asperity::{
    output,
    prompt::{Options, PromptError},
};
use asperity_formats::Asset;

pub(crate) fn run(args: &Compile, quiet: bool) -> Result<(), Failures> {
    // Before half a second of loading.
    if args.prompt.trim().is_empty() {
        return Err(one(PromptError::Empty));
    }
    let author = inference::author(&args.inference)?;
    let options = Options {
        seed: args.seed,
        fidelity: args.fidelity,
        rate_hz: args.rate,
        preview: !args.no_preview,
    };
    let authored = author.author(&args.prompt, &options).map_err(one)?;
    output::write_atomic(&args.output, &authored.lowered.bytes).map_err(one)?;
    if let Some(file) = &args.plot {
        // Verified a moment ago: the bytes parse.
        let asset = Asset::parse(&authored.lowered.bytes)
            .map_err(|cause| one(PromptError::Verify(cause.into())))?;
        plot::draw(&asset, file)?;
    }
    if !quiet {
        for warning in authored.warnings() {
            eprintln!("warning: {warning}");
        }
    }
    if args.json {
        return console::print(&format!("{:#}\n", authored.json()));
    }
    console::print(&format!("{}\n{}", args.output.display(), authored.text()))
}
