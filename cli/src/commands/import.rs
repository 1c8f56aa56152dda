//! `asperity import model`, `haptic`, `ahap`, `hjif` and `recording`.

use super::{
    inference,
    one_texture::{Job, Wanted, request},
};
use crate::cli::{ImportEffects, ImportModel, ImportRecording};
use asperity::{
    library::model_files,
    pipeline::Request,
    sources::{
        Source, Tools,
        effects::{Effects, Kind, Options},
        model_file::ModelFile,
        recording::RecordingFolder,
    },
};
use asperity_console::Console;
use asperity_io::diagnostic::Failures;

pub(crate) fn model(args: &ImportModel, console: Console) -> Result<(), Failures> {
    let source = ModelFile {
        file: args.input.clone(),
    };
    let wanted = Wanted::of(&args.output, args.reporting);
    let request = request(args.fidelity, args.rate, &args.preview);
    let job = Job::open(wanted, &source.inputs(), console)?;
    job.run(&source, &request, &Tools::default())
}

pub(crate) fn effects(args: &ImportEffects, kind: Kind, console: Console) -> Result<(), Failures> {
    let source = Effects {
        file: args.input.clone(),
        kind,
        options: Options {
            speed_mm_s: args.speed.into(),
            force_n: args.force.into(),
            full_scale_m_s2: args.full_scale.into(),
            tap_full_scale_m_s2: args.tap_full_scale.into(),
            tap_speed_m_s: args.tap_speed.into(),
            mu: args.mu.into(),
        },
    };
    let wanted = Wanted::of(&args.output, args.reporting);
    let request = Request {
        name: args.name.clone(),
        ..request(args.fidelity, args.rate, &args.preview)
    };
    let job = Job::open(wanted, &source.inputs(), console)?;
    job.run(&source, &request, &Tools::default())
}

pub(crate) fn recording(args: &ImportRecording, console: Console) -> Result<(), Failures> {
    let source = RecordingFolder {
        folder: args.folder.clone(),
        force: args.force,
    };
    let mut inputs = source.inputs();
    inputs.extend(model_files(args.model.as_deref()));
    let wanted = Wanted {
        emit_model: args.emit_model.as_deref(),
        plot: args.plot.as_deref(),
        report: args.report.as_deref(),
        ..Wanted::of(&args.output, args.reporting)
    };
    let request = request(args.fidelity, args.rate, &args.preview);
    let job = Job::open(wanted, &inputs, console)?;
    let model = inference::completer(args.model.as_deref())?;
    let tools = Tools {
        model: Some(&model),
        ..Tools::default()
    };
    job.run(&source, &request, &tools)
}
