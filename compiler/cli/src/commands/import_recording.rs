//! `asperity import recording`.

use super::{inference, outputs::TextureOutputs, timings};
use crate::cli::ImportRecording;
use asperity::{
    pipeline::Request,
    preview,
    recording::{self, Options, RecordingFailure},
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use asperity_recording::check::Severity;
use std::path::PathBuf;

pub(crate) fn run(args: &ImportRecording, console: Console) -> Result<(), Failures> {
    let mut inputs = files(args);
    inputs.extend(inference::model_files(args.model.as_deref()));
    let mut outputs = TextureOutputs::open(&inputs, &args.output, args.emit_model.as_deref())?;
    let plot = outputs.open_if(args.plot.as_deref())?;
    let report = outputs.open_if(args.report.as_deref())?;
    let console = outputs.console(console);
    let model = inference::completer(args.model.as_deref())?;
    let options = Options {
        request: Request {
            fidelity: args.fidelity,
            rate_hz: args.rate,
            preview_px: (!args.no_preview).then_some(preview::SIZE),
        },
        force: args.force,
    };
    let activity = console.activity();
    activity.set_message("importing");
    let imported = recording::import(&args.folder, &model, &options).map_err(one)?;
    if let Some(file) = plot {
        let sheet =
            recording::sheet(&imported).map_err(|error| one(RecordingFailure::from(error)))?;
        outputs.beside(file, sheet);
    }
    if let Some(file) = report {
        let mut text = format!("{:#}", recording::json(&imported)).into_bytes();
        text.push(b'\n');
        outputs.beside(file, text);
    }
    outputs.model(&imported.whole);
    let mut pipeline = imported.pipeline.clone();
    outputs.write(&imported.bytes, &mut pipeline)?;
    activity.finish_and_clear();
    let warnings: Vec<String> = imported
        .analysis
        .checked
        .at_least(Severity::Warning)
        .map(|finding| format!("{} {}: {}", finding.file, finding.channel, finding.what))
        .collect();
    console.warnings(&warnings, args.json);
    let printed = if args.json {
        console.json(&recording::json(&imported))
    } else {
        console.report(&format!("{imported}\n"))
    };
    printed.map_err(one)?;
    if args.timings {
        for step in &imported.analysis.steps {
            let ms = 1e3 * step.took.as_secs_f64();
            console.aside(&format!("  {:<16} {ms:>10.3} ms", step.name));
        }
    }
    timings::print(args.timings, &pipeline, console);
    Ok(())
}

/// The files of the folder, which no output may replace.
fn files(args: &ImportRecording) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(&args.folder).into_iter().flatten();
    entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file())
        .collect()
}
