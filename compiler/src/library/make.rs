//! Making one texture of a manifest: by its source, or by latents of others.

use super::manifest::{Edit, Entry, Manifest, Options, Origin};
use crate::{
    driver::{self, Compiled, Failure},
    edit::{
        EditError, History, How, Latents, Origin as Making, Part, Source as Ingredient, Step,
        Studio, Worded, encode, remembered,
    },
    model::{FrictionLaw, Provenance},
    pipeline::{Pipeline, Request},
    prompt::PromptError,
    sources::{Source, Tools, asset::OpenLibraries, latents::FromLatents},
};
use asperity_formats::Asset;
use std::{
    collections::HashMap,
    sync::{Mutex, PoisonError},
};

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
                Origin::Source { source, .. } => source.prompt(),
                _ => None,
            })
            .collect();
        if let Some(studio) = self.studio {
            studio.author().read_ahead(&prompts);
        }
    }

    /// Makes the texture at an index of the manifest.
    pub(super) fn make(&self, index: usize) -> Result<Compiled, Failure> {
        let entry = &self.manifest.entries[index];
        let options = &entry.options;
        let request = Request {
            name: Some(entry.name.clone()),
            ..options.request.clone()
        };
        match &entry.origin {
            Origin::Source { source, .. } if options.edit.is_still() => {
                driver::compile(&**source, &request, &self.tools())
            }
            _ => driver::compile(&self.mixed(index)?, &request, &self.tools()),
        }
    }

    fn tools(&self) -> Tools<'_> {
        let author = self.studio.map(Studio::author);
        Tools {
            libraries: Some(self.libraries),
            ..author.map_or_else(Tools::default, Tools::of)
        }
    }

    fn studio(&self) -> Result<&'a Studio<'a>, Failure> {
        // The build opens one where any texture needs it.
        Ok(self.studio.ok_or(PromptError::Empty)?)
    }

    /// A texture that is decoded from latents: a blend, a composition, whatever is edited.
    fn mixed(&self, index: usize) -> Result<FromLatents, Failure> {
        let known = self.latents(index)?;
        let model = self.studio()?.author().model();
        let provenance = known
            .provenance
            .unwrap_or_else(|| model.provenance("build"));
        Ok(FromLatents {
            latents: known.latents,
            name: self.manifest.entries[index].name.clone(),
            provenance,
            history: known.history,
            law: known.law,
            certainty: known.certainty,
            warnings: known.warnings,
        })
    }

    /// Where a texture lies, edit included. What it is made of is found out first, without
    /// recursion: a chain may be as long as the manifest.
    fn latents(&self, index: usize) -> Result<Known, Failure> {
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
        let name = || self.manifest.entries[index].name.clone();
        Ok(self
            .find(index)
            .ok_or_else(|| EditError::NoLatent(name()))?)
    }

    fn find(&self, index: usize) -> Option<Known> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(&index).cloned()
    }

    fn found_out(&self, index: usize) -> Result<Known, Failure> {
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
                known.latents = studio.edited(&before, sliders, &how)?;
                Step::new(*sliders, &before)
            }
            Edit::Words(words) => {
                let Worded {
                    latents,
                    sliders,
                    unread,
                    ..
                } = studio.worded(&before, words, &how)?;
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
    fn unedited(&self, index: usize) -> Result<Known, Failure> {
        let studio = self.studio()?;
        let entry = &self.manifest.entries[index];
        let ingredient = |index: usize| -> Result<(Known, Ingredient), Failure> {
            let known = self.latents(index)?;
            let name = &self.manifest.entries[index].name;
            let ingredient = Ingredient::new(name, known.prompt.as_deref(), &known.latents);
            Ok((known, ingredient))
        };
        Ok(match &entry.origin {
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
            Origin::Source { source, .. } => self.placed(entry, &**source, studio)?,
        })
    }

    /// Where the texture of a source lies: as it remembers, or as the model encodes it.
    fn placed(
        &self,
        entry: &Entry,
        source: &dyn Source,
        studio: &Studio<'_>,
    ) -> Result<Known, Failure> {
        let request = &entry.options.request;
        let sourced = source.read(request, &self.tools(), &mut Pipeline::default())?;
        let texture = sourced.texture;
        let memory = match &sourced.asset {
            Some(bytes) => remembered(&Asset::parse(bytes).map_err(EditError::from)?)?,
            None => sourced.memory,
        };
        if let Some(memory) = memory.filter(|memory| memory.model_crc32 == studio.model_crc32()) {
            return Ok(Known {
                prompt: texture.provenance.prompt.clone(),
                provenance: Some(texture.provenance),
                law: texture.friction.law,
                warnings: sourced.warnings,
                certainty: sourced.certainty,
                ..Known::of(memory.latents, memory.history)
            });
        }
        let part = Part::recorded(&texture);
        let latents = encode(studio, &texture, part)?.latents;
        let name = match sourced.asset {
            Some(_) => texture.name,
            None => entry.name.clone(),
        };
        let made = Making::Encode {
            name,
            part: part.name().to_owned(),
        };
        Ok(Known {
            law: texture.friction.law,
            warnings: sourced.warnings,
            ..Known::of(latents, History::of(made))
        })
    }
}

fn how(options: &Options, law: Option<FrictionLaw>) -> How {
    How {
        request: options.request.clone(),
        law,
    }
}
