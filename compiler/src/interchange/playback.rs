//! Playback of effects: tones, curves and transients.
//!
//! A tone is a sine with amplitude and frequency over time. A curve is the signal itself, drawn by
//! straight lines. A transient is two periods of a sine, as the reference software of MPEG plays it.
//! Values are in full scales.

use std::f64::consts::TAU;

/// Rate at which effects are played, Hz.
pub const PLAY_HZ: u32 = 16_000;

/// Everything that a file plays.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    /// Tones.
    pub tones: Vec<Vec<TonePoint>>,
    /// Curves.
    pub curves: Vec<Vec<CurvePoint>>,
    /// Transients, in order of time.
    pub transients: Vec<Transient>,
    /// True if the phase of a tone is zero where the tone begins, rather than at its first sample. The relative phases
    /// of simultaneous tones of equal frequency determine their level.
    pub phase_from_beginning: bool,
    /// Deviations from the file in reading it.
    pub warnings: Vec<String>,
}

/// A point of a tone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TonePoint {
    /// Time, s.
    pub t_s: f64,
    /// Amplitude, 0..=1.
    pub amplitude: f64,
    /// Frequency, Hz.
    pub freq_hz: f64,
}

/// A point of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Time, s.
    pub t_s: f64,
    /// Value, −1..=1.
    pub value: f64,
}

/// Two periods of a sine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transient {
    /// When it begins, s.
    pub t_s: f64,
    /// Largest value, 0..=1.
    pub amplitude: f64,
    /// Frequency, Hz.
    pub freq_hz: f64,
}

impl Transient {
    /// Its value `t_s` after its beginning.
    #[must_use]
    pub fn value(&self, t_s: f64) -> f64 {
        if (0.0..2.0 / self.freq_hz).contains(&t_s) {
            self.amplitude * libm::sin(TAU * self.freq_hz * t_s)
        } else {
            0.0
        }
    }
}

impl Track {
    /// When the last effect ends, s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        let tones = self.tones.iter().filter_map(|t| t.last()).map(|p| p.t_s);
        let curves = self.curves.iter().filter_map(|c| c.last()).map(|p| p.t_s);
        let transients = self.transients.iter().map(|t| t.t_s + 2.0 / t.freq_hz);
        tones.chain(curves).chain(transients).fold(0.0, f64::max)
    }

    /// Tones and curves as samples, up to the end of the last one.
    #[must_use]
    pub fn continuous(&self, rate_hz: u32) -> Vec<f64> {
        let mut samples = Vec::new();
        for tone in &self.tones {
            let mut phase = match tone.first() {
                Some(first) if self.phase_from_beginning => {
                    let rate = f64::from(rate_hz);
                    let sample_s = (first.t_s * rate).ceil() / rate;
                    TAU * first.freq_hz * (sample_s - first.t_s)
                }
                _ => 0.0,
            };
            each_sample(
                tone,
                |p| p.t_s,
                rate_hz,
                &mut samples,
                |a, b, share| {
                    let mix = |x: f64, y: f64| x + share * (y - x);
                    let value = mix(a.amplitude, b.amplitude) * libm::sin(phase);
                    phase += TAU * mix(a.freq_hz, b.freq_hz) / f64::from(rate_hz);
                    value
                },
            );
        }
        for curve in &self.curves {
            each_sample(
                curve,
                |p| p.t_s,
                rate_hz,
                &mut samples,
                |a, b, share| a.value + share * (b.value - a.value),
            );
        }
        samples
    }

    /// Transients as samples.
    #[must_use]
    pub fn taps(&self, rate_hz: u32) -> Vec<f64> {
        let rate = f64::from(rate_hz);
        let mut samples = Vec::new();
        for transient in &self.transients {
            let end = transient.t_s + 2.0 / transient.freq_hz;
            let range = (transient.t_s * rate).ceil() as usize..(end * rate).ceil() as usize;
            grow(&mut samples, range.end);
            for n in range {
                samples[n] += transient.value(n as f64 / rate - transient.t_s);
            }
        }
        samples
    }
}

fn grow(samples: &mut Vec<f64>, len: usize) {
    if samples.len() < len {
        samples.resize(len, 0.0);
    }
}

/// Adds `value` of the points on both sides, and of the share of the way, for every sample.
fn each_sample<P>(
    points: &[P],
    time: impl Fn(&P) -> f64,
    rate_hz: u32,
    samples: &mut Vec<f64>,
    mut value: impl FnMut(&P, &P, f64) -> f64,
) {
    let rate = f64::from(rate_hz);
    for pair in points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let (from, to) = (time(a), time(b));
        let range = (from * rate).ceil() as usize..(to * rate).ceil() as usize;
        grow(samples, range.end);
        for n in range {
            let share = (n as f64 / rate - from) / (to - from);
            samples[n] += value(a, b, share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_keeps_its_phase_where_its_frequency_changes() {
        let point = |t_s, freq_hz| TonePoint {
            t_s,
            amplitude: 1.0,
            freq_hz,
        };
        let track = Track {
            tones: vec![vec![point(0.0, 50.0), point(0.5, 60.0), point(1.0, 300.0)]],
            ..Track::default()
        };
        let samples = track.continuous(PLAY_HZ);
        assert_eq!(samples.len(), PLAY_HZ as usize);
        let most = TAU * 300.0 / f64::from(PLAY_HZ);
        assert!(samples.windows(2).all(|x| (x[1] - x[0]).abs() <= most));
    }

    #[test]
    fn a_curve_passes_its_points_and_a_transient_has_two_periods() {
        let point = |t_s, value| CurvePoint { t_s, value };
        let track = Track {
            curves: vec![vec![point(0.1, 0.0), point(0.2, 1.0), point(0.3, -1.0)]],
            transients: vec![Transient {
                t_s: 0.5,
                amplitude: 0.5,
                freq_hz: 100.0,
            }],
            ..Track::default()
        };
        let samples = track.continuous(1000);
        assert!((samples[150] - 0.5).abs() < 1e-9 && (samples[250]).abs() < 1e-9);
        let taps = track.taps(PLAY_HZ);
        assert_eq!(taps.len(), (0.52 * f64::from(PLAY_HZ)) as usize);
        let peak = taps.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        assert!((peak - 0.5).abs() < 1e-3);
    }
}
