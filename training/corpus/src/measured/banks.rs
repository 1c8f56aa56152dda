//! Dependence of a bank's traces on the impact speed.

use crate::{
    TAP_RATE_HZ, TAP_SAMPLES, TAPS,
    generator::{Physical, tap},
};
use asperity::signal::{impact, spectrum::trace_centroid_hz};

/// A pulse counts as over where it falls below this fraction of its peak.
const OVER: f64 = 0.1;

/// Figures of a material's bank.
#[derive(Debug, Clone, PartialEq)]
pub struct Bank {
    /// Contact time of each trace, ms, read from its pulse. `None` where the hand or a mode hides its
    /// end.
    pub contact_ms: [Option<f64>; TAPS],
    /// Hertz's, ms.
    pub hertz_ms: [f64; TAPS],
    /// Spectral centroid of each trace, Hz.
    pub centroid_hz: [f64; TAPS],
    /// Exponent of the peak in the impact speed, from the slowest to the fastest trace.
    pub peak_exponent: f64,
    /// Cosine between the slowest and the fastest trace.
    pub cosine: f64,
    /// RMS error half-way between two speeds of the bank, the worst of them, relative to the truth's
    /// RMS: of the mean of the two traces, and of the better of the two alone.
    pub between: [f64; 2],
}

impl Bank {
    /// Measures the taps of a surface.
    #[must_use]
    pub fn of(physical: &Physical) -> Self {
        let impact = tap::impact(physical);
        let speeds = impact::speeds_m_s();
        let bank = impact::bank(&impact, 1.0, f64::INFINITY);
        let mut between = [0.0_f64; 2];
        for n in 0..TAPS - 1 {
            let speed_m_s = 0.5 * (speeds[n] + speeds[n + 1]);
            let truth = impact.unit_trace(speed_m_s).map(|a| a * speed_m_s);
            let mean: [f64; TAP_SAMPLES] =
                std::array::from_fn(|i| 0.5 * (bank[n][i] + bank[n + 1][i]));
            let nearest = error(&bank[n], &truth).min(error(&bank[n + 1], &truth));
            between[0] = between[0].max(error(&mean, &truth));
            between[1] = between[1].max(nearest);
        }
        let (slowest, fastest) = (&bank[0], &bank[TAPS - 1]);
        Self {
            contact_ms: bank.each_ref().map(contact_ms),
            hertz_ms: speeds.map(|speed_m_s| 1e3 * impact.contact_time_s(speed_m_s)),
            centroid_hz: bank
                .each_ref()
                .map(|trace| trace_centroid_hz(trace, TAP_RATE_HZ).unwrap_or_default()),
            peak_exponent: libm::log(peak(fastest) / peak(slowest))
                / libm::log(speeds[TAPS - 1] / speeds[0]),
            cosine: product(slowest, fastest)
                / (product(slowest, slowest) * product(fastest, fastest)).sqrt(),
            between,
        }
    }

    /// Largest difference of a contact time from Hertz's, relative; `None` where none can be read.
    #[must_use]
    pub fn contact_error(&self) -> Option<f64> {
        let pairs = self.contact_ms.iter().zip(&self.hertz_ms);
        pairs
            .filter_map(|(found, hertz)| found.map(|found| (found / hertz - 1.0).abs()))
            .max_by(f64::total_cmp)
    }
}

/// From the touch to where the pulse is over, through the part of a Hertzian pulse before that.
fn contact_ms(trace: &[f64; TAP_SAMPLES]) -> Option<f64> {
    let top = (0..TAP_SAMPLES).max_by(|&i, &j| trace[i].total_cmp(&trace[j]))?;
    let level = OVER * trace[top];
    let after = (top..TAP_SAMPLES).find(|&n| trace[n] < level)?;
    let fraction = (trace[after - 1] - level) / (trace[after - 1] - trace[after]);
    let crossing = after as f64 - 1.0 + fraction;
    let before = 1.0 - libm::asin(libm::pow(OVER, 2.0 / 3.0)) / std::f64::consts::PI;
    Some(1e3 * crossing / TAP_RATE_HZ / before)
}

fn peak(trace: &[f64]) -> f64 {
    trace.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()))
}

fn product(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

fn error(found: &[f64], truth: &[f64]) -> f64 {
    let difference: Vec<f64> = found.iter().zip(truth).map(|(a, b)| a - b).collect();
    (product(&difference, &difference) / product(truth, truth)).sqrt()
}
