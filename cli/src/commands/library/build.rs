//! `asperity build` of a manifest.

use crate::{
    cli::Build as Arguments,
    commands::{inference, timings},
};
use asperity::{
    library::{Build, BuildFile, Cache, Lock, Manifest, Pinned, Request, Setup},
    pipeline::{Clock, Pass, Pipeline},
    sources::Registry,
};
use asperity_console::Console;
use asperity_io::{
    clock::now,
    diagnostic::{Failures, Fault, all, one},
    input::Reach,
    output::{OutputId, Outputs, display, is_standard_output},
    shown::counted,
};
use serde_json::json;
use std::{io::BufWriter, path::Path};

/// Warnings that are printed one by one.
const WARNINGS: usize = 20;

pub(crate) fn run(args: &Arguments, build: BuildFile, console: Console) -> Result<(), Failures> {
    for (given, option) in [
        (args.target.is_some(), "--target"),
        (args.budget_bytes.is_some(), "--budget-bytes"),
    ] {
        if given {
            let what =
                format!("{option} applies only to scenes, but the manifest has no [[surface]]");
            let remedy = "leave it out, or add a [[surface]] for every texture";
            return Err(one(Fault::new(what, remedy).usage()));
        }
    }
    let BuildFile { text, reach, .. } = build;
    let mut manifest =
        Manifest::within(&args.scene, &text, reach.clone(), &Registry::default()).map_err(all)?;
    previews(args, &mut manifest);
    if args.check {
        return checked(args, &manifest, console);
    }
    let mut build = Prepared::new(args, &manifest, &reach, console)?;
    let request = build.request();
    let textures = Build::new(&manifest, &request)?;
    let bar = build.console.rated_bar(textures.len(), "textures");
    let built = textures.run(&|| build.setup.prompt_compiler(), &|| bar.inc(1));
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

/// Prerequisites of a manifest build, with or without a scene: outputs, model, cache, lock.
pub(crate) struct Prepared<'a> {
    args: &'a Arguments,
    pub(crate) output: &'a Path,
    pub(crate) outputs: Outputs,
    /// The library among the outputs.
    pub(crate) library: OutputId,
    pub(crate) console: Console,
    pub(crate) setup: Setup,
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
        let setup = args.inference.setup().within(manifest)?;
        let output = args.output.as_deref().unwrap_or(Path::new("-"));
        let mut inputs = vec![args.scene.clone()];
        inputs.extend(manifest.sources.iter().cloned());
        inputs.extend(setup.files());
        let lock = Lock::within(&args.scene, reach).map_err(one)?;
        inputs.push(lock.file().to_owned());
        let mut outputs = Outputs::beside(&inputs);
        let library = outputs.open(output).map_err(one)?;
        let console = console.beside(&outputs);
        let pinned = setup.pinned()?;
        if args.locked {
            lock.hold(&pinned).map_err(one)?;
        }
        let cache = (!args.no_cache).then(|| Cache::chosen(args.cache.clone(), folder_of(output)));
        Ok(Self {
            args,
            output,
            outputs,
            library,
            console,
            setup,
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
            stop: None,
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
        if !args.locked {
            warnings.extend(self.lock.update(&self.pinned));
        }
        let shown = warnings.len().min(WARNINGS);
        console.warnings(&warnings[..shown], args.reporting.json);
        if warnings.len() > shown && !args.reporting.json {
            let more = counted(warnings.len() - shown, "more warning", "more warnings");
            console.warn(&format!("{more}; --json lists all of them"));
        }
        warnings
    }
}

/// Prints the result of `--check` for a manifest without faults.
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

/// The folder of an output; that of a pipe is where the command runs.
fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if folder != Path::new("") && !is_standard_output(file) => folder,
        _ => Path::new("."),
    }
}
