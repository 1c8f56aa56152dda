//! Errors of a prediction, in every unit that matters.

use crate::evaluate::signature::{Objective, Signature};
use serde::{Deserialize, Serialize};

/// Number of [`NAMES`].
pub(super) const METRICS: usize = 11;

/// Metrics of a prediction with units: absolute values, less is better.
pub(super) const NAMES: [&str; METRICS] = [
    "spectrum, level free, dB",
    "spectrum with level, dB",
    "level, dB",
    "tap spectrum, dB",
    "rate-hardness, ln ratio",
    "rough_db, dB",
    "sharp_hz, Hz",
    "hard_hz, Hz",
    "hard_hz, ln ratio",
    "μ",
    "μ, ln ratio",
];

/// Who says what a held-out caption feels like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum Predictor {
    /// The model, from the caption.
    Text,
    /// The mean texture of the training materials, whatever the caption.
    Mean,
    /// The training material whose mean caption is nearest to the caption.
    Nearest,
    /// The same with the phrases of the lexicon beside the captions, all that the model has: a phrase
    /// that is nearer stands for the training material whose rating is nearest to its own.
    NearestRated,
    /// The model, from the texture itself: encoded and decoded. No prediction, but how
    /// much of the error is the decoder's.
    Own,
}

impl Predictor {
    /// All of them, in the order of every array.
    pub(crate) const ALL: [Self; PREDICTORS] = [
        Self::Text,
        Self::Mean,
        Self::Nearest,
        Self::NearestRated,
        Self::Own,
    ];
}

/// Number of predictors.
pub(super) const PREDICTORS: usize = 5;

/// A held-out caption.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Its largest cosine with the mean caption of a training material.
    pub similarity: f64,
    /// True for each predictor whose attributes lie within tolerance.
    pub within: [bool; PREDICTORS],
}

impl Trial {
    pub(super) fn new(similarity: f64, said: &[Objective; PREDICTORS], truth: &Objective) -> Self {
        Self {
            similarity,
            within: said.map(|said| within_tolerance(&said, truth)),
        }
    }
}

/// In the order of [`NAMES`].
pub(super) fn errors(said: &Signature, truth: &Signature) -> [f64; METRICS] {
    let distance = said.distance(truth);
    let (x, y) = (said.objective, truth.objective);
    let (x_even, y_even) = (x.even(), y.even());
    [
        distance.shape_db,
        distance.spectrum_db,
        distance.level_db,
        distance.taps_db,
        distance.rate_hardness,
        (x.rough_db - y.rough_db).abs(),
        (x.sharp_hz - y.sharp_hz).abs(),
        (x.hard_hz - y.hard_hz).abs(),
        (x_even[2] - y_even[2]).abs(),
        (x.mu - y.mu).abs(),
        (x_even[3] - y_even[3]).abs(),
    ]
}

/// Returns true if attributes are as near to the truth as a prompt may expect: within 6 dB of roughness, a quarter of
/// the hardness, and a factor of e^0.35 in μ.
fn within_tolerance(said: &Objective, truth: &Objective) -> bool {
    let (said_even, truth_even) = (said.even(), truth.even());
    (said.rough_db - truth.rough_db).abs() < 6.0
        && (said.hard_hz / truth.hard_hz - 1.0).abs() < 0.25
        && (said_even[3] - truth_even[3]).abs() < 0.35
}
