//! Distance of a prompt's texture from the measured material that it names.
//!
//! Measured models, a user's own copy of the HaTT, are compared with the textures of their names at nine strokes (50,
//! 100, 150 mm/s × 0.5, 1, 2 N) in twelve third octaves from 31.5 to 400 Hz, and so are baselines that know the other
//! materials. Nothing of the measured models is kept: by name there are RMS errors and ranks alone, and means are over
//! [`trend::FEWEST`] materials or more.
//!
//! | file | holds |
//! |---|---|
//! | [`signature`] | band levels, and differences between them |
//! | [`material`] | both sides of a material |
//! | [`prediction`] | the prompt and the baselines, among them a `ridge` regression |
//! | [`calibration`] | the constants of the generator, fitted by `least_squares` |
//! | [`score`] | medians over materials, with intervals |
//! | [`trend`] | mean spectra, slopes over force and speed, friction |
//! | [`markdown`], [`chart`] | tables and a picture |

pub mod calibration;
pub mod chart;
mod least_squares;
pub mod markdown;
pub mod material;
pub mod prediction;
mod ridge;
pub mod score;
pub mod signature;
#[cfg(test)]
mod tests;
pub mod trend;

use asperity_corpus::generator::constants::{Constant, ConstantsFile};
use material::{Material, Materials};
use prediction::Method;
use serde::Serialize;

/// The comparison of a folder with its prompts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Materials that were compared.
    pub materials: usize,
    /// Different names among them.
    pub names: usize,
    /// Every method that predicts a material.
    pub scores: Vec<score::Score>,
    /// The constants of the generator; `None` of fewer than [`trend::FEWEST`].
    pub constants: Option<Vec<Constant>>,
    /// Over all materials; `None` of fewer than [`trend::FEWEST`].
    pub trends: Option<trend::Trends>,
    /// Every material by its prompt.
    pub own: Vec<score::Own>,
    /// Materials that were not compared, each with the reason.
    pub left_out: Vec<(String, String)>,
}

impl Comparison {
    /// Judges every method.
    #[must_use]
    pub fn of(materials: &Materials, calibrated: Option<&ConstantsFile>) -> Self {
        let compared: &[Material] = &materials.compared;
        Self {
            materials: compared.len(),
            names: score::names(compared)
                .into_iter()
                .max()
                .map_or(0, |n| n + 1),
            scores: Method::ALL
                .iter()
                .filter_map(|method| score::score(*method, compared))
                .collect(),
            constants: calibrated.map(|file| file.constant.clone()),
            trends: trend::trends(compared),
            own: score::own(compared),
            left_out: materials.left_out.clone(),
        }
    }
}
