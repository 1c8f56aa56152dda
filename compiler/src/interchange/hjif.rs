//! HJIF, the interchange form of ISO/IEC 23090-31 (MPEG haptics), as JSON.
//!
//! Strokes are a curve band: the signal itself, drawn by straight lines between keyframes at
//! [`TIMESCALE`]. Taps are a transient band. Read are curve, vectorial and transient bands. Wavelet
//! bands are refused: they hold samples in an arithmetic code.

use super::{
    clip::Clip,
    envelope::transient_hz,
    haptic::rounded,
    parse::{MAX_S, bounded, json, too_many, within},
    playback::{CurvePoint, Track, Transient},
};
use asperity_io::diagnostic::Fault;
use asperity_texture::signal::resample::resample;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Ticks a second of what is written.
pub const TIMESCALE: u32 = 4000;
/// Time of a transient in the reference software, s: two periods.
const TRANSIENT_S: f64 = 0.022;
/// Keyframes of silence between two parts of a curve: one at each end.
const SILENT: f64 = 1e-6;

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Document {
    pub(super) version: String,
    pub(super) profile: String,
    pub(super) level: u8,
    pub(super) date: String,
    pub(super) description: String,
    #[serde(default = "millisecond")]
    pub(super) timescale: u32,
    /// An empty list, which is not read, as all of this type.
    #[serde(skip_deserializing)]
    pub(super) avatars: Vec<()>,
    pub(super) perceptions: Vec<Perception>,
    #[serde(skip_deserializing)]
    pub(super) syncs: Vec<()>,
}

fn millisecond() -> u32 {
    1000
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Perception {
    pub(super) id: i32,
    pub(super) avatar_id: i32,
    pub(super) description: String,
    pub(super) perception_modality: String,
    #[serde(skip_deserializing)]
    pub(super) reference_devices: Vec<()>,
    #[serde(default)]
    pub(super) effect_library: Vec<Effect>,
    pub(super) channels: Vec<Channel>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Channel {
    pub(super) id: i32,
    pub(super) description: String,
    pub(super) gain: f64,
    pub(super) mixing_coefficient: f64,
    pub(super) body_part_mask: u32,
    pub(super) bands: Vec<Band>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Band {
    pub(super) band_type: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) curve_type: Option<String>,
    pub(super) lower_frequency_limit: u32,
    pub(super) upper_frequency_limit: u32,
    pub(super) effects: Vec<Effect>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Effect {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<i32>,
    pub(super) effect_type: String,
    pub(super) position: i64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) phase: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) base_signal: Option<String>,
    #[serde(default)]
    pub(super) keyframes: Vec<Keyframe>,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Keyframe {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) relative_position: Option<i64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) amplitude_modulation: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) frequency_modulation: Option<i64>,
}

const CURVE: &str = "Curve";
const VECTORIAL: &str = "VectorialWave";
const TRANSIENT: &str = "Transient";
const BASIS: &str = "Basis";

/// A clip as a document.
pub(super) fn document(clip: &Clip) -> Document {
    let tick = |t_s: f64| (t_s * f64::from(TIMESCALE)).round() as i64;
    let mut bands = Vec::new();
    if !clip.strokes.is_empty() {
        let mut keyframes: Vec<Keyframe> = Vec::new();
        for take in &clip.strokes {
            let from = tick(take.start_s);
            let signal = resample(&take.signal_m_s2, clip.rate_hz, TIMESCALE);
            // The lines to and from the silence around a stroke are one tick long.
            if from > 0 {
                keyframes.push(keyframe(from - 1, 0.0));
            }
            for (tick, x) in (from..).zip(&signal) {
                let value = (x / clip.scale.stroke_m_s2).clamp(-1.0, 1.0);
                keyframes.push(keyframe(tick, value));
            }
            keyframes.push(keyframe(from + signal.len() as i64, 0.0));
        }
        bands.push(Band {
            band_type: CURVE.into(),
            curve_type: Some("Linear".into()),
            lower_frequency_limit: 0,
            upper_frequency_limit: clip.rate_hz.min(TIMESCALE) / 2,
            effects: vec![Effect {
                id: Some(0),
                effect_type: BASIS.into(),
                position: 0,
                phase: None,
                base_signal: None,
                keyframes,
            }],
        });
    }
    if !clip.taps.is_empty() {
        let tap = |(id, take): (i32, &super::clip::Take)| Effect {
            id: Some(id),
            effect_type: BASIS.into(),
            position: tick(take.onset_s(clip.rate_hz)),
            phase: None,
            base_signal: None,
            keyframes: vec![Keyframe {
                relative_position: Some(0),
                amplitude_modulation: Some(rounded(
                    (take.peak_m_s2() / clip.scale.tap_m_s2).min(1.0),
                )),
                frequency_modulation: Some(
                    transient_hz(&take.signal_m_s2, clip.rate_hz).round() as i64
                ),
            }],
        };
        bands.push(Band {
            band_type: TRANSIENT.into(),
            curve_type: None,
            lower_frequency_limit: 0,
            upper_frequency_limit: 1000,
            effects: (1..).zip(&clip.taps).map(tap).collect(),
        });
    }
    Document {
        version: "2023".into(),
        profile: "Main".into(),
        level: 1,
        date: "2023-01-01".into(),
        description: clip.description.clone(),
        timescale: TIMESCALE,
        avatars: Vec::new(),
        perceptions: vec![Perception {
            id: 0,
            avatar_id: 0,
            description: clip.name.clone(),
            perception_modality: "Vibrotactile".into(),
            reference_devices: Vec::new(),
            effect_library: Vec::new(),
            channels: vec![Channel {
                id: 0,
                description: "acceleration".into(),
                gain: 1.0,
                mixing_coefficient: 1.0,
                body_part_mask: 0,
                bands,
            }],
        }],
        syncs: Vec::new(),
    }
}

fn keyframe(tick: i64, value: f64) -> Keyframe {
    let value = rounded(value);
    Keyframe {
        relative_position: Some(tick),
        amplitude_modulation: Some(if value.abs() < SILENT { 0.0 } else { value }),
        frequency_modulation: None,
    }
}

/// Writes a clip.
pub(super) fn write(clip: &Clip) -> Vec<u8> {
    // Plain structures of finite numbers and strings always serialise.
    let mut bytes = serde_json::to_vec(&document(clip)).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

/// Parses the text of a file into a track.
///
/// # Errors
/// The JSON path of the first field at fault, and what is wrong with it.
pub(crate) fn read(text: &str) -> Result<Track, Fault> {
    play(&json::<Document>(text)?)
}

/// Converts a document into a track.
pub(super) fn play(document: &Document) -> Result<Track, Fault> {
    let timescale = within(
        || "timescale".into(),
        f64::from(document.timescale),
        1.0,
        1e6,
    )?;
    let mut track = Track::default();
    let mut others = std::collections::BTreeMap::<String, usize>::new();
    for (p, perception) in document.perceptions.iter().enumerate() {
        if !matches!(
            perception.perception_modality.as_str(),
            "Vibrotactile" | "Vibration" | "Acceleration" | "Force" | "Kinesthetic" | "Pressure"
        ) {
            let modality: String = perception.perception_modality.chars().take(40).collect();
            *others.entry(format!("{modality:?}")).or_default() += 1;
            continue;
        }
        let library: HashMap<i32, &Effect> = perception
            .effect_library
            .iter()
            .filter_map(|effect| Some((effect.id?, effect)))
            .collect();
        for (c, channel) in perception.channels.iter().enumerate() {
            let at = |key: &str| format!("perceptions[{p}].channels[{c}].{key}");
            let gain = within(|| at("gain"), channel.gain, -1e4, 1e4)?;
            for (b, band) in channel.bands.iter().enumerate() {
                for (e, effect) in band.effects.iter().enumerate() {
                    let placement = EffectPlacement {
                        path: || at(&format!("bands[{b}].effects[{e}]")),
                        timescale,
                        gain,
                    };
                    placement.add(band, effect, &library, &mut track)?;
                }
            }
        }
    }
    if !others.is_empty() {
        let named = others.iter().take(6);
        let named: Vec<String> = named
            .map(|(modality, count)| format!("{count} {modality}"))
            .collect();
        track.warnings.push(format!(
            "perceptions left out, whose modality is no vibration: {}",
            named.join(", ")
        ));
    }
    bounded(track)
}

/// An effect of a band.
struct EffectPlacement<F> {
    path: F,
    timescale: f64,
    gain: f64,
}

impl<F: Fn() -> String> EffectPlacement<F> {
    fn add(
        &self,
        band: &Band,
        effect: &Effect,
        library: &HashMap<i32, &Effect>,
        track: &mut Track,
    ) -> Result<(), Fault> {
        let refused = |what| {
            let fault = Fault::new(what, "export the effect again without it");
            Err(fault.field((self.path)()))
        };
        let keyframes = match effect.effect_type.as_str() {
            BASIS => &effect.keyframes,
            "Reference" => match effect.id.and_then(|id| library.get(&id)) {
                Some(effect) => &effect.keyframes,
                None => return refused("a reference to an effect that the library does not hold"),
            },
            _ => return refused("a composite effect, which is not read"),
        };
        if keyframes.len() > track_room(track) {
            let (found, limit) = (keyframes.len() as f64, track_room(track) as f64);
            return Err(too_many("keyframes", found, limit).field((self.path)()));
        }
        match band.band_type.as_str() {
            CURVE => self.curve(effect.position, keyframes, track),
            VECTORIAL => self.tone(effect.position, keyframes, track),
            TRANSIENT => self.transients(effect.position, keyframes, track),
            _ => refused("a wavelet band, which is not read: encode it without wavelets"),
        }
    }

    /// Time of a keyframe, s.
    fn time(&self, n: usize, position: i64, frame: &Keyframe, before: f64) -> Result<f64, Fault> {
        let ticks = position as f64 + frame.relative_position.unwrap_or(0) as f64;
        let field = || format!("{}.keyframes[{n}].relative_position", (self.path)());
        super::parse::time(field, ticks / self.timescale, before)
    }

    fn level(&self, n: usize, value: f64) -> Result<f64, Fault> {
        let field = || format!("{}.keyframes[{n}].amplitude_modulation", (self.path)());
        Ok(self.gain * within(field, value, -1.0, 1.0)?)
    }

    fn freq_hz(&self, n: usize, value: i64) -> Result<f64, Fault> {
        let field = || format!("{}.keyframes[{n}].frequency_modulation", (self.path)());
        within(field, value as f64, 0.0, 10_000.0)
    }

    fn curve(&self, position: i64, frames: &[Keyframe], track: &mut Track) -> Result<(), Fault> {
        let mut points = Vec::with_capacity(frames.len());
        let mut before = 0.0;
        for (n, frame) in frames.iter().enumerate() {
            before = self.time(n, position, frame, before)?;
            if let Some(value) = frame.amplitude_modulation {
                points.push(CurvePoint {
                    t_s: before,
                    value: self.level(n, value)?,
                });
            }
        }
        if points.len() > 1 {
            track.curves.push(points);
        }
        Ok(())
    }

    fn tone(&self, position: i64, frames: &[Keyframe], track: &mut Track) -> Result<(), Fault> {
        let (mut amplitudes, mut frequencies) = (Vec::new(), Vec::new());
        let mut before = 0.0;
        for (n, frame) in frames.iter().enumerate() {
            before = self.time(n, position, frame, before)?;
            if let Some(value) = frame.amplitude_modulation {
                amplitudes.push((before, self.level(n, value)?.abs()));
            }
            if let Some(value) = frame.frequency_modulation {
                frequencies.push((before, self.freq_hz(n, value)?));
            }
        }
        track
            .tones
            .extend(super::haptic::tone(&amplitudes, &frequencies));
        Ok(())
    }

    fn transients(
        &self,
        position: i64,
        frames: &[Keyframe],
        track: &mut Track,
    ) -> Result<(), Fault> {
        let mut before = 0.0;
        for (n, frame) in frames.iter().enumerate() {
            before = self.time(n, position, frame, before)?;
            track.transients.push(Transient {
                t_s: before,
                amplitude: self
                    .level(n, frame.amplitude_modulation.unwrap_or(1.0))?
                    .abs(),
                freq_hz: match frame.frequency_modulation {
                    Some(hz) if hz > 0 => self.freq_hz(n, hz)?,
                    _ => 2.0 / TRANSIENT_S,
                },
            });
        }
        Ok(())
    }
}

/// The track as the reference software plays it: with one pulse for all transients.
pub(super) fn as_played(mut track: Track) -> Track {
    for transient in &mut track.transients {
        transient.freq_hz = 2.0 / TRANSIENT_S;
    }
    track
}

/// Keyframes that a track has room for: one a sample of the longest track at 8 kHz.
fn track_room(track: &Track) -> usize {
    let held: usize = track.tones.iter().map(Vec::len).sum::<usize>()
        + track.curves.iter().map(Vec::len).sum::<usize>();
    ((8000.0 * MAX_S) as usize).saturating_sub(held)
}
