//! `asperity builtin`.

use super::{outputs::TextureOutputs, timings};
use crate::cli::Builtin;
use asperity::{
    builtin,
    pipeline::{Pass, Pipeline, Request, Ringing},
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &Builtin, console: Console) -> Result<(), Failures> {
    let mut outputs = TextureOutputs::open(&[], &args.output, args.emit_model.as_deref())?;
    let console = outputs.console(console);
    let mut pipeline = Pipeline::default();
    let texture = pipeline.run(Pass::Generate, builtin::texture);
    let compiled = pipeline
        .compile(texture, &Request::default(), Ringing::Refused)
        .map_err(one)?;
    outputs.model(&compiled.whole);
    outputs.write(&compiled.lowered.bytes, &mut pipeline)?;
    let lowered = &compiled.lowered;
    let report = format!(
        "{}: {} haptic bytes, {} in all, {:.4} dB RMS from LSF quantisation\n",
        compiled.texture.name,
        lowered.haptic_bytes,
        lowered.bytes.len(),
        lowered.lsf_error.rms_db
    );
    console.report(&report).map_err(one)?;
    timings::print(args.timings, &pipeline, console);
    Ok(())
}
