//! Materials whose relief or friction depends on the direction of a stroke: what differs along their axis.
//!
//! The corpus states what a stroke across the ribs, the grain or the nap meets. Nothing is trained on this table.

use crate::{error::CorpusError, generator::Physical};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The table.
const FILE: &str = "directions.toml";
const TEXT: &str = include_str!("../../../corpora/directions.toml");

/// A material with an axis.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// Its name, as the corpus has it.
    pub name: String,
    /// [`Physical::wavelength_mm`] of a stroke along the axis.
    pub wavelength_mm: f64,
    /// [`Physical::spread_octaves`] of a stroke along the axis.
    pub spread_octaves: f64,
    /// [`Physical::height_um`] of a stroke along the axis.
    pub height_um: f64,
    /// Friction along the axis, the mean of both senses, over that across it.
    pub mu_ratio: f64,
    /// Friction along the axis against the nap over that with it; 1 without a nap.
    #[serde(default = "none")]
    pub nap: f64,
    /// What the axis is: ribs, grain, brush marks.
    pub axis: String,
    /// The sources of relief and friction, or that they are estimates.
    pub from: BTreeMap<String, String>,
}

const fn none() -> f64 {
    1.0
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    material: Vec<Direction>,
}

impl Direction {
    /// What a stroke along the axis meets of a material of which `across` is what one across it meets.
    #[must_use]
    pub fn along(&self, across: &Physical) -> Physical {
        Physical {
            wavelength_mm: self.wavelength_mm,
            spread_octaves: self.spread_octaves,
            height_um: self.height_um,
            mu: self.mu_ratio * across.mu,
            ..*across
        }
    }
}

/// Every material of the committed corpus that has a direction, in the order of the corpus.
///
/// # Errors
/// [`CorpusError::Syntax`].
pub fn directions() -> Result<Vec<Direction>, CorpusError> {
    let table: Table = toml::from_str(TEXT).map_err(|error| CorpusError::Syntax {
        file: FILE.to_owned(),
        message: error.to_string(),
    })?;
    Ok(table.material)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::schema;

    /// Claim: every direction is of a material of the corpus, once, within the ranges of the corpus, with its sources.
    #[test]
    fn directions_are_of_the_corpus() {
        let physical = crate::reference::physical().unwrap();
        let directions = directions().unwrap();
        let mut names: Vec<&str> = directions.iter().map(|d| d.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!((names.len(), directions.len()), (83, 83));
        for direction in &directions {
            let name = &direction.name;
            let along = direction.along(&physical[name]);
            let values = [
                along.wavelength_mm,
                along.spread_octaves,
                along.height_um,
                along.mu,
            ];
            let sourced = |value| schema::Sourced {
                value,
                from: "geometry: here".to_owned(),
            };
            let [wavelength_mm, spread_octaves, height_um, mu] = values.map(sourced);
            let [modulus_mpa, loss_factor] = [1.0, 0.1].map(sourced);
            let entry = schema::PhysicalEntry {
                wavelength_mm,
                spread_octaves,
                height_um,
                modulus_mpa,
                loss_factor,
                mu,
            };
            for (field, found, (low, high)) in entry.fields() {
                assert!(
                    (low..=high).contains(&found.value),
                    "{name}: {field} {}",
                    found.value
                );
            }
            assert!(
                (0.5..=2.0).contains(&direction.mu_ratio) && (1.0..=3.0).contains(&direction.nap),
                "{name}"
            );
            let sources: Vec<&String> = direction.from.keys().collect();
            assert_eq!(sources, ["mu_ratio", "relief"], "{name}");
            assert!(!direction.axis.is_empty(), "{name}");
        }
    }
}
