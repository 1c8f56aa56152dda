//! Strokes and taps as sound: what the runtime renders for a hand that performs one after the other.
//!
//! ```
//! use asperity::{sources::builtin, views::listen::{Gesture, perform}, emit::lower::lower};
//! use asperity_formats::Asset;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let asset = Asset::parse(&bytes).expect("a valid asset");
//! let stroke = Gesture::asked(Some(100.0), Some(1.0), false); // mm/s, N, no taps
//! let performance = perform(&asset, &stroke, None, 1)?;
//! let (_, vibration_m_s2) = &performance.strokes[0];
//! assert!(vibration_m_s2.iter().any(|a| a.abs() > 0.0) && performance.taps.is_empty());
//! # Ok::<(), asperity_io::diagnostic::Fault>(())
//! ```

mod hand;

use super::offline_config;
use crate::emit::raise::raise;
use asperity_formats::Asset;
use asperity_io::diagnostic::Fault;
use asperity_runtime::{HostTexture, Renderer};
use asperity_texture::signal::resample::resample;
use hand::Hand;
use std::io::Cursor;

/// Rate of the sound, Hz.
pub const SOUND_HZ: u32 = 44_100;
/// Speeds of the usual strokes, mm/s.
const SPEEDS_MM_S: [f32; 3] = [40.0, 100.0, 200.0];
/// Forces of the usual strokes, N.
const FORCES_N: [f32; 2] = [0.4, 1.2];
/// Time of one of the usual strokes, and of a single one, s.
const STROKE_S: (f32, f32) = (1.0, 3.0);
/// Silence after a stroke or a tap, s.
const PAUSE_S: f32 = 0.25;

/// A stroke along a line, in contact from its beginning to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Speed between its ends, mm/s.
    pub speed_mm_s: f32,
    /// Normal force, N.
    pub force_n: f32,
    /// Time, s.
    pub time_s: f32,
}

/// Gesture of the hand.
#[derive(Debug, Clone, PartialEq)]
pub struct Gesture {
    /// Strokes, one after the other.
    pub strokes: Vec<Stroke>,
    /// True if taps follow: slow, middling and fast among those that the texture holds.
    pub taps: bool,
}

impl Gesture {
    /// A few strokes and taps.
    #[must_use]
    pub fn usual() -> Self {
        let stroke = |force_n| {
            SPEEDS_MM_S.map(|speed_mm_s| Stroke {
                speed_mm_s,
                force_n,
                time_s: STROKE_S.0,
            })
        };
        Self {
            strokes: FORCES_N.into_iter().flat_map(stroke).collect(),
            taps: true,
        }
    }

    /// Returns the requested gesture: a stroke of this speed or force, taps alone, or the default.
    #[must_use]
    pub fn asked(speed_mm_s: Option<f32>, force_n: Option<f32>, taps: bool) -> Self {
        let stated = speed_mm_s.is_some() || force_n.is_some();
        let stroke = stated.then(|| Stroke {
            speed_mm_s: speed_mm_s.unwrap_or(SPEEDS_MM_S[1]),
            force_n: force_n.unwrap_or(1.0),
            time_s: STROKE_S.1,
        });
        Self::chosen(stroke, taps, Self::usual().strokes)
    }

    /// Returns the stated stroke, with taps if they are wanted, taps alone, or the usual strokes and taps.
    pub(crate) fn chosen(stated: Option<Stroke>, taps: bool, usual: Vec<Stroke>) -> Self {
        let strokes = match stated {
            Some(stroke) => vec![stroke],
            None if taps => Vec::new(),
            None => usual,
        };
        Self {
            strokes,
            taps: taps || stated.is_none(),
        }
    }
}

/// Rendered sound.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderedSound {
    /// A mono WAV file of 16 bits at [`SOUND_HZ`].
    pub wav: Vec<u8>,
    /// Its time, s.
    pub seconds: f64,
    /// Strokes heard, and their gain.
    pub strokes: Part,
    /// Taps heard, and their gain.
    pub taps: Part,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Statistics of the strokes or the taps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Strokes or taps.
    pub count: usize,
    /// Largest acceleration, m/s².
    pub peak_m_s2: f64,
    /// Full scales for 1 m/s²; 0 for silence.
    pub gain_per_m_s2: f64,
}

/// Refuses taps alone of a texture that has none; `verb` says what is done with strokes.
pub(crate) fn check_taps(asset: &Asset<'_>, session: &Gesture, verb: &str) -> Result<(), Fault> {
    if !session.strokes.is_empty() || !tap_speeds(asset).is_empty() {
        return Ok(());
    }
    let what = format!("{}: the texture has no taps", asset.name());
    let remedy = format!("{verb} strokes: leave out --taps");
    Err(Fault::new(what, remedy).usage())
}

/// Returns the fault of a sound that the encoder does not take.
pub(crate) fn not_encoded(error: hound::Error) -> Fault {
    let what = format!("the sound cannot be encoded: {error}");
    Fault::new(what, "free memory and try again")
}

/// The accelerations of a session, part by part, before device gain.
#[derive(Debug, Clone, PartialEq)]
pub struct Performance {
    /// Rate of the loop, Hz.
    pub rate_hz: f32,
    /// Strokes, each with its vibration, m/s².
    pub strokes: Vec<(Stroke, Vec<f64>)>,
    /// Impact speeds, m/s, each with its transient, m/s².
    pub taps: Vec<(f32, Vec<f64>)>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Renders a session on the texture of an asset in a loop at `rate_hz`, or at the texture's own
/// rate. The same asset, session and seed give the same numbers.
///
/// # Errors
/// [`Fault`] for a rate that does not suit, and for taps alone where there are none.
pub fn perform(
    asset: &Asset<'_>,
    session: &Gesture,
    rate_hz: Option<f32>,
    seed: u64,
) -> Result<Performance, Fault> {
    check_taps(asset, session, "listen to")?;
    let name = asset.name();
    let speeds = tap_speeds(asset);
    let rate_hz = rate_hz.unwrap_or(asset.grid().sample_rate_hz());
    let config = offline_config(rate_hz);
    let renderer = Renderer::new(&config).map_err(|cause| {
        let what = format!("{name}: the servo rate is not supported: {cause}");
        Fault::new(what, "give --rate a servo rate, e.g. 1000").usage()
    })?;
    let mut slot = Box::new(HostTexture::new());
    slot.load(asset, rate_hz).map_err(|cause| {
        let remedy = "give --rate 1 to 20 times the texture's own rate";
        Fault::new(format!("{name}: {cause}"), remedy)
    })?;
    let hand = Hand {
        renderer: &renderer,
        texture: &slot,
        coupling: *asset.coupling(),
        contact: raise(asset).contact,
        rate_hz,
        seed,
    };
    let mut warnings = Vec::new();
    let numbered = (0u64..).zip(&session.strokes);
    let strokes = numbered
        .map(|(number, stroke)| (*stroke, hand.stroke(stroke, number)))
        .collect();
    let mut taps = Vec::new();
    if session.taps {
        if speeds.is_empty() {
            warnings.push("the texture holds no taps".to_owned());
        }
        taps = speeds
            .iter()
            .map(|&speed_m_s| (speed_m_s, hand.tap(speed_m_s)))
            .collect();
    }
    let fastest = raise(asset)
        .grid
        .vertices
        .iter()
        .fold(0.0, |v, x| x.speed_mm_s.max(v));
    let beyond = |stroke: &Stroke| f64::from(stroke.speed_mm_s) > fastest;
    if session.strokes.iter().any(beyond) {
        warnings.push(format!(
            "the texture is known up to {fastest:.0} mm/s; faster strokes sound as at that speed"
        ));
    }
    Ok(Performance {
        rate_hz,
        strokes,
        taps,
        warnings,
    })
}

/// Renders a session as [`perform`] does, as a sound. The same asset, session and seed give the
/// same bytes.
///
/// # Errors
/// As [`perform`].
pub fn listen(
    asset: &Asset<'_>,
    session: &Gesture,
    rate_hz: Option<f32>,
    seed: u64,
) -> Result<RenderedSound, Fault> {
    let performed = perform(asset, session, rate_hz, seed)?;
    let rate_hz = performed.rate_hz;
    let pause = vec![0.0; (PAUSE_S * rate_hz).round() as usize];
    let paused = |signal: Vec<f64>| signal.into_iter().chain(pause.iter().copied());
    let (strokes, taps) = (performed.strokes.len(), performed.taps.len());
    let scraping: Vec<f64> = performed
        .strokes
        .into_iter()
        .flat_map(|(_, signal)| paused(signal))
        .collect();
    let tapping: Vec<f64> = performed
        .taps
        .into_iter()
        .flat_map(|(_, signal)| paused(signal))
        .collect();
    let raised = |signal: &[f64]| resample(signal, rate_hz.round() as u32, SOUND_HZ);
    let (scraping, tapping) = (raised(&scraping), raised(&tapping));
    let strokes = part(strokes, &scraping);
    let taps = part(taps, &tapping);
    let mut warnings = performed.warnings;
    if strokes.count > 0 && strokes.gain_per_m_s2 == 0.0 {
        warnings.push("the strokes are silent: the texture does not vibrate".to_owned());
    }
    let samples = levelled(&[(&scraping, &strokes), (&tapping, &taps)]);
    Ok(RenderedSound {
        seconds: samples.len() as f64 / f64::from(SOUND_HZ),
        wav: wav(&samples).map_err(not_encoded)?,
        strokes,
        taps,
        warnings,
    })
}

/// The slowest, the middle and the fastest impact speed that the asset has a trace for, m/s.
fn tap_speeds(asset: &Asset<'_>) -> Vec<f32> {
    let speeds: Vec<f32> = asset.taps().traces().map(|trace| trace.speed_m_s).collect();
    let Some(last) = speeds.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut chosen = vec![speeds[0], speeds[last / 2], speeds[last]];
    chosen.dedup();
    chosen
}

#[cfg(test)]
mod tests;

// Accelerations as samples of a sound.

/// Level of the loudest sample, of full scale: −1 dB.
const CEILING: f64 = 0.891;

/// A part with the gain that takes its loudest sample to the ceiling.
fn part(count: usize, signal: &[f64]) -> Part {
    let peak_m_s2 = signal.iter().fold(0.0f64, |peak, x| peak.max(x.abs()));
    let audible = count > 0 && peak_m_s2 > 0.0;
    Part {
        count,
        peak_m_s2,
        gain_per_m_s2: if audible { CEILING / peak_m_s2 } else { 0.0 },
    }
}

/// The parts one after the other, each with its gain, as 16-bit samples.
fn levelled(parts: &[(&[f64], &Part)]) -> Vec<i16> {
    let scaled = |(signal, part): &(&[f64], &Part)| -> Vec<i16> {
        let full = part.gain_per_m_s2 * f64::from(i16::MAX);
        signal.iter().map(|x| (x * full).round() as i16).collect()
    };
    parts.iter().flat_map(scaled).collect()
}

/// The samples as a WAV file.
pub(crate) fn wav(samples: &[i16]) -> Result<Vec<u8>, hound::Error> {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: SOUND_HZ,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut bytes = Vec::new();
    let mut writer = hound::WavWriter::new(Cursor::new(&mut bytes), spec)?;
    for sample in samples {
        writer.write_sample(*sample)?;
    }
    writer.finalize()?;
    Ok(bytes)
}
