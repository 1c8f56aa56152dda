//! The ratios by which strokes along an axis follow from those across it.

use crate::vibration::{Spectrum, bands_db};

/// Levels so far below the loudest third octave across the axis count as silent, dB.
pub const SILENT_DB: f64 = 30.0;

/// Speeds that are tried along the axis, as steps of so many octaves: a third to twice that of the stroke, so that
/// the slowest stays among those that a model has.
const SPEED_STEPS: std::ops::RangeInclusive<i32> = -6..=4;
const SPEED_OCTAVES: f64 = 0.25;

/// Ratios of a stroke along the axis to one across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratios {
    /// P, the power along over that across at the same speed.
    pub power: f64,
    /// r, the speed across that sounds as a stroke along, over the speed of that.
    pub speed: f64,
}

/// The ratios that render strokes along the axis best at some speeds, mm/s, in third octaves, from spectra of acceleration by
/// speed.
#[must_use]
pub fn fit(
    speeds_mm_s: &[f64],
    across: impl Fn(f64) -> Spectrum,
    along: impl Fn(f64) -> Spectrum,
) -> Ratios {
    let bands = |v: &f64| (loudest_db(&across(*v)) - SILENT_DB, bands_db(&along(*v)));
    let truth: Vec<(f64, Vec<f64>)> = speeds_mm_s.iter().map(bands).collect();
    let is_silent = |(least, bands): &(f64, Vec<f64>)| bands.iter().all(|band| band <= least);
    if truth.iter().all(is_silent) {
        return Ratios {
            power: 0.0,
            speed: 1.0,
        };
    }
    let fitted = |octaves: f64| {
        let speed = libm::exp2(octaves);
        let apart: Vec<f64> = (speeds_mm_s.iter().zip(&truth))
            .flat_map(|(v, (least, truth))| {
                let found = bands_db(&across(v * speed));
                let pairs = truth.iter().zip(found);
                pairs.map(|(truth, found)| truth.max(*least) - found.max(*least))
            })
            .collect();
        let mean = apart.iter().sum::<f64>() / apart.len() as f64;
        let spread: f64 = apart.iter().map(|db| (db - mean) * (db - mean)).sum();
        let power = speed * speed * libm::exp10(mean / 10.0);
        (spread, Ratios { power, speed })
    };
    let tried = SPEED_STEPS.map(|step| fitted(f64::from(step) * SPEED_OCTAVES));
    let best = tried.min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(
        Ratios {
            power: 1.0,
            speed: 1.0,
        },
        |(_, ratios)| ratios,
    )
}

/// Level of the loudest third octave, dB.
#[must_use]
pub fn loudest_db(power: &Spectrum) -> f64 {
    bands_db(power).into_iter().fold(f64::MIN, f64::max)
}
