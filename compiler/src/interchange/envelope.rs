//! Amplitude and frequency over time, for formats whose players drive an actuator by both.

use super::third_octave::{Shape, density};
use asperity_texture::signal::spectrum::Angles;
use std::f64::consts::TAU;

/// Time between two points, s.
const STEP_S: f64 = 0.02;
/// Length of the window around a point, s.
const WINDOW_S: f64 = 0.06;
/// Distance of the frequencies, Hz, and the lowest one that counts.
const BIN_HZ: f64 = 10.0;
const LOWEST_HZ: f64 = 20.0;
/// Frequencies above that no hand feels, Hz.
const HIGHEST_HZ: f64 = 1000.0;

/// Breakpoint of an envelope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    /// Time, s.
    pub(super) t_s: f64,
    /// Amplitude of the sine that has the signal's RMS, in the signal's unit.
    pub(super) amplitude: f64,
    /// Mean frequency by power, Hz.
    pub(super) freq_hz: f64,
}

/// The envelope of a signal that begins at `start_s`: points every 20 ms, and silence at both ends.
pub(super) fn envelope(signal: &[f64], rate_hz: u32, start_s: f64) -> Vec<Point> {
    let rate = f64::from(rate_hz);
    let half = ((0.5 * WINDOW_S * rate) as usize).max(1);
    let top_hz = HIGHEST_HZ.min(0.45 * rate);
    let bins: Vec<f64> = (1..)
        .map(|n| f64::from(n) * BIN_HZ)
        .skip_while(|hz| *hz < LOWEST_HZ)
        .take_while(|hz| *hz <= top_hz)
        .collect();
    let angles = Angles::new(bins.iter().map(|hz| TAU * hz / rate));
    let window: Vec<f64> = (0..2 * half)
        .map(|n| 0.5 - 0.5 * libm::cos(TAU * (n as f64 + 0.5) / (2 * half) as f64))
        .collect();
    let length_s = signal.len() as f64 / rate;
    let steps = (length_s / STEP_S).round().max(1.0) as usize;
    let at = |t_s: f64| {
        let center = (t_s * rate).round() as usize;
        let mut windowed = Vec::with_capacity(2 * half);
        let mut weights = 0.0;
        for (n, weight) in window.iter().enumerate() {
            let sample = (center + n).checked_sub(half).and_then(|i| signal.get(i));
            if let Some(x) = sample {
                windowed.push(x * weight);
                weights += weight * weight;
            }
        }
        let energy: f64 = windowed.iter().map(|x| x * x).sum();
        let (mut power, mut moment) = (0.0, 0.0);
        for (hz, x) in bins.iter().zip(angles.squared_magnitudes(&windowed)) {
            power += x;
            moment += hz * x;
        }
        let rms = (energy / weights.max(f64::MIN_POSITIVE)).sqrt();
        Point {
            t_s: start_s + t_s,
            amplitude: std::f64::consts::SQRT_2 * rms,
            freq_hz: if power > 0.0 {
                moment / power
            } else {
                LOWEST_HZ
            },
        }
    };
    let mut points: Vec<Point> = (0..=steps)
        .map(|step| at((step as f64 * STEP_S).min(length_s)))
        .collect();
    for end in [0, points.len() - 1] {
        points[end].amplitude = 0.0;
    }
    points
}

/// Mean frequency of a transient by power, Hz.
pub(super) fn transient_hz(signal: &[f64], rate_hz: u32) -> f64 {
    let rate = f64::from(rate_hz);
    let density = density(signal, rate, HIGHEST_HZ.min(0.45 * rate), Shape::Transient);
    let (mut power, mut moment) = (0.0, 0.0);
    for (hz, x) in density.iter().enumerate().skip(LOWEST_HZ as usize) {
        power += x;
        moment += hz as f64 * x;
    }
    if power > 0.0 {
        moment / power
    } else {
        LOWEST_HZ
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_has_its_amplitude_and_frequency_between_its_silent_ends() {
        let tone: Vec<f64> = (0..1000)
            .map(|n| 0.7 * libm::sin(TAU * 150.0 * f64::from(n) / 1000.0))
            .collect();
        let points = envelope(&tone, 1000, 2.0);
        assert_eq!((points[0].t_s, points[0].amplitude), (2.0, 0.0));
        for point in &points[3..points.len() - 3] {
            assert!((point.amplitude - 0.7).abs() < 0.02, "{point:?}");
            assert!((point.freq_hz - 150.0).abs() < 5.0, "{point:?}");
        }
    }
}
