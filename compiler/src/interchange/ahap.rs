//! AHAP, the Apple Haptic and Audio Pattern: continuous and transient events, and curves of at most 16
//! points that control intensity and sharpness.
//!
//! An intensity is the square root of an amplitude, as the players of NiceVibrations have it. A
//! sharpness s is 65 Hz + 235 Hz·s, as the reference software of MPEG has it; Apple states neither.
//! The times of a curve's points count from the beginning of the curve. Files of NiceVibrations, in
//! which they count from the beginning of the pattern, are recognised.

use super::{
    clip::Clip,
    envelope::{envelope, transient_hz},
    error::{EffectProblem, Fault},
    haptic::{pretty, rounded, sharpness, sharpness_hz, tone, value_at},
    parse::{MAX_S, bounded, json, within},
    playback::{Track, Transient},
};
use serde::{Deserialize, Serialize};

/// Most points of a curve.
const CURVE_POINTS: usize = 16;
/// Longest continuous event, s.
const EVENT_S: f64 = 30.0;
/// Time between points at which curves are read, s.
const READ_STEP_S: f64 = 0.005;

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Document {
    #[serde(default)]
    version: Option<f64>,
    #[serde(default)]
    metadata: Metadata,
    pattern: Vec<Item>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase", default)]
struct Metadata {
    project: String,
    created: String,
    description: String,
}

/// One entry of a pattern; of those that are not read, nothing is kept.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Item {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    event: Option<Event>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    parameter_curve: Option<Curve>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    parameter: Option<Parameter>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Event {
    event_type: String,
    time: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    event_duration: Option<f64>,
    #[serde(default)]
    event_parameters: Vec<EventParameter>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct EventParameter {
    #[serde(rename = "ParameterID")]
    id: String,
    parameter_value: f64,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Parameter {
    #[serde(rename = "ParameterID")]
    id: String,
    parameter_value: f64,
    time: f64,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Curve {
    #[serde(rename = "ParameterID")]
    id: String,
    time: f64,
    parameter_curve_control_points: Vec<Point>,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Point {
    time: f64,
    parameter_value: f64,
}

const CONTINUOUS: &str = "HapticContinuous";
const TRANSIENT: &str = "HapticTransient";
const INTENSITY: &str = "HapticIntensity";
const SHARPNESS: &str = "HapticSharpness";
const INTENSITY_CONTROL: &str = "HapticIntensityControl";
const SHARPNESS_CONTROL: &str = "HapticSharpnessControl";

/// Writes a clip.
pub(super) fn write(clip: &Clip) -> Vec<u8> {
    let mut pattern = Vec::new();
    for take in &clip.strokes {
        let points = envelope(&take.signal_m_s2, clip.rate_hz, take.start_s);
        let end_s = points.last().map_or(take.start_s, |point| point.t_s);
        let mut time = take.start_s;
        while time < end_s {
            let duration = (end_s - time).min(EVENT_S);
            pattern.push(event(CONTINUOUS, time, Some(duration), 1.0, 0.0));
            time += duration;
        }
        let of = |value: fn(&super::envelope::Point, f64) -> f64| -> Vec<(f64, f64)> {
            let scale = clip.scale.stroke_m_s2;
            points.iter().map(|p| (p.t_s, value(p, scale))).collect()
        };
        let intensity = of(|point, scale| (point.amplitude / scale).min(1.0).sqrt());
        pattern.extend(curves(INTENSITY_CONTROL, &intensity));
        let control = of(|point, _| sharpness(point.freq_hz));
        pattern.extend(curves(SHARPNESS_CONTROL, &control));
        // The last values go on, and taps would be multiplied by silence.
        let rest = |value| [(end_s + 0.01, value), (end_s + 0.02, value)];
        pattern.extend(curves(INTENSITY_CONTROL, &rest(1.0)));
        pattern.extend(curves(SHARPNESS_CONTROL, &rest(0.0)));
    }
    for take in &clip.taps {
        let intensity = (take.peak_m_s2() / clip.scale.tap_m_s2).min(1.0).sqrt();
        let sharpness = sharpness(transient_hz(&take.signal_m_s2, clip.rate_hz));
        let time = take.onset_s(clip.rate_hz);
        pattern.push(event(TRANSIENT, time, None, intensity, sharpness));
    }
    pretty(&Document {
        version: Some(1.0),
        metadata: Metadata {
            project: clip.name.clone(),
            created: concat!("asperity ", env!("CARGO_PKG_VERSION")).into(),
            description: clip.description.clone(),
        },
        pattern,
    })
}

fn event(kind: &str, time: f64, duration: Option<f64>, intensity: f64, sharpness: f64) -> Item {
    let parameter = |id: &str, value: f64| EventParameter {
        id: id.into(),
        parameter_value: rounded(value),
    };
    Item {
        event: Some(Event {
            event_type: kind.into(),
            time: rounded(time),
            event_duration: duration.map(rounded),
            event_parameters: vec![
                parameter(INTENSITY, intensity),
                parameter(SHARPNESS, sharpness),
            ],
        }),
        ..Item::default()
    }
}

/// Curves of [`CURVE_POINTS`] at most, each of which begins with the last point of the one before.
fn curves(id: &str, points: &[(f64, f64)]) -> Vec<Item> {
    let mut items = Vec::new();
    let mut from = 0;
    while from + 1 < points.len() {
        let part = &points[from..points.len().min(from + CURVE_POINTS)];
        let begin = rounded(part[0].0);
        let point = |&(time, value): &(f64, f64)| Point {
            time: rounded(rounded(time) - begin),
            parameter_value: rounded(value),
        };
        items.push(Item {
            parameter_curve: Some(Curve {
                id: id.into(),
                time: begin,
                parameter_curve_control_points: part.iter().map(point).collect(),
            }),
            ..Item::default()
        });
        from += part.len() - 1;
    }
    items
}

/// What the text of a file plays.
///
/// # Errors
/// The JSON path of the first field at fault, and what is wrong with it.
pub(crate) fn read(text: &str) -> Result<Track, Fault> {
    let document: Document = json(text)?;
    let mut track = Track::default();
    let (mut intensity, mut sharpening) = (Vec::new(), Vec::new());
    for (n, item) in document.pattern.iter().enumerate() {
        if let Some(curve) = &item.parameter_curve {
            let at = |key: &str| format!("Pattern[{n}].ParameterCurve.{key}");
            let begin = within(|| at("Time"), curve.time, 0.0, MAX_S)?;
            let points = &curve.parameter_curve_control_points;
            // NiceVibrations' converter counts from the beginning of the pattern.
            let absolute = begin > 0.0 && points.first().is_some_and(|p| p.time == begin);
            let begin = if absolute { 0.0 } else { begin };
            for (m, point) in points.iter().enumerate() {
                let key = |key| at(&format!("ParameterCurveControlPoints[{m}].{key}"));
                let time = within(|| key("Time"), begin + point.time, 0.0, MAX_S)?;
                let value = within(|| key("ParameterValue"), point.parameter_value, -1.0, 1.0)?;
                match curve.id.as_str() {
                    INTENSITY_CONTROL => intensity.push((time, value)),
                    SHARPNESS_CONTROL => sharpening.push((time, value)),
                    _ => {}
                }
            }
        }
        if let Some(parameter) = &item.parameter {
            let at = |key: &str| format!("Pattern[{n}].Parameter.{key}");
            let time = within(|| at("Time"), parameter.time, 0.0, MAX_S)?;
            let value = within(
                || at("ParameterValue"),
                parameter.parameter_value,
                -1.0,
                1.0,
            )?;
            match parameter.id.as_str() {
                INTENSITY_CONTROL => intensity.push((time, value)),
                SHARPNESS_CONTROL => sharpening.push((time, value)),
                _ => {}
            }
        }
    }
    for list in [&mut intensity, &mut sharpening] {
        list.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let mut unread = 0;
    let mut span_s = 0.0;
    for (n, item) in document.pattern.iter().enumerate() {
        let Some(event) = &item.event else {
            continue;
        };
        let at = |key: &str| format!("Pattern[{n}].Event.{key}");
        let begin = within(|| at("Time"), event.time, 0.0, MAX_S)?;
        let (mut level, mut sharp) = (0.5, 0.5);
        for (m, parameter) in event.event_parameters.iter().enumerate() {
            let key = || at(&format!("EventParameters[{m}].ParameterValue"));
            match parameter.id.as_str() {
                INTENSITY => level = within(key, parameter.parameter_value, 0.0, 1.0)?,
                SHARPNESS => sharp = within(key, parameter.parameter_value, 0.0, 1.0)?,
                _ => {}
            }
        }
        let both = |t_s: f64| {
            let control = value_at(&intensity, t_s).unwrap_or(1.0);
            let sharpness = sharp + value_at(&sharpening, t_s).unwrap_or(0.0);
            let intensity = (level * control).clamp(0.0, 1.0);
            (intensity * intensity, sharpness_hz(sharpness))
        };
        match event.event_type.as_str() {
            TRANSIENT => {
                let (amplitude, freq_hz) = both(begin);
                track.transients.push(Transient {
                    t_s: begin,
                    amplitude,
                    freq_hz,
                });
            }
            CONTINUOUS => {
                let duration = event.event_duration.unwrap_or(0.0);
                let end = within(|| at("EventDuration"), begin + duration, begin, MAX_S)?;
                span_s += duration;
                if span_s > 2.0 * MAX_S {
                    let problem = EffectProblem::TooMany {
                        what: "seconds of continuous events in all",
                        found: span_s,
                        limit: 2.0 * MAX_S,
                    };
                    return Err((at("EventDuration"), problem));
                }
                let steps = ((end - begin) / READ_STEP_S).ceil() as usize;
                let (mut amplitudes, mut frequencies) = (Vec::new(), Vec::new());
                for step in 0..=steps {
                    let t_s = (begin + step as f64 * READ_STEP_S).min(end);
                    let (amplitude, freq_hz) = both(t_s);
                    amplitudes.push((t_s, amplitude));
                    frequencies.push((t_s, freq_hz));
                }
                track.tones.extend(tone(&amplitudes, &frequencies));
            }
            _ => unread += 1,
        }
    }
    if unread > 0 {
        let warning = format!("{unread} events are neither {CONTINUOUS} nor {TRANSIENT}: left out");
        track.warnings.push(warning);
    }
    bounded(track)
}
