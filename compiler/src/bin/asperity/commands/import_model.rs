//! `asperity import model`.

use super::outputs::Outputs;
use crate::{
    cli::ImportModel,
    console,
    failure::{Failures, one},
};
use asperity::{
    model_file::{self, Options},
    pipeline::Pipeline,
};

pub(crate) fn run(args: &ImportModel) -> Result<(), Failures> {
    let outputs = Outputs::new(&args.output);
    outputs.check(&[&args.input], None)?;
    let options = Options {
        fidelity: args.fidelity,
        rate_hz: args.rate,
        preview: !args.no_preview,
    };
    let imported = model_file::import(&args.input, &options).map_err(one)?;
    let mut pipeline = Pipeline::default();
    pipeline.merge(&imported.timings);
    outputs.write(&imported.bytes, &mut pipeline)?;
    if args.json {
        console::print(&format!("{:#}\n", imported.json()))?;
    } else {
        console::print(&format!("{}\n", imported.report))?;
    }
    console::print_timings(args.timings, pipeline.timings());
    Ok(())
}
