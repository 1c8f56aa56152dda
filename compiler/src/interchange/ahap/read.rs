//! AHAP playback, as Core Haptics does it.

use super::{
    CONTINUOUS, EVENT_S, INTENSITY, INTENSITY_CONTROL, SHARPNESS, SHARPNESS_CONTROL, TRANSIENT,
    control::{Control, Part},
    document::{Curve, Document, Event, Item, Parameter, Scalar},
    notes::{Note, Notes},
};
use crate::interchange::{
    haptic::sharpness_hz,
    parse::{MAX_S, bounded, json, too_many, within},
    playback::{TonePoint, Track, Transient},
};
use asperity_io::diagnostic::Fault;

/// Time between points at which controls are read besides their own points, s: intensities are squared.
const STEP_S: f64 = 0.005;
/// Intensity or sharpness of an event that states none.
const UNSTATED: f64 = 0.5;
/// Continuous events together, s.
const MAX_EVENTS_S: f64 = 2.0 * MAX_S;
/// Most points of controls within all events, each counted for each event.
const MAX_CONTROLLED: usize = 1_000_000;
/// Parameters of the envelope of an event, and the value without an effect.
const ENVELOPE: [(&str, f64); 4] = [
    ("AttackTime", 0.0),
    ("DecayTime", 0.0),
    ("ReleaseTime", 0.0),
    ("Sustained", 1.0),
];

/// Parses the text of a file into a track.
///
/// # Errors
/// The JSON path of the first field at fault, and what is wrong with it.
pub(crate) fn read(text: &str) -> Result<Track, Fault> {
    let document: Document = json(text)?;
    let mut notes = Notes::default();
    let version = match &document.version {
        Scalar::Number(number) => Some(*number),
        Scalar::Text(text) => text.trim().parse().ok(),
        _ => None,
    };
    if version.is_some_and(|version| !(1.0..2.0).contains(&version)) {
        notes.add(Note::Version, || "Version".into());
    }
    let controls = Controls::new(&document.pattern.0, &mut notes)?;
    let mut track = Track {
        phase_from_beginning: true,
        ..Track::default()
    };
    let mut totals = Totals::default();
    for (n, item) in document.pattern.0.iter().enumerate() {
        let at = |key: &str| format!("Pattern[{n}].Event{key}");
        if let Some(event) = &item.event {
            add(event, at, &controls, &mut totals, &mut track, &mut notes)?;
        } else if item.parameter.is_none() && item.parameter_curve.is_none() {
            notes.add(Note::NoContent, || format!("Pattern[{n}]"));
        }
    }
    track.warnings = notes.lines();
    bounded(track)
}

/// A number in its range, or the nearest one that is.
fn clamped(
    value: f64,
    low: f64,
    high: f64,
    place: impl FnOnce() -> String,
    notes: &mut Notes,
) -> f64 {
    let inside = value.clamp(low, high);
    if inside != value {
        notes.add(Note::Clamped, || format!("{} {value}", place()));
    }
    inside
}

/// A time; 0 where it is left out.
fn time(value: &Scalar, place: impl Fn() -> String, notes: &mut Notes) -> Result<f64, Fault> {
    match value.number(&place)? {
        Some(time) => within(place, time, 0.0, MAX_S),
        None => {
            notes.add(Note::NoTime, place);
            Ok(0.0)
        }
    }
}

/// The least value of a control of intensity and of one of sharpness; the largest is 1.
const LEAST: [f64; 2] = [0.0, -1.0];

/// Returns the index of a control: 0 for intensity, 1 for sharpness.
fn controlled(id: &Scalar) -> Option<usize> {
    [INTENSITY_CONTROL, SHARPNESS_CONTROL]
        .iter()
        .position(|known| *known == id.text())
}

/// Controls that apply to all events.
struct Controls {
    intensity: Control,
    sharpness: Control,
}

impl Controls {
    fn new(pattern: &[Item], notes: &mut Notes) -> Result<Self, Fault> {
        let mut parts = [Vec::new(), Vec::new()];
        for (n, item) in pattern.iter().enumerate() {
            if let Some(step) = &item.parameter {
                let at = |key: &str| format!("Pattern[{n}].Parameter{key}");
                match controlled(&step.id) {
                    Some(index) => parts[index].push(parameter(step, LEAST[index], at, notes)?),
                    None => notes.control(step.id.text(), || at("")),
                }
            }
            if let Some(points) = &item.parameter_curve {
                let at = |key: &str| format!("Pattern[{n}].ParameterCurve{key}");
                match controlled(&points.id) {
                    Some(index) => parts[index].push(curve(points, LEAST[index], at, notes)?),
                    None => notes.control(points.id.text(), || at("")),
                }
            }
        }
        let [intensity, sharpness] = parts;
        let (intensity, cut) = Control::new(1.0, intensity);
        let (sharpness, also_cut) = Control::new(0.0, sharpness);
        notes.cut = cut + also_cut;
        Ok(Self {
            intensity,
            sharpness,
        })
    }

    /// Times at which either has a point, between two times.
    fn times(&self, from: f64, to: f64) -> impl Iterator<Item = f64> + '_ {
        self.intensity
            .times(from, to)
            .chain(self.sharpness.times(from, to))
    }
}

/// A step to a value from `low` to 1.
fn parameter(
    parameter: &Parameter,
    low: f64,
    at: impl Fn(&str) -> String,
    notes: &mut Notes,
) -> Result<Part, Fault> {
    let t_s = time(&parameter.time, || at(".Time"), notes)?;
    let value = parameter
        .parameter_value
        .required(|| at(".ParameterValue"))?;
    let value = clamped(value, low, 1.0, || at(".ParameterValue"), notes);
    Ok(vec![(t_s, value)])
}

/// A curve of values from `low` to 1.
fn curve(
    curve: &Curve,
    low: f64,
    at: impl Fn(&str) -> String,
    notes: &mut Notes,
) -> Result<Part, Fault> {
    let begin = time(&curve.time, || at(".Time"), notes)?;
    let points = &curve.parameter_curve_control_points.0;
    // NiceVibrations' converter counts from the beginning of the pattern.
    let absolute = begin > 0.0
        && points
            .first()
            .is_some_and(|p| p.time == Scalar::Number(begin));
    if absolute {
        notes.add(Note::FromTheBeginning, || at(".Time"));
    }
    let begin = if absolute { 0.0 } else { begin };
    let mut part = Part::with_capacity(points.len());
    for (m, point) in points.iter().enumerate() {
        let key = |key| at(&format!(".ParameterCurveControlPoints[{m}].{key}"));
        let t_s = time(&point.time, || key("Time"), notes)?;
        let t_s = within(|| key("Time"), begin + t_s, 0.0, MAX_S)?;
        let value = point.parameter_value.required(|| key("ParameterValue"))?;
        part.push((
            t_s,
            clamped(value, low, 1.0, || key("ParameterValue"), notes),
        ));
    }
    if !part.is_sorted_by(|a, b| a.0 <= b.0) {
        notes.add(Note::Unsorted, || at(".ParameterCurveControlPoints"));
        part.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    Ok(part)
}

/// Totals so far, which are limited.
#[derive(Default)]
struct Totals {
    span_s: f64,
    controlled: usize,
}

/// Adds what an event plays.
fn add(
    event: &Event,
    at: impl Fn(&str) -> String,
    controls: &Controls,
    totals: &mut Totals,
    track: &mut Track,
    notes: &mut Notes,
) -> Result<(), Fault> {
    let kind = event.event_type.text();
    if kind != TRANSIENT && kind != CONTINUOUS {
        notes.event(kind, || at(""));
        return Ok(());
    }
    let begin = time(&event.time, || at(".Time"), notes)?;
    let [level, sharp] = character(event, &at, notes)?;
    let sound = |control: f64, sharpening: f64| {
        let intensity = (level * control).clamp(0.0, 1.0);
        (intensity * intensity, sharpness_hz(sharp + sharpening))
    };
    if kind == TRANSIENT {
        let (amplitude, freq_hz) = sound(
            controls.intensity.after(begin),
            controls.sharpness.after(begin),
        );
        track.transients.push(Transient {
            t_s: begin,
            amplitude,
            freq_hz,
        });
        return Ok(());
    }
    let end = end(event, begin, &at, notes)?;
    totals.span_s += end - begin;
    let too_many =
        |what, found, limit| Err(too_many(what, found, limit).field(at(".EventDuration")));
    if totals.span_s > MAX_EVENTS_S {
        let what = "seconds of continuous events in all";
        return too_many(what, totals.span_s, MAX_EVENTS_S);
    }
    let inside =
        controls.intensity.times(begin, end).len() + controls.sharpness.times(begin, end).len();
    totals.controlled += inside;
    if totals.controlled > MAX_CONTROLLED {
        let what = "points of controls within events";
        return too_many(what, totals.controlled as f64, MAX_CONTROLLED as f64);
    }
    let steps = ((end - begin) / STEP_S).ceil() as usize;
    let grid = (0..=steps).map(|step| (begin + step as f64 * STEP_S).min(end));
    let mut times: Vec<f64> = grid.chain(controls.times(begin, end)).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut tone: Vec<TonePoint> = Vec::with_capacity(times.len() + inside);
    for t_s in times {
        let point = |(amplitude, freq_hz)| TonePoint {
            t_s,
            amplitude,
            freq_hz,
        };
        let before = point(sound(
            controls.intensity.before(t_s),
            controls.sharpness.before(t_s),
        ));
        let after = point(sound(
            controls.intensity.after(t_s),
            controls.sharpness.after(t_s),
        ));
        if t_s > begin {
            tone.push(before);
        }
        if t_s < end && (t_s == begin || after != before) {
            tone.push(after);
        }
    }
    if tone.len() > 1 && tone.iter().any(|point| point.amplitude > 0.0) {
        track.tones.push(tone);
    }
    Ok(())
}

/// Intensity and sharpness of an event.
fn character(
    event: &Event,
    at: impl Fn(&str) -> String,
    notes: &mut Notes,
) -> Result<[f64; 2], Fault> {
    let mut found = [None; 2];
    for (m, parameter) in event.event_parameters.0.iter().enumerate() {
        let place = || at(&format!(".EventParameters[{m}].ParameterValue"));
        let id = parameter.id.text();
        let index = match id {
            INTENSITY => 0,
            SHARPNESS => 1,
            _ => {
                let envelope = ENVELOPE.iter().find(|(name, _)| *name == id);
                match envelope {
                    Some((_, neutral)) if parameter.parameter_value == Scalar::Number(*neutral) => {
                    }
                    Some((name, _)) => {
                        notes.envelope(name, || at(&format!(".EventParameters[{m}]")));
                    }
                    None => notes.parameter(id, || at(&format!(".EventParameters[{m}]"))),
                }
                continue;
            }
        };
        let value = parameter.parameter_value.required(place)?;
        found[index] = Some(clamped(value, 0.0, 1.0, place, notes));
    }
    if found.contains(&None) {
        notes.add(Note::NoLevel, || at(""));
    }
    Ok(found.map(|value| value.unwrap_or(UNSTATED)))
}

/// When a continuous event ends, s. Without a duration, or with one of 0, it has no end of its own.
fn end(
    event: &Event,
    begin: f64,
    at: impl Fn(&str) -> String,
    notes: &mut Notes,
) -> Result<f64, Fault> {
    let place = || at(".EventDuration");
    let stated = event.event_duration.number(place)?.unwrap_or(0.0);
    if stated == 0.0 {
        notes.add(Note::Endless, || at(""));
        return Ok((begin + EVENT_S).min(MAX_S));
    }
    let end = within(place, begin + stated, begin, MAX_S)?;
    if stated > EVENT_S {
        notes.add(Note::TooLong, || format!("{} {stated}", place()));
    }
    Ok(end.min(begin + EVENT_S))
}
