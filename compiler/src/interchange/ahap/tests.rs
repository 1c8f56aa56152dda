//! AHAPs sound as Core Haptics plays them, and what is not honoured is named.

use super::{player::play, read};
use crate::{interchange::playback::Track, sources::effects};
use asperity_tests::{draw::Draw, size::sized, spectrum};
use asperity_texture::signal::level;
use serde_json::{Value, json};
use std::fs;

/// Rate at which both are compared, Hz.
const RATE_HZ: u32 = 4000;
/// Bands this far below the loudest one do not count, dB.
const FLOOR_DB: f64 = 30.0;
/// The goal, dB.
const MOST_DB: f64 = 0.5;

fn parsed(pattern: &Value) -> Track {
    let text = pattern.to_string();
    read(&text).unwrap_or_else(|fault| panic!("{fault}: {text}"))
}

fn event(kind: &str, time: f64, duration: Option<f64>, character: [f64; 2]) -> Value {
    let [intensity, sharpness] = character;
    let mut event = json!({
        "Time": time,
        "EventType": kind,
        "EventParameters": [
            {"ParameterID": "HapticIntensity", "ParameterValue": intensity},
            {"ParameterID": "HapticSharpness", "ParameterValue": sharpness},
        ],
    });
    if let Some(duration) = duration {
        event["EventDuration"] = duration.into();
    }
    json!({"Event": event})
}

fn hum(duration: f64) -> Value {
    event("HapticContinuous", 0.0, Some(duration), [1.0, 0.5])
}

fn step(id: &str, time: f64, value: f64) -> Value {
    json!({"Parameter": {"ParameterID": id, "Time": time, "ParameterValue": value}})
}

fn curve(id: &str, time: f64, points: &[(f64, f64)]) -> Value {
    let point = |(time, value): &(f64, f64)| json!({"Time": time, "ParameterValue": value});
    let points: Vec<Value> = points.iter().map(point).collect();
    json!({"ParameterCurve": {
        "ParameterID": id, "Time": time, "ParameterCurveControlPoints": points,
    }})
}

fn pattern(items: Vec<Value>) -> Value {
    json!({"Version": 1.0, "Pattern": items})
}

/// A number with three decimals, as tools write them.
fn number(draw: &mut Draw, low: f64, high: f64) -> f64 {
    (draw.range(low, high) * 1e3).round() / 1e3
}

/// Draws one to three continuous events that may overlap, transients, and parameters and curves of both controls in any
/// order, some of them beyond their range.
fn random(draw: &mut Draw) -> Value {
    let mut items = Vec::new();
    let mut time = number(draw, 0.0, 0.3);
    let mut end: f64 = 0.0;
    for _ in 0..1 + draw.below(3) {
        let duration = number(draw, 0.5, 3.0);
        let character = [number(draw, 0.3, 1.1), number(draw, -0.1, 1.1)];
        items.push(event("HapticContinuous", time, Some(duration), character));
        end = end.max(time + duration);
        time = ((time + number(draw, 0.0, 2.0)) * 1e3).round() / 1e3;
    }
    for _ in 0..draw.below(4) {
        let character = [number(draw, 0.0, 1.0), number(draw, 0.0, 1.0)];
        items.push(event(
            "HapticTransient",
            number(draw, 0.0, end),
            None,
            character,
        ));
    }
    for (id, low) in [
        ("HapticIntensityControl", -0.1),
        ("HapticSharpnessControl", -1.1),
    ] {
        for _ in 0..draw.below(4) {
            let time = number(draw, 0.0, end);
            if draw.below(2) == 0 {
                items.push(step(id, time, number(draw, low, 1.1)));
                continue;
            }
            let mut at = 0.0;
            let mut points = vec![(0.0, number(draw, low.max(-1.0), 1.0))];
            for _ in 0..draw.below(4) {
                at = ((at + number(draw, 0.05, 0.8)) * 1e3).round() / 1e3;
                points.push((at, number(draw, low.max(0.0), 1.0)));
            }
            items.push(curve(id, time, &points));
        }
    }
    for n in (1..items.len()).rev() {
        items.swap(n, draw.below(n + 1));
    }
    pattern(items)
}

/// Power in third octaves, for the bands above a floor of the first signal's.
fn octaves_db(source: &[f64], other: &[f64]) -> Vec<(f64, f64)> {
    let samples = source.len().max(other.len()).max(RATE_HZ as usize);
    let rate_hz = f64::from(RATE_HZ);
    let [source, other] = [source, other].map(|signal| {
        let mut padded = signal.to_vec();
        padded.resize(samples, 0.0);
        let power = spectrum::periodogram(&padded);
        let bin_hz = 0.5 * rate_hz / (power.len() - 1) as f64;
        let inside = |low: f64, high: f64| {
            let bins = (low / bin_hz).ceil() as usize..=(high / bin_hz).floor() as usize;
            power[bins].iter().sum::<f64>()
        };
        spectrum::third_octaves(20.0, rate_hz)
            .into_iter()
            .map(|(centre, low, high)| (centre, inside(low, high)))
            .collect::<Vec<_>>()
    });
    let loudest = source.iter().map(|band| band.1).fold(0.0, f64::max);
    let floor = loudest * 10f64.powf(-0.1 * FLOOR_DB);
    let bands = source.iter().zip(&other);
    bands
        .filter(|(a, b)| a.1.max(b.1) > floor)
        .map(|(a, b)| (a.0, 10.0 * (b.1.max(floor) / a.1.max(floor)).log10()))
        .collect()
}

/// RMS of the blocks of 20 ms that reach a tenth of the loudest.
fn sounding_rms(signal: &[f64]) -> f64 {
    let power = |block: &[f64]| block.iter().map(|x| x * x).sum::<f64>() / block.len() as f64;
    let blocks: Vec<f64> = signal.chunks(RATE_HZ as usize / 50).map(power).collect();
    let loudest = blocks.iter().copied().fold(0.0, f64::max);
    let loud: Vec<f64> = blocks
        .into_iter()
        .filter(|block| *block > 0.01 * loudest)
        .collect();
    (loud.iter().sum::<f64>() / loud.len() as f64).sqrt()
}

#[test]
fn generated_files_sound_as_a_player_plays_them() {
    let count = sized("AHAPs against the player", 20, 200);
    let folder = tempfile::tempdir().unwrap();
    for seed in 0..count {
        let pattern = random(&mut Draw::new(seed));
        let (track, played) = (parsed(&pattern), play(&pattern, f64::from(RATE_HZ)));
        for (part, source, read) in [
            ("events", &played.continuous, track.continuous(RATE_HZ)),
            ("transients", &played.transients, track.taps(RATE_HZ)),
        ] {
            for (centre, off_db) in octaves_db(source, &read) {
                assert!(
                    off_db.abs() < MOST_DB,
                    "{seed}, {part} at {centre:.0} Hz: {off_db} dB: {pattern}"
                );
            }
        }
        let file = folder.path().join("generated.ahap");
        fs::write(&file, pattern.to_string()).unwrap();
        let options = effects::tests::options();
        let imported = effects::tests::import(&file, effects::EffectsKind::Ahap, &options).unwrap();
        let stroke = imported
            .whole
            .grid
            .vertices
            .iter()
            .find(|v| v.speed_mm_s == options.speed_mm_s);
        let stroke = stroke.unwrap();
        let rms = stroke.sigma_m_s2 * level::nyquist_rms(&stroke.lsf_rad);
        let off_db =
            20.0 * (rms / (options.full_scale_m_s2 * sounding_rms(&played.continuous))).log10();
        assert!(
            off_db.abs() < MOST_DB,
            "{seed}: level off by {off_db} dB: {pattern}"
        );
    }
}

/// RMS of a track between two times.
fn rms(track: &Track, from: f64, to: f64) -> f64 {
    let samples = track.continuous(RATE_HZ);
    let at = |t: f64| ((t * f64::from(RATE_HZ)) as usize).min(samples.len());
    let part = &samples[at(from)..at(to)];
    (part.iter().map(|x| x * x).sum::<f64>() / part.len() as f64).sqrt()
}

#[test]
fn a_parameter_is_a_step_and_a_control_is_neutral_before_it_begins() {
    let full = rms(&parsed(&pattern(vec![hum(4.0)])), 0.0, 4.0);
    let track = parsed(&pattern(vec![
        hum(4.0),
        step("HapticIntensityControl", 3.0, 0.0),
    ]));
    assert!((rms(&track, 0.0, 3.0) / full - 1.0).abs() < 1e-3);
    assert!(rms(&track, 3.0, 4.0) < 1e-9);
    let later = curve("HapticIntensityControl", 3.0, &[(0.0, 0.0), (0.5, 0.2)]);
    let track = parsed(&pattern(vec![hum(4.0), later]));
    assert!((rms(&track, 0.0, 2.999) / full - 1.0).abs() < 1e-3);
    assert!((rms(&track, 3.6, 4.0) / (0.04 * full) - 1.0).abs() < 1e-2);
}

#[test]
fn a_continuous_event_without_an_end_lasts_30_s_as_does_a_longer_one() {
    for duration in [None, Some(0.0), Some(45.0)] {
        let endless = event("HapticContinuous", 1.0, duration, [1.0, 0.5]);
        let track = parsed(&pattern(vec![endless]));
        assert_eq!(track.end_s(), 31.0);
        assert_eq!(track.warnings.len(), 1, "{:?}", track.warnings);
        assert!(
            track.warnings[0].contains("EventDuration"),
            "{:?}",
            track.warnings
        );
        assert!(track.warnings[0].contains("30 s"), "{:?}", track.warnings);
    }
    let click = event("HapticTransient", 1.0, None, [1.0, 0.5]);
    let track = parsed(&pattern(vec![click]));
    assert!(track.warnings.is_empty() && track.transients.len() == 1);
}

#[test]
fn what_is_not_honoured_is_named_with_its_place() {
    let with = |id: &str, value: f64| {
        let mut item = hum(1.0);
        let parameters = item["Event"]["EventParameters"].as_array_mut().unwrap();
        parameters.push(json!({"ParameterID": id, "ParameterValue": value}));
        pattern(vec![item])
    };
    for (file, named) in [
        (
            with("AttackTime", 0.3),
            "AttackTime (Pattern[0].Event.EventParameters[2])",
        ),
        (with("DecayTime", 0.3), "DecayTime"),
        (with("ReleaseTime", 0.3), "ReleaseTime"),
        (with("Sustained", 0.0), "Sustained"),
        (with("HapticIntensty", 0.3), "HapticIntensty"),
        (with("AudioVolume", 0.3), "AudioVolume"),
        (
            pattern(vec![hum(1.0), step("HapticDecayTimeControl", 0.0, 0.5)]),
            "HapticDecayTimeControl (Pattern[1].Parameter)",
        ),
        (
            pattern(vec![
                hum(1.0),
                curve("AudioVolumeControl", 0.0, &[(0.0, 9.0)]),
            ]),
            "AudioVolumeControl",
        ),
        (
            pattern(vec![
                hum(1.0),
                event("HapticContinous", 0.0, None, [1.0, 0.5]),
            ]),
            "1 HapticContinous (Pattern[1].Event)",
        ),
        (pattern(vec![hum(1.0), json!({"Evnt": {}})]), "Pattern[1]"),
        (json!({"Version": 2.0, "Pattern": [hum(1.0)]}), "Version"),
        (
            pattern(vec![
                hum(1.0),
                curve("HapticIntensityControl", 0.5, &[(0.5, 1.0), (0.9, 0.0)]),
            ]),
            "haptic2ahap",
        ),
        (
            pattern(vec![
                hum(1.0),
                curve("HapticIntensityControl", 0.0, &[(0.0, 1.0), (0.9, 0.0)]),
                step("HapticIntensityControl", 0.5, 1.0),
            ]),
            "1 curve",
        ),
    ] {
        let warnings = parsed(&file).warnings;
        assert_eq!(warnings.len(), 1, "{named}: {warnings:?}");
        assert!(warnings[0].contains(named), "{named}: {warnings:?}");
    }
    let neutral = parsed(&with("Sustained", 1.0)).warnings;
    assert!(neutral.is_empty(), "{neutral:?}");
}

#[test]
fn values_are_clamped_with_a_warning_that_has_the_first_of_them() {
    let file = pattern(vec![
        event("HapticContinuous", 0.0, Some(1.0), [1.000_000_1, -1.0]),
        step("HapticIntensityControl", 0.5, 7.0),
    ]);
    let track = parsed(&file);
    let plain = parsed(&pattern(vec![event(
        "HapticContinuous",
        0.0,
        Some(1.0),
        [1.0, 0.0],
    )]));
    assert!((rms(&track, 0.0, 1.0) - rms(&plain, 0.0, 1.0)).abs() < 1e-9);
    assert_eq!(track.warnings.len(), 1, "{:?}", track.warnings);
    assert!(
        track.warnings[0].contains("Pattern[1].Parameter.ParameterValue 7"),
        "{:?}",
        track.warnings
    );
    assert!(
        track.warnings[0].contains("2 more places"),
        "{:?}",
        track.warnings
    );
}

#[test]
fn what_is_not_used_refuses_no_file() {
    for (key, value) in [
        ("Version", json!("1.0")),
        ("Version", json!(null)),
        ("Version", json!([1, {"a": 0}])),
        ("Metadata", json!(null)),
        ("Metadata", json!({"Created": 20_240_101, "Project": ["a"]})),
        ("Metadata", json!("a text")),
        ("Other", json!({"Pattern": 3})),
    ] {
        let mut file = pattern(vec![hum(1.0)]);
        file[key] = value;
        assert_eq!(parsed(&file).warnings, Vec::<String>::new(), "{key}");
    }
    let audio = json!({"Event": {
        "EventType": "AudioCustom", "Time": "now", "EventWaveformPath": "a.wav",
        "EventParameters": null, "EventDuration": {},
    }});
    let warnings = parsed(&pattern(vec![hum(1.0), audio])).warnings;
    assert!(
        warnings.len() == 1 && warnings[0].contains("AudioCustom"),
        "{warnings:?}"
    );
}

#[test]
fn a_fault_is_named_by_its_path() {
    let text = |pattern: &str| {
        format!("{{\"Version\": 1, \"Metadata\": {{\"a\": 1,}},\n\"Pattern\": [{pattern}]}}")
    };
    let hum = r#"{"Event": {"Time": 0, "EventType": "HapticContinuous", "EventDuration": 1}}"#;
    for (file, field, said) in [
        (
            text(&hum.replace("0,", "\"soon\",")),
            "Pattern[0].Event.Time",
            "\"soon\", must be a number",
        ),
        (
            text(&hum.replace("0,", "-1,")),
            "Pattern[0].Event.Time",
            "-1",
        ),
        (
            text(&hum.replace("\"Time\": 0,", "\"Time\" 0,")),
            "Pattern[0].Event",
            "line 2 column 31",
        ),
        (
            text(&format!("{hum}, {{\"Event\": 3}}")),
            "Pattern[1].Event",
            "line 2",
        ),
        (
            text(r#"{"Parameter": {"ParameterID": "HapticIntensityControl", "Time": 0}}"#),
            "Pattern[0].Parameter.ParameterValue",
            "missing",
        ),
        ("{\"Version\": 1}".into(), "", "Pattern"),
    ] {
        let fault = read(&file).unwrap_err();
        assert_eq!(fault.field, field, "{fault}");
        assert!(fault.what.contains(said), "{fault}");
    }
}
