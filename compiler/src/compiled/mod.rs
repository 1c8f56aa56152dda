//! The result of a source: a compiled texture, how far its asset is from the source, and the reports of both.
//!
//! ```
//! use asperity::{sources::{builtin::Builtin, Tools}, driver, pipeline::Request, passes::reduce::Fidelity};
//!
//! let request = Request { fidelity: Fidelity::Auto, ..Request::default() };
//! let compiled = driver::compile(&Builtin, &request, &Tools::default())?;
//! let left_out = compiled.reduced().expect("a report, as not everything was to be kept");
//! assert!(left_out.order.kept < left_out.order.full);
//! assert_eq!(compiled.json()["name"], "Built-in Grit"); // for machines; `text` is for people
//! # Ok::<(), asperity::driver::Failure>(())
//! ```

mod reference;

pub use reference::ErrorReference;

use crate::learned::Certainty;
use crate::{
    emit::{
        lower::{ErrorSummary, Lowered},
        verify::VerifyReport,
    },
    passes::reduce::{self, Fidelity},
    pipeline::Timings,
};
use asperity_io::shown::{counted, size};
use asperity_plot::PlotError;
use asperity_texture::model::{
    TextureModel,
    attributes::{self, Attributes},
};
use serde_json::{Value, json};
use std::{any::Any, fmt, sync::Arc};

/// A texture that passed, with its asset.
#[derive(Debug, Clone)]
pub struct Compiled {
    /// The whole texture before reduction, at its rate, and stabilised where it had to be.
    pub whole: TextureModel,
    /// The texture that the asset holds, with gains that the ceiling allows.
    pub texture: TextureModel,
    /// Requested fidelity.
    pub fidelity: Fidelity,
    /// Reduction by the fidelity, and its error.
    pub reduction: reduce::Report,
    /// The preview, if one was asked for.
    pub preview: Option<Vec<u8>>,
    /// The asset.
    pub lowered: Lowered,
    /// Verification results; `None` for an asset that was taken as it is.
    pub verified: Option<VerifyReport>,
    /// The fraction of the way to white noise that the models were moved so that they pass, 0..=1.
    pub stabilised: f64,
    /// Error against the source, where known.
    pub compared: Option<Compared>,
    /// Certainty of the prompt's interpretation.
    pub certainty: Option<Certainty>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// Additional findings of the source.
    pub findings: Option<Arc<dyn Findings>>,
    /// The time of every pass.
    pub timings: Timings,
}

/// Distance of an asset from its source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compared {
    /// In full it is measured at every vertex that sounds, else on what the whole grid renders, at
    /// the places of [`mixture::places`](asperity_texture::model::mixture::places).
    pub error: ErrorSummary,
    /// Vertices or places that were compared.
    pub count: usize,
}

impl Compiled {
    /// Objective attributes of what the asset holds.
    #[must_use]
    pub fn attributes(&self) -> Attributes {
        attributes::of(&self.texture)
    }

    /// Returns the reduction report; `None` at full fidelity.
    #[must_use]
    pub fn reduced(&self) -> Option<&reduce::Report> {
        (self.fidelity != Fidelity::Full).then_some(&self.reduction)
    }

    /// Returns the findings of a source whose findings have type `F`.
    #[must_use]
    pub fn found<F: Findings>(&self) -> Option<&F> {
        let findings: &dyn Any = &**self.findings.as_ref()?;
        findings.downcast_ref()
    }

    /// The report for people.
    #[must_use]
    pub fn text(&self) -> String {
        match &self.findings {
            Some(findings) => findings.text(self),
            None => self.line(),
        }
    }

    /// The report for machines.
    #[must_use]
    pub fn json(&self) -> Value {
        match &self.findings {
            Some(findings) => findings.json(self),
            None => self.figures(),
        }
    }

    /// A picture of what the source found as PNG, if it has one.
    ///
    /// # Errors
    /// [`PlotError`] if it cannot be drawn.
    pub fn sheet(&self) -> Result<Option<Vec<u8>>, PlotError> {
        match &self.findings {
            Some(findings) => findings.sheet(self),
            None => Ok(None),
        }
    }

    /// The figures that every texture has, for machines.
    #[must_use]
    pub fn figures(&self) -> Value {
        let grid = &self.texture.grid;
        json!({
            "name": self.texture.name,
            "error": self.compared.map(|compared| compared.error),
            "compared": self.compared.map(|compared| compared.count),
            "vertices": grid.vertices.len(),
            "triangles": grid.triangles.len(),
            "models": self.lowered.models,
            "reduction": self.reduced(),
            "bytes": { "haptic": self.lowered.haptic_bytes, "total": self.lowered.bytes.len() },
            "stages_ms": self.timings.json(),
            "warnings": self.warnings,
        })
    }

    /// The figures that every texture has, in one line for people.
    #[must_use]
    pub fn line(&self) -> String {
        let grid = &self.texture.grid;
        let error = match &self.compared {
            None => format!(
                "{:.4} dB RMS from LSF quantisation",
                self.lowered.lsf_error.rms_db
            ),
            Some(Compared { error, count }) => {
                let over = match self.reduced() {
                    None => format!("{count} of {} vertices", grid.vertices.len()),
                    Some(_) => format!("{count} places"),
                };
                format!(
                    "{:.4} dB from its source at worst, {:.4} dB on average over {over}",
                    error.max_db, error.mean_db
                )
            }
        };
        let reduced = self
            .reduced()
            .map_or_else(String::new, |report| format!("; kept {report}"));
        format!(
            "{}: {error}; {}, {}; {} haptic, {} in total{reduced}",
            self.texture.name,
            counted(self.lowered.models, "model", "models"),
            counted(grid.triangles.len(), "triangle", "triangles"),
            size(self.lowered.haptic_bytes as u64),
            size(self.lowered.bytes.len() as u64),
        )
    }
}

// What a source found besides its texture.

/// Findings of a source, for reports.
pub trait Findings: Any + fmt::Debug + Send + Sync {
    /// The report for people, of one line or more.
    fn text(&self, compiled: &Compiled) -> String {
        compiled.line()
    }

    /// The report for machines.
    fn json(&self, compiled: &Compiled) -> Value {
        compiled.figures()
    }

    /// A picture of what was found as PNG, if there is more to see than in the asset.
    ///
    /// # Errors
    /// [`PlotError`] if it cannot be drawn.
    fn sheet(&self, compiled: &Compiled) -> Result<Option<Vec<u8>>, PlotError> {
        let _ = compiled;
        Ok(None)
    }
}
