//! Shared steps of the commands that import many materials: into a library, a folder, or one asset.

use super::timings;
use asperity::{
    driver::{self, Compiled, Failure},
    emit::pack::{self, NamedAsset},
    pipeline::{Clock, Pass, Pipeline, Request},
    sources::{Source, Tools, model_file},
};
use asperity_console::Console;
use asperity_io::{
    clock::now,
    diagnostic::{Failures, Fault, one},
    output::{self, FileNames, OutputId, Outputs},
    shown::counted,
};
use std::{
    fmt::Write as _,
    path::{Path, PathBuf},
};

/// Where the assets go: what is one file is open, so that a bad path costs no work.
pub(super) enum Target {
    File {
        outputs: Outputs,
        /// The library, or else the asset.
        file: OutputId,
        is_library: bool,
        model: Option<OutputId>,
    },
    Folder(PathBuf),
}

impl Target {
    /// Resolves the target of a command that imports `materials` from a path and reads `inputs`.
    pub(super) fn open(
        from: &Path,
        output: &Path,
        emit_model: Option<&Path>,
        materials: usize,
        inputs: &[PathBuf],
    ) -> Result<Self, Failures> {
        let extension = output
            .extension()
            .map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        let extension = extension.as_deref();
        let piped = output::is_standard_output(output);
        let many = from.is_dir();
        let names_folder = output.to_string_lossy().ends_with(['/', '\\']) || output.is_dir();
        let is_folder = names_folder || (many && !piped && extension != Some("aspl"));
        if !names_folder && many && extension == Some("asp") {
            let what = format!(
                "{} cannot go into the single asset {}",
                counted(materials, "material", "materials"),
                output.display()
            );
            let remedy = "give a folder, or a library (.aspl), as the output";
            return Err(one(Fault::new(what, remedy).at(from).usage()));
        }
        let is_library = !is_folder && (many || extension == Some("aspl"));
        if (is_folder || is_library) && emit_model.is_some() {
            let what = "--emit-model needs one material as the input and one asset as the output";
            let remedy =
                "give one material and an output that ends in .asp, or leave --emit-model out";
            return Err(one(Fault::new(what, remedy).at(output).usage()));
        }
        if is_folder {
            return Ok(Self::Folder(output.to_owned()));
        }
        let mut outputs = Outputs::beside(inputs);
        Ok(Self::File {
            file: outputs.open(output).map_err(one)?,
            is_library,
            model: outputs.open_if(emit_model).map_err(one)?,
            outputs,
        })
    }

    fn console(&self, console: Console) -> Console {
        match self {
            Self::File { outputs, .. } => console.beside(outputs),
            Self::Folder(_) => console,
        }
    }

    fn write(
        self,
        imported: &[Compiled],
        inputs: &[PathBuf],
        pipeline: &mut Pipeline,
        console: Console,
    ) -> Result<(), Failures> {
        match self {
            Self::Folder(folder) => {
                let names: Vec<&str> = imported.iter().map(|m| m.texture.name.as_str()).collect();
                let FileNames { files, changed } = FileNames::of(&names, "asp");
                console.warn_of_many(&changed);
                let files: Vec<(String, &[u8])> = files
                    .into_iter()
                    .zip(imported)
                    .map(|(name, material)| (name, &material.lowered.bytes[..]))
                    .collect();
                let write = || output::write_folder_beside(inputs, &folder, &files);
                pipeline.run(Pass::Write, write).map_err(one)
            }
            Self::File {
                mut outputs,
                file,
                is_library,
                model,
            } => {
                let packed;
                let bytes = match imported {
                    // A single source file gives a single asset.
                    [material] if !is_library => &material.lowered.bytes,
                    _ => {
                        packed = pipeline.run(Pass::Pack, || self::packed(imported))?;
                        &packed
                    }
                };
                let write = || {
                    outputs.fill(file, bytes)?;
                    if let (Some(file), [material]) = (model, imported) {
                        outputs.fill(file, &model_file::to_json(&material.whole))?;
                    }
                    outputs.commit()
                };
                pipeline.run(Pass::Write, write).map_err(one)
            }
        }
    }

    /// Compiles all sources, and writes and reports them; nothing is written unless all succeed.
    pub(super) fn import<S: Source>(
        self,
        sources: &[S],
        request: &Request,
        tools: &Tools<'_>,
        check: impl FnOnce(&mut Vec<Result<Compiled, Failure>>),
        (inputs, timed, console): (&[PathBuf], bool, Console),
    ) -> Result<(), Failures> {
        let console = self.console(console);
        let bar = console.bar(sources.len(), "importing");
        let clock = Clock(now);
        let tools = Tools { clock, ..*tools };
        let mut results = driver::compile_all(sources, request, &tools, || bar.inc(1));
        check(&mut results);
        bar.finish_and_clear();
        let mut imported: Vec<Compiled> = Vec::with_capacity(results.len());
        let mut failures: Failures = Vec::new();
        for result in results {
            match result {
                Ok(material) => imported.push(material),
                Err(error) => failures.push(error),
            }
        }
        if !failures.is_empty() {
            return Err(failures);
        }
        let mut pipeline = Pipeline::timed(clock);
        for material in &imported {
            pipeline.merge(&material.timings);
        }
        self.write(&imported, inputs, &mut pipeline, console)?;
        let warnings = imported.iter().flat_map(|material| {
            let name = &material.texture.name;
            let warnings = material.warnings.iter();
            warnings.map(move |warning| format!("{name}: {warning}"))
        });
        console.warn_of_many(&warnings.collect::<Vec<_>>());
        console.report(&figures(&imported)).map_err(one)?;
        timings::print(timed, &pipeline, console);
        Ok(())
    }
}

/// The library of all materials.
fn packed(imported: &[Compiled]) -> Result<Vec<u8>, Failures> {
    let named: Vec<NamedAsset<'_>> = imported
        .iter()
        .map(|material| NamedAsset {
            name: &material.texture.name,
            bytes: &material.lowered.bytes,
        })
        .collect();
    pack::encode(&named).map_err(one)
}

/// Formats a line per material and, for several materials, a summary.
fn figures(imported: &[Compiled]) -> String {
    let mut text = String::new();
    for material in imported {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", material.line());
    }
    if imported.len() > 1 {
        let all = || imported.iter().filter_map(|m| m.compared);
        let compared: usize = all().map(|m| m.count).sum();
        let sum_db: f64 = all().map(|m| m.error.mean_db * m.count as f64).sum();
        let max_db = all().fold(0.0_f64, |max, m| max.max(m.error.max_db));
        let places = match imported[0].reduced() {
            None => "vertices",
            Some(_) => "places",
        };
        let _ = writeln!(
            text,
            "{} materials: {max_db:.4} dB from their sources at worst, {:.4} dB on average over {compared} {places}",
            imported.len(),
            sum_db / compared.max(1) as f64
        );
    }
    text
}
