//! A player of AHAP for the tests, written from what Apple publishes, and without the code of the reader.
//!
//! "Representing haptic patterns in AHAP files" says that values out of range are clamped and that keys which
//! are not supported are ignored; the pages on `CHHapticDynamicParameter`, `CHHapticParameterCurve` and
//! `CHHapticEvent` say that a parameter changes a value at once, that a curve goes straight from point to point,
//! that both apply to all active and future events, which ranges values have, and that a continuous event lasts
//! 30 s at most and has no end without a duration. What Apple does not state, amplitude and frequency, is that
//! of the documents of this project.
//!
//! Everything is looked up anew for every sample: no time line is built.

use serde_json::Value;
use std::f64::consts::TAU;

/// Rendered signal of a file at a rate, continuous events and transients apart.
pub(super) struct Played {
    pub(super) continuous: Vec<f64>,
    pub(super) transients: Vec<f64>,
}

/// Plays a pattern.
pub(super) fn play(pattern: &Value, rate_hz: f64) -> Played {
    let items = pattern["Pattern"].as_array().unwrap();
    let events: Vec<&Value> = items.iter().filter_map(|item| item.get("Event")).collect();
    let span = |event: &&Value| {
        let begin = event["Time"].as_f64().unwrap();
        if event["EventType"] == "HapticTransient" {
            return (begin, begin + 2.0 / 65.0);
        }
        let duration = event["EventDuration"]
            .as_f64()
            .filter(|d| *d > 0.0)
            .unwrap_or(30.0);
        (begin, begin + duration.min(30.0))
    };
    let last = events.iter().map(|event| span(event).1).fold(0.0, f64::max);
    let samples = ((last + 0.1) * rate_hz).ceil() as usize;
    let mut played = Played {
        continuous: vec![0.0; samples],
        transients: vec![0.0; samples],
    };
    for event in &events {
        let (begin, end) = span(event);
        let own = |id: &str| {
            let parameters = event["EventParameters"].as_array().unwrap();
            let found = parameters.iter().find(|p| p["ParameterID"] == id).unwrap();
            found["ParameterValue"].as_f64().unwrap().clamp(0.0, 1.0)
        };
        let (level, sharp) = (own("HapticIntensity"), own("HapticSharpness"));
        let sound = |t: f64| {
            let intensity = level * control(items, "HapticIntensityControl", 0.0, t).unwrap_or(1.0);
            let shift = control(items, "HapticSharpnessControl", -1.0, t).unwrap_or(0.0);
            (
                intensity.powi(2),
                65.0 + 235.0 * (sharp + shift).clamp(0.0, 1.0),
            )
        };
        match event["EventType"].as_str().unwrap() {
            "HapticContinuous" => {
                let mut cycles = None;
                for n in 0..samples {
                    let t = n as f64 / rate_hz;
                    if t >= begin && t < end {
                        let (amplitude, hz) = sound(t);
                        let passed = cycles.unwrap_or(hz * (t - begin));
                        played.continuous[n] += amplitude * (TAU * passed).sin();
                        cycles = Some(passed + hz / rate_hz);
                    }
                }
            }
            "HapticTransient" => {
                let (amplitude, hz) = sound(begin);
                for n in 0..samples {
                    let t = n as f64 / rate_hz - begin;
                    if t >= 0.0 && t < 2.0 / hz {
                        played.transients[n] += amplitude * (TAU * hz * t).sin();
                    }
                }
            }
            _ => {}
        }
    }
    played
}

/// The value of a control at a time; `None` before all of its parameters and curves.
fn control(items: &[Value], id: &str, least: f64, t: f64) -> Option<f64> {
    let number = |value: &Value| value.as_f64().unwrap();
    let stated = |of: &Value| number(&of["ParameterValue"]).clamp(least, 1.0);
    // When the part in force began, and its value.
    let mut in_force: Option<(f64, f64)> = None;
    for item in items {
        let (part, points): (&Value, Vec<(f64, f64)>) = if let Some(part) = item.get("Parameter") {
            (part, vec![(number(&part["Time"]), stated(part))])
        } else if let Some(part) = item.get("ParameterCurve") {
            let from = number(&part["Time"]);
            let points = part["ParameterCurveControlPoints"].as_array().unwrap();
            let point = |p: &Value| (from + number(&p["Time"]), stated(p));
            (part, points.iter().map(point).collect())
        } else {
            continue;
        };
        if part["ParameterID"] != id || t < points[0].0 {
            continue;
        }
        let passed = points.iter().rposition(|p| p.0 <= t).unwrap();
        let (from, value) = points[passed];
        let value = match points.get(passed + 1) {
            Some((to, next)) => value + (next - value) * (t - from) / (to - from),
            None => value,
        };
        if in_force.is_none_or(|(began, _)| points[0].0 >= began) {
            in_force = Some((points[0].0, value));
        }
    }
    in_force.map(|(_, value)| value)
}
