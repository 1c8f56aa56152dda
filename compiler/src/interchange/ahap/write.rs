//! A clip as an AHAP.

use super::{
    CONTINUOUS, EVENT_S, INTENSITY, INTENSITY_CONTROL, SHARPNESS, SHARPNESS_CONTROL, TRANSIENT,
};
use crate::interchange::{
    clip::Clip,
    envelope::{self, envelope, transient_hz},
    haptic::{pretty, rounded, sharpness},
};
use serde::Serialize;

/// Most points of a curve.
const CURVE_POINTS: usize = 16;

#[derive(Debug, Serialize)]
#[serde(rename_all = "PascalCase")]
struct Document {
    version: f64,
    metadata: Metadata,
    pattern: Vec<Item>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "PascalCase")]
struct Metadata {
    project: String,
    created: String,
    description: String,
}

/// Entry of a pattern.
#[derive(Debug, Default, Serialize)]
#[serde(rename_all = "PascalCase")]
struct Item {
    #[serde(skip_serializing_if = "Option::is_none")]
    event: Option<Event>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameter_curve: Option<Curve>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "PascalCase")]
struct Event {
    event_type: String,
    time: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    event_duration: Option<f64>,
    event_parameters: Vec<EventParameter>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "PascalCase")]
struct EventParameter {
    #[serde(rename = "ParameterID")]
    id: String,
    parameter_value: f64,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "PascalCase")]
struct Curve {
    #[serde(rename = "ParameterID")]
    id: String,
    time: f64,
    parameter_curve_control_points: Vec<Point>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "PascalCase")]
struct Point {
    time: f64,
    parameter_value: f64,
}

/// Writes a clip.
pub(in crate::interchange) fn write(clip: &Clip) -> Vec<u8> {
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
        let of = |value: fn(&envelope::Point, f64) -> f64| -> Vec<(f64, f64)> {
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
        version: 1.0,
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
