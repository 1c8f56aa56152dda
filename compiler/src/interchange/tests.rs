//! Exports read back, obey the rules of their format, and lose no more than reported.

use super::*;
use crate::{
    emit::lower::lower,
    interchange::playback::{PLAY_HZ, Track},
    sources::builtin,
};
use asperity_formats::Asset;
use asperity_io::diagnostic::Fault;
use serde_json::Value;

fn options() -> Options {
    Options {
        session: session(None, None, None, false),
        rate_hz: None,
        seed: 1,
        full_scale_m_s2: None,
        tap_full_scale_m_s2: None,
        size_px: 64,
    }
}

fn with<T>(work: impl FnOnce(&Asset<'_>) -> T) -> T {
    let bytes = lower(&builtin::texture(), None).unwrap().bytes;
    work(&Asset::parse(&bytes).unwrap())
}

fn exported(format: ClipFormat) -> Exported {
    with(|asset| export(asset, format, &options()).unwrap())
}

/// RMS and worst loss of the stroke, dB.
fn stroke_loss(exported: &Exported) -> (f64, f64) {
    let loss = exported.carried[0].loss.as_ref().unwrap();
    (loss.rms_db, loss.worst_db)
}

fn parsed(exported: &Exported) -> Value {
    serde_json::from_slice(&exported.bytes).unwrap()
}

#[test]
fn a_clip_has_a_stroke_and_three_taps_or_what_is_asked_for() {
    let (clip, _) = with(|asset| clip(asset, &options()).unwrap());
    assert_eq!((clip.strokes.len(), clip.taps.len()), (1, 3));
    assert_eq!(clip.strokes[0].label, "stroke 100 mm/s 1 N");
    assert!(
        clip.taps
            .windows(2)
            .all(|pair| pair[1].start_s > pair[0].end_s(clip.rate_hz))
    );
    assert_eq!(clip.clipped(), 0.0);
    let taps = session(None, None, None, true);
    assert!(taps.strokes.is_empty() && taps.taps);
    let fast = session(Some(200.0), None, None, false);
    assert_eq!(
        (fast.strokes[0].speed_mm_s, fast.strokes[0].force_n),
        (200.0, 1.0)
    );
    assert!(!fast.taps);
}

#[test]
fn samples_are_kept_by_csv_and_wav() {
    for (format, most_db) in [(ClipFormat::Csv, 1e-9), (ClipFormat::Wav, 0.3)] {
        let exported = exported(format);
        assert_eq!(exported.carried.len(), 4);
        for part in &exported.carried {
            let loss = part.loss.as_ref().unwrap();
            assert!(
                loss.worst_db < most_db,
                "{format:?} {}: {}",
                part.part,
                loss.worst_db
            );
        }
    }
}

#[test]
fn a_table_has_the_numbers_that_the_runtime_rendered() {
    let text = String::from_utf8(exported(ClipFormat::Csv).bytes).unwrap();
    let (clip, _) = with(|asset| clip(asset, &options()).unwrap());
    let column: Vec<f32> = text
        .lines()
        .skip(1)
        .map(|row| row.split(',').nth(1).unwrap().parse().unwrap())
        .collect();
    let rendered = clip.strokes.iter().chain(&clip.taps);
    let rendered: Vec<f32> = rendered
        .flat_map(|take| take.signal_m_s2.iter().map(|x| *x as f32))
        .collect();
    assert_eq!(column, rendered);
}

#[test]
fn a_curve_keeps_the_stroke_within_half_a_decibel_and_eight_bits_within_two() {
    let (rms, worst) = stroke_loss(&exported(ClipFormat::Hjif));
    assert!(rms < 0.2 && worst < 0.5, "{rms} {worst}");
    let (rms, worst) = stroke_loss(&exported(ClipFormat::Hmpg));
    assert!(rms < 1.0 && worst < 3.0, "{rms} {worst}");
}

/// A single tone cannot be noise, but it has its level.
#[test]
fn envelopes_keep_the_level_of_the_stroke_within_a_decibel() {
    let (clip, _) = with(|asset| clip(asset, &options()).unwrap());
    let rms = |x: &[f64]| (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt();
    let middle = |x: &[f64], rate: f64| {
        let at = |t: f64| (t * rate) as usize;
        rms(&x[at(0.2)..at(0.8)])
    };
    let source = middle(&clip.strokes[0].signal_m_s2, f64::from(clip.rate_hz));
    for (format, read) in [
        (
            ClipFormat::Haptic,
            haptic::read as fn(&str) -> Result<Track, Fault>,
        ),
        (ClipFormat::Ahap, ahap::read),
    ] {
        let exported = exported(format);
        let track = read(std::str::from_utf8(&exported.bytes).unwrap()).unwrap();
        let played = track.continuous(PLAY_HZ);
        let level = clip.scale.stroke_m_s2 * middle(&played, f64::from(PLAY_HZ));
        let off_db = 20.0 * (level / source).log10();
        assert!(off_db.abs() < 1.0, "{format:?}: {off_db} dB");
        let (loss_db, _) = stroke_loss(&exported);
        assert!(loss_db > 3.0, "{format:?}: one tone is no noise, {loss_db}");
        assert_eq!(track.transients.len(), 3);
        let louder = |pair: &[playback::Transient]| pair[0].amplitude < pair[1].amplitude;
        assert!(
            track.transients.windows(2).all(louder),
            "{:?}",
            track.transients
        );
    }
}

#[test]
fn ahap_has_curves_of_16_points_events_of_30_s_and_values_in_range() {
    let mut long = options();
    long.session = session(None, None, Some(40.0), true);
    let exported = with(|asset| export(asset, ClipFormat::Ahap, &long).unwrap());
    let json = parsed(&exported);
    assert_eq!(json["Version"], 1.0);
    let (mut curves, mut continuous, mut transient) = (0, 0, 0);
    for item in json["Pattern"].as_array().unwrap() {
        if let Some(curve) = item.get("ParameterCurve") {
            curves += 1;
            let points = curve["ParameterCurveControlPoints"].as_array().unwrap();
            assert!((2..=16).contains(&points.len()), "{}", points.len());
            assert_eq!(points[0]["Time"], 0.0);
            let times: Vec<f64> = points.iter().map(|p| p["Time"].as_f64().unwrap()).collect();
            assert!(times.windows(2).all(|t| t[0] < t[1]), "{times:?}");
            for point in points {
                let value = point["ParameterValue"].as_f64().unwrap();
                assert!((0.0..=1.0).contains(&value));
            }
        } else {
            let event = &item["Event"];
            for parameter in event["EventParameters"].as_array().unwrap() {
                let value = parameter["ParameterValue"].as_f64().unwrap();
                assert!((0.0..=1.0).contains(&value));
            }
            if event["EventType"] == "HapticContinuous" {
                continuous += 1;
                assert!(event["EventDuration"].as_f64().unwrap() <= 30.0);
            } else {
                assert_eq!(event["EventType"], "HapticTransient");
                assert!(event.get("EventDuration").is_none());
                transient += 1;
            }
        }
    }
    assert!(
        curves > 200 && continuous == 2 && transient == 3,
        "{curves} {continuous} {transient}"
    );
}

#[test]
fn haptic_has_ascending_times_and_emphasis_above_its_point() {
    let json = parsed(&exported(ClipFormat::Haptic));
    assert_eq!(json["version"]["major"], 1);
    let envelopes = &json["signals"]["continuous"]["envelopes"];
    let mut last = 0.0;
    let mut emphases = 0;
    for point in envelopes["amplitude"].as_array().unwrap() {
        let (time, level) = (
            point["time"].as_f64().unwrap(),
            point["amplitude"].as_f64().unwrap(),
        );
        assert!(time >= last && (0.0..=1.0).contains(&level));
        last = time;
        if let Some(emphasis) = point.get("emphasis") {
            emphases += 1;
            assert!(emphasis["amplitude"].as_f64().unwrap() >= level);
        }
    }
    assert_eq!(emphases, 3);
    let frequencies = envelopes["frequency"].as_array().unwrap();
    assert!(
        frequencies
            .iter()
            .all(|f| (0.0..=1.0).contains(&f["frequency"].as_f64().unwrap()))
    );
}

#[test]
fn hjif_reads_back_to_the_same_curve() {
    let text = String::from_utf8(exported(ClipFormat::Hjif).bytes).unwrap();
    let track = hjif::read(&text).unwrap();
    assert_eq!(
        (
            track.curves.len(),
            track.tones.len(),
            track.transients.len()
        ),
        (1, 0, 3)
    );
    assert!(track.warnings.is_empty(), "{:?}", track.warnings);
    let peak = track.curves[0]
        .iter()
        .fold(0.0f64, |peak, p| peak.max(p.value.abs()));
    // Between its samples a signal may rise a little above the loudest one, and is cut there.
    assert!((0.97..=1.0).contains(&peak), "{peak}");
}

/// Units fill the file, packets fill their units, and the time adds up.
#[test]
fn hmpg_is_a_chain_of_units_of_packets() {
    let exported = exported(ClipFormat::Hmpg);
    let mut rest = exported.bytes.as_slice();
    let (mut ticks, mut kinds) = (0, Vec::new());
    while !rest.is_empty() {
        let header = rest[..9]
            .iter()
            .fold(0u128, |sum, b| sum << 8 | u128::from(*b));
        let (kind, duration) = (header >> 66, header >> 36 & 0xff_ffff);
        let length = (header >> 4 & 0xffff_ffff) as usize;
        kinds.push(kind);
        ticks += duration;
        let (mut packets, after) = rest[9..].split_at(length);
        while !packets.is_empty() {
            let header = packets[..3]
                .iter()
                .fold(0u32, |sum, b| sum << 8 | u32::from(*b));
            packets = &packets[3 + (header >> 1 & 0x1_ffff) as usize..];
        }
        rest = after;
    }
    assert_eq!(kinds[0], 0);
    assert!(kinds[1..].iter().all(|kind| matches!(kind, 1 | 3)) && kinds.contains(&1));
    let (clip, _) = with(|asset| clip(asset, &options()).unwrap());
    let last_tap_s = clip.taps.last().unwrap().onset_s(clip.rate_hz);
    let seconds = ticks as f64 / f64::from(hjif::TIMESCALE);
    assert!(
        seconds > last_tap_s && seconds < last_tap_s + 0.2,
        "{seconds} {last_tap_s}"
    );
}

#[test]
fn hmpg_says_how_long_a_stroke_it_holds() {
    let mut long = options();
    long.session = session(None, None, Some(20.0), false);
    let refused = with(|asset| export(asset, ClipFormat::Hmpg, &long).unwrap_err());
    assert!(refused.what.contains("the clip takes"), "{refused}");
}

#[test]
fn a_gltf_has_four_pictures_a_square_and_a_haptic_material() {
    let exported = exported(ClipFormat::Gltf);
    let json = parsed(&exported);
    assert_eq!(json["asset"]["version"], "2.0");
    let name = "MPEG_haptic_material";
    assert_eq!(json["extensionsUsed"][0], name);
    let material = &json["extensions"][name]["materials"][0];
    let textures = json["textures"].as_array().unwrap().len();
    for property in ["stiffness", "friction", "vibrotactileTexture", "vibration"] {
        let entry = &material[property][0];
        assert_eq!(entry["type"], "High_Resolution", "{property}");
        assert!((entry["texture"]["index"].as_u64().unwrap() as usize) < textures);
    }
    assert_eq!(material["friction"][0]["extras"]["white_is_mu"], 0.72);
    assert_eq!(
        json["meshes"][0]["extensions"][name]["hapticMaterialIndex"],
        0
    );
    let decoded = |uri: &Value, kind: &str| {
        use base64::Engine as _;
        let text = uri
            .as_str()
            .unwrap()
            .strip_prefix(&format!("data:{kind};base64,"))
            .unwrap();
        base64::engine::general_purpose::STANDARD
            .decode(text)
            .unwrap()
    };
    let images = json["images"].as_array().unwrap();
    assert_eq!(images.len(), 4);
    for image in images {
        let png = decoded(&image["uri"], "image/png");
        png::Decoder::new(std::io::Cursor::new(png))
            .read_info()
            .unwrap();
    }
    let buffer = decoded(&json["buffers"][0]["uri"], "application/octet-stream");
    assert_eq!(
        buffer.len() as u64,
        json["buffers"][0]["byteLength"].as_u64().unwrap()
    );
    let last = json["bufferViews"].as_array().unwrap().last().unwrap();
    let end = last["byteOffset"].as_u64().unwrap() + last["byteLength"].as_u64().unwrap();
    assert_eq!(end, buffer.len() as u64);
}

#[test]
fn a_silent_texture_is_said_to_be_silent() {
    let mut texture = builtin::texture();
    for vertex in &mut texture.grid.vertices {
        vertex.sigma_m_s2 = 0.0;
    }
    let bytes = lower(&texture, None).unwrap().bytes;
    let asset = Asset::parse(&bytes).unwrap();
    for format in [
        ClipFormat::Haptic,
        ClipFormat::Ahap,
        ClipFormat::Hjif,
        ClipFormat::Hmpg,
    ] {
        let exported = export(&asset, format, &options()).unwrap();
        assert!(exported.carried[0].loss.is_none(), "{format:?}");
    }
}

#[test]
fn a_full_scale_below_the_signal_is_warned_of() {
    let mut small = options();
    small.full_scale_m_s2 = Some(0.5);
    let exported = with(|asset| export(asset, ClipFormat::Wav, &small).unwrap());
    assert!(
        exported.warnings.iter().any(|w| w.contains("exceed")),
        "{:?}",
        exported.warnings
    );
    let (_, worst) = stroke_loss(&exported);
    assert!(worst > 1.0, "{worst}");
}

#[test]
fn strange_effects_are_refused_with_their_place() {
    let haptic = |times: [f64; 2], level: f64| {
        format!(
            r#"{{"version":{{"major":1,"minor":0,"patch":0}},"signals":{{"continuous":{{"envelopes":
            {{"amplitude":[{{"time":{},"amplitude":0.1}},{{"time":{},"amplitude":{level}}}]}}}}}}}}"#,
            times[0], times[1]
        )
    };
    assert!(haptic::read(&haptic([0.0, 1.0], 1.0)).is_ok());
    for (text, place) in [
        (haptic([1.0, 0.5], 1.0), "amplitude[1].time"),
        (haptic([0.0, 1e9], 1.0), "amplitude[1].time"),
        (haptic([-1.0, 1.0], 1.0), "amplitude[0].time"),
        (haptic([0.0, 1.0], 1.5), "amplitude[1].amplitude"),
        (
            haptic([0.0, 1.0], 1.0).replace("\"major\":1", "\"major\":2"),
            "version",
        ),
        (
            haptic([0.0, 1.0], 1.0).replace("time", "tyme"),
            "amplitude[0]",
        ),
    ] {
        let fault = haptic::read(&text).unwrap_err();
        assert!(fault.field.ends_with(place), "{fault}");
    }
    let event = |duration: f64| {
        format!(
            r#"{{"Version":1.0,"Pattern":[{{"Event":{{"Time":0.0,"EventType":"HapticContinuous",
            "EventDuration":{duration},"EventParameters":[]}}}}]}}"#
        )
    };
    assert!(ahap::read(&event(1.0)).is_ok());
    for duration in [-1.0, 1e6, 1e308] {
        let fault = ahap::read(&event(duration)).unwrap_err();
        assert_eq!(fault.field, "Pattern[0].Event.EventDuration");
    }
    let text = String::from_utf8(exported(ClipFormat::Hjif).bytes).unwrap();
    let fault = hjif::read(&text.replace("Transient", "WaveletWave")).unwrap_err();
    assert!(
        fault.field.contains("bands[1]") && fault.what.contains("wavelet"),
        "{fault}"
    );
    let fault = hjif::read(&text.replace("\"timescale\":4000", "\"timescale\":0")).unwrap_err();
    assert_eq!(fault.field, "timescale");
}

#[test]
fn a_part_that_loses_more_than_six_decibels_is_warned_of_by_name() {
    // glTF holds one level and one frequency.
    for format in [
        ClipFormat::Wav,
        ClipFormat::Haptic,
        ClipFormat::Ahap,
        ClipFormat::Gltf,
    ] {
        let exported = with(|asset| export(asset, format, &options()).unwrap());
        let lossy: Vec<&str> = exported
            .carried
            .iter()
            .filter(|c| c.loss.as_ref().is_some_and(|loss| loss.rms_db > 6.0))
            .map(|c| c.part.as_str())
            .collect();
        let warned: Vec<&String> = exported
            .warnings
            .iter()
            .filter(|w| w.contains("loses more than 6 dB"))
            .collect();
        println!("{format:?}: {lossy:?} {warned:?}");
        assert_eq!(warned.len(), usize::from(!lossy.is_empty()), "{format:?}");
        for part in &lossy {
            assert!(warned[0].contains(part), "{part} in {warned:?}");
        }
        match format {
            ClipFormat::Wav => assert!(lossy.is_empty(), "{lossy:?}"),
            ClipFormat::Gltf => assert!(!lossy.is_empty()),
            _ => {}
        }
    }
}
