//! `asperity build` of a manifest.

use crate::{
    cli::{Build as Arguments, Inference},
    commands::{inference, timings},
};
use asperity::{
    library::{
        Build, Cache, Lock, Manifest, Pinned, Request, default_folder, manifest::ManifestError,
    },
    pipeline::{Clock, Pass, Pipeline},
    sources::Registry,
    text::TextEncoderChoice,
};
use asperity_console::Console;
use asperity_io::{
    clock::now,
    diagnostic::{Diagnostic, Failures, one},
    input::Reach,
    output::{OutputId, Outputs, display, is_standard_output, write_atomic},
    shown::counted,
};
use serde_json::json;
use std::{
    io::BufWriter,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// Warnings that are printed one by one.
const WARNINGS: usize = 20;

/// Why the options do not go together.
#[derive(Debug, Error)]
enum Usage {
    #[error("{0} applies only to scenes, but the manifest has no [[surface]]")]
    ForScenes(&'static str),
    #[error("{file}: defaults.{key}: {message}", file = file.display())]
    Setup {
        file: PathBuf,
        key: &'static str,
        message: String,
    },
}

impl Diagnostic for Usage {
    fn remedy(&self) -> String {
        match self {
            Self::ForScenes(_) => "leave it out, or add a [[surface]] for every texture".into(),
            Self::Setup { .. } => "correct the value".into(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::ForScenes(_))
    }
}

pub(crate) fn run(
    args: &Arguments,
    text: &str,
    reach: Reach,
    console: Console,
) -> Result<(), Failures> {
    for (given, option) in [
        (args.target.is_some(), "--target"),
        (args.budget_bytes.is_some(), "--budget-bytes"),
    ] {
        if given {
            return Err(one(Usage::ForScenes(option)));
        }
    }
    let mut manifest =
        Manifest::within(&args.scene, text, reach.clone(), &Registry::default()).map_err(boxed)?;
    previews(args, &mut manifest);
    if args.check {
        return checked(args, &manifest, console);
    }
    let mut build = Prepared::new(args, &manifest, &reach, console)?;
    let request = build.request();
    let textures = Build::new(&manifest, &request)?;
    let bar = build.console.rated_bar(textures.len(), "textures");
    let built = textures.run(&|| inference::prompt_compiler(&build.inference), &|| {
        bar.inc(1)
    });
    bar.finish_and_clear();
    let built = built?;
    let mut pipeline = Pipeline::timed(Clock(now));
    pipeline.merge(&built.timings);
    pipeline
        .run(Pass::Write, || {
            let file = build.outputs.file(build.library);
            let written = built.library.write(&mut BufWriter::new(&mut *file));
            written.map_err(|error| file.error("cannot write it", error))?;
            build.outputs.commit()
        })
        .map_err(one)?;
    let console = build.console;
    let warnings = build.pins.told(args, built.warnings, console);
    let output = display(build.output);
    let printed = if args.reporting.json {
        // Plain structures of numbers and strings always serialise.
        let mut json = serde_json::to_value(&built.report).unwrap_or_default();
        json["library"] = output.to_string().into();
        json["stages_ms"] = pipeline.timings().json();
        json["warnings"] = warnings.into();
        console.json(&json)
    } else {
        console.report(&format!("{output}: {}", built.report))
    };
    printed.map_err(one)?;
    timings::print(args.reporting.timings, &pipeline, console);
    Ok(())
}

/// Draws previews as the options say.
pub(crate) fn previews(args: &Arguments, manifest: &mut Manifest) {
    for entry in &mut manifest.entries {
        let size = &mut entry.options.request.preview_px;
        *size = size.and_then(|px| args.preview.px(Some(px)));
    }
}

/// What a build of a manifest needs, scene or not: its outputs, the model, the cache, the lock.
pub(crate) struct Prepared<'a> {
    args: &'a Arguments,
    pub(crate) output: &'a Path,
    pub(crate) outputs: Outputs,
    /// The library among the outputs.
    pub(crate) library: OutputId,
    pub(crate) console: Console,
    pub(crate) inference: Inference,
    pub(crate) pins: Pins,
    cache: Option<Cache>,
}

impl<'a> Prepared<'a> {
    pub(crate) fn new(
        args: &'a Arguments,
        manifest: &Manifest,
        reach: &Reach,
        console: Console,
    ) -> Result<Self, Failures> {
        let inference = setup(&args.inference, manifest)?;
        let output = args.output.as_deref().unwrap_or(Path::new("-"));
        let mut inputs = vec![args.scene.clone()];
        inputs.extend(manifest.sources.iter().cloned());
        inputs.extend(inference::files(&inference));
        let lock = Lock::within(&args.scene, reach).map_err(one)?;
        inputs.push(lock.file().to_owned());
        let mut outputs = Outputs::beside(&inputs);
        let library = outputs.open(output).map_err(one)?;
        let console = console.beside(&outputs);
        let pinned = inference::pinned(&inference)?;
        if args.locked {
            lock.hold(&pinned).map_err(one)?;
        }
        let cache = (!args.no_cache).then(|| Cache::new(cache_folder(args, output)));
        Ok(Self {
            args,
            output,
            outputs,
            library,
            console,
            inference,
            pins: Pins { lock, pinned },
            cache,
        })
    }

    pub(crate) fn request(&self) -> Request<'_> {
        Request {
            cache: self.cache.as_ref(),
            shard: self.args.shard,
            program: inference::program(),
            pinned: self.pins.pinned.clone(),
            clock: Clock(now),
            min_certainty: self.args.min_certainty,
            scratch: (!self.outputs.to_standard_output()).then(|| folder_of(self.output)),
        }
    }
}

/// The lock file, and what it is to pin.
pub(crate) struct Pins {
    lock: Lock,
    pinned: Pinned,
}

impl Pins {
    /// Writes the lock, tells the first of the warnings, and gives all of them.
    pub(crate) fn told(
        &self,
        args: &Arguments,
        mut warnings: Vec<String>,
        console: Console,
    ) -> Vec<String> {
        warnings.extend(pin(args, &self.lock, &self.pinned));
        let shown = warnings.len().min(WARNINGS);
        console.warnings(&warnings[..shown], args.reporting.json);
        if warnings.len() > shown && !args.reporting.json {
            let more = counted(warnings.len() - shown, "more warning", "more warnings");
            console.warn(&format!("{more}; --json lists all of them"));
        }
        warnings
    }
}

fn boxed(errors: Vec<ManifestError>) -> Failures {
    let boxed = errors
        .into_iter()
        .map(|error| Box::new(error) as Box<dyn Diagnostic>);
    boxed.collect()
}

/// What `--check` says of a manifest without a fault.
fn checked(args: &Arguments, manifest: &Manifest, console: Console) -> Result<(), Failures> {
    let count = manifest.entries.len();
    let printed = if args.reporting.json {
        console.json(&json!({ "textures": count, "files": manifest.sources.len() }))
    } else {
        let file = args.scene.display();
        let textures = counted(count, "texture", "textures");
        console.report(&format!("{file}: {textures}, no faults found\n"))
    };
    printed.map_err(one)
}

/// The options of the command, and those of the manifest where the command has the usual ones.
fn setup(options: &Inference, manifest: &Manifest) -> Result<Inference, Failures> {
    let wrong = |key: &'static str, message: String| {
        one(Usage::Setup {
            file: manifest.file.clone(),
            key,
            message,
        })
    };
    let stated = &manifest.setup;
    let mut setup = options.clone();
    if setup.model.is_none() {
        setup.model.clone_from(&stated.model);
    }
    if let (TextEncoderChoice::MiniLm, Some(text)) = (&options.text_encoder, &stated.text_encoder) {
        setup.text_encoder = text.parse().map_err(|e: String| wrong("text_encoder", e))?;
    }
    if let (true, Some(text)) = (options.backend == Default::default(), &stated.backend) {
        setup.backend = text.parse().map_err(|e: String| wrong("backend", e))?;
    }
    Ok(setup)
}

/// Where textures are kept: as the user says, the user's cache, or a folder beside the output.
fn cache_folder(args: &Arguments, output: &Path) -> PathBuf {
    let beside = || {
        let folder = if is_standard_output(output) {
            Path::new("")
        } else {
            folder_of(output)
        };
        folder.join(".asperity-cache")
    };
    let chosen = args.cache.clone().or_else(default_folder);
    chosen.unwrap_or_else(beside)
}

fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Writes the lock file where it says something else; a warning where it changes or cannot be
/// written.
fn pin(args: &Arguments, lock: &Lock, pinned: &Pinned) -> Vec<String> {
    if args.locked {
        return Vec::new();
    }
    let file = lock.file().display();
    let mut warnings: Vec<String> = lock
        .drift(pinned)
        .iter()
        .map(|drift| format!("{file}: {drift}; it pins that now"))
        .collect();
    if let Some(text) = lock.text(pinned)
        && let Err(error) = write_atomic(lock.file(), text.as_bytes())
    {
        warnings.push(format!("{error}: {}; nothing is pinned", error.source));
    }
    warnings
}
