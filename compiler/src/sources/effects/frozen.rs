//! Imports of `.haptic` and HJIF files are fixed to the bit: changes of code shared with other formats show here.

use super::{
    EffectsKind,
    tests::{self, options},
};
use crate::interchange::{
    haptic, hjif,
    playback::{TonePoint, Track},
};
use asperity_tests::draw::Draw;
use asperity_texture::model::TextureModel;
use serde_json::{Value, json};
use std::fs;

/// Files of each format that are read.
const FILES: u64 = 60;
/// Number of them that are compiled.
const COMPILED: u64 = 2;

/// Bits of numbers, hashed.
#[derive(Default)]
struct Bits(crc32fast::Hasher);

impl Bits {
    fn add(&mut self, numbers: impl IntoIterator<Item = f64>) {
        for number in numbers {
            self.0.update(&number.to_bits().to_le_bytes());
        }
    }

    fn track(&mut self, track: &Track) {
        let tone = |p: &TonePoint| [p.t_s, p.amplitude, p.freq_hz];
        for points in &track.tones {
            self.add([points.len() as f64]);
            self.add(points.iter().flat_map(tone));
        }
        for points in &track.curves {
            self.add([points.len() as f64]);
            self.add(points.iter().flat_map(|p| [p.t_s, p.value]));
        }
        self.add(
            track
                .transients
                .iter()
                .flat_map(|t| [t.t_s, t.amplitude, t.freq_hz]),
        );
    }

    fn texture(&mut self, texture: &TextureModel) {
        for vertex in &texture.grid.vertices {
            self.add([
                vertex.speed_mm_s,
                vertex.force_n,
                vertex.gain,
                vertex.sigma_m_s2,
            ]);
            self.add(vertex.lsf_rad.iter().copied());
        }
        for trace in &texture.taps.traces {
            self.add([trace.speed_m_s]);
            self.add(trace.accel_m_s2.iter().copied());
        }
    }
}

/// Numbers with three decimals, as tools write them.
fn number(draw: &mut Draw, low: f64, high: f64) -> f64 {
    (draw.range(low, high) * 1e3).round() / 1e3
}

/// Times that do not fall, from `first`.
fn times(draw: &mut Draw, first: f64, count: usize) -> Vec<f64> {
    let mut time = first;
    let mut next = |n| {
        if n > 0 {
            time = ((time + number(draw, 0.0, 0.2)) * 1e3).round() / 1e3;
        }
        time
    };
    (0..count).map(&mut next).collect()
}

fn haptic_file(draw: &mut Draw) -> Value {
    let first = if draw.below(3) == 0 {
        number(draw, 0.0, 0.1)
    } else {
        0.0
    };
    let count = 2 + draw.below(20);
    let mut amplitude = Vec::new();
    for time in times(draw, first, count) {
        let mut point = json!({"time": time, "amplitude": number(draw, 0.0, 1.0)});
        if draw.below(4) == 0 {
            point["emphasis"] =
                json!({"amplitude": number(draw, 0.0, 1.0), "frequency": number(draw, 0.0, 1.0)});
        }
        amplitude.push(point);
    }
    let mut envelopes = json!({"amplitude": amplitude});
    if draw.below(4) > 0 {
        let count = 1 + draw.below(20);
        let points: Vec<Value> = times(draw, first, count)
            .into_iter()
            .map(|time| json!({"time": time, "frequency": number(draw, 0.0, 1.0)}))
            .collect();
        envelopes["frequency"] = points.into();
    }
    json!({
        "version": {"major": 1, "minor": 0, "patch": 0},
        "signals": {"continuous": {"envelopes": envelopes}},
    })
}

fn hjif_file(draw: &mut Draw) -> Value {
    let mut band = |kind: &str| {
        let count = 1 + draw.below(12);
        let ticks: Vec<f64> = times(draw, 0.0, count).iter().map(|t| t * 1e3).collect();
        let frames: Vec<Value> = ticks
            .into_iter()
            .map(|tick| {
                json!({
                    "relative_position": tick.round() as i64,
                    "amplitude_modulation": number(draw, -1.0, 1.0),
                    "frequency_modulation": 20 + draw.below(300),
                })
            })
            .collect();
        json!({
            "band_type": kind, "curve_type": "Linear",
            "lower_frequency_limit": 0, "upper_frequency_limit": 1000,
            "effects": [{"effect_type": "Basis", "position": draw.below(500), "keyframes": frames}],
        })
    };
    let bands = ["Curve", "VectorialWave", "Transient"].map(&mut band);
    json!({
        "version": "2023", "profile": "Main", "level": 1, "date": "2023-01-01", "description": "",
        "timescale": 1000,
        "perceptions": [{
            "id": 0, "avatar_id": 0, "description": "", "perception_modality": "Vibrotactile",
            "channels": [{
                "id": 0, "description": "", "gain": 1.0, "mixing_coefficient": 1.0,
                "body_part_mask": 0, "bands": bands,
            }],
        }],
    })
}

/// Hashes of what the files of a format play, and of the textures of the first of them.
fn hashes(kind: EffectsKind, file: impl Fn(&mut Draw) -> Value) -> (u32, u32) {
    let folder = tempfile::tempdir().unwrap();
    let (mut played, mut compiled) = (Bits::default(), Bits::default());
    for seed in 0..FILES {
        let text = file(&mut Draw::new(seed)).to_string();
        let track = match kind {
            EffectsKind::Haptic => haptic::read(&text),
            EffectsKind::Hjif => hjif::read(&text),
            EffectsKind::Ahap => unreachable!("AHAP is held against a player instead"),
        };
        played.track(&track.unwrap_or_else(|fault| panic!("{fault}: {text}")));
        if seed < COMPILED {
            let path = folder.path().join(format!("{seed}.json"));
            fs::write(&path, text).unwrap();
            let imported = tests::import(&path, kind, &options()).unwrap();
            compiled.texture(&imported.whole);
        }
    }
    (played.0.finalize(), compiled.0.finalize())
}

#[test]
fn haptic_files_give_what_they_gave() {
    assert_eq!(
        hashes(EffectsKind::Haptic, haptic_file),
        (360_784_425, 2_915_589_708)
    );
}

#[test]
fn hjif_files_give_what_they_gave() {
    assert_eq!(
        hashes(EffectsKind::Hjif, hjif_file),
        (832_443_039, 3_113_750_556)
    );
}
