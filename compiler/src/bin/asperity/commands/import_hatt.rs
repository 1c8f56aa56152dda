//! `asperity import hatt`.

use super::{inference, outputs::Outputs};
use crate::failure::{Failures, one};
use crate::{cli::ImportHatt, console};
use asperity::{
    diagnostic::Diagnostic,
    hatt::{self, Imported},
    library::{self, NamedAsset},
    output,
    pipeline::{Pass, Pipeline},
    progress,
};
use std::{
    collections::HashSet,
    fmt::Write as _,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// A folder was to go into one asset.
#[derive(Debug, Error)]
#[error("{folder}: {count} materials do not fit the one asset {output}", folder = folder.display(), output = output.display())]
struct ManyIntoOne {
    folder: PathBuf,
    count: usize,
    output: PathBuf,
}

impl Diagnostic for ManyIntoOne {
    fn is_usage(&self) -> bool {
        true
    }

    fn remedy(&self) -> String {
        "give a folder, or a library whose name ends in .aspl".into()
    }
}

/// One model was to be written of several materials, or of a library.
#[derive(Debug, Error)]
#[error("{path}: --emit-model writes the model of one material that becomes one asset", path = path.display())]
struct NoSingleModel {
    path: PathBuf,
}

impl Diagnostic for NoSingleModel {
    fn is_usage(&self) -> bool {
        true
    }

    fn remedy(&self) -> String {
        "give one Models_<name>.xml and an output that ends in .asp, or leave --emit-model out"
            .into()
    }
}

/// Where the assets go.
enum Target {
    File(PathBuf),
    Folder(PathBuf),
    Library(PathBuf),
}

fn target(args: &ImportHatt, files: usize) -> Result<Target, ManyIntoOne> {
    let output = args.output.clone();
    let extension = output
        .extension()
        .map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let names_folder = output.to_string_lossy().ends_with(['/', '\\']) || output.is_dir();
    if names_folder {
        return Ok(Target::Folder(output));
    }
    if extension.as_deref() == Some("aspl") {
        return Ok(Target::Library(output));
    }
    if !args.input.is_dir() {
        return Ok(Target::File(output));
    }
    if extension.as_deref() == Some("asp") {
        return Err(ManyIntoOne {
            folder: args.input.clone(),
            count: files,
            output,
        });
    }
    Ok(Target::Folder(output))
}

pub(crate) fn run(args: &ImportHatt, quiet: bool) -> Result<(), Failures> {
    let files = hatt::files(&args.input).map_err(one)?;
    let target = target(args, files.len()).map_err(one)?;
    check_outputs(args, &target)?;
    let completer = args
        .complete_taps
        .then(|| inference::completer(args.model.as_deref()))
        .transpose()?;
    let bar = progress::bar(quiet, files.len(), "importing");
    let results = hatt::import_all(&files, completer.as_ref(), args.fidelity, || bar.inc(1));
    bar.finish_and_clear();
    let mut imported: Vec<Imported> = Vec::with_capacity(results.len());
    let mut failures: Failures = Vec::new();
    for result in results {
        match result {
            Ok(material) => imported.push(material),
            Err(error) => failures.push(Box::new(error)),
        }
    }
    if !failures.is_empty() {
        return Err(failures);
    }
    let mut pipeline = Pipeline::default();
    for material in &imported {
        pipeline.merge(&material.timings);
    }
    write(
        &target,
        &imported,
        args.emit_model.as_deref(),
        &mut pipeline,
    )?;
    console::print(&figures(&imported))?;
    console::print_timings(args.timings, pipeline.timings());
    Ok(())
}

/// Refuses a model beside anything but a single asset, and an output that is the input.
fn check_outputs(args: &ImportHatt, target: &Target) -> Result<(), Failures> {
    let wanted = args.emit_model.as_deref();
    match target {
        Target::File(file) => Outputs::with_model(file, wanted).check(&[&args.input], None),
        Target::Folder(path) | Target::Library(path) if wanted.is_some() => {
            let path = path.clone();
            Err(one(NoSingleModel { path }))
        }
        Target::Library(file) => output::distinct(&[&args.input], &[file]).map_err(one),
        Target::Folder(_) => Ok(()),
    }
}

fn write(
    target: &Target,
    imported: &[Imported],
    model: Option<&Path>,
    pipeline: &mut Pipeline,
) -> Result<(), Failures> {
    let named: Vec<NamedAsset<'_>> = imported
        .iter()
        .map(|material| NamedAsset {
            name: &material.report.name,
            bytes: &material.bytes,
        })
        .collect();
    match target {
        Target::Folder(folder) => {
            let names = file_names(imported);
            let files: Vec<(String, &[u8])> = names
                .into_iter()
                .zip(&named)
                .map(|(name, asset)| (name, asset.bytes))
                .collect();
            pipeline
                .run(Pass::Write, || output::write_folder(folder, &files))
                .map_err(one)
        }
        Target::Library(file) => {
            let bytes = pipeline
                .run(Pass::Pack, || library::encode(&named))
                .map_err(one)?;
            pipeline.write(&[(file, &bytes)]).map_err(one)
        }
        Target::File(file) => {
            // A single source file gives a single asset.
            for material in imported {
                let mut outputs = Outputs::with_model(file, model);
                outputs.model(&material.whole);
                outputs.write(&material.bytes, pipeline)?;
            }
            Ok(())
        }
    }
}

/// One line a material, and of several a summary.
fn figures(imported: &[Imported]) -> String {
    let mut text = String::new();
    for material in imported {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", material.report);
    }
    if imported.len() > 1 {
        let compared: usize = imported.iter().map(|m| m.report.compared).sum();
        let sum_db: f64 = imported
            .iter()
            .map(|m| m.report.error.mean_db * m.report.compared as f64)
            .sum();
        let max_db = imported
            .iter()
            .fold(0.0_f64, |max, m| max.max(m.report.error.max_db));
        let places = match imported[0].report.reduction {
            None => "vertices",
            Some(_) => "places",
        };
        let _ = writeln!(
            text,
            "{} materials: max {max_db:.4} dB, mean {:.4} dB over {compared} {places}",
            imported.len(),
            sum_db / compared.max(1) as f64
        );
    }
    text
}

/// File names of the materials: their own, freed of what a file system refuses.
fn file_names(imported: &[Imported]) -> Vec<String> {
    let mut taken = HashSet::new();
    imported
        .iter()
        .map(|material| {
            let safe: String = material
                .report
                .name
                .chars()
                .map(|c| if r#"/\<>:"|?*"#.contains(c) { '_' } else { c })
                .collect();
            let safe = if safe.starts_with('.') {
                format!("_{safe}")
            } else {
                safe
            };
            let mut name = format!("{safe}.asp");
            let mut next = 2;
            // Some file systems take upper and lower case for the same.
            while !taken.insert(name.to_lowercase()) {
                name = format!("{safe} ({next}).asp");
                next += 1;
            }
            name
        })
        .collect()
}
