//! `asperity.build`.

use crate::{
    arguments::Preview,
    author::{self, networks},
    error::Failure,
    library::Library,
    watch::{Steps, watched},
};
use asperity::{
    emit::textures::Textures,
    learned::Certainty,
    library::{Build, BuildFile, Cache, Lock, Manifest, Packed, Request, Setup, Shard},
    pipeline::Clock,
    scene::{self, Budget, Description, Target},
    sources::Registry,
};
use asperity_io::{
    clock::now,
    diagnostic::{Failures, all},
    output::Outputs,
};
use pyo3::prelude::*;
use serde_json::Value;
use std::{
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
    str::FromStr,
};

/// Warnings that are issued; the report has all of them.
const WARNINGS: usize = 20;

/// Where textures are kept between builds.
#[derive(FromPyObject)]
pub(crate) enum Kept {
    /// In the folder of the user, or nowhere.
    Usual(bool),
    /// In this folder.
    Folder(PathBuf),
}

/// Builds a library from a manifest, or a scene from one with surfaces, as ``asperity build`` does.
///
/// The same files give the same bytes as the command, whatever the number of threads and the cache.
/// ``MANIFEST.lock`` pins the model and the versions. Other threads run meanwhile. Ctrl-C stops the
/// build once the textures that are being compiled are in the cache.
///
/// Parameters
/// ----------
/// manifest : str or os.PathLike
///     The manifest (.toml, .csv, .jsonl), as ``docs/libraries.md`` describes it, or the scene
///     (.toml) of ``docs/scenes.md``.
/// path : str or os.PathLike, optional
///     The library to write (.aspl), in full or not at all. Without it, memory holds the library.
/// model : str or os.PathLike, optional
///     A model folder; the manifest's or the embedded model by default.
/// text_encoder : str, default "minilm"
///     ``"minilm"`` or ``"clip:DIR"``.
/// backend : {"portable", "onnxruntime"}, default "portable"
///     What runs the networks.
/// preview : bool or int, default True
///     Whether textures keep their previews, or the size of all of them in pixels.
/// cache : bool or str or os.PathLike, default True
///     Whether textures are kept between builds, or the folder for them.
/// shard : str, optional
///     One part of several, e.g. ``"1/4"``; `merge` joins them.
/// locked : bool, default False
///     Whether a model or a version that differs from the lock file is an error.
/// confined : bool, default False
///     Whether the manifest may name files in its own folder alone.
/// min_certainty : {"known", "close", "guess"}, optional
///     The least certainty of a prompt.
/// target : str, optional
///     Of a scene: what a tick must fit into, e.g. ``"cortex-m4f@168MHz"`` or ``"2500"``.
/// share : float, default 50
///     Of a scene: percentage of the target's clock cycles that a tick may use.
/// budget_bytes : int, optional
///     Of a scene: largest size of the library, bytes.
/// progress : callable, optional
///     Called now and then with the textures that are done and all of them, on this thread.
///
/// Returns
/// -------
/// Library or Scene
///     With what the build did as `Library.report`.
///
/// Warns
/// -----
/// AsperityWarning
///     For the first 20 of the warnings in the report.
///
/// Raises
/// ------
/// UsageError
///     For options that make no sense, or do not go together.
/// AsperityError
///     With every line of the manifest that is wrong, or every texture that failed.
#[pyfunction]
#[pyo3(
    signature = (
        manifest, path=None, *, model=None, text_encoder="minilm", backend="portable",
        preview=Preview::Usual, cache=Kept::Usual(true), shard=None, locked=false, confined=false,
        min_certainty=None, target=None, share=50.0, budget_bytes=None, progress=None
    ),
    text_signature = "(manifest, path=None, *, model=None, text_encoder='minilm', \
                      backend='portable', preview=True, cache=True, shard=None, locked=False, \
                      confined=False, min_certainty=None, target=None, share=50.0, \
                      budget_bytes=None, progress=None)"
)]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn build(
    py: Python<'_>,
    manifest: PathBuf,
    path: Option<PathBuf>,
    model: Option<PathBuf>,
    text_encoder: &str,
    backend: &str,
    preview: Preview,
    cache: Kept,
    shard: Option<&str>,
    locked: bool,
    confined: bool,
    min_certainty: Option<&str>,
    target: Option<&str>,
    share: f64,
    budget_bytes: Option<u64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    if !(share > 0.0 && share <= 100.0) {
        let message = format!("share = {share}: not a percentage above 0 and at most 100");
        return Err(Failure::usage(message, "leave it out, or give e.g. share=50").into());
    }
    let certainty = |text: &str| {
        let rule = |()| "known, close or guess".to_owned();
        text.parse::<Certainty>().map_err(rule)
    };
    let job = Job {
        manifest,
        path,
        setup: networks(model, text_encoder, backend)?,
        preview,
        cache,
        shard: parsed("shard", shard, Shard::from_str)?,
        locked,
        confined,
        min_certainty: parsed("min_certainty", min_certainty, certainty)?,
        budget: Budget {
            target: parsed("target", target, Target::from_str)?,
            share: share / 100.0,
            bytes: budget_bytes,
        },
        program: program(py)?,
    };
    let (library, warnings) = watched(py, progress, |steps| job.run(steps))??;
    author::warn(py, &warnings[..warnings.len().min(WARNINGS)])?;
    library.into_python(py)
}

/// The value of an argument that is text.
fn parsed<T>(
    name: &str,
    text: Option<&str>,
    parse: impl Fn(&str) -> Result<T, String>,
) -> Result<Option<T>, Failure> {
    let parse = |text: &str| {
        parse(text).map_err(|rule| {
            let message = format!("{name} = {text:?}: not {rule}");
            Failure::usage(message, "leave it out, or give one of these")
        })
    };
    text.map(parse).transpose()
}

/// This module to the byte, because two builds of one version may give other textures, and a cache
/// tells them apart. One that cannot be read counts by its version alone.
fn program(py: Python<'_>) -> PyResult<String> {
    let file: PathBuf = py
        .import("asperity._native")?
        .getattr("__file__")?
        .extract()?;
    let crc32 = py.detach(|| std::fs::read(file).map_or(0, |bytes| crc32fast::hash(&bytes)));
    Ok(format!("python {} {crc32:08x}", env!("CARGO_PKG_VERSION")))
}

/// Arguments of a build.
struct Job {
    manifest: PathBuf,
    path: Option<PathBuf>,
    setup: Setup,
    preview: Preview,
    cache: Kept,
    shard: Option<Shard>,
    locked: bool,
    confined: bool,
    min_certainty: Option<Certainty>,
    budget: Budget,
    program: String,
}

/// Result of a build, and its report.
struct Built {
    content: Content,
    report: Value,
    warnings: Vec<String>,
}

/// The bytes of a scene, or the textures of a library, which a temporary file may hold.
enum Content {
    Scene(Vec<u8>),
    Library(Packed),
}

impl Content {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Scene(bytes) => out.write_all(bytes).and_then(|()| out.flush()),
            Self::Library(packed) => packed.write(out),
        }
    }
}

impl Job {
    /// The library and its warnings.
    fn run(&self, steps: &Steps) -> Result<(Library, Vec<String>), Failure> {
        let file = BuildFile::read(&self.manifest, self.confined).map_err(Failure::all)?;
        let registry = Registry::default();
        let BuildFile { text, reach, .. } = &file;
        if file.is_scene {
            if self.shard.is_some() {
                return Err(apart("shard", "libraries", "remove the surfaces"));
            }
            let description = Description::within(&file.file, text, reach.clone(), &registry);
            let mut description = description.map_err(Failure::all)?;
            self.previews(&mut description.manifest);
            steps.of(description.worn().len());
            let (budget, done) = (&self.budget, || steps.done());
            return self.built(&file, &description.manifest, steps, |request, setup| {
                let open = || setup.prompt_compiler();
                let built = scene::build(&description, budget, request, &open, &done)?;
                Ok(Built {
                    content: Content::Scene(built.bytes),
                    report: value(&built.report),
                    warnings: built.warnings,
                })
            });
        }
        for (given, name) in [
            (self.budget.target.is_some(), "target"),
            (self.budget.bytes.is_some(), "budget_bytes"),
        ] {
            if given {
                return Err(apart(name, "scenes", "add a [[surface]] for every texture"));
            }
        }
        let manifest = Manifest::within(&file.file, text, reach.clone(), &registry);
        let mut manifest = manifest.map_err(|faults| Failure::all(all(faults)))?;
        self.previews(&mut manifest);
        self.built(&file, &manifest, steps, |request, setup| {
            let build = Build::new(&manifest, request)?;
            steps.of(build.len());
            let built = build.run(&|| setup.prompt_compiler(), &|| steps.done())?;
            let mut report = value(&built.report);
            report["stages_ms"] = built.timings.json();
            Ok(Built {
                content: Content::Library(built.library),
                report,
                warnings: built.warnings,
            })
        })
    }

    /// Draws previews as the argument says.
    fn previews(&self, manifest: &mut Manifest) {
        for entry in &mut manifest.entries {
            let size = &mut entry.options.request.preview_px;
            *size = size.and_then(|px| self.preview.px_or(Some(px)));
        }
    }

    /// Opens the output and holds the lock, builds, then writes both.
    fn built(
        &self,
        file: &BuildFile,
        manifest: &Manifest,
        steps: &Steps,
        build: impl FnOnce(&Request<'_>, &Setup) -> Result<Built, Failures>,
    ) -> Result<(Library, Vec<String>), Failure> {
        let setup = self.setup.within(manifest).map_err(Failure::all)?;
        let lock = Lock::within(&file.file, &file.reach)?;
        let mut inputs = vec![file.file.clone(), lock.file().to_owned()];
        inputs.extend(manifest.sources.iter().cloned());
        inputs.extend(setup.files());
        let mut outputs = Outputs::beside(&inputs);
        let output = outputs.open_if(self.path.as_deref())?;
        let pinned = setup.pinned().map_err(Failure::all)?;
        if self.locked {
            lock.hold(&pinned)?;
        }
        let folder = self.path.as_deref().and_then(Path::parent);
        let folder = folder.filter(|folder| *folder != Path::new(""));
        let beside = folder.unwrap_or(Path::new("."));
        let cache = match &self.cache {
            Kept::Usual(false) => None,
            Kept::Usual(true) => Some(Cache::chosen(None, beside)),
            Kept::Folder(folder) => Some(Cache::new(folder.clone())),
        };
        let request = Request {
            cache: cache.as_ref(),
            shard: self.shard,
            program: self.program.clone(),
            pinned: pinned.clone(),
            clock: Clock(now),
            min_certainty: self.min_certainty,
            scratch: self.path.as_ref().map(|_| beside),
            stop: Some(&steps.stop),
        };
        let Built {
            content,
            mut report,
            mut warnings,
        } = build(&request, &setup).map_err(Failure::all)?;
        let library = match (&self.path, output) {
            (Some(path), Some(output)) => {
                let target = outputs.file(output);
                let written = content.write(&mut BufWriter::new(&mut *target));
                written.map_err(|error| target.error("cannot write it", error))?;
                outputs.commit()?;
                let textures = Textures::open(path)?;
                Library::in_file(textures.names().unwrap_or_default(), textures)
            }
            _ => {
                let mut bytes = Vec::new();
                let failed = |error| Failure::new(error, "free memory or disk space");
                content.write(&mut bytes).map_err(failed)?;
                Library::in_memory(bytes)?
            }
        };
        if !self.locked {
            warnings.extend(lock.update(&pinned));
        }
        report["warnings"] = warnings.clone().into();
        Ok((library.reporting(&report), warnings))
    }
}

/// Plain structures of numbers and strings always serialise.
fn value(report: &impl serde::Serialize) -> Value {
    serde_json::to_value(report).unwrap_or_default()
}

/// An argument that does not go with what is built.
fn apart(name: &str, only: &str, otherwise: &str) -> Failure {
    let message = format!("{name}: it applies only to {only}");
    Failure::usage(message, format!("leave it out, or {otherwise}"))
}
