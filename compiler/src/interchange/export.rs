//! A texture in a format by its name, and what of it the format carries.

use super::{
    ahap,
    clip::{Clip, Scale, Take},
    csv, gltf, haptic, hjif, hmpg,
    playback::{PLAY_HZ, Track},
    third_octave::{Loss, Shape, loss},
    wav,
};
use crate::{
    emit::raise::raise,
    views::{
        listen::{self, Gesture, Stroke, check_taps, not_encoded, perform},
        preview,
    },
};
use asperity_formats::Asset;
use asperity_io::diagnostic::Fault;
use asperity_texture::signal::resample::resample;
use serde::Serialize;
use serde_json::{Value, json};
use std::{fmt, str::FromStr};

/// Speed, mm/s, force, N, and time, s, of a stroke that nothing is said of.
const STROKE: Stroke = Stroke {
    speed_mm_s: 100.0,
    force_n: 1.0,
    time_s: 1.0,
};
/// Bands up to this part of the rate of the loop count.
const TOP: f64 = 0.45;

/// Ranges of the numeric options of effect export and import.
pub mod ranges {
    use std::ops::RangeInclusive;

    /// Speed of a stroke, mm/s.
    pub const SPEED_MM_S: RangeInclusive<f32> = 1.0..=1000.0;
    /// Normal force of a stroke, N.
    pub const FORCE_N: RangeInclusive<f32> = 0.05..=20.0;
    /// Duration of a stroke, s.
    pub const TIME_S: RangeInclusive<f32> = 0.3..=60.0;
    /// Acceleration at full scale, m/s².
    pub const FULL_SCALE_M_S2: RangeInclusive<f32> = 0.001..=10_000.0;
    /// Impact speed of a tap, m/s.
    pub const TAP_SPEED_M_S: RangeInclusive<f32> = 0.01..=5.0;
    /// Coefficient of friction.
    pub const MU: RangeInclusive<f32> = 0.0..=2.0;
}

/// A format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Source text with the bytes of an asset or a library.
    Source(Language),
    /// Strokes and taps, or what can be said of them.
    Clip(ClipFormat),
}

/// A language of source text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is called what it is")]
pub enum Language {
    C,
    Rust,
}

/// A format that takes a clip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is called what it is")]
pub enum ClipFormat {
    Hjif,
    Hmpg,
    Ahap,
    Haptic,
    Gltf,
    Wav,
    Csv,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 9] = [
        Self::Source(Language::C),
        Self::Source(Language::Rust),
        Self::Clip(ClipFormat::Hjif),
        Self::Clip(ClipFormat::Hmpg),
        Self::Clip(ClipFormat::Ahap),
        Self::Clip(ClipFormat::Haptic),
        Self::Clip(ClipFormat::Gltf),
        Self::Clip(ClipFormat::Wav),
        Self::Clip(ClipFormat::Csv),
    ];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Source(Language::C) => "c-array",
            Self::Source(Language::Rust) => "rust",
            Self::Clip(format) => format.name(),
        }
    }

    /// The end of its files' names.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Source(Language::C) => "c",
            Self::Source(Language::Rust) => "rs",
            Self::Clip(format) => format.name(),
        }
    }
}

impl ClipFormat {
    /// Its name, and the end of its files' names.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hjif => "hjif",
            Self::Hmpg => "hmpg",
            Self::Ahap => "ahap",
            Self::Haptic => "haptic",
            Self::Gltf => "gltf",
            Self::Wav => "wav",
            Self::Csv => "csv",
        }
    }
}

impl FromStr for Format {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|format| format.name() == text);
        let names = Self::ALL.map(Self::name).join(", ");
        found.ok_or_else(|| format!("one of {names}"))
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Export options.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Gesture.
    pub session: Gesture,
    /// Rate of the loop, Hz; that of the texture if `None`.
    pub rate_hz: Option<f32>,
    /// Seed of the excitation.
    pub seed: u64,
    /// Acceleration of a full scale in strokes, m/s²; the largest one if `None`.
    pub full_scale_m_s2: Option<f64>,
    /// Acceleration of a full scale in taps, m/s²; the largest one if `None`.
    pub tap_full_scale_m_s2: Option<f64>,
    /// Width and height of pictures, pixels.
    pub size_px: u32,
}

/// Defaults of the command.
impl Default for Options {
    fn default() -> Self {
        Self {
            session: session(None, None, None, false),
            rate_hz: None,
            seed: 0,
            full_scale_m_s2: None,
            tap_full_scale_m_s2: None,
            size_px: preview::SIZE,
        }
    }
}

/// Returns the default session, one stroke and the taps, or the requested one: a stroke, or taps alone.
#[must_use]
pub fn session(
    speed_mm_s: Option<f32>,
    force_n: Option<f32>,
    time_s: Option<f32>,
    taps: bool,
) -> Gesture {
    let stated = speed_mm_s.is_some() || force_n.is_some() || time_s.is_some();
    let stroke = Stroke {
        speed_mm_s: speed_mm_s.unwrap_or(STROKE.speed_mm_s),
        force_n: force_n.unwrap_or(STROKE.force_n),
        time_s: time_s.unwrap_or(STROKE.time_s),
    };
    Gesture::chosen(stated.then_some(stroke), taps, vec![stroke])
}

/// A texture in a format.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// The file.
    pub bytes: Vec<u8>,
    /// Full scales; `None` for a format that holds the asset itself.
    pub scale: Option<Scale>,
    /// Every stroke and tap.
    pub carried: Vec<Carried>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

impl Exported {
    /// The report for machines, of the texture of this name.
    #[must_use]
    pub fn json(&self, name: &str) -> Value {
        json!({
            "name": name,
            "bytes": self.bytes.len(),
            "full_scale": self.scale,
            "parts": self.carried,
            "warnings": self.warnings,
        })
    }
}

/// Level loss of a stroke or a tap in a format.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Carried {
    /// Description of the gesture.
    pub part: String,
    /// The difference in third octaves; `None` for a part that does not sound.
    pub loss: Option<Loss>,
}

/// RMS over third octaves above which a part does not feel as it was, dB.
const LARGEST_LOSS_DB: f64 = 6.0;

/// A warning for the parts of which the format loses much.
fn lossy(carried: &[Carried]) -> Option<String> {
    let lossy = carried.iter().filter_map(|part| {
        let loss_db = part.loss.as_ref()?.rms_db;
        (loss_db > LARGEST_LOSS_DB).then(|| format!("{} ({loss_db:.1} dB)", part.part))
    });
    let parts: Vec<String> = lossy.collect();
    (!parts.is_empty()).then(|| {
        format!(
            "this format loses more than {LARGEST_LOSS_DB} dB of: {}",
            parts.join(", ")
        )
    })
}

/// The clip that an asset gives.
///
/// # Errors
/// [`Fault`] where strokes and taps cannot be rendered.
pub fn clip(asset: &Asset<'_>, options: &Options) -> Result<(Clip, Vec<String>), Fault> {
    check_taps(asset, &options.session, "export")?;
    let performance = perform(asset, &options.session, options.rate_hz, options.seed)?;
    let scales = (options.full_scale_m_s2, options.tap_full_scale_m_s2);
    let clip = Clip::new(asset.name(), &performance, scales.0, scales.1);
    Ok((clip, performance.warnings))
}

/// A texture in a format that takes a clip. The same asset and options give the same bytes.
///
/// # Errors
/// As [`clip`], and for a clip that the format does not hold.
pub fn export(asset: &Asset<'_>, format: ClipFormat, options: &Options) -> Result<Exported, Fault> {
    let (clip, mut warnings) = clip(asset, options)?;
    let back = |track: Result<Track, Fault>| {
        track.map_err(|Fault { field, what, .. }| {
            let name = asset.name();
            let what = format!("{name}: what was written does not read back: {field}: {what}");
            let remedy = "report this with the asset: it is a fault of asperity";
            Fault::new(what, remedy)
        })
    };
    let (bytes, track) = match format {
        ClipFormat::Haptic => {
            let bytes = haptic::write(&clip);
            let track = back(haptic::read(&String::from_utf8_lossy(&bytes)))?;
            (bytes, Some(track))
        }
        ClipFormat::Ahap => {
            let bytes = ahap::write(&clip);
            let track = back(ahap::read(&String::from_utf8_lossy(&bytes)))?;
            (bytes, Some(track))
        }
        ClipFormat::Hjif => {
            let bytes = hjif::write(&clip);
            let track = back(hjif::read(&String::from_utf8_lossy(&bytes)))?;
            (bytes, Some(hjif::as_played(track)))
        }
        ClipFormat::Hmpg => {
            let strokes_end_s = clip
                .strokes
                .last()
                .map_or(0.0, |take| take.end_s(clip.rate_hz));
            let limit_s = hmpg::MAX_TICK as f64 / f64::from(hjif::TIMESCALE) - 0.01;
            if strokes_end_s > limit_s {
                let (name, format) = (asset.name(), format.name());
                let what = format!(
                    "{name}: the clip takes {strokes_end_s:.1} s, and {format} holds {limit_s} s"
                );
                return Err(Fault::new(what, "give a shorter --time").usage());
            }
            let document = hmpg::quantised(&hjif::document(&clip));
            let track = back(hjif::play(&document))?;
            (hmpg::write(&document), Some(hjif::as_played(track)))
        }
        ClipFormat::Gltf => {
            let bytes = gltf::write(&raise(asset), &clip, options.size_px)?;
            let track = gltf::vibration(&clip).map(|v| gltf::played(&clip, v));
            warnings
                .push("glTF holds one level and one frequency of the vibration, and no tap".into());
            (bytes, Some(track.unwrap_or_default()))
        }
        ClipFormat::Wav => {
            let bytes = listen::wav(&wav::samples(&clip)).map_err(not_encoded)?;
            (bytes, None)
        }
        ClipFormat::Csv => (csv::write(&clip), None),
    };
    let played = match (&track, format) {
        (Some(track), _) => Some((track.continuous(PLAY_HZ), track.taps(PLAY_HZ))),
        (None, ClipFormat::Wav) => {
            let played = wav::played(&wav::samples(&clip), PLAY_HZ);
            Some((played.clone(), played))
        }
        _ => None,
    };
    let clipped = clip.clipped();
    if clipped > 0.0 && format != ClipFormat::Csv {
        let percent = 100.0 * clipped;
        warnings.push(format!(
            "{percent:.2} % of the samples exceed the full scale and are cut off"
        ));
    }
    let carried = carried(&clip, played);
    warnings.extend(lossy(&carried));
    Ok(Exported {
        bytes,
        scale: (format != ClipFormat::Csv).then_some(clip.scale),
        carried,
        warnings,
    })
}

/// The loss of each part, where something is played; none where the samples themselves are kept.
fn carried(clip: &Clip, played: Option<(Vec<f64>, Vec<f64>)>) -> Vec<Carried> {
    let top_hz = TOP * f64::from(clip.rate_hz);
    let part = |take: &Take, played: Option<&Vec<f64>>, scale: f64, shape: Shape| {
        let source = resample(&take.signal_m_s2, clip.rate_hz, PLAY_HZ);
        let from = (take.start_s * f64::from(PLAY_HZ)).round() as usize;
        let found: Vec<f64> = match played {
            None => source.clone(),
            Some(played) => {
                let samples = played.iter().skip(from).copied();
                let padded = samples.chain(std::iter::repeat(0.0));
                padded.take(source.len()).map(|x| scale * x).collect()
            }
        };
        Carried {
            part: take.label.clone(),
            loss: loss(&source, &found, f64::from(PLAY_HZ), top_hz, shape),
        }
    };
    let strokes = clip.strokes.iter().map(|take| {
        let played = played.as_ref().map(|p| &p.0);
        part(take, played, clip.scale.stroke_m_s2, Shape::Steady)
    });
    let taps = clip.taps.iter().map(|take| {
        let played = played.as_ref().map(|p| &p.1);
        part(take, played, clip.scale.tap_m_s2, Shape::Transient)
    });
    strokes.chain(taps).collect()
}
