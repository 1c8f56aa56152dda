//! Levels in third octaves, and how far two signals are apart in them.

use asperity_texture::signal::spectrum::Angles;
use serde::Serialize;
use std::f64::consts::TAU;

/// The lowest band: 1000 Hz·2^(−19/3) = 12.4 Hz.
const LOWEST: i32 = -19;
/// Length of a segment, s, and with it the distance of the frequencies, 1 Hz.
const SEGMENT_S: f64 = 1.0;
/// Bands this far below the loudest one of the source count as silent, dB.
pub const FLOOR_DB: f64 = 40.0;
/// Most segments that a spectrum is averaged over.
const MAX_SEGMENTS: usize = 64;

/// Type of signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// It goes on: Hann windows of 1 s, which overlap by half, are averaged.
    Steady,
    /// It comes and goes within 1 s: one window without weights.
    Transient,
}

/// Power density at whole frequencies, Hz, from 0 to `top_hz`, in the signal's unit² per Hz.
#[must_use]
pub fn density(signal: &[f64], rate_hz: f64, top_hz: f64, shape: Shape) -> Vec<f64> {
    let segment = ((SEGMENT_S * rate_hz) as usize).max(1);
    let bins = top_hz.min(0.5 * rate_hz).max(0.0) as usize + 1;
    let angles = Angles::new((0..bins).map(|hz| TAU * hz as f64 / rate_hz));
    let length = segment.min(signal.len());
    let weight = |n: usize| match shape {
        Shape::Transient => 1.0,
        Shape::Steady => 0.5 - 0.5 * libm::cos(TAU * (n as f64 + 0.5) / length as f64),
    };
    let window: Vec<f64> = (0..length).map(weight).collect();
    let energy: f64 = window.iter().map(|w| w * w).sum();
    let last = match shape {
        Shape::Transient => 0,
        Shape::Steady => signal.len() - length,
    };
    let starts: Vec<usize> = (0..=last)
        .step_by((length / 2).max(1))
        .take(MAX_SEGMENTS)
        .collect();
    let mut sums = vec![0.0; bins];
    for &start in &starts {
        let part = &signal[start..start + length];
        let windowed: Vec<f64> = part.iter().zip(&window).map(|(x, w)| x * w).collect();
        for (sum, power) in sums.iter_mut().zip(angles.squared_magnitudes(&windowed)) {
            *sum += power;
        }
    }
    // One-sided.
    let scale = 2.0 / (rate_hz * energy.max(f64::MIN_POSITIVE) * starts.len().max(1) as f64);
    sums.iter_mut().for_each(|sum| *sum *= scale);
    sums
}

/// Centres of the bands whose upper edge is not above `top_hz`, Hz.
#[must_use]
pub fn centers_hz(top_hz: f64) -> Vec<f64> {
    (LOWEST..)
        .map(|n| 1000.0 * libm::exp2(f64::from(n) / 3.0))
        .take_while(|center| center * edge() <= top_hz)
        .collect()
}

/// Upper edge of a band relative to its centre.
fn edge() -> f64 {
    libm::exp2(1.0 / 6.0)
}

/// Mean square in each band up to `top_hz`.
#[must_use]
pub fn powers(signal: &[f64], rate_hz: f64, top_hz: f64, shape: Shape) -> Vec<f64> {
    let density = density(signal, rate_hz, top_hz + 1.0, shape);
    centers_hz(top_hz)
        .iter()
        .map(|center| {
            let (low, high) = (center / edge(), center * edge());
            let inside =
                (low.ceil() as usize..=high.floor() as usize).filter_map(|hz| density.get(hz));
            inside.sum()
        })
        .collect()
}

/// A band of the source and of what a format carries.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Band {
    /// Centre, Hz.
    pub center_hz: f64,
    /// Level of the source, dB re 1 (m/s²)².
    pub source_db: f64,
    /// Level of what is carried, dB re 1 (m/s²)².
    pub carried_db: f64,
}

/// Level loss of a signal in a format, over the third octaves in which either of the two sounds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Loss {
    /// RMS of the level differences, dB.
    pub rms_db: f64,
    /// The largest one, dB.
    pub worst_db: f64,
    /// Centre of its band, Hz.
    pub worst_hz: f64,
    /// The bands. Levels below the floor are given as the floor, [`FLOOR_DB`] below the loudest band
    /// of the source.
    pub bands: Vec<Band>,
}

/// The difference of two signals at one rate; `None` for a silent source.
#[must_use]
pub fn loss(
    source: &[f64],
    carried: &[f64],
    rate_hz: f64,
    top_hz: f64,
    shape: Shape,
) -> Option<Loss> {
    let [source, carried] = [source, carried].map(|x| powers(x, rate_hz, top_hz, shape));
    let loudest = source.iter().fold(0.0f64, |a, &b| a.max(b));
    if loudest <= 0.0 {
        return None;
    }
    let floor = loudest * libm::pow(10.0, -FLOOR_DB / 10.0);
    let db = |power: f64| 10.0 * libm::log10(power.max(floor));
    let bands: Vec<Band> = centers_hz(top_hz)
        .into_iter()
        .zip(source.into_iter().zip(carried))
        .filter(|(_, (a, b))| a.max(*b) > floor)
        .map(|(center_hz, (a, b))| Band {
            center_hz,
            source_db: db(a),
            carried_db: db(b),
        })
        .collect();
    let difference = |band: &Band| (band.carried_db - band.source_db).abs();
    let worst = bands
        .iter()
        .max_by(|a, b| difference(a).total_cmp(&difference(b)))?;
    let squares: f64 = bands
        .iter()
        .map(|band| difference(band) * difference(band))
        .sum();
    Some(Loss {
        rms_db: (squares / bands.len() as f64).sqrt(),
        worst_db: difference(worst),
        worst_hz: worst.center_hz,
        bands,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(freq_hz: f64, amplitude: f64) -> Vec<f64> {
        let at = |n: usize| amplitude * libm::sin(TAU * freq_hz * n as f64 / 4000.0);
        (0..8000).map(at).collect()
    }

    #[test]
    fn a_tone_has_its_mean_square_in_its_band_and_next_to_nothing_elsewhere() {
        let powers = powers(&tone(100.0, 2.0), 4000.0, 500.0, Shape::Steady);
        let centers = centers_hz(500.0);
        for (center, power) in centers.iter().zip(&powers) {
            if (center / 100.0).log2().abs() < 1.0 / 6.0 {
                assert!((power - 2.0).abs() < 0.01, "{power}");
            } else {
                assert!(*power < 1e-6, "{center}: {power}");
            }
        }
    }

    #[test]
    fn half_the_amplitude_is_six_decibels_and_another_band_is_down_to_the_floor() {
        let halved = loss(
            &tone(100.0, 1.0),
            &tone(100.0, 0.5),
            4000.0,
            500.0,
            Shape::Steady,
        );
        let halved = halved.unwrap();
        assert!((halved.rms_db - 6.02).abs() < 0.01 && halved.bands.len() == 1);
        let moved = loss(
            &tone(100.0, 1.0),
            &tone(200.0, 1.0),
            4000.0,
            500.0,
            Shape::Steady,
        );
        let moved = moved.unwrap();
        assert!((moved.rms_db - FLOOR_DB).abs() < 0.1 && moved.bands.len() == 2);
        assert!(
            loss(
                &[0.0; 8000],
                &tone(100.0, 1.0),
                4000.0,
                500.0,
                Shape::Steady
            )
            .is_none()
        );
    }
}
