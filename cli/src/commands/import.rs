//! `asperity import model`, `haptic`, `ahap`, `hjif`, `recording` and `surface`.

use super::{
    inference,
    one_texture::{Job, RequestedOutputs, request},
};
use crate::cli::{ImportEffects, ImportModel, ImportRecording, ImportSurface, TipChoice};
use asperity::{
    library::model_files,
    pipeline::Request,
    sources::{
        Source, Tools,
        effects::{Effects, EffectsKind, Options},
        model_file::ModelFile,
        prompt,
        recording::RecordingFolder,
        surface::{Options as SurfaceOptions, Size, Surface, Tip},
    },
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};

pub(crate) fn model(args: &ImportModel, console: Console) -> Result<(), Failures> {
    let source = ModelFile {
        file: args.input.clone(),
    };
    let requested = RequestedOutputs::of(&args.output, args.reporting);
    let request = request(args.fidelity, args.rate, &args.preview);
    let job = Job::open(requested, &source.inputs(), console)?;
    job.run(&source, &request, &Tools::default())
}

pub(crate) fn effects(
    args: &ImportEffects,
    kind: EffectsKind,
    console: Console,
) -> Result<(), Failures> {
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
    let requested = RequestedOutputs::of(&args.output, args.reporting);
    let request = Request {
        name: args.name.clone(),
        ..request(args.fidelity, args.rate, &args.preview)
    };
    let job = Job::open(requested, &source.inputs(), console)?;
    job.run(&source, &request, &Tools::default())
}

pub(crate) fn recording(args: &ImportRecording, console: Console) -> Result<(), Failures> {
    let source = RecordingFolder {
        folder: args.folder.clone(),
        force: args.force,
    };
    let mut inputs = source.inputs();
    inputs.extend(model_files(args.model.as_deref()));
    let requested = RequestedOutputs {
        emit_model: args.emit_model.as_deref(),
        plot: args.plot.as_deref(),
        report: args.report.as_deref(),
        ..RequestedOutputs::of(&args.output, args.reporting)
    };
    let request = request(args.fidelity, args.rate, &args.preview);
    let job = Job::open(requested, &inputs, console)?;
    let model = inference::completer(args.model.as_deref())?;
    let tools = Tools {
        model: Some(&model),
        ..Tools::default()
    };
    job.run(&source, &request, &tools)
}

pub(crate) fn surface(args: &ImportSurface, console: Console) -> Result<(), Failures> {
    if let Some(like) = &args.like {
        prompt::check(like).map_err(one)?;
    }
    let source = Surface {
        path: args.path.clone(),
        options: SurfaceOptions {
            size: Size {
                width_mm: args.width_mm,
                depth_mm: args.depth_mm,
            },
            like: args.like.clone(),
            convention: args.normal,
            tip: match args.tip {
                TipChoice::Stylus => Tip::STYLUS,
                TipChoice::Fingertip => Tip::FINGERTIP,
                TipChoice::Needle => Tip::NEEDLE,
            },
        },
    };
    let setup = args.inference.setup();
    let mut inputs = source.inputs();
    inputs.extend(setup.files());
    let requested = RequestedOutputs {
        emit_model: args.emit_model.as_deref(),
        report: args.report.as_deref(),
        ..RequestedOutputs::of(&args.output, args.reporting)
    };
    let request = Request {
        name: args.name.clone(),
        ..request(args.fidelity, args.rate, &args.preview)
    };
    let job = Job::open(requested, &inputs, console)?;
    if args.like.is_some() {
        let prompt_compiler = setup.prompt_compiler()?;
        return job.run(&source, &request, &Tools::of(&prompt_compiler));
    }
    let model = inference::completer(args.inference.model.as_deref())?;
    let tools = Tools {
        model: Some(&model),
        ..Tools::default()
    };
    job.run(&source, &request, &tools)
}
