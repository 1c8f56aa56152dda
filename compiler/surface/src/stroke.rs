//! Strokes over a relief: at speed v, heights at a spatial frequency k are accelerations at v·k.

use crate::{
    stylus::{Stylus, Support},
    vibration::{self, Spectrum},
    wave_spectrum::LineSpectrum,
};
use std::f64::consts::{LN_2, TAU};

/// Narrowest line in the spectrum of a real surface, octaves. No surface is perfectly regular.
pub const LEAST_SPREAD_OCTAVES: f64 = 0.22;

/// Points an octave.
const PER_OCTAVE: f64 = 24.0;
/// End of the spatial frequencies, 1/mm: 640 Hz at 20 mm/s.
const END_PER_MM: f64 = 32.0;
/// A line is drawn so many deviations far.
const REACH: f64 = 4.0;
/// Part of the highest frequencies that a power law is fitted to.
const FITTED: std::ops::Range<f64> = 0.25..0.7;
/// Steepest and flattest power of the heights beyond what was measured.
const SLOPES: (f64, f64) = (-9.0, -1.0);

/// Strokes over a relief in one direction and under one force.
#[derive(Debug, Clone)]
pub struct Strokes {
    /// Octave of the first point, re 1/mm.
    start: f64,
    /// Power of the heights times k⁴, µm²/mm⁴ an octave: that of accelerations but for the speed.
    per_octave: Vec<f64>,
    /// Spatial frequency from which the spectrum is continued by a power law, 1/mm.
    measured_to_per_mm: f64,
}

impl Strokes {
    /// Strokes over heights of this spectrum. Lines are no narrower than [`LEAST_SPREAD_OCTAVES`]; beyond what was
    /// measured, the heights follow the power law that fits their last octave and a half.
    #[must_use]
    pub fn over(line: &LineSpectrum) -> Self {
        let step = line.step_per_mm;
        let steps = line.power_um2.len();
        let measured_to_per_mm = step * (steps.max(2) - 1) as f64 * FITTED.end;
        let mut strokes = Self {
            start: libm::log2(0.5 * step),
            per_octave: vec![
                0.0;
                (PER_OCTAVE * libm::log2(END_PER_MM / (0.5 * step))) as usize + 1
            ],
            measured_to_per_mm,
        };
        let ends = (measured_to_per_mm / step) as usize;
        for (n, power) in line.power_um2.iter().enumerate().take(ends).skip(1) {
            let n = n as f64;
            let spread = LEAST_SPREAD_OCTAVES.max(libm::log2((n + 1.0) / n));
            strokes.draw(step * n, *power, spread);
        }
        if let Some((density, slope)) = power_law(line, measured_to_per_mm) {
            let octave = libm::log2(measured_to_per_mm);
            let count = ((libm::log2(END_PER_MM) - octave) * PER_OCTAVE).max(0.0) as usize;
            for point in 0..count {
                let k = libm::exp2(octave + (point as f64 + 0.5) / PER_OCTAVE);
                let power =
                    density * libm::pow(k / measured_to_per_mm, slope) * k * LN_2 / PER_OCTAVE;
                strokes.draw(k, power, LEAST_SPREAD_OCTAVES);
            }
        }
        strokes
    }

    /// Adds heights of a power around a spatial frequency, as a log-normal line.
    fn draw(&mut self, k_per_mm: f64, power_um2: f64, spread: f64) {
        let centre = (libm::log2(k_per_mm) - self.start) * PER_OCTAVE;
        let deviation = spread * PER_OCTAVE;
        let weight = power_um2 * k_per_mm.powi(4) / (spread * TAU.sqrt());
        let from = (centre - REACH * deviation).max(0.0) as usize;
        let to = (centre + REACH * deviation) as usize + 1;
        let end = self.per_octave.len().min(to);
        for (n, slot) in self.per_octave[from.min(end)..end].iter_mut().enumerate() {
            let x = ((from + n) as f64 - centre) / deviation;
            *slot += weight * libm::exp(-0.5 * x * x);
        }
    }

    /// Spatial frequency from which the spectrum is a continuation, 1/mm.
    #[must_use]
    pub const fn measured_to_per_mm(&self) -> f64 {
        self.measured_to_per_mm
    }

    /// Power of the acceleration of a stylus in a stroke, (m/s²)²/Hz.
    #[must_use]
    pub fn power(&self, speed_mm_s: f64, support: &Support) -> Spectrum {
        std::array::from_fn(|point| {
            let freq_hz = vibration::freq_hz(point);
            let k = freq_hz / speed_mm_s;
            // (2πv)⁴ with v in mm/s, of heights in µm.
            let squared = TAU * speed_mm_s * (TAU * speed_mm_s);
            let heights = self.per_octave_at(k) / (k * LN_2) / speed_mm_s;
            1e-12 * squared * squared * heights * Stylus::CALIBRATED.transmission(support, freq_hz)
        })
    }

    fn per_octave_at(&self, k_per_mm: f64) -> f64 {
        let at = (libm::log2(k_per_mm) - self.start) * PER_OCTAVE;
        if at < 0.0 {
            return 0.0;
        }
        let share = at - libm::floor(at);
        let point = |n: usize| self.per_octave.get(n).copied().unwrap_or(0.0);
        (1.0 - share) * point(at as usize) + share * point(at as usize + 1)
    }
}

/// Density of the heights at the end of what was measured, µm²·mm, and its slope in k: those of the power law with the same
/// mean power in two halves of the last octave and a half.
fn power_law(line: &LineSpectrum, end_per_mm: f64) -> Option<(f64, f64)> {
    let middle = (FITTED.start / FITTED.end).sqrt();
    let mean = |from: f64, to: f64| {
        let bins = [from, to].map(|share| (share * end_per_mm / line.step_per_mm) as usize);
        let powers = line.power_um2.get(bins[0].max(1)..bins[1])?;
        let density = powers.iter().sum::<f64>() / powers.len() as f64 / line.step_per_mm;
        (density > 0.0).then_some(density)
    };
    let low = mean(middle * middle, middle)?;
    let high = mean(middle, 1.0)?;
    let slope = libm::log(high / low) / -libm::log(middle);
    let slope = slope.clamp(SLOPES.0, SLOPES.1);
    // From the geometric middle of the upper half to its end.
    Some((high * libm::pow(middle, -0.5 * slope), slope))
}
