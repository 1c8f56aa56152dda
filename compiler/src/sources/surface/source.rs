//! A map of heights as a source.

use super::{
    Options,
    grid::{Stroked, Survey},
    options, picture, report,
    sheet::sheet,
};
use crate::{
    compiled::{Compiled, ErrorReference},
    learned::{contact, modulus},
    name,
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, Request, Ringing},
    sources::{
        Findings, ManifestSource, Operand, Source, SourceKind, SourceOutput, Tools,
        key::Parts,
        prompt::Prompt,
        recording::{Nearest, complete},
    },
};
use asperity_io::{
    diagnostic::{Failure, Fault},
    input::{InputError, InputKind},
};
use asperity_plot::PlotError;
use asperity_surface::{
    contact::{Contact, Tip},
    heights::HeightField,
    map::{Convention, HeightMap, Material, Pictures, Raster, profile},
};
use asperity_texture::model::{
    Friction, FrictionAnchor, Provenance, TextureModel, Wall, attributes, defaults,
};
use serde_json::Value;
use std::{
    borrow::Cow,
    ffi::OsStr,
    path::{Path, PathBuf},
    sync::Arc,
};

/// Modulus of something hard, MPa, where no words say another.
const HARD_MPA: f64 = 1000.0;
/// Level that heights of no stated depth are scaled to where no words say another, dB re 1 m/s².
const USUAL_DB: f64 = 0.0;
/// Steps towards that level.
const STEPS: usize = 3;
/// Ranges of heights that may be guessed, mm.
pub(super) const RANGES_MM: (f64, f64) = (1e-6, 10.0);
/// Most points along a side of the heights that are kept for the sheet.
const THUMBNAIL: usize = 256;

/// Maps of a surface.
#[derive(Debug, Clone)]
pub struct Surface {
    /// A height map, a normal map, a profile, or a folder with the pictures of a material.
    pub path: PathBuf,
    /// The rest.
    pub options: Options,
}

/// Findings of a surface.
#[derive(Debug)]
pub struct Surveyed {
    /// The files that were read.
    pub files: Vec<PathBuf>,
    /// Pixels of the pictures.
    pub pixels: [usize; 2],
    /// Points of the field that was stroked.
    pub points: [usize; 2],
    /// Their distance, mm.
    pub pitch_mm: [f64; 2],
    /// Root mean square of the heights, µm.
    pub rms_um: f64,
    /// Findings in the pictures.
    pub notes: Vec<String>,
    /// What strokes over it meet.
    pub survey: Survey,
    /// Height of white above black, mm, that was taken where none was stated.
    pub guessed_mm: Option<f64>,
    /// The heights, at most 256 × 256 points.
    pub thumbnail: HeightField,
    /// Words for the material.
    pub like: Option<String>,
    /// The materials that complete it where no words do, the nearest first.
    pub nearest: Vec<Nearest>,
}

/// `surface` of a manifest.
pub const KIND: SourceKind = SourceKind {
    key: "surface",
    operand: Operand::Path,
    open: |stated| {
        Ok(Arc::new(Surface {
            path: stated.path.to_owned(),
            options: Options::stated(stated.options)?,
        }))
    },
    options: &options::KEYS,
    refuses: &["texture", "seed", "edit"],
    fidelity: Fidelity::Auto,
    preview: true,
};

impl Surface {
    /// The files of the path; one that is no folder stands for the heights. Bytes that are given are those of one file.
    fn material(&self, tools: &Tools<'_>) -> Result<Material, Fault> {
        if tools.given.is_none() && self.path.is_dir() {
            return Material::of(&self.path);
        }
        Ok(Material {
            height: Some(self.path.clone()),
            ..Material::default()
        })
    }

    fn bytes<'a>(&self, file: &Path, tools: &Tools<'a>) -> Result<Cow<'a, [u8]>, Failure> {
        let bytes = tools.file(file, InputKind::HeightMap);
        Ok(bytes.map_err(|problem| InputError {
            file: file.to_owned(),
            problem,
        })?)
    }

    /// The heights, what the surface looks like, and the CRC-32 of all pictures.
    fn read(&self, tools: &Tools<'_>) -> Result<(HeightMap, Option<Raster>, u32), Failure> {
        self.options.size.check()?;
        if self.path.extension().is_some_and(is_table) {
            let bytes = self.bytes(&self.path, tools)?;
            let map = profile(&bytes, &self.options.size);
            let map = map.map_err(|fault| fault.at(&self.path))?;
            return Ok((map, None, crc32fast::hash(&bytes)));
        }
        let material = self.material(tools)?;
        let mut hasher = crc32fast::Hasher::new();
        let mut raster = |file: &Option<PathBuf>| -> Result<Option<Raster>, Failure> {
            let Some(file) = file else {
                return Ok(None);
            };
            let bytes = self.bytes(file, tools)?;
            hasher.update(&bytes);
            Ok(Some(Raster::read(file, &bytes)?))
        };
        let color = raster(&material.color)?;
        let (height, normal) = (raster(&material.height)?, raster(&material.normal)?);
        let convention = self.options.convention.or(material.convention);
        let pictures = match (height, normal) {
            (Some(only), None) => Pictures::of(only, convention),
            (height, normal) => Pictures {
                height,
                normal,
                convention,
            },
        };
        let heights = pictures.heights(&self.options.size)?;
        Ok((heights, color, hasher.finalize()))
    }
}

/// Returns true for the ending of a profile's file.
fn is_table(ending: &OsStr) -> bool {
    ["csv", "tsv", "txt"]
        .iter()
        .any(|table| ending.eq_ignore_ascii_case(table))
}

impl Source for Surface {
    fn needs_model(&self) -> bool {
        true
    }

    fn origin(&self) -> String {
        self.path.display().to_string()
    }

    fn inputs(&self) -> Vec<PathBuf> {
        match self.material(&Tools::default()) {
            Ok(material) => material.files().cloned().collect(),
            // Reading it says why.
            Err(_) => vec![self.path.clone()],
        }
    }

    fn model(
        &self,
        request: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let Options { like, tip, .. } = &self.options;
        let files = match tools.given {
            Some(_) => vec![self.path.clone()],
            None => self.inputs(),
        };
        let (mut map, color, crc32) = pipeline.run(Pass::Read, || self.read(tools))?;
        let words = match like {
            Some(text) => {
                let prompt = Prompt {
                    text: text.clone(),
                    seed: 0,
                    picture: None,
                };
                Some(prompt.model(&Request::default(), tools, pipeline)?)
            }
            None => None,
        };
        let like_texture = words.as_ref().map(|words| &words.texture);
        let modulus_mpa = like_texture
            .and_then(|texture| modulus::of(&texture.friction.anchors))
            .unwrap_or(HARD_MPA);
        let (survey, guessed_mm) = pipeline.run(Pass::Grid, || {
            let wanted_db = like_texture.map(|texture| attributes::of(texture).rough_db);
            let wanted_db = wanted_db.flatten().unwrap_or(USUAL_DB);
            let guessed_mm = match map.has_depth {
                true => None,
                false => Some(scale(&mut map.field, *tip, modulus_mpa, wanted_db)),
            };
            let contact = Contact::with(&map.field);
            (
                Stroked::new(&contact, *tip, modulus_mpa).survey(map.is_profile),
                guessed_mm,
            )
        });
        let mut texture = TextureModel {
            name: name::of_file(&self.path),
            grid: survey.grid.clone(),
            taps: Default::default(),
            friction: Friction {
                mu: 0.0,
                anchors: Vec::new(),
                law: None,
            },
            wall: Wall {
                stiffness_n_m: defaults::STIFFNESS_N_M,
                damping_n_s_m: defaults::DAMPING_N_S_M,
            },
            contact: None,
            direction: survey.direction,
            gains: defaults::gains(),
            provenance: Provenance {
                generator: format!("asperity {} import surface", env!("CARGO_PKG_VERSION")),
                source: self
                    .path
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned(),
                source_crc32: crc32,
                prompt: None,
                seed: 0,
                fidelity: "full".into(),
                taps_synthetic: true,
                lsf_error_db: 0.0,
                notes: String::new(),
            },
        };
        let mut nearest = Vec::new();
        if let Some(words) = &words {
            let like = words.texture.clone();
            texture.taps = like.taps;
            texture.friction = like.friction;
            texture.wall = like.wall;
            texture.contact = like.contact;
        } else {
            let model = tools.model()?;
            let completed = pipeline.run(Pass::Complete, || {
                complete(model, &texture.grid, &texture.gains)
            })?;
            texture.taps = completed.taps;
            texture.friction.mu = completed.mu;
            texture.friction.anchors = vec![FrictionAnchor {
                name: texture.name.clone(),
                mu: completed.mu,
                weight: 1.0,
            }];
            texture.wall.stiffness_n_m = completed.stiffness_n_m;
            contact::set(&mut texture, completed.contact);
            nearest = completed.nearest;
        }
        let field = &map.field;
        let picture = request.preview_px.map(|size_px| match &color {
            Some(color) => picture::of_color(color, size_px),
            None => picture::of_heights(field, size_px),
        });
        let surveyed = Surveyed {
            files,
            pixels: map.pixels,
            points: [field.width(), field.height()],
            pitch_mm: field.pitch_mm(),
            rms_um: field.rms_um(),
            notes: map.notes,
            survey,
            guessed_mm,
            thumbnail: field.thinned(THUMBNAIL),
            like: like.clone(),
            nearest,
        };
        texture.provenance.notes = report::notes(&surveyed);
        let mut warnings = report::warnings(&surveyed);
        warnings.extend(words.iter().flat_map(|words| words.warnings.clone()));
        Ok(SourceOutput {
            truth: Some(ErrorReference::Texture),
            ringing: Ringing::Stabilised,
            picture: picture.transpose()?,
            certainty: words.and_then(|words| words.certainty),
            warnings,
            findings: Some(Arc::new(surveyed)),
            ..SourceOutput::new(texture)
        })
    }
}

/// Scales heights of a range of 1 mm until strokes over them have a level: the range, mm.
fn scale(field: &mut HeightField, tip: Tip, modulus_mpa: f64, wanted_db: f64) -> f64 {
    let whole = field.clone();
    let mut range_mm = 0.1;
    for _ in 0..STEPS {
        let contact = Contact::with(&whole.scaled(range_mm));
        let found_db = Stroked::new(&contact, tip, modulus_mpa).level_db();
        let factor = libm::exp10((wanted_db - found_db) / 20.0);
        range_mm = (range_mm * factor).clamp(RANGES_MM.0, RANGES_MM.1);
    }
    *field = whole.scaled(range_mm);
    range_mm
}

impl ManifestSource for Surface {
    fn key(&self, parts: Parts, tools: &Tools<'_>) -> Result<Parts, Failure> {
        let Options {
            size,
            like,
            tip,
            convention,
        } = &self.options;
        let parts = parts
            .number(size.width_mm.unwrap_or(f64::NAN))
            .number(size.depth_mm.unwrap_or(f64::NAN))
            .number(tip.radius_mm)
            .number(tip.modulus_mpa)
            .text(convention.map_or("", Convention::name))
            .text(like.as_deref().unwrap_or_default());
        let material = self.material(tools)?;
        let mut files = material.files();
        Ok(files.try_fold(parts, |parts, file| parts.file(file, InputKind::HeightMap))?)
    }
}

impl Findings for Surveyed {
    fn text(&self, compiled: &Compiled) -> String {
        report::text(self, compiled)
    }

    fn json(&self, compiled: &Compiled) -> Value {
        report::json(self, compiled)
    }

    fn sheet(&self, compiled: &Compiled) -> Result<Option<Vec<u8>>, PlotError> {
        sheet(self, &compiled.whole).map(Some)
    }
}
