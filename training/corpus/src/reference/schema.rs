//! The form of a family file.

use crate::{Caption, Rating, error::CorpusError, generator::Physical};
use serde::Deserialize;

/// A file: a family of materials.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FamilyFile {
    /// Name of the family: the file's name without its ending.
    pub family: String,
    /// Its materials.
    pub material: Vec<MaterialEntry>,
}

/// A material as the file states it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialEntry {
    /// Name, unique in the corpus.
    pub name: String,
    /// Words that name it; no held-out caption may contain one.
    pub synonyms: Vec<String>,
    /// Captions to train on, at least six.
    pub training: Vec<Caption>,
    /// Three captions that are never trained on.
    pub held_out: Vec<String>,
    /// The attributes that an average person would state.
    pub attributes: Rating,
    /// The parameters of the generator.
    pub physical: PhysicalEntry,
}

/// Physical parameters, each with its source.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhysicalEntry {
    /// See [`Physical::wavelength_mm`].
    pub wavelength_mm: Sourced,
    /// See [`Physical::spread_octaves`].
    pub spread_octaves: Sourced,
    /// See [`Physical::height_um`].
    pub height_um: Sourced,
    /// See [`Physical::modulus_mpa`].
    pub modulus_mpa: Sourced,
    /// See [`Physical::loss_factor`].
    pub loss_factor: Sourced,
    /// See [`Physical::mu`].
    pub mu: Sourced,
}

/// A number and where it comes from.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sourced {
    /// The number, in the unit of its field.
    pub value: f64,
    /// `handbook:`, `standard:`, `geometry:`, `estimate:` or `analogy:`, and a word on it.
    pub from: String,
}

impl PhysicalEntry {
    /// The numbers alone.
    #[must_use]
    pub fn values(&self) -> Physical {
        Physical {
            wavelength_mm: self.wavelength_mm.value,
            spread_octaves: self.spread_octaves.value,
            height_um: self.height_um.value,
            modulus_mpa: self.modulus_mpa.value,
            loss_factor: self.loss_factor.value,
            mu: self.mu.value,
        }
    }

    /// Field names with their entries and allowed ranges.
    #[must_use]
    pub fn fields(&self) -> [(&'static str, &Sourced, (f64, f64)); 6] {
        [
            ("wavelength_mm", &self.wavelength_mm, (0.01, 20.0)),
            ("spread_octaves", &self.spread_octaves, (0.05, 3.0)),
            ("height_um", &self.height_um, (0.05, 2000.0)),
            ("modulus_mpa", &self.modulus_mpa, (1e-3, 1e6)),
            ("loss_factor", &self.loss_factor, (1e-4, 1.0)),
            ("mu", &self.mu, (0.01, 3.0)),
        ]
    }
}

/// Reads one file.
///
/// # Errors
/// [`CorpusError::Syntax`] with the line and the field.
pub fn parse(file: &str, text: &str) -> Result<FamilyFile, CorpusError> {
    toml::from_str(text).map_err(|error| CorpusError::Syntax {
        file: file.to_owned(),
        message: error.to_string(),
    })
}
