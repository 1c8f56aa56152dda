//! Shared steps of all commands that compile a single texture: open the outputs, compile, write, report.

use super::timings;
use crate::cli::{PreviewOptions, ReportOptions};
use asperity::{
    driver::{self, Compiled},
    emit::verify::VerifyError,
    passes::reduce::Fidelity,
    pipeline::{Clock, Pass, Pipeline, Request},
    sources::{Source, Tools, model_file},
    views::{plot, preview::SIZE},
};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    clock::now,
    diagnostic::{Failures, Fault, alone, one},
    output::{OutputId, Outputs},
};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The request of a command with these options; without a preview option, a preview of the usual size is drawn.
pub(super) fn request(
    fidelity: Fidelity,
    rate_hz: Option<f64>,
    preview: &PreviewOptions,
) -> Request {
    Request {
        fidelity,
        rate_hz,
        preview_px: preview.px(Some(SIZE)),
        ..Request::default()
    }
}

/// Requested outputs of a texture.
pub(super) struct RequestedOutputs<'a> {
    /// The asset.
    pub(super) output: &'a Path,
    /// The texture before its reduction, as JSON.
    pub(super) emit_model: Option<&'a Path>,
    /// A picture of what the source found, or else of the asset.
    pub(super) plot: Option<&'a Path>,
    /// The report, as JSON.
    pub(super) report: Option<&'a Path>,
    /// What is printed.
    pub(super) reporting: ReportOptions,
}

impl<'a> RequestedOutputs<'a> {
    /// The asset alone.
    pub(super) fn of(output: &'a Path, reporting: ReportOptions) -> Self {
        Self {
            output,
            emit_model: None,
            plot: None,
            report: None,
            reporting,
        }
    }
}

/// The outputs of a command, open.
pub(super) struct Job<'a> {
    requested: RequestedOutputs<'a>,
    outputs: Outputs,
    asset: OutputId,
    model: Option<OutputId>,
    plot: Option<OutputId>,
    report: Option<OutputId>,
    /// Where the command talks.
    pub(super) console: Console,
}

impl<'a> Job<'a> {
    /// Opens the outputs of a command that reads these files: a bad path costs no work.
    pub(super) fn open(
        requested: RequestedOutputs<'a>,
        inputs: &[PathBuf],
        console: Console,
    ) -> Result<Self, Failures> {
        let mut outputs = Outputs::beside(inputs);
        Ok(Self {
            asset: outputs.open(requested.output).map_err(one)?,
            model: outputs.open_if(requested.emit_model).map_err(one)?,
            plot: outputs.open_if(requested.plot).map_err(one)?,
            report: outputs.open_if(requested.report).map_err(one)?,
            console: console.beside(&outputs),
            outputs,
            requested,
        })
    }

    /// Compiles, writes and reports.
    pub(super) fn run(
        self,
        source: &dyn Source,
        request: &Request,
        tools: &Tools<'_>,
    ) -> Result<(), Failures> {
        let compiled = self.compile(source, request, tools)?;
        let text = format!("{}\n", compiled.text());
        self.finish(&compiled, compiled.json(), &text, "")
    }

    /// Compiles. On a terminal it is shown that the command works.
    pub(super) fn compile(
        &self,
        source: &dyn Source,
        request: &Request,
        tools: &Tools<'_>,
    ) -> Result<Compiled, Failures> {
        let activity = self.console.activity();
        activity.set_message("compiling");
        let clock = Clock(now);
        let compiled = driver::compile(source, request, &Tools { clock, ..*tools }).map_err(alone);
        activity.finish_and_clear();
        compiled
    }

    /// Writes all that was wanted, and prints the report: as JSON, or as texts. A quiet console
    /// prints only what was asked for besides.
    pub(super) fn finish(
        mut self,
        compiled: &Compiled,
        mut json: Value,
        report: &str,
        asked: &str,
    ) -> Result<(), Failures> {
        let mut beside = Vec::new();
        if let Some(file) = self.plot {
            let sheet = compiled.sheet().map_err(|error| {
                let what = format!("the sheet cannot be drawn: {error}");
                one(Fault::new(what, "leave --plot out"))
            })?;
            let sheet = match sheet {
                Some(sheet) => sheet,
                None => {
                    let asset = Asset::parse(&compiled.lowered.bytes);
                    plot::of_asset(&asset.map_err(|e| one(VerifyError::from(e)))?).map_err(one)?
                }
            };
            beside.push((file, sheet));
        }
        if let Some(file) = self.report {
            let mut text = format!("{json:#}").into_bytes();
            text.push(b'\n');
            beside.push((file, text));
        }
        if let Some(file) = self.model {
            beside.push((file, model_file::to_json(&compiled.whole)));
        }
        let mut pipeline = Pipeline::timed(Clock(now));
        pipeline.merge(&compiled.timings);
        pipeline
            .run(Pass::Write, || {
                self.outputs.fill(self.asset, &compiled.lowered.bytes)?;
                for (file, bytes) in &beside {
                    self.outputs.fill(*file, bytes)?;
                }
                self.outputs.commit()
            })
            .map_err(one)?;
        let console = self.console;
        let ReportOptions {
            json: as_json,
            timings,
        } = self.requested.reporting;
        console.warnings(&compiled.warnings, as_json);
        let printed = if as_json {
            json["stages_ms"] = pipeline.timings().json();
            console.json(&json)
        } else {
            console.report(report).and_then(|()| console.text(asked))
        };
        printed.map_err(one)?;
        timings::print(timings, &pipeline, console);
        Ok(())
    }
}
