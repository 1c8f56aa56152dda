//! `.haptic` of NiceVibrations and Lofelt LatentEditor, version 1: envelopes of amplitude and frequency, and
//! emphasis on points of the amplitude.
//!
//! Amplitudes and frequencies are 0 to 1. The format states no Hz; here a frequency f is 65 Hz + 235
//! Hz·√f, because players take √f for the sharpness of a Core Haptics event, and the reference
//! software of MPEG takes sharpness for 65 to 300 Hz.

use super::{
    clip::Clip,
    envelope::{envelope, transient_hz},
    parse::{bounded, json, time, within},
    playback::{TonePoint, Track, Transient},
};
use asperity_io::diagnostic::Fault;
use serde::{Deserialize, Serialize};

/// Frequencies of the least and of the largest sharpness, Hz.
const SHARPNESS_HZ: (f64, f64) = (65.0, 300.0);
/// Largest part of a full scale by which two amplitudes may be merged into a line.
const TOLERANCE: f64 = 5e-4;

/// Sharpness of Core Haptics, 0 to 1, of a frequency.
pub(super) fn sharpness(freq_hz: f64) -> f64 {
    let (low, high) = SHARPNESS_HZ;
    ((freq_hz - low) / (high - low)).clamp(0.0, 1.0)
}

/// Frequency of a sharpness, Hz.
pub(super) fn sharpness_hz(sharpness: f64) -> f64 {
    let (low, high) = SHARPNESS_HZ;
    low + sharpness.clamp(0.0, 1.0) * (high - low)
}

#[derive(Debug, Serialize, Deserialize)]
struct Document {
    version: Version,
    #[serde(default)]
    metadata: Metadata,
    signals: Signals,
}

#[derive(Debug, Serialize, Deserialize)]
struct Version {
    major: u32,
    minor: u32,
    patch: u32,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Metadata {
    editor: String,
    author: String,
    source: String,
    project: String,
    tags: Vec<String>,
    description: String,
}

#[derive(Debug, Serialize, Deserialize)]
struct Signals {
    continuous: Continuous,
}

#[derive(Debug, Serialize, Deserialize)]
struct Continuous {
    envelopes: Envelopes,
}

#[derive(Debug, Serialize, Deserialize)]
struct Envelopes {
    amplitude: Vec<Amplitude>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frequency: Option<Vec<Frequency>>,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Amplitude {
    time: f64,
    amplitude: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    emphasis: Option<Emphasis>,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Emphasis {
    amplitude: f64,
    frequency: f64,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Frequency {
    time: f64,
    frequency: f64,
}

/// Six decimals: a microsecond, and less than any player resolves.
pub(super) fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}

/// Writes a clip.
pub(super) fn write(clip: &Clip) -> Vec<u8> {
    let (mut amplitude, mut frequency) = (Vec::new(), Vec::new());
    for take in &clip.strokes {
        for point in envelope(&take.signal_m_s2, clip.rate_hz, take.start_s) {
            let time = rounded(point.t_s);
            let level = (point.amplitude / clip.scale.stroke_m_s2).min(1.0);
            amplitude.push(Amplitude {
                time,
                amplitude: rounded(level),
                emphasis: None,
            });
            let sharpness = sharpness(point.freq_hz);
            frequency.push(Frequency {
                time,
                frequency: rounded(sharpness * sharpness),
            });
        }
    }
    for take in &clip.taps {
        let time = rounded(take.onset_s(clip.rate_hz));
        amplitude.push(Amplitude {
            time,
            amplitude: 0.0,
            emphasis: Some(Emphasis {
                amplitude: rounded((take.peak_m_s2() / clip.scale.tap_m_s2).min(1.0)),
                frequency: rounded(sharpness(transient_hz(&take.signal_m_s2, clip.rate_hz))),
            }),
        });
    }
    // A player stops at the last point.
    amplitude.push(Amplitude {
        time: rounded(clip.end_s()),
        amplitude: 0.0,
        emphasis: None,
    });
    let document = Document {
        version: Version {
            major: 1,
            minor: 0,
            patch: 0,
        },
        metadata: Metadata {
            editor: concat!("asperity ", env!("CARGO_PKG_VERSION")).into(),
            project: clip.name.clone(),
            tags: vec!["texture".into()],
            description: clip.description.clone(),
            ..Metadata::default()
        },
        signals: Signals {
            continuous: Continuous {
                envelopes: Envelopes {
                    amplitude: straightened(amplitude),
                    frequency: (!frequency.is_empty()).then_some(frequency),
                },
            },
        },
    };
    pretty(&document)
}

/// A document as indented text.
pub(super) fn pretty(document: &impl Serialize) -> Vec<u8> {
    // Plain structures of finite numbers and strings always serialise.
    let mut bytes = serde_json::to_vec_pretty(document).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

/// The points without those that lie on the line between their neighbours.
fn straightened(points: Vec<Amplitude>) -> Vec<Amplitude> {
    let mut kept: Vec<Amplitude> = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        let between = kept.last().zip(points.get(index + 1));
        let needless = between.is_some_and(|(before, after)| {
            let span = after.time - before.time;
            let share = (point.time - before.time) / span;
            let line = before.amplitude + share * (after.amplitude - before.amplitude);
            let level = |p: &Amplitude| p.emphasis.is_none() && p.amplitude == 0.0;
            // Only silence is drawn by long lines: errors would add up elsewhere.
            let silent = level(before) && level(point) && level(after);
            span > 0.0 && silent && (line - point.amplitude).abs() <= TOLERANCE
        });
        if !needless {
            kept.push(*point);
        }
    }
    kept
}

/// Parses the text of a file into a track.
///
/// # Errors
/// The JSON path of the first field at fault, and what is wrong with it.
pub(crate) fn read(text: &str) -> Result<Track, Fault> {
    let document: Document = json(text)?;
    let Version {
        major,
        minor,
        patch,
    } = document.version;
    if major != 1 {
        let what = format!("{major}.{minor}.{patch}, 1.x.y expected");
        return Err(Fault::new(what, "export it again in that version").field("version"));
    }
    let envelopes = document.signals.continuous.envelopes;
    let at =
        |list: &str, n: usize, key: &str| format!("signals.continuous.envelopes.{list}[{n}].{key}");
    let mut frequencies = Vec::new();
    let mut previous = 0.0;
    for (n, point) in envelopes.frequency.unwrap_or_default().iter().enumerate() {
        previous = time(|| at("frequency", n, "time"), point.time, previous)?;
        let f = within(
            || at("frequency", n, "frequency"),
            point.frequency,
            0.0,
            1.0,
        )?;
        frequencies.push((previous, sharpness_hz(f.sqrt())));
    }
    let mut track = Track::default();
    let mut amplitudes = Vec::new();
    let mut previous = 0.0;
    for (n, point) in envelopes.amplitude.iter().enumerate() {
        previous = time(|| at("amplitude", n, "time"), point.time, previous)?;
        let level = within(
            || at("amplitude", n, "amplitude"),
            point.amplitude,
            0.0,
            1.0,
        )?;
        amplitudes.push((previous, level));
        if let Some(emphasis) = &point.emphasis {
            let key = |key| at("amplitude", n, &format!("emphasis.{key}"));
            let f = within(|| key("frequency"), emphasis.frequency, 0.0, 1.0)?;
            track.transients.push(Transient {
                t_s: previous,
                amplitude: within(|| key("amplitude"), emphasis.amplitude, 0.0, 1.0)?,
                freq_hz: sharpness_hz(f),
            });
        }
    }
    track.tones.extend(tone(&amplitudes, &frequencies));
    bounded(track)
}

/// A tone of two envelopes, (time, value); `None` without two amplitudes or where all are zero.
pub(super) fn tone(
    amplitudes: &[(f64, f64)],
    frequencies: &[(f64, f64)],
) -> Option<Vec<TonePoint>> {
    if amplitudes.len() < 2 || amplitudes.iter().all(|(_, level)| *level == 0.0) {
        return None;
    }
    let [first, last] = [amplitudes.first()?.0, amplitudes.last()?.0];
    let inside = frequencies
        .iter()
        .map(|(t, _)| *t)
        .filter(|t| (first..=last).contains(t));
    let mut times: Vec<f64> = amplitudes.iter().map(|(t, _)| *t).chain(inside).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    Some(
        times
            .into_iter()
            .map(|t_s| TonePoint {
                t_s,
                amplitude: value_at(amplitudes, t_s).unwrap_or(0.0),
                freq_hz: value_at(frequencies, t_s).unwrap_or(sharpness_hz(0.0)),
            })
            .collect(),
    )
}

/// The value of an envelope at a time, straight between its points; `None` for an empty one.
fn value_at(points: &[(f64, f64)], t_s: f64) -> Option<f64> {
    let next = points.partition_point(|(t, _)| *t <= t_s);
    let before = next.checked_sub(1).map(|n| points[n]);
    match (before, points.get(next)) {
        (Some((t0, a)), Some(&(t1, b))) => Some(a + (t_s - t0) / (t1 - t0) * (b - a)),
        (Some((_, a)), None) => Some(a),
        (None, next) => next.map(|(_, b)| *b),
    }
}
