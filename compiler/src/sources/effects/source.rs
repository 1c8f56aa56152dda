//! A file of effects as a source.

use super::stroke;
use crate::{
    compiled::ErrorReference,
    interchange::{
        ahap, haptic, hjif,
        playback::{Track, Transient},
    },
    learned::edges,
    name,
    pipeline::{Pass, Pipeline, Request, Ringing},
    sources::{ManifestSource, Source, SourceOutput, Tools, key::Parts},
};
use asperity_io::{
    diagnostic::{Failure, Fault},
    input::{self, Format, InputProblem},
};
use asperity_texture::model::{
    Friction, ModelGrid, Numerator, Provenance, TapBank, TapTrace, TextureModel, defaults,
    tap_synthesis, triangulate,
};
use std::path::{Path, PathBuf};

/// The grid reaches this many times the speed and the force of the stroke.
const REACH: f64 = 2.0;

/// Format of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EffectsKind {
    /// `.haptic` of NiceVibrations.
    Haptic,
    /// The Apple Haptic and Audio Pattern.
    Ahap,
    /// The interchange form of MPEG haptics.
    Hjif,
}

impl EffectsKind {
    /// All kinds, each with its format and its name.
    const ALL: [(Self, Format, &'static str); 3] = [
        (Self::Haptic, Format::Haptic, "haptic"),
        (Self::Ahap, Format::Ahap, "ahap"),
        (Self::Hjif, Format::Hjif, "hjif"),
    ];

    /// The kind that the content of a file says.
    #[must_use]
    pub fn of_format(found: Format) -> Option<Self> {
        let mut all = Self::ALL.into_iter();
        all.find_map(|(kind, format, _)| (format == found).then_some(kind))
    }

    /// The kind that the end of a file's name says.
    #[must_use]
    pub fn of_name(file: &Path) -> Option<Self> {
        let extension = file.extension()?;
        let mut all = Self::ALL.into_iter();
        all.find_map(|(kind, _, name)| extension.eq_ignore_ascii_case(name).then_some(kind))
    }

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        Self::ALL[self as usize].2
    }
}

/// Parameters that an effect file lacks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Speed of the stroke, mm/s.
    pub speed_mm_s: f64,
    /// Normal force of the stroke, N.
    pub force_n: f64,
    /// Acceleration of a full scale in strokes, m/s².
    pub full_scale_m_s2: f64,
    /// Acceleration of a full scale in taps, m/s².
    pub tap_full_scale_m_s2: f64,
    /// Impact speed of the loudest tap, m/s.
    pub tap_speed_m_s: f64,
    /// Coefficient of friction, of which the file says nothing.
    pub mu: f64,
}

/// A stroke at 100 mm/s and 1 N; a full scale is 5 m/s² in strokes and 50 m/s² in taps.
impl Default for Options {
    fn default() -> Self {
        Self {
            speed_mm_s: 100.0,
            force_n: 1.0,
            full_scale_m_s2: 5.0,
            tap_full_scale_m_s2: 50.0,
            // To the bit as the command reads it.
            tap_speed_m_s: f64::from(0.3_f32),
            mu: 0.5,
        }
    }
}

/// A file of effects.
#[derive(Debug, Clone)]
pub struct Effects {
    /// The file.
    pub file: PathBuf,
    /// Its format.
    pub kind: EffectsKind,
    /// Parameters that it lacks.
    pub options: Options,
}

impl Source for Effects {
    fn origin(&self) -> String {
        self.file.display().to_string()
    }

    fn inputs(&self) -> Vec<PathBuf> {
        vec![self.file.clone()]
    }

    /// Reads, plays and models the file.
    fn model(
        &self,
        request: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let Self {
            file,
            kind,
            options,
        } = self;
        let (track, crc32) = pipeline.run(Pass::Read, || self.track(tools))?;
        let mut warnings = track.warnings.clone();
        let name = request.name.clone().unwrap_or_else(|| name::of_file(file));
        if !name::fits(&name) {
            let remedy = "give another --name".into();
            let fault = Fault {
                remedy,
                ..name::invalid(&name)
            };
            return Err(fault.at(file).usage().into());
        }
        let whole = pipeline.run(Pass::Decode, || {
            texture(&track, name, *kind, options, &mut warnings)
        });
        let Some(mut whole) = whole else {
            let mut reasons = track.warnings;
            if reasons.is_empty() {
                let silent = "no transient, and no continuous effect with an amplitude above zero";
                reasons.push(silent.into());
            }
            let what = format!("it holds no effect that sounds: {}", reasons.join("; "));
            let remedy = "give a file with a continuous effect, a transient or both";
            return Err(Fault::new(what, remedy).at(file).into());
        };
        let name = file.file_name().unwrap_or_default();
        whole.provenance.source = name.to_string_lossy().into_owned();
        whole.provenance.source_crc32 = crc32;
        Ok(SourceOutput {
            truth: Some(ErrorReference::Texture),
            ringing: Ringing::Stabilised,
            warnings,
            ..SourceOutput::new(whole)
        })
    }
}

impl ManifestSource for Effects {
    fn key(&self, parts: Parts, _: &Tools<'_>) -> Result<Parts, Failure> {
        let options = format!("{:?}", self.options);
        Ok(parts
            .text(self.kind.name())
            .text(&options)
            .file(&self.file, input::InputKind::Effects)?)
    }
}

impl Effects {
    /// Reads the track of the file, and its CRC-32.
    fn track(&self, tools: &Tools<'_>) -> Result<(Track, u32), Fault> {
        let refused = |problem: InputProblem| Fault::from(problem).at(&self.file);
        let bytes = tools
            .file(&self.file, input::InputKind::Effects)
            .map_err(refused)?;
        let (_, wanted, _) = EffectsKind::ALL[self.kind as usize];
        if let Some(format) = Format::of(&bytes).filter(|format| *format != wanted) {
            let wanted = wanted.name().into();
            return Err(refused(InputProblem::OtherFormat { format, wanted }));
        }
        let text = input::text(&bytes).map_err(refused)?;
        let track = match self.kind {
            EffectsKind::Haptic => haptic::read(text),
            EffectsKind::Ahap => ahap::read(text),
            EffectsKind::Hjif => hjif::read(text),
        };
        let track = track.map_err(|fault| fault.at(&self.file))?;
        Ok((track, crc32fast::hash(&bytes)))
    }
}

/// The texture of a track; `None` for one that does not sound.
fn texture(
    track: &Track,
    name: String,
    kind: EffectsKind,
    options: &Options,
    warnings: &mut Vec<String>,
) -> Option<TextureModel> {
    let vertex = stroke::vertex(
        track,
        options.speed_mm_s,
        options.force_n,
        options.full_scale_m_s2,
    );
    let sounds = vertex.sigma_m_s2 > 0.0;
    let taps: Vec<_> = track
        .transients
        .iter()
        .filter(|t| t.amplitude > 0.0)
        .copied()
        .collect();
    if !sounds && taps.is_empty() {
        return None;
    }
    let vertices = edges::close(
        vec![vertex],
        REACH * options.speed_mm_s,
        REACH * options.force_n,
    );
    let grid = ModelGrid {
        sample_rate_hz: f64::from(stroke::MODEL_HZ),
        order: stroke::ORDER,
        numerator: Numerator::Nyquist,
        triangles: triangulate::delaunay(&vertices),
        vertices,
    };
    let gains = defaults::gains();
    let synthetic = taps.is_empty();
    let bank: TapBank = if synthetic {
        warnings
            .push("the file has no transients: the taps are synthesised from its spectrum".into());
        tap_synthesis::bank(tap_synthesis::frequency_hz(&grid), &gains)
    } else {
        bank(&taps, options.tap_speed_m_s, options.tap_full_scale_m_s2)
    };
    if !sounds {
        warnings.push("the file has transients alone: the texture does not vibrate".into());
    }
    let generator = format!(
        "asperity {} import {}",
        env!("CARGO_PKG_VERSION"),
        kind.name()
    );
    Some(TextureModel {
        name,
        taps: bank,
        grid,
        friction: Friction {
            mu: options.mu,
            anchors: Vec::new(),
            law: None,
        },
        wall: defaults::wall(),
        contact: None,
        direction: None,
        gains,
        provenance: Provenance {
            generator,
            taps_synthetic: synthetic,
            notes: format!(
                "One stroke at {} mm/s and {} N; a full scale is {} m/s² in strokes and {} m/s² in \
                 taps. Friction, wall and gains are not the file's.",
                options.speed_mm_s,
                options.force_n,
                options.full_scale_m_s2,
                options.tap_full_scale_m_s2
            ),
            ..Provenance::default()
        },
    })
}

// Transients as taps: the louder one is, the faster was the impact.

/// Rate of the traces, Hz.
const RATE_HZ: f64 = 5000.0;
/// Least frequency of a trace, Hz: two periods of it are its length.
const LEAST_HZ: f64 = 50.0;
/// Most traces, and the least part of the loudest that is one.
const TRACES: usize = 13;
const LEAST: f64 = 0.02;
/// Amplitudes nearer than this are one.
const APART: f64 = 0.02;

/// A trace for each loudness; the loudest has an impact speed of `speed_m_s`, and the others are
/// slower as they are quieter.
fn bank(transients: &[Transient], speed_m_s: f64, full_scale_m_s2: f64) -> TapBank {
    let mut all: Vec<Transient> = transients
        .iter()
        .map(|t| Transient {
            freq_hz: t.freq_hz.clamp(LEAST_HZ, 0.2 * RATE_HZ),
            ..*t
        })
        .collect();
    all.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let loudest = all.first().map_or(0.0, |t| t.amplitude);
    let mut chosen: Vec<Transient> = Vec::new();
    for transient in all {
        let next = chosen
            .last()
            .is_none_or(|last| last.amplitude - transient.amplitude > APART * loudest);
        if next && transient.amplitude > LEAST * loudest {
            chosen.push(transient);
        }
    }
    let spread = chosen.len().div_ceil(TRACES).max(1);
    let chosen: Vec<Transient> = chosen.into_iter().step_by(spread).collect();
    let longest = chosen.iter().map(|t| 2.0 / t.freq_hz).fold(0.0, f64::max);
    let samples = (longest * RATE_HZ).ceil() as usize + 1;
    TapBank {
        sample_rate_hz: RATE_HZ,
        traces: chosen
            .iter()
            .rev()
            .map(|transient| TapTrace {
                speed_m_s: speed_m_s * transient.amplitude / loudest,
                accel_m_s2: (0..samples)
                    .map(|n| full_scale_m_s2 * transient.value(n as f64 / RATE_HZ))
                    .collect(),
            })
            .collect(),
    }
}
