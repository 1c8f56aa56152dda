//! `asperity import hatt`.

use super::{inference, many_textures::Target};
use crate::cli::ImportHatt;
use asperity::{
    library::model_files,
    pipeline::Request,
    sources::{
        Tools,
        hatt::{self, Hatt},
    },
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn run(args: &ImportHatt, console: Console) -> Result<(), Failures> {
    let files = hatt::files(&args.input).map_err(one)?;
    let mut inputs = files.clone();
    inputs.extend(model_files(args.model.as_deref()));
    let target = Target::open(
        &args.input,
        &args.output,
        args.emit_model.as_deref(),
        files.len(),
        &inputs,
    )?;
    let completer = args
        .complete_taps
        .then(|| inference::completer(args.model.as_deref()))
        .transpose()?;
    let hatt = |file| Hatt {
        file,
        complete_taps: args.complete_taps,
    };
    let materials: Vec<Hatt> = files.into_iter().map(hatt).collect();
    let request = Request {
        fidelity: args.fidelity,
        ..Request::default()
    };
    let tools = Tools {
        model: completer.as_ref(),
        ..Tools::default()
    };
    let check = |results: &mut Vec<_>| hatt::refuse_namesakes(&materials, results);
    let context = (&inputs[..], args.timings, console);
    target.import(&materials, &request, &tools, check, context)
}
