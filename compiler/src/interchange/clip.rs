//! Strokes and taps on one time line, for formats that know no speed and no force.

use crate::views::listen::Performance;
use serde::Serialize;

/// Silence after a stroke or a tap, s.
const PAUSE_S: f64 = 0.25;
/// Part of its peak that a tap exceeds when it begins.
const ONSET: f64 = 0.05;

/// Strokes, then taps.
#[derive(Debug, Clone, PartialEq)]
pub struct Clip {
    /// Name of the texture.
    pub name: String,
    /// Description of the contents.
    pub description: String,
    /// Rate of the signals, Hz.
    pub rate_hz: u32,
    /// The strokes.
    pub strokes: Vec<Take>,
    /// The taps.
    pub taps: Vec<Take>,
    /// Meaning of a format's full scale.
    pub scale: Scale,
}

/// A single stroke or tap.
#[derive(Debug, Clone, PartialEq)]
pub struct Take {
    /// Description of the gesture.
    pub label: String,
    /// When it begins, s.
    pub start_s: f64,
    /// Acceleration before device gain, m/s².
    pub signal_m_s2: Vec<f64>,
}

/// Accelerations that a format's largest amplitude stands for, m/s².
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scale {
    /// For strokes.
    pub stroke_m_s2: f64,
    /// For taps.
    pub tap_m_s2: f64,
}

impl Clip {
    /// The clip of a performance. A scale that is not given is the largest acceleration.
    #[must_use]
    pub fn new(
        name: &str,
        performance: &Performance,
        stroke_m_s2: Option<f64>,
        tap_m_s2: Option<f64>,
    ) -> Self {
        let rate_hz = performance.rate_hz.round() as u32;
        let mut start_s = 0.0;
        let mut take = |label: String, signal: &[f64]| {
            let take = Take {
                label,
                start_s,
                signal_m_s2: signal.to_vec(),
            };
            start_s = take.end_s(rate_hz) + PAUSE_S;
            take
        };
        let strokes: Vec<Take> = performance
            .strokes
            .iter()
            .map(|(stroke, signal)| {
                let label = format!("stroke {} mm/s {} N", stroke.speed_mm_s, stroke.force_n);
                take(label, signal)
            })
            .collect();
        let taps: Vec<Take> = performance
            .taps
            .iter()
            .map(|(speed_m_s, signal)| take(format!("tap {speed_m_s:.3} m/s"), signal))
            .collect();
        let scale = Scale {
            stroke_m_s2: stroke_m_s2.unwrap_or_else(|| full_scale(&strokes)),
            tap_m_s2: tap_m_s2.unwrap_or_else(|| full_scale(&taps)),
        };
        let labels: Vec<&str> = strokes
            .iter()
            .chain(&taps)
            .map(|t| t.label.as_str())
            .collect();
        Self {
            name: name.to_owned(),
            description: format!(
                "{}; 1.0 is {:.4} m/s2 in strokes, {:.4} m/s2 in taps",
                labels.join(", "),
                scale.stroke_m_s2,
                scale.tap_m_s2
            ),
            rate_hz,
            strokes,
            taps,
            scale,
        }
    }

    /// When the last part ends, s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        let last = self.taps.last().or(self.strokes.last());
        last.map_or(0.0, |take| take.end_s(self.rate_hz))
    }

    /// Samples that a full scale does not reach, over all samples.
    #[must_use]
    pub fn clipped(&self) -> f64 {
        let of = |takes: &[Take], scale: f64| {
            let samples = takes.iter().flat_map(|take| &take.signal_m_s2);
            // Rounding may lift the loudest sample itself.
            let over = samples
                .clone()
                .filter(|x| x.abs() > scale * (1.0 + 1e-9))
                .count();
            (over, samples.count())
        };
        let (a, n) = of(&self.strokes, self.scale.stroke_m_s2);
        let (b, m) = of(&self.taps, self.scale.tap_m_s2);
        (a + b) as f64 / (n + m).max(1) as f64
    }
}

impl Take {
    /// When it ends, s.
    #[must_use]
    pub fn end_s(&self, rate_hz: u32) -> f64 {
        self.start_s + self.signal_m_s2.len() as f64 / f64::from(rate_hz.max(1))
    }

    /// Largest acceleration, m/s².
    #[must_use]
    pub fn peak_m_s2(&self) -> f64 {
        self.signal_m_s2
            .iter()
            .fold(0.0f64, |peak, x| peak.max(x.abs()))
    }

    /// When a tap begins to sound, s.
    #[must_use]
    pub fn onset_s(&self, rate_hz: u32) -> f64 {
        let least = ONSET * self.peak_m_s2();
        let first = self.signal_m_s2.iter().position(|x| x.abs() > least);
        self.start_s + first.unwrap_or(0) as f64 / f64::from(rate_hz.max(1))
    }
}

/// The largest acceleration, or 1 m/s² where there is none.
fn full_scale(takes: &[Take]) -> f64 {
    let peak = takes.iter().map(Take::peak_m_s2).fold(0.0, f64::max);
    if peak > 0.0 { peak } else { 1.0 }
}
