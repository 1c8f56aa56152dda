//! From a commanded force to the acceleration at the tip: gain, phase, coherence, resonance, delay.
//!
//! With the cross-spectrum S_ua and the spectra S_uu and S_aa, averaged over windowed segments,
//!
//! ```text
//! H(f) = S_ua / S_uu,   γ²(f) = |S_ua|² / (S_uu·S_aa)
//! ```
//!
//! H ignores noise of the accelerometer. Where γ² is low, the acceleration does not follow from
//! the force: friction, noise, or a hand that moves.

use core::f64::consts::TAU;

use thiserror::Error;

/// The response at one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Frequency, Hz.
    pub freq_hz: f64,
    /// Gain, m/s² a newton.
    pub gain_m_s2_n: f64,
    /// Phase, rad, in −π..=π.
    pub phase_rad: f64,
    /// Coherence γ², 0 to 1.
    pub coherence: f64,
}

/// A measured response.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// Rate of the signals, Hz.
    pub rate_hz: f64,
    /// The response, in ascending frequency.
    pub points: Vec<Point>,
    /// Frequency of the largest gain within the band, Hz.
    pub resonance_hz: f64,
    /// That gain over the median gain of the band, dB.
    pub resonance_db: f64,
    /// Delay of the acceleration, s, from the slope of the phase where the coherence is high.
    pub delay_s: f64,
    /// Least coherence within the band.
    pub worst_coherence: f64,
}

/// Where textures are felt, and devices are to agree, Hz.
pub const BAND_HZ: (f64, f64) = (40.0, 400.0);

/// Why no response can be estimated.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// The signals have different lengths.
    #[error("{force} forces and {acceleration} accelerations: each period needs both")]
    Lengths {
        /// Forces.
        force: usize,
        /// Accelerations.
        acceleration: usize,
    },
    /// Too short.
    #[error("{found} samples are too few: {needed} at least")]
    TooShort {
        /// Samples.
        found: usize,
        /// Samples that are needed.
        needed: usize,
    },
    /// A value that is not finite.
    #[error("sample {at} is not a number")]
    NotFinite {
        /// Which.
        at: usize,
    },
    /// The rate cannot show the band.
    #[error("a rate of {rate_hz} Hz shows nothing at 400 Hz; 900 Hz at least")]
    Rate {
        /// The rate.
        rate_hz: f64,
    },
    /// The force has no energy in a part of the band.
    #[error("the force has nothing at {freq_hz:.0} Hz; play the whole sweep")]
    Silent {
        /// Where.
        freq_hz: f64,
    },
}

impl ResponseError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        "record the whole sweep, with the force and the acceleration of every period in one row"
    }
}

/// Samples of a segment: bins of 3.9 Hz at 1 kHz.
const SEGMENT: usize = 256;
/// Segments overlap by half, so this many samples give 16 of them at least.
const LEAST: usize = SEGMENT * 17 / 2;

/// Estimates the response.
///
/// # Errors
/// [`ResponseError`].
pub fn estimate(
    force_n: &[f64],
    accel_m_s2: &[f64],
    rate_hz: f64,
) -> Result<Response, ResponseError> {
    if force_n.len() != accel_m_s2.len() {
        return Err(ResponseError::Lengths {
            force: force_n.len(),
            acceleration: accel_m_s2.len(),
        });
    }
    if force_n.len() < LEAST {
        return Err(ResponseError::TooShort {
            found: force_n.len(),
            needed: LEAST,
        });
    }
    if rate_hz.is_nan() || rate_hz < 900.0 {
        return Err(ResponseError::Rate { rate_hz });
    }
    let finite = |at: &usize| force_n[*at].is_finite() && accel_m_s2[*at].is_finite();
    if let Some(at) = (0..force_n.len()).find(|at| !finite(at)) {
        return Err(ResponseError::NotFinite { at });
    }
    let bins = 1..SEGMENT / 2;
    let spectra: Vec<Spectra> = bins
        .map(|bin| Spectra::at(bin, force_n, accel_m_s2))
        .collect();
    let loudest = spectra.iter().map(|s| s.force).fold(0.0, f64::max);
    let step_hz = rate_hz / SEGMENT as f64;
    let mut points = Vec::new();
    for (n, spectra) in spectra.iter().enumerate() {
        let freq_hz = (n + 1) as f64 * step_hz;
        let in_band = (BAND_HZ.0..=BAND_HZ.1).contains(&freq_hz);
        // 60 dB below the loudest bin is leakage.
        if spectra.force <= 1e-6 * loudest {
            if in_band {
                return Err(ResponseError::Silent { freq_hz });
            }
            continue;
        }
        points.push(spectra.point(freq_hz));
    }
    Ok(summarise(rate_hz, points))
}

fn summarise(rate_hz: f64, points: Vec<Point>) -> Response {
    let in_band = |point: &&Point| (BAND_HZ.0..=BAND_HZ.1).contains(&point.freq_hz);
    let band: Vec<Point> = points.iter().filter(in_band).copied().collect();
    let loudest = band
        .iter()
        .copied()
        .reduce(|a, b| if b.gain_m_s2_n > a.gain_m_s2_n { b } else { a });
    let mut gains: Vec<f64> = band.iter().map(|point| point.gain_m_s2_n).collect();
    gains.sort_by(f64::total_cmp);
    let median = gains.get(gains.len() / 2).copied().unwrap_or(0.0);
    let (resonance_hz, peak) =
        loudest.map_or((0.0, 0.0), |point| (point.freq_hz, point.gain_m_s2_n));
    Response {
        rate_hz,
        resonance_hz,
        resonance_db: 20.0 * libm::log10(peak / median),
        delay_s: delay_s(&band),
        worst_coherence: band.iter().map(|point| point.coherence).fold(1.0, f64::min),
        points,
    }
}

/// Minus the slope of the unwrapped phase over the angular frequency, weighted by coherence.
fn delay_s(band: &[Point]) -> f64 {
    let mut turns = 0.0;
    let mut last = None;
    let (mut w, mut wx, mut wy, mut wxx, mut wxy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for point in band {
        if let Some(last) = last {
            let step: f64 = point.phase_rad - last;
            turns -= libm::round(step / TAU);
        }
        last = Some(point.phase_rad);
        let (x, y) = (TAU * point.freq_hz, point.phase_rad + TAU * turns);
        let weight = point.coherence * point.coherence;
        w += weight;
        wx += weight * x;
        wy += weight * y;
        wxx += weight * x * x;
        wxy += weight * x * y;
    }
    let spread = w * wxx - wx * wx;
    if spread > 0.0 {
        -(w * wxy - wx * wy) / spread
    } else {
        0.0
    }
}

/// Averaged spectra in one bin.
#[derive(Debug, Clone, Copy, Default)]
struct Spectra {
    force: f64,
    accel: f64,
    cross_re: f64,
    cross_im: f64,
}

impl Spectra {
    fn at(bin: usize, force_n: &[f64], accel_m_s2: &[f64]) -> Self {
        // Window and rotation of every sample of a segment.
        let turn = TAU * bin as f64 / SEGMENT as f64;
        let kernel: Vec<(f64, f64)> = (0..SEGMENT)
            .map(|n| {
                let hann = 0.5 - 0.5 * libm::cos(TAU * (n as f64 + 0.5) / SEGMENT as f64);
                (
                    hann * libm::cos(turn * n as f64),
                    -hann * libm::sin(turn * n as f64),
                )
            })
            .collect();
        let project = |signal: &[f64]| {
            let pairs = signal.iter().zip(&kernel);
            pairs.fold((0.0, 0.0), |(re, im), (x, (c, s))| (re + x * c, im + x * s))
        };
        let mut sum = Self::default();
        let starts = (0..=force_n.len() - SEGMENT).step_by(SEGMENT / 2);
        for start in starts {
            let (ure, uim) = project(&force_n[start..start + SEGMENT]);
            let (are, aim) = project(&accel_m_s2[start..start + SEGMENT]);
            sum.force += ure * ure + uim * uim;
            sum.accel += are * are + aim * aim;
            sum.cross_re += ure * are + uim * aim;
            sum.cross_im += ure * aim - uim * are;
        }
        sum
    }

    fn point(&self, freq_hz: f64) -> Point {
        let cross = self.cross_re * self.cross_re + self.cross_im * self.cross_im;
        let power = self.force * self.accel;
        Point {
            freq_hz,
            gain_m_s2_n: libm::sqrt(cross) / self.force,
            phase_rad: libm::atan2(self.cross_im, self.cross_re),
            coherence: if power > 0.0 {
                (cross / power).clamp(0.0, 1.0)
            } else {
                0.0
            },
        }
    }
}

/// Gain of a response at any frequency, interpolated in decibels; the nearest one beyond the ends.
pub(super) fn gain_at(points: &[Point], freq_hz: f64) -> f64 {
    let after = points.partition_point(|point| point.freq_hz < freq_hz);
    let (Some(low), Some(high)) = (
        points.get(after.saturating_sub(1)),
        points.get(after.min(points.len().saturating_sub(1))),
    ) else {
        return 0.0;
    };
    let span = high.freq_hz - low.freq_hz;
    let part = if span > 0.0 {
        ((freq_hz - low.freq_hz) / span).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let [low, high] = [low, high].map(|point| libm::log(point.gain_m_s2_n.max(1e-12)));
    libm::exp(low + part * (high - low))
}
