//! `asperity builtin`.

use crate::failure::{Failures, one};
use crate::{cli::Builtin, console};
use asperity::{builtin, lower, output, verify};

pub(crate) fn run(args: &Builtin) -> Result<(), Failures> {
    let texture = builtin::texture();
    let lowered = lower::lower(&texture, None).map_err(one)?;
    verify::verify(&texture, &lowered.bytes).map_err(one)?;
    output::write_atomic(&args.output, &lowered.bytes).map_err(one)?;
    console::print(&format!(
        "{}: {} haptic bytes, {} in all, {:.4} dB RMS from LSF quantisation\n",
        texture.name,
        lowered.haptic_bytes,
        lowered.bytes.len(),
        lowered.lsf_error.rms_db
    ))
}
