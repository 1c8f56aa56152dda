//! Perceptual attributes of a texture, from its bytes.

use super::{Texture, polynomial};
use asperity_formats::Asset;
use std::f64::consts::TAU;

/// Speed (mm/s) and force (N) of the stroke that attributes describe.
const STROKE: (f64, f64) = (100.0, 1.0);
/// Below it a vibration is not felt as rough or sharp, Hz.
const FLOOR_HZ: f64 = 40.0;
/// Frequencies of a spectrum, from 0 to half the rate.
const POINTS: usize = 2048;
/// Frequencies where only the level counts, at many places: steps of 1 Hz for models at 1 kHz.
const LEVEL_POINTS: usize = 512;
/// Places on each axis of the grid where its level is looked for.
const PLACES: usize = 12;

/// The attributes of a texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attributes {
    /// Level above 40 Hz at 100 mm/s and 1 N, dB re 1 (m/s²)².
    pub rough_db: f64,
    /// Centroid of its power, Hz.
    pub sharp_hz: f64,
    /// Centroid of the power of the fastest tap, Hz.
    pub hard_hz: f64,
    /// Coefficient of friction.
    pub mu: f64,
}

/// The attributes of an asset with taps that sounds at the stroke.
///
/// # Panics
/// If it has no taps.
#[must_use]
pub fn attributes(asset: &Asset<'_>) -> Attributes {
    let texture = Texture::new(asset);
    let rate_hz = texture.sample_rate_hz;
    let (speed, force) = (
        STROKE.0.min(texture.max_speed_mm_s),
        STROKE.1.min(texture.max_force_n),
    );
    let density = density(&texture, speed, force, POINTS);
    let heard: Vec<(f64, f64)> = frequencies(rate_hz, POINTS)
        .zip(density)
        .filter(|(freq_hz, _)| *freq_hz >= FLOOR_HZ)
        .collect();
    let mean = heard.iter().map(|(_, power)| power).sum::<f64>() / POINTS as f64;
    let taps = asset.taps();
    let trace = taps.traces().last().expect("a tap");
    let samples: Vec<f64> = trace.accel_m_s2().map(f64::from).collect();
    let tap_rate_hz = f64::from(taps.sample_rate_hz());
    let tap: Vec<(f64, f64)> = frequencies(tap_rate_hz, POINTS)
        .map(|freq_hz| (freq_hz, power(&samples, TAU * freq_hz / tap_rate_hz)))
        .collect();
    Attributes {
        rough_db: 10.0 * mean.log10(),
        sharp_hz: centroid(&heard),
        hard_hz: centroid(&tap),
        mu: asset.friction().mu().into(),
    }
}

/// Largest RMS of the vibration's force anywhere on the grid, N: at its vertices and on a lattice.
#[must_use]
pub fn loudest_n(asset: &Asset<'_>) -> f64 {
    let texture = Texture::new(asset);
    let share = |k: usize| k as f64 / (PLACES - 1) as f64;
    let lattice = (0..PLACES * PLACES).map(|n| {
        (
            share(n % PLACES) * texture.max_speed_mm_s,
            share(n / PLACES) * texture.max_force_n,
        )
    });
    let vertices = texture.vertices.iter().map(|v| (v.speed_mm_s, v.force_n));
    let all = lattice.chain(vertices);
    let rms = all.map(|(speed, force)| rms_n(asset, &texture, speed, force));
    rms.fold(0.0, f64::max)
}

/// RMS of the vibration's force at the stroke that attributes describe, N.
#[must_use]
pub fn stroke_n(asset: &Asset<'_>) -> f64 {
    rms_n(asset, &Texture::new(asset), STROKE.0, STROKE.1)
}

fn rms_n(asset: &Asset<'_>, texture: &Texture, speed_mm_s: f64, force_n: f64) -> f64 {
    let power: f64 = density(texture, speed_mm_s, force_n, LEVEL_POINTS).sum();
    let coupling = asset.coupling();
    let to_force = f64::from(coupling.vib_s2_m) * f64::from(coupling.f_max_n);
    to_force * (power / LEVEL_POINTS as f64).sqrt()
}

/// Middles of equal steps from 0 to half a rate, Hz.
fn frequencies(rate_hz: f64, points: usize) -> impl Iterator<Item = f64> {
    (0..points).map(move |n| (n as f64 + 0.5) / points as f64 * rate_hz / 2.0)
}

/// Power of a texture's model at [`frequencies`]; its mean is the variance.
fn density(
    texture: &Texture,
    speed_mm_s: f64,
    force_n: f64,
    points: usize,
) -> impl Iterator<Item = f64> {
    let model = texture.model(speed_mm_s, force_n);
    let whole = |rest: Vec<f64>| [vec![1.0], rest].concat();
    let (a, b) = (
        whole(polynomial(&model.cosines)),
        whole(texture.numerator(&model)),
    );
    let rate_hz = texture.sample_rate_hz;
    frequencies(rate_hz, points).map(move |freq_hz| {
        let omega = TAU * freq_hz / rate_hz;
        model.level_m_s2 * model.level_m_s2 * power(&b, omega) / power(&a, omega)
    })
}

/// |Σ cₖ e^(−iωk)|².
fn power(coefficients: &[f64], omega: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (k, c) in coefficients.iter().enumerate() {
        re += c * (omega * k as f64).cos();
        im -= c * (omega * k as f64).sin();
    }
    re * re + im * im
}

fn centroid(spectrum: &[(f64, f64)]) -> f64 {
    let power: f64 = spectrum.iter().map(|(_, power)| power).sum();
    spectrum.iter().map(|(hz, power)| hz * power).sum::<f64>() / power
}
