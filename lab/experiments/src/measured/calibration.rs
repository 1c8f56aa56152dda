//! The constants of the generator, fitted to measured materials.
//!
//! Residuals are the levels of third octaves in all strokes and ln μ; the prior is what physics and open data say. The
//! generator of a prediction has not seen its name: the names are left out in five parts.

use super::{
    least_squares::{self, Fit},
    material::{Generated, Material, Vibration},
    score::names,
    signature::{BANDS, FORCES_N, SPEEDS_MM_S, STROKES, Signature},
    trend::FEWEST,
};
use asperity_corpus::{
    Bin, CorpusError, SAMPLE_RATE_HZ, UnifiedGrid,
    generator::{
        self, Physical,
        constants::{COUNT, ConstantSet, Constants, ConstantsFile, Estimate},
        friction, level, surface, transfer,
    },
};
use asperity_surface::vibration::with_floor;
use rayon::prelude::*;
use std::array;

/// Parts that the names are left out in.
const FOLDS: usize = 5;
/// Deviation of a level from what the best constants say, dB, and the independent ones among the 108 of a material.
const LEVEL_DEVIATION_DB: f64 = 6.0;
const INDEPENDENT_LEVELS: f64 = 12.0;
/// Half of a 95 % interval of a normal distribution, standard deviations.
const INTERVAL: f64 = 1.959_964;
/// Deviation of ln μ.
const FRICTION_DEVIATION: f64 = 0.5;
/// Residuals of a material: levels and ln μ.
const ROWS: usize = STROKES * BANDS + 1;
/// Third octaves that the level is summed over, 10 to 400 Hz, as decades of a hertz in tenths; and which is the
/// first of the signature.
const OCTAVES: std::ops::Range<usize> = 10..27;
const FIRST_BAND: usize = 5;
/// Frequencies a third octave.
const PER_OCTAVE: usize = 6;

/// A measured material and its physical parameters.
struct Observed<'a> {
    physical: Physical,
    measured: &'a Vibration,
    name: usize,
}

/// Fills in what the generator predicts of each material, and fits its constants: the file with the calibrated values anew,
/// `None` where fewer than [`FEWEST`] materials have a counterpart in the reference corpus.
///
/// # Errors
/// [`CorpusError`] of the committed constants.
pub fn calibrate(materials: &mut [Material]) -> Result<Option<ConstantsFile>, CorpusError> {
    let file = ConstantsFile::embedded()?;
    let names = names(materials);
    let observed: Vec<Observed<'_>> = (materials.iter().zip(&names))
        .filter_map(|(m, &name)| {
            Some(Observed {
                physical: m.physical?,
                measured: &m.measured,
                name,
            })
        })
        .collect();
    let (calibration, folds) = if observed.len() < FEWEST {
        (None, Vec::new())
    } else {
        let all: Vec<&Observed<'_>> = observed.iter().collect();
        let fit = fitted(&file, &all, [0.0; COUNT]);
        let folds = (0..FOLDS).map(|fold| {
            let others = all.iter().copied().filter(|o| o.name % FOLDS != fold);
            at(&file, &fitted(&file, &others.collect::<Vec<_>>(), fit.x).x)
        });
        let folds: Vec<Constants> = folds.collect();
        (Some(calibrated(&file, &fit, &all)), folds)
    };
    let [shipped, open] = [ConstantSet::Calibrated, ConstantSet::Open].map(|set| file.values(set));
    materials
        .par_iter_mut()
        .zip(names)
        .for_each(|(material, name)| {
            material.generated = material.physical.map(|physical| {
                let by = |constants: &Constants| generate(constants, &physical);
                Generated {
                    shipped: by(&shipped),
                    left_out: folds.get(name % FOLDS).map(by),
                    open: by(&open),
                }
            });
        });
    Ok(calibration)
}

/// The texture that the generator makes, as the runtime mixes it.
fn generate(constants: &Constants, physical: &Physical) -> Vibration {
    let grid = UnifiedGrid::reference();
    let instance = generator::instance(constants, physical, &grid);
    Vibration {
        signature: Signature::of(&instance.grid(&grid.description())),
        mu: friction::mu(constants, physical),
    }
}

fn fitted(file: &ConstantsFile, observed: &[&Observed<'_>], start: [f64; COUNT]) -> Fit<COUNT> {
    least_squares::fit(start, |x| {
        let constants = at(file, x);
        let rows = observed.iter().flat_map(|o| residuals(&constants, o));
        rows.collect()
    })
}

/// The constants at a distance from the prior.
fn at(file: &ConstantsFile, x: &[f64; COUNT]) -> Constants {
    Constants::from_array(array::from_fn(|i| {
        let constant = &file.constant[i];
        let prior = constant.scaled(constant.open.value);
        constant.unscaled(prior + x[i] * constant.prior_deviation())
    }))
}

/// The file with the fitted values, their intervals, and how far one material moves each.
fn calibrated(file: &ConstantsFile, fit: &Fit<COUNT>, observed: &[&Observed<'_>]) -> ConstantsFile {
    let group: Vec<usize> = observed.iter().flat_map(|o| [o.name; ROWS]).collect();
    let half = fit.standard_errors(&group).map(|error| INTERVAL * error);
    let mut moved = [0.0_f64; COUNT];
    for material in 0..observed.len() {
        let without = fit.moved_without(material * ROWS..(material + 1) * ROWS);
        (0..COUNT).for_each(|i| moved[i] = moved[i].max(without[i]));
    }
    let end = |sign: f64| at(file, &array::from_fn(|i| fit.x[i] + sign * half[i])).to_array();
    let (value, low, high) = (at(file, &fit.x).to_array(), end(-1.0), end(1.0));
    let mut file = file.clone();
    for (i, constant) in file.constant.iter_mut().enumerate() {
        constant.moved = (100.0 * moved[i] / half[i]).round() / 100.0;
        constant.calibrated = Estimate {
            value: value[i],
            low: low[i],
            high: high[i],
        }
        .rounded();
    }
    file
}

/// Returns the residuals of a material, in standard deviations.
fn residuals(constants: &Constants, observed: &Observed<'_>) -> [f64; ROWS] {
    let weight = (INDEPENDENT_LEVELS / (STROKES * BANDS) as f64).sqrt() / LEVEL_DEVIATION_DB;
    let mut rows = [0.0; ROWS];
    for stroke in 0..STROKES {
        let found = bands_db(constants, &observed.physical, stroke_at(stroke));
        for band in 0..BANDS {
            let apart = found[band] - observed.measured.signature.0[stroke][band];
            rows[stroke * BANDS + band] = weight * apart;
        }
    }
    let mu = friction::mu(constants, &observed.physical);
    rows[ROWS - 1] = libm::log(mu / observed.measured.mu) / FRICTION_DEVIATION;
    rows
}

/// A stroke of a signature.
fn stroke_at(stroke: usize) -> Bin {
    Bin {
        speed_mm_s: SPEEDS_MM_S[stroke / FORCES_N.len()],
        force_n: FORCES_N[stroke % FORCES_N.len()],
    }
}

/// Levels of the third octaves of a signature, dB, by the generator's spectrum itself: the AR(21) that an instance
/// holds follows it closely, and takes a hundred times as long.
fn bands_db(constants: &Constants, physical: &Physical, stroke: Bin) -> [f64; BANDS] {
    let points = OCTAVES.len() * PER_OCTAVE;
    let mut mean = 0.0;
    let mut powers = vec![(0.0, 0.0); points];
    for (n, slot) in powers.iter_mut().enumerate() {
        let decades =
            OCTAVES.start as f64 / 10.0 - 0.05 + (n as f64 + 0.5) / (10 * PER_OCTAVE) as f64;
        let freq_hz = libm::exp10(decades);
        let half = 0.05 / PER_OCTAVE as f64;
        let width_hz = freq_hz * (libm::exp10(half) - libm::exp10(-half));
        let relief = surface::relief_power(constants, physical, freq_hz / stroke.speed_mm_s);
        let power = relief * transfer::gain(constants, physical, stroke, freq_hz);
        // The zero 1 + z⁻¹, of which a constant is left out.
        let zero = 1.0 + libm::cos(std::f64::consts::TAU * freq_hz / SAMPLE_RATE_HZ);
        mean += power * width_hz / (0.5 * SAMPLE_RATE_HZ);
        *slot = (power, width_hz * zero);
    }
    let mut bands = [0.0; BANDS];
    let mut total = 0.0;
    for (n, (power, width)) in powers.into_iter().enumerate() {
        let power = with_floor(power / mean, constants.floor) * width;
        total += power;
        if let Some(band) = (n / PER_OCTAVE).checked_sub(FIRST_BAND) {
            bands[band] += power;
        }
    }
    let level_db = level::rms_db(constants, physical, stroke);
    bands.map(|power| level_db + 10.0 * libm::log10(power / total))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_corpus::reference;

    #[test]
    fn the_constants_that_made_materials_are_found_again() {
        let file = ConstantsFile::embedded().expect("the committed constants");
        let truth = Constants {
            level_db: -9.0,
            force_exponent: 0.8,
            resonance_hz: 300.0,
            friction: 0.5,
            ..file.values(ConstantSet::Calibrated)
        };
        let materials = reference::physical().expect("the committed corpus");
        let made: Vec<(Physical, Vibration)> = (materials.into_values().step_by(6))
            .map(|physical| (physical, generate(&truth, &physical)))
            .collect();
        let observed: Vec<Observed<'_>> = (made.iter().enumerate())
            .map(|(name, (physical, measured))| Observed {
                physical: *physical,
                measured,
                name,
            })
            .collect();
        let fit = fitted(&file, &observed.iter().collect::<Vec<_>>(), [0.0; COUNT]);
        let found = at(&file, &fit.x);
        // The prior draws, and the instances are AR models: a quarter of the way from it is left at most.
        let prior = file.values(ConstantSet::Open);
        for (name, pick) in [
            (
                "level",
                (|c: &Constants| c.level_db) as fn(&Constants) -> f64,
            ),
            ("force", |c| c.force_exponent),
            ("resonance", |c| libm::log(c.resonance_hz)),
            ("friction", |c| libm::log(c.friction)),
        ] {
            let left = (pick(&found) - pick(&truth)) / (pick(&prior) - pick(&truth));
            assert!(left.abs() < 0.25, "{name}: {left}, {found:?}");
        }
    }
}
