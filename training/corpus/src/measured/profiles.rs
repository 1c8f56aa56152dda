//! Measured height profiles through the generator's contact model, held against its own heights.
//!
//! Both are drawn at 100 mm/s under 1 N: heights at v·k, the tip, two derivatives, stylus and hand,
//! the floor. What is compared is the power in third octaves, the mean difference taken off.

use crate::{
    Bin,
    generator::{Physical, constants::Constants, surface::relief_power, transfer},
};
use asperity_surface::vibration::{POINTS, freq_hz};
use std::collections::BTreeMap;

const PROFILES_CSV: &str = include_str!("../../../corpora/measured/profiles.csv");
const STROKE: Bin = Bin {
    speed_mm_s: 100.0,
    force_n: 1.0,
};
/// Third octaves: 16 to 400 Hz, as decades of a hertz in tenths.
const BANDS: std::ops::RangeInclusive<i32> = 12..=26;

/// A profile and the material of the reference corpus that it is compared with.
pub const PAIRS: [(&str, &str); 12] = [
    ("acrylic", "acrylic sheet"),
    ("bass_wood", "planed pine"),
    ("ceramic", "unglazed terracotta"),
    ("plywood", "plywood"),
    ("polycarbonate", "acrylic sheet"),
    ("polyethylene", "polythene bag"),
    ("poplar_wood", "planed pine"),
    ("pvc", "PVC pipe"),
    ("rough_wood", "rough-sawn plank"),
    ("sanded_acrylic", "acrylic sheet"),
    ("sandpaper", "220-grit sandpaper"),
    ("vinyl", "vinyl record"),
];

/// Density of a profile's heights at a spatial frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Spatial frequency, 1/mm.
    pub k_per_mm: f64,
    /// Power spectral density, one-sided, µm²·mm.
    pub density_um2_mm: f64,
}

/// Difference between a profile and the generator's heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// RMS difference of third octaves of acceleration, 16–400 Hz, level aligned, dB.
    pub rms_db: f64,
    /// Slope of the third octaves of the profile and of the generator, dB an octave.
    pub slope_db_per_octave: [f64; 2],
    /// RMS difference of the densities of heights before the contact, level aligned, dB.
    pub heights_rms_db: f64,
}

/// Profiles by name. A line that is no point is skipped; a test counts them.
#[must_use]
pub fn profiles() -> BTreeMap<&'static str, Vec<Point>> {
    let mut profiles: BTreeMap<_, Vec<Point>> = BTreeMap::new();
    for line in PROFILES_CSV.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let &[profile, k_per_mm, density] = fields.as_slice() else {
            continue;
        };
        if let (Ok(k_per_mm), Ok(density_um2_mm)) = (k_per_mm.parse(), density.parse()) {
            let point = Point {
                k_per_mm,
                density_um2_mm,
            };
            profiles.entry(profile).or_default().push(point);
        }
    }
    profiles
}

/// Returns the difference between a measured profile and a surface; `None` for an unknown profile.
#[must_use]
pub fn distance(constants: &Constants, profile: &str, physical: &Physical) -> Option<Distance> {
    let profiles = profiles();
    let points = profiles.get(profile)?;
    Some(distance_of(constants, physical, |k_per_mm| {
        density_at(points, k_per_mm)
    }))
}

/// Returns the difference between heights of a given density and a surface's own.
#[must_use]
pub fn distance_of(
    constants: &Constants,
    physical: &Physical,
    density_at: impl Fn(f64) -> f64,
) -> Distance {
    let own_heights = |k: f64| relief_power(constants, physical, k);
    let measured = third_octaves_db(constants, physical, &density_at);
    let own = third_octaves_db(constants, physical, own_heights);
    let centres = || BANDS.map(|band| libm::exp10(f64::from(band) / 10.0) / STROKE.speed_mm_s);
    let heights = centres().map(|k| decibels(density_at(k)) - decibels(own_heights(k)));
    let differences = measured.iter().zip(&own).map(|(x, y)| x - y);
    Distance {
        rms_db: spread(&differences.collect::<Vec<_>>()),
        slope_db_per_octave: [slope(&measured), slope(&own)],
        heights_rms_db: spread(&heights.collect::<Vec<_>>()),
    }
}

/// Mean power in the third octaves of the acceleration that heights cause, dB.
fn third_octaves_db(
    constants: &Constants,
    physical: &Physical,
    heights: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let spectrum = transfer::spectrum_over(constants, physical, STROKE, heights);
    BANDS
        .map(|band| {
            let centre_hz = libm::exp10(f64::from(band) / 10.0);
            let edge = libm::exp10(0.05);
            let inside =
                |point: &usize| (centre_hz / edge..centre_hz * edge).contains(&freq_hz(*point));
            let powers: Vec<f64> = (0..POINTS).filter(inside).map(|p| spectrum[p]).collect();
            decibels(powers.iter().sum::<f64>() / powers.len().max(1) as f64)
        })
        .collect()
}

/// Density at a spatial frequency, µm²·mm: log-linear between the points, constant beyond them.
#[must_use]
pub fn density_at(points: &[Point], k_per_mm: f64) -> f64 {
    let after = points.partition_point(|p| p.k_per_mm < k_per_mm);
    let (Some(low), Some(high)) = (after.checked_sub(1), points.get(after)) else {
        let end = if after == 0 {
            points.first()
        } else {
            points.last()
        };
        return end.map_or(0.0, |p| p.density_um2_mm);
    };
    let low = &points[low];
    let fraction = libm::log(k_per_mm / low.k_per_mm) / libm::log(high.k_per_mm / low.k_per_mm);
    low.density_um2_mm * libm::pow(high.density_um2_mm / low.density_um2_mm, fraction)
}

fn decibels(power: f64) -> f64 {
    10.0 * libm::log10(power.max(f64::MIN_POSITIVE))
}

/// RMS about the mean.
fn spread(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count).sqrt()
}

/// Least squares over third octaves, dB an octave.
fn slope(values_db: &[f64]) -> f64 {
    let centre = 0.5 * (values_db.len() as f64 - 1.0);
    let (mut product, mut square) = (0.0, 0.0);
    for (index, value) in values_db.iter().enumerate() {
        let x = index as f64 - centre;
        product += x * value;
        square += x * x;
    }
    // A tenth of a decade is 0.332 octaves.
    product / square / (0.1 * std::f64::consts::LOG2_10)
}
