//! `asperity import model`, `haptic`, `ahap`, `hjif`, `recording` and `surface`.

use super::{
    inference,
    many_textures::Target,
    one_texture::{Job, RequestedOutputs, request},
};
use crate::cli::{ImportEffects, ImportModel, ImportRecording, ImportSurface, MeasuredTexture};
use asperity::{
    library::model_files,
    pipeline::Request,
    sources::{
        Source, Tools,
        effects::{Effects, EffectsKind, Options},
        model_file::ModelFile,
        prompt,
        recording::RecordingFolder,
        surface::{self, Options as SurfaceOptions, Size, Surface},
    },
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, Fault, one};
use std::path::Path;

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
    let job = Job::open(args.texture.outputs(&args.output), &inputs, console)?;
    let model = inference::completer(args.model.as_deref())?;
    let tools = Tools {
        model: Some(&model),
        ..Tools::default()
    };
    job.run(&source, &args.texture.request(), &tools)
}

impl MeasuredTexture {
    fn outputs<'a>(&'a self, output: &'a Path) -> RequestedOutputs<'a> {
        RequestedOutputs {
            emit_model: self.emit_model.as_deref(),
            plot: self.plot.as_deref(),
            report: self.report.as_deref(),
            ..RequestedOutputs::of(output, self.reporting)
        }
    }

    fn request(&self) -> Request {
        request(self.fidelity, self.rate, &self.preview)
    }
}

pub(crate) fn surface(args: &ImportSurface, console: Console) -> Result<(), Failures> {
    let options = &args.texture;
    if let Some(like) = &args.like {
        prompt::check(like).map_err(one)?;
    }
    let surface = |path| Surface {
        path,
        options: SurfaceOptions {
            size: Size {
                width_mm: args.width_mm,
                depth_mm: args.depth_mm,
            },
            like: args.like.clone(),
            tip: args.tip,
            convention: args.normal,
        },
    };
    let extension = args.output.extension().unwrap_or_default();
    let names_folder = args.output.to_string_lossy().ends_with(['/', '\\']) || args.output.is_dir();
    let many = extension.eq_ignore_ascii_case("aspl") || names_folder;
    let single = [
        ("--name", args.name.is_some()),
        ("--plot", options.plot.is_some()),
        ("--report", options.report.is_some()),
        ("--json", options.reporting.json),
    ];
    if let (true, Some((option, _))) = (many, single.iter().find(|(_, stated)| *stated)) {
        let what = format!(
            "{option} is of one texture, and {} takes many",
            args.output.display()
        );
        let remedy = "leave it out, or give an output that ends in .asp";
        return Err(one(Fault::new(what, remedy).usage()));
    }
    let sources: Vec<Surface> = match many {
        true => surface::all(&args.path).map_err(one)?,
        false => vec![args.path.clone()],
    }
    .into_iter()
    .map(surface)
    .collect();
    let setup = args.inference.setup();
    let mut inputs: Vec<_> = sources.iter().flat_map(Source::inputs).collect();
    inputs.extend(setup.files());
    let request = Request {
        name: args.name.clone().filter(|_| !many),
        ..options.request()
    };
    if many {
        let emit_model = options.emit_model.as_deref();
        let target = Target::open(&args.path, &args.output, emit_model, sources.len(), &inputs)?;
        let prompt_compiler = setup.prompt_compiler()?;
        let tools = Tools::of(&prompt_compiler);
        let context = (&inputs[..], options.reporting.timings, console);
        return target.import(&sources, &request, &tools, |_| (), context);
    }
    let job = Job::open(options.outputs(&args.output), &inputs, console)?;
    let prompt_compiler = setup.prompt_compiler()?;
    job.run(&sources[0], &request, &Tools::of(&prompt_compiler))
}
