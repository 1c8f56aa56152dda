//! `asperity-lab measured`: prompts against the measured materials that they name.

use std::path::PathBuf;

use asperity::{
    learned::{inference::BackendName, text::TextEncoderChoice},
    library::Setup,
    sources::hatt,
};
use asperity_console::Console;
use asperity_experiments::{
    measured::{Comparison, calibration, chart, markdown, material},
    pareto::material::hatt as measured_models,
};
use asperity_io::{
    diagnostic::{Failures, one},
    output,
};

use crate::error::{Plain, all};

/// Remedy of what no input can cause.
const BUG: &str = "report this as a bug";

/// Compare prompts with the measured materials that they name
///
/// Every material of a HaTT folder is compiled by its name, and the vibration of the texture is held
/// against the measured models at nine strokes in twelve third octaves. Baselines that know the other
/// materials are judged alike, among them the generator of the reference corpus, whose constants are
/// fitted to the folder without the name. Intervals are of 95 %, by a bootstrap over names.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab measured --hatt hatt/models
  asperity-lab measured --hatt hatt/models --model my-model -o measured
  asperity-lab measured --hatt hatt/models --json > measured.json

With --output: tables.md and, where 20 materials or more are compared, spectra.png and generator.toml,
the constants of the generator fitted to them.")]
pub(crate) struct Arguments {
    /// Folder of HaTT models
    #[arg(long, value_name = "DIR")]
    hatt: PathBuf,
    /// Text encoder: the embedded `minilm`, or `clip:DIR` for an exported text tower of CLIP
    #[arg(long, default_value = "minilm", value_name = "minilm|clip:DIR")]
    text_encoder: TextEncoderChoice,
    /// Model folder written by `asperity-train fit` [default: the embedded model]
    #[arg(long, value_name = "DIR")]
    model: Option<PathBuf>,
    /// Inference back end: `portable`, which gives the same bits everywhere, or `onnxruntime`
    #[arg(long, default_value_t, value_name = "portable|onnxruntime")]
    backend: BackendName,
    /// Folder to write tables and a picture to; created if its parent exists
    #[arg(short = 'o', long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print JSON, with the errors of each material
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let setup = Setup {
        text_encoder: arguments.text_encoder.clone(),
        model: arguments.model.clone(),
        backend: arguments.backend,
    };
    let prompt_compiler = setup.prompt_compiler()?;
    let models = measured_models(&arguments.hatt).map_err(one)?;
    let bar = console.bar(models.len(), "compiling by name");
    let mut materials = material::compile_by_name(&models, &prompt_compiler, || bar.inc(1))
        .map_err(|error| Plain::failure(error, BUG))?;
    bar.finish_and_clear();
    for unknown in materials.compared.iter().filter(|m| m.physical.is_none()) {
        console.warn(&format!(
            "{}: no material of the reference corpus is known for it, so the generator does not predict it",
            unknown.name
        ));
    }
    let calibrated = calibration::calibrate(&mut materials.compared)
        .map_err(|error| Plain::failure(error, BUG))?;
    let comparison = Comparison::of(&materials, calibrated.as_ref());
    for (name, reason) in &comparison.left_out {
        console.warn(&format!("{name} is not compared: {reason}"));
    }
    if comparison.names < 2 {
        return Err(Plain::failure(
            format!(
                "{}: materials of two names or more are needed, {} can be compared",
                arguments.hatt.display(),
                comparison.names
            ),
            "give a folder with materials of two names or more",
        ));
    }
    let tables = markdown::tables(&comparison);
    let write = |folder: &PathBuf| {
        let mut files = vec![("tables.md".to_owned(), tables.clone().into_bytes())];
        if let Some(trends) = &comparison.trends {
            files.push((
                "spectra.png".to_owned(),
                chart::spectra(trends).map_err(|error| Plain::failure(error, BUG))?,
            ));
        }
        if let Some(constants) = &calibrated {
            let text = constants.text();
            let text = text.map_err(|error| Plain::failure(error, BUG))?;
            files.push(("generator.toml".to_owned(), text.into_bytes()));
        }
        let files: Vec<(String, &[u8])> = (files.iter())
            .map(|(name, bytes)| (name.clone(), &bytes[..]))
            .collect();
        let mut inputs = hatt::files(&arguments.hatt).map_err(one)?;
        inputs.extend(setup.files());
        output::write_folder_beside(&inputs, folder, &files).map_err(one)
    };
    let written = arguments.out.as_ref().map_or(Ok(()), write);
    let printed = if arguments.json {
        let text = serde_json::to_string_pretty(&comparison)
            .map_err(|error| Plain::failure(error, BUG))?;
        console.json(&text)
    } else {
        console.result_of(arguments.out.is_some() && written.is_ok(), &tables)
    };
    all([written, printed.map_err(one)])
}
