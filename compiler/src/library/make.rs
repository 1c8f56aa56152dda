//! Making one texture of a manifest.

use super::{
    error::{Cause, cause},
    facts::Facts,
    manifest::{Edit, Entry, Manifest, Options, Origin},
    opened::OpenLibraries,
    rename::renamed,
};
use crate::{
    driver,
    edit::{
        EditError, History, How, Latents, Made, Memory, Origin as Making, Part,
        Source as Ingredient, Step, Studio, Worded, encode, equal_loudness, remember, remembered,
    },
    emit::raise::{self, raise},
    model::{FrictionLaw, Provenance, TextureModel, attributes},
    pipeline::{Pipeline, Request, Ringing, Timings},
    sources::{Source, Tools, hatt::Hatt, model_file::ModelFile, prompt},
};
use asperity_formats::Asset;
use std::{
    collections::HashMap,
    path::Path,
    sync::{Mutex, PoisonError},
};

/// A texture that was made.
pub(super) struct Finished {
    pub(super) asset: Vec<u8>,
    pub(super) facts: Facts,
    pub(super) timings: Timings,
}

/// Makes textures of a manifest, on any number of threads.
pub(super) struct Maker<'a> {
    manifest: &'a Manifest,
    /// `None` where no texture needs the learned model.
    studio: Option<&'a Studio<'a>>,
    libraries: &'a OpenLibraries,
    /// What was found out of textures that others are made of.
    known: Mutex<HashMap<usize, Known>>,
}

/// Where a texture lies in the latent space, before and apart from how it is compiled.
#[derive(Clone)]
struct Known {
    latents: Latents,
    prompt: Option<String>,
    provenance: Option<Provenance>,
    warnings: Vec<String>,
    certainty: Option<f64>,
    /// How its friction depends on speed.
    law: Option<FrictionLaw>,
    /// How it was made, and its edits. The level of loudness is that of the entry.
    history: History,
}

impl Known {
    fn of(latents: Latents, history: History) -> Self {
        Self {
            latents,
            prompt: None,
            provenance: None,
            warnings: Vec::new(),
            certainty: None,
            law: None,
            history,
        }
    }
}

/// Whether a source needs the learned model.
pub(super) fn is_learned(origin: &Origin) -> bool {
    match origin {
        Origin::Prompt(_) | Origin::Of(_) | Origin::Blend { .. } | Origin::Compose { .. } => true,
        Origin::Import(_) | Origin::Asset { .. } => false,
    }
}

impl<'a> Maker<'a> {
    pub(super) fn new(
        manifest: &'a Manifest,
        studio: Option<&'a Studio<'a>>,
        libraries: &'a OpenLibraries,
    ) -> Self {
        Self {
            manifest,
            studio,
            libraries,
            known: Mutex::default(),
        }
    }

    /// Reads the prompts of some entries together, which changes nothing but time.
    pub(super) fn read_ahead(&self, indices: impl Iterator<Item = usize>) {
        let prompts: Vec<&str> = indices
            .filter_map(|index| match &self.manifest.entries[index].origin {
                Origin::Prompt(text) => Some(text.as_str()),
                _ => None,
            })
            .collect();
        if let Some(studio) = self.studio {
            studio.author().read_ahead(&prompts);
        }
    }

    /// Makes the texture at an index of the manifest.
    pub(super) fn make(&self, index: usize) -> Result<Finished, Cause> {
        let entry = &self.manifest.entries[index];
        let options = &entry.options;
        match &entry.origin {
            Origin::Prompt(text) if options.edit.is_still() && options.loudness_db.is_none() => {
                self.prompted(entry, text)
            }
            Origin::Import(file) => imported(entry, file),
            Origin::Asset { file, texture } => {
                taken(entry, &self.libraries.asset(file, texture.as_deref())?)
            }
            _ => self.mixed(index),
        }
    }

    fn studio(&self) -> Result<&'a Studio<'a>, Cause> {
        // The build opens one where any texture needs it.
        self.studio.ok_or_else(|| cause(prompt::PromptError::Empty))
    }

    /// A prompt as `asperity compile` makes it.
    fn prompted(&self, entry: &Entry, text: &str) -> Result<Finished, Cause> {
        let studio = self.studio()?;
        let authored = studio
            .author()
            .author(text, &prompt_options(&entry.options))
            .map_err(cause)?;
        let memory = Memory {
            model_crc32: studio.model_crc32(),
            latents: Latents::whole(authored.z).shifted(authored.shift),
            history: History::default(),
        };
        let haptic_bytes =
            authored.lowered.haptic_bytes + entry.name.len() - authored.texture.name.len();
        let asked_s2_m = authored.whole.gains.vib_s2_m;
        let mut facts = Facts::of(
            &authored.texture,
            &authored.attributes,
            haptic_bytes,
            asked_s2_m,
        );
        facts.certainty = Some(authored.certainty);
        facts.warnings = authored.warnings();
        let asset = renamed(&authored.lowered.bytes, &entry.name)
            .and_then(|bytes| remember(&bytes, &memory))
            .map_err(|error| cause(EditError::from(error)))?;
        Ok(Finished {
            asset,
            facts,
            timings: authored.timings,
        })
    }

    /// A texture that is decoded from latents: a blend, a composition, whatever is edited.
    fn mixed(&self, index: usize) -> Result<Finished, Cause> {
        let studio = self.studio()?;
        let entry = &self.manifest.entries[index];
        let options = &entry.options;
        let known = self.latents(index)?;
        let history = History {
            loudness_db: options.loudness_db,
            ..known.history
        };
        let provenance = known
            .provenance
            .unwrap_or_else(|| studio.provenance("build"));
        let how = how(options, known.law);
        let Made {
            bytes,
            texture,
            haptic_bytes,
            asked_s2_m,
            attributes,
            timings,
            ..
        } = studio
            .compile(&known.latents, &entry.name, provenance, history, &how)
            .map_err(cause)?;
        let mut facts = Facts::of(&texture, &attributes, haptic_bytes, asked_s2_m);
        facts.certainty = known.certainty;
        facts.warnings = known.warnings;
        Ok(Finished {
            asset: bytes,
            facts,
            timings,
        })
    }

    /// Where a texture lies, edit included. What it is made of is found out first, without
    /// recursion: a chain may be as long as the manifest.
    fn latents(&self, index: usize) -> Result<Known, Cause> {
        let mut stack = vec![index];
        while let Some(&top) = stack.last() {
            if self.find(top).is_some() {
                stack.pop();
                continue;
            }
            let parts = self.manifest.entries[top].origin.parts().into_iter();
            let open: Vec<usize> = parts.filter(|&part| self.find(part).is_none()).collect();
            if open.is_empty() {
                let found = self.found_out(top)?;
                let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
                known.insert(top, found);
                drop(known);
                stack.pop();
            } else {
                stack.extend(open);
            }
        }
        self.find(index).ok_or_else(|| {
            cause(EditError::NoLatent(
                self.manifest.entries[index].name.clone(),
            ))
        })
    }

    fn find(&self, index: usize) -> Option<Known> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(&index).cloned()
    }

    fn found_out(&self, index: usize) -> Result<Known, Cause> {
        let mut known = self.unedited(index)?;
        let options = &self.manifest.entries[index].options;
        if options.edit.is_still() {
            return Ok(known);
        }
        let (studio, how, before) = (
            self.studio()?,
            how(options, known.law.clone()),
            known.latents,
        );
        let step = match &options.edit {
            Edit::Steps(sliders) => {
                known.latents = studio.edited(&before, sliders, &how).map_err(cause)?;
                Step::new(*sliders, &before)
            }
            Edit::Words(words) => {
                let Worded {
                    latents,
                    sliders,
                    unread,
                    ..
                } = studio.worded(&before, words, &how).map_err(cause)?;
                known.latents = latents;
                if !unread.is_empty() {
                    let unread = unread.join(", ");
                    known.warnings.push(format!("not understood: {unread}"));
                }
                Step::new(sliders, &before).worded(words)
            }
        };
        known.history.steps.push(step);
        Ok(known)
    }

    /// Where a texture lies before its edit; what it is made of is known.
    fn unedited(&self, index: usize) -> Result<Known, Cause> {
        let studio = self.studio()?;
        let entry = &self.manifest.entries[index];
        let ingredient = |index: usize| -> Result<(Known, Ingredient), Cause> {
            let known = self.latents(index)?;
            let name = &self.manifest.entries[index].name;
            let ingredient = Ingredient::new(name, known.prompt.as_deref(), &known.latents);
            Ok((known, ingredient))
        };
        let encoded = |texture: &TextureModel, name: &str| -> Result<Known, Cause> {
            let part = Part::recorded(texture);
            let latents = encode(studio, texture, part).map_err(cause)?.latents;
            let made = Making::Encode {
                name: name.to_owned(),
                part: part.name().to_owned(),
            };
            Ok(Known {
                law: texture.friction.law.clone(),
                ..Known::of(latents, History::of(made))
            })
        };
        Ok(match &entry.origin {
            Origin::Prompt(text) => {
                let options = prompt::Options {
                    seed: entry.options.seed,
                    request: Request {
                        rate_hz: entry.options.request.rate_hz,
                        ..Request::default()
                    },
                };
                let authored = studio.author().author(text, &options).map_err(cause)?;
                Known {
                    latents: Latents::whole(authored.z).shifted(authored.shift),
                    prompt: Some(text.clone()),
                    warnings: authored.warnings(),
                    certainty: Some(authored.certainty),
                    law: None,
                    provenance: Some(authored.texture.provenance),
                    history: History::default(),
                }
            }
            Origin::Import(file) => encoded(&whole(file)?, &entry.name)?,
            Origin::Asset { file, texture } => {
                let bytes = self.libraries.asset(file, texture.as_deref())?;
                let asset = Asset::parse(&bytes).map_err(|e| cause(EditError::from(e)))?;
                match remembered(&asset).map_err(cause)? {
                    Some(memory) if memory.model_crc32 == studio.model_crc32() => Known {
                        prompt: asset.provenance().and_then(|p| p.prompt).map(str::to_owned),
                        provenance: Some(raise(&asset).provenance),
                        law: raise::law(&asset),
                        ..Known::of(memory.latents, memory.history)
                    },
                    _ => encoded(&raise(&asset), asset.name())?,
                }
            }
            Origin::Of(other) => self.latents(*other)?,
            Origin::Blend { a, b, t } => {
                let ((at_a, a), (at_b, b)) = (ingredient(*a)?, ingredient(*b)?);
                let latents = Latents::between(&at_a.latents, &at_b.latents, *t);
                Known {
                    law: FrictionLaw::between(at_a.law.as_ref(), at_b.law.as_ref(), *t),
                    ..Known::of(latents, History::of(Making::Blend { a, b, t: *t }))
                }
            }
            Origin::Compose {
                tap,
                slide,
                friction,
            } => {
                let (at_tap, tap) = ingredient(*tap)?;
                let (at_slide, slide) = ingredient(*slide)?;
                let (at_friction, friction) = ingredient(*friction)?;
                let made = Making::Compose {
                    tap,
                    slide,
                    friction,
                };
                let latents =
                    Latents::composed(&at_tap.latents, &at_slide.latents, &at_friction.latents);
                Known {
                    law: at_friction.law,
                    ..Known::of(latents, History::of(made))
                }
            }
        })
    }
}

fn how(options: &Options, law: Option<FrictionLaw>) -> How {
    How {
        request: options.request.clone(),
        law,
    }
}

fn prompt_options(options: &Options) -> prompt::Options {
    prompt::Options {
        seed: options.seed,
        request: options.request.clone(),
    }
}

/// The whole texture of an import, before it is reduced.
fn whole(file: &Path) -> Result<TextureModel, Cause> {
    let is_model = file
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("json"));
    let source: &dyn Source = if is_model {
        &ModelFile { file: file.into() }
    } else {
        &Hatt::new(file)
    };
    Ok(driver::compile(source, &Request::default(), &Tools::default())?.whole)
}

fn imported(entry: &Entry, file: &Path) -> Result<Finished, Cause> {
    let options = &entry.options;
    let mut texture = whole(file)?;
    texture.name.clone_from(&entry.name);
    if let Some(level_db) = options.loudness_db {
        equal_loudness(&mut texture, level_db);
    }
    let mut pipeline = Pipeline::default();
    let compiled = pipeline
        .compile(texture, &options.request, Ringing::Refused)
        .map_err(cause)?;
    let asked_s2_m = compiled.whole.gains.vib_s2_m;
    let haptic_bytes = compiled.lowered.haptic_bytes;
    Ok(Finished {
        facts: Facts::of(
            &compiled.texture,
            &attributes::of(&compiled.texture),
            haptic_bytes,
            asked_s2_m,
        ),
        asset: compiled.lowered.bytes,
        timings: pipeline.timings().clone(),
    })
}

fn taken(entry: &Entry, asset: &[u8]) -> Result<Finished, Cause> {
    let bytes = renamed(asset, &entry.name).map_err(|error| cause(EditError::from(error)))?;
    let asset = Asset::parse(&bytes).map_err(|error| cause(EditError::from(error)))?;
    let model = raise(&asset);
    let facts = Facts::of(
        &model,
        &attributes::of(&model),
        asset.haptic_len(),
        model.gains.vib_s2_m,
    );
    Ok(Finished {
        facts,
        asset: bytes,
        timings: Timings::default(),
    })
}
