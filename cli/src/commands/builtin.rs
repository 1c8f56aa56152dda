//! `asperity builtin`.

use super::one_texture::{Job, RequestedOutputs};
use crate::cli::Builtin as Arguments;
use asperity::{
    pipeline::Request,
    sources::{Tools, builtin::Builtin},
};
use asperity_console::Console;
use asperity_io::diagnostic::Failures;

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let requested = RequestedOutputs {
        emit_model: args.emit_model.as_deref(),
        ..RequestedOutputs::of(&args.output, args.reporting)
    };
    let job = Job::open(requested, &[], console)?;
    job.run(&Builtin, &Request::default(), &Tools::default())
}
