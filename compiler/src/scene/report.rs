//! Report on the use of the budget.

use super::{budget::Budget, description::Description, fidelity::Candidate, target::Target};
use crate::library::manifest::Entry;
use asperity_io::shown::{counted, size};
use serde::Serialize;
use std::fmt;

/// Use of the budget.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Processor whose instructions are counted.
    pub processor: String,
    /// Target that limits the instructions.
    pub target: Option<String>,
    /// Rate of the servo loop, Hz.
    pub servo_rate_hz: f64,
    /// Share of the target's clocks.
    pub share: f64,
    /// Instructions a tick may take.
    pub instructions_budget: Option<u64>,
    /// Instructions of the costliest texture's tick.
    pub instructions: u64,
    /// Largest excess of the counts of instructions over the measured ones, percent. They are never below.
    pub instructions_above_percent: f64,
    /// Bytes the library may take.
    pub bytes_budget: Option<u64>,
    /// Bytes it takes.
    pub bytes: usize,
    /// Surfaces.
    pub surfaces: usize,
    /// The textures in order of name.
    pub textures: Vec<TextureCost>,
    /// Textures that were left out, because no surface wears them.
    pub unused: Vec<String>,
}

/// Fidelity and cost of a texture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TextureCost {
    /// Its name.
    pub name: String,
    /// `full`, `auto`, an order, or `auto` with a lower order.
    pub fidelity: String,
    /// Poles.
    pub order: usize,
    /// `none`, `nyquist` or `lsf`.
    pub numerator: asperity_texture::model::Numerator,
    /// Zeros that are mixed and converted.
    pub zeros: usize,
    /// Vertices of the grid.
    pub vertices: usize,
    /// Triangles of the grid.
    pub triangles: usize,
    /// Tap traces.
    pub taps: usize,
    /// Samples of a tap trace.
    pub tap_samples: usize,
    /// Executed instructions a tick.
    pub instructions: u64,
    /// Bytes of the asset.
    pub bytes: usize,
    /// Largest spectral distance from the whole texture, dB.
    pub error_db: f64,
}

impl TextureCost {
    fn new(name: &str, candidate: &Candidate) -> Self {
        let texture = &candidate.texture;
        Self {
            name: name.to_owned(),
            fidelity: candidate.fidelity.clone(),
            order: texture.grid.order,
            numerator: texture.grid.numerator,
            zeros: candidate.zeros(),
            vertices: texture.grid.vertices.len(),
            triangles: texture.grid.triangles.len(),
            taps: texture.taps.traces.len(),
            tap_samples: texture
                .taps
                .traces
                .first()
                .map_or(0, |t| t.accel_m_s2.len()),
            instructions: candidate.instructions,
            bytes: candidate.bytes.len(),
            error_db: candidate.error_db,
        }
    }
}

impl Report {
    pub(super) fn new(
        scene: &Description,
        budget: &Budget,
        target: &Target,
        order: &[&Entry],
        chosen: &[Candidate],
        bytes: usize,
    ) -> Self {
        let rows = order.iter().zip(chosen);
        Self {
            processor: target.processor().to_owned(),
            target: budget.target.map(|target| target.to_string()),
            servo_rate_hz: scene.servo_rate_hz,
            share: budget.share,
            instructions_budget: budget
                .target
                .map(|target| target.budget(scene.servo_rate_hz, budget.share)),
            instructions: chosen.iter().map(|c| c.instructions).max().unwrap_or(0),
            instructions_above_percent: target.above_percent(),
            bytes_budget: budget.bytes,
            bytes,
            surfaces: scene.surfaces.len(),
            textures: rows
                .map(|(entry, c)| TextureCost::new(&entry.name, c))
                .collect(),
            unused: scene.unused(),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "  fidelity  order  numerator  vertices      taps  instructions   bytes  error dB  texture"
        )?;
        for row in &self.textures {
            let numerator = match row.numerator {
                asperity_texture::model::Numerator::None => "1".to_owned(),
                asperity_texture::model::Numerator::Nyquist => "1 + z⁻¹".to_owned(),
                asperity_texture::model::Numerator::Lsf => format!("{} zeros", row.zeros),
            };
            let taps = format!("{} × {}", row.taps, row.tap_samples);
            writeln!(
                f,
                "  {:<8}  {:>5}  {numerator:>9}  {:>8}  {taps:>8}  {:>12}  {:>6}  {:>8.3}  {}",
                row.fidelity,
                row.order,
                row.vertices,
                row.instructions,
                row.bytes,
                row.error_db,
                row.name
            )?;
        }
        write!(
            f,
            "{}; a tick takes at most {} instructions on a {}",
            counted(self.surfaces, "surface", "surfaces"),
            self.instructions,
            self.processor
        )?;
        let above = self.instructions_above_percent;
        write!(f, " (estimated, at most {above} % too high)")?;
        if let (Some(budget), Some(target)) = (self.instructions_budget, &self.target) {
            write!(f, ", within a budget of {budget} ({target}")?;
            if target.contains('@') {
                // Two digits of a small share, and no zeros behind the point.
                let percent = (1e4 * self.share).round() / 1e2;
                write!(f, ", {percent} % of a period at {} Hz", self.servo_rate_hz)?;
            }
            write!(f, ")")?;
        }
        match self.bytes_budget {
            None => writeln!(f, "; library {}", size(self.bytes as u64)),
            Some(budget) => writeln!(f, "; library {} of {budget} bytes", self.bytes),
        }
    }
}
