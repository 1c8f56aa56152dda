//! `asperity builtin`.

use super::outputs::Outputs;
use crate::failure::{Failures, one};
use crate::{cli::Builtin, console};
use asperity::{
    builtin,
    pipeline::{Pass, Pipeline, Settings},
};

pub(crate) fn run(args: &Builtin) -> Result<(), Failures> {
    let mut outputs = Outputs::with_model(&args.output, args.emit_model.as_deref());
    outputs.check(&[], None)?;
    let mut pipeline = Pipeline::default();
    let texture = pipeline.run(Pass::Generate, builtin::texture);
    let compiled = pipeline
        .compile(texture, &Settings::default())
        .map_err(one)?;
    outputs.model(&compiled.whole);
    outputs.write(&compiled.lowered.bytes, &mut pipeline)?;
    let lowered = &compiled.lowered;
    console::print(&format!(
        "{}: {} haptic bytes, {} in all, {:.4} dB RMS from LSF quantisation\n",
        compiled.texture.name,
        lowered.haptic_bytes,
        lowered.bytes.len(),
        lowered.lsf_error.rms_db
    ))?;
    console::print_timings(args.timings, pipeline.timings());
    Ok(())
}
