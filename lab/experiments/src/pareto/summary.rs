//! Results of a variant, on one material and over all of them.

use super::accuracy::Errors;
use super::statistics::{Spread, percentile};
use asperity::passes::reduce::BUDGET_DB;
use asperity_kernels::{design::Variant, workload::Orders};

/// A variant on a single material.
pub(super) struct Measurement {
    /// Orders of its filter.
    pub(super) orders: Orders,
    /// Bytes of the asset.
    pub(super) bytes: Option<usize>,
    /// Its errors.
    pub(super) errors: Errors,
}

/// A variant over all materials.
#[derive(Debug, Clone, PartialEq)]
pub struct VariantSummary {
    /// The variant.
    pub variant: Variant,
    /// Executed instructions a tick of mixing, conversion and synthesis. They are counted at the
    /// commonest orders; for `auto` they are the mean over the materials.
    pub instructions: Option<f64>,
    /// Median of the bytes of an asset.
    pub bytes: Option<usize>,
    /// RMS log-spectral distortion at rest, dB.
    pub distortion_db: Option<Spread>,
    /// Absolute level error of blocks while moving, dB.
    pub moving_level_db: Option<Spread>,
    /// RMS under alternation relative to the louder model, dB.
    pub alternation_db: Option<Spread>,
    /// Fraction of places whose filter is unstable.
    pub unstable: f64,
    /// Number of materials with such a place.
    pub unstable_materials: usize,
}

impl VariantSummary {
    /// Returns true if the variant is within the budget at rest: stable everywhere, and within 0.5 dB at 95 % of all
    /// places.
    #[must_use]
    pub fn is_within_budget(&self) -> bool {
        self.unstable == 0.0 && self.distortion_db.is_some_and(|d| d.p95 <= BUDGET_DB.0)
    }
}

/// Summarises a variant's rows.
pub(super) fn summarised(
    variant: Variant,
    rows: &[&Measurement],
    instructions: Option<f64>,
) -> VariantSummary {
    let spread = |list: fn(&Errors) -> &Vec<f64>| -> Option<Spread> {
        let values: Vec<f64> = rows
            .iter()
            .flat_map(|row| list(&row.errors).iter().copied())
            .collect();
        Spread::of(&values)
    };
    let places: usize = rows.iter().map(|row| row.errors.places).sum();
    let unstable: usize = rows.iter().map(|row| row.errors.unstable).sum();
    let bytes: Vec<f64> = rows
        .iter()
        .filter_map(|row| row.bytes.map(|b| b as f64))
        .collect();
    VariantSummary {
        variant,
        instructions,
        bytes: percentile(&bytes, 0.5).map(|b| b as usize),
        distortion_db: spread(|e| &e.distortion_db),
        moving_level_db: spread(|e| &e.moving_level_db),
        alternation_db: spread(|e| &e.alternation_db),
        unstable: unstable as f64 / places.max(1) as f64,
        unstable_materials: rows.iter().filter(|row| row.errors.unstable > 0).count(),
    }
}
