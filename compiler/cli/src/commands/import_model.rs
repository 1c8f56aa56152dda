//! `asperity import model`.

use super::{outputs::TextureOutputs, timings};
use crate::cli::ImportModel;
use asperity::{
    model_file,
    pipeline::{Pipeline, Request},
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &ImportModel, console: Console) -> Result<(), Failures> {
    let outputs = TextureOutputs::open(std::slice::from_ref(&args.input), &args.output, None)?;
    let console = outputs.console(console);
    let request = Request {
        fidelity: args.fidelity,
        rate_hz: args.rate,
        preview_px: (!args.no_preview).then_some(args.preview_size),
    };
    let imported = model_file::import(&args.input, &request).map_err(one)?;
    let mut pipeline = Pipeline::default();
    pipeline.merge(&imported.timings);
    outputs.write(&imported.bytes, &mut pipeline)?;
    let printed = if args.json {
        console.json(&imported.json())
    } else {
        console.report(&format!("{}\n", imported.report))
    };
    printed.map_err(one)?;
    timings::print(args.timings, &pipeline, console);
    Ok(())
}
