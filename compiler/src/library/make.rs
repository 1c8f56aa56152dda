//! Making one texture of a manifest: by its source, or by latents of others.

use super::manifest::{Entry, Manifest, Origin};
use crate::{
    driver::{self, Compiled, Failure},
    edit_memory::remembered,
    pipeline::{Clock, Pipeline, Request},
    sources::{
        Source, Tools,
        asset::parsed,
        latents::{FromLatents, LatentEditor, Part, encode, no_latent},
        libraries::OpenLibraries,
        prompt::PromptError,
    },
};
use std::{
    collections::HashMap,
    sync::{Mutex, PoisonError, atomic::AtomicBool},
};

/// Compiles the textures of a manifest, on any number of threads.
pub(super) struct Maker<'a> {
    manifest: &'a Manifest,
    /// `None` where no texture needs the learned model.
    editor: Option<&'a LatentEditor<'a>>,
    libraries: &'a OpenLibraries,
    clock: Clock,
    stop: Option<&'a AtomicBool>,
    /// Textures that others are made of, edits included. The level of loudness is that of the entry.
    known: Mutex<HashMap<usize, FromLatents>>,
}

impl<'a> Maker<'a> {
    pub(super) fn new(
        manifest: &'a Manifest,
        editor: Option<&'a LatentEditor<'a>>,
        libraries: &'a OpenLibraries,
        clock: Clock,
        stop: Option<&'a AtomicBool>,
    ) -> Self {
        Self {
            manifest,
            editor,
            libraries,
            clock,
            stop,
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
        if let (Some(editor), Ok(())) = (self.editor, self.tools().go_on()) {
            editor.prompt_compiler().read_ahead(&prompts);
        }
    }

    /// Compiles the texture at an index of the manifest.
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
        let prompt_compiler = self.editor.map(LatentEditor::prompt_compiler);
        Tools {
            libraries: Some(self.libraries),
            clock: self.clock,
            stop: self.stop,
            ..prompt_compiler.map_or_else(Tools::default, Tools::of)
        }
    }

    fn editor(&self) -> Result<&'a LatentEditor<'a>, Failure> {
        // The build opens one where any texture needs it.
        Ok(self.editor.ok_or(PromptError::Empty)?)
    }

    /// A texture that is decoded from latents: a blend, a composition, whatever is edited. What it
    /// is made of is found out first, without recursion: a chain may be as long as the manifest.
    fn mixed(&self, index: usize) -> Result<FromLatents, Failure> {
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
        let name = &self.manifest.entries[index].name;
        Ok(self.find(index).ok_or_else(|| no_latent(name))?)
    }

    fn find(&self, index: usize) -> Option<FromLatents> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(&index).cloned()
    }

    /// Resolves the latents of an entry whose parts are resolved.
    fn found_out(&self, index: usize) -> Result<FromLatents, Failure> {
        let entry = &self.manifest.entries[index];
        let editor = self.editor()?;
        let built = || editor.prompt_compiler().model().provenance("build");
        let mut mixed = match &entry.origin {
            Origin::Of(other) => self.mixed(*other)?,
            Origin::Blend { a, b, t } => {
                FromLatents::between(&self.mixed(*a)?, &self.mixed(*b)?, *t, built())
            }
            Origin::Compose {
                tap,
                slide,
                friction,
            } => {
                let (tap, slide) = (self.mixed(*tap)?, self.mixed(*slide)?);
                FromLatents::composed(&tap, &slide, &self.mixed(*friction)?, built())
            }
            Origin::Source { source, .. } => self.placed(entry, &**source, editor)?,
        };
        mixed.name.clone_from(&entry.name);
        if !entry.options.edit.is_still() {
            mixed.edit(editor, &entry.options.edit, &entry.options.request)?;
        }
        Ok(mixed)
    }

    /// Where the texture of a source lies: as it remembers, or as the model encodes it.
    fn placed(
        &self,
        entry: &Entry,
        source: &dyn Source,
        editor: &LatentEditor<'_>,
    ) -> Result<FromLatents, Failure> {
        let request = &entry.options.request;
        let sourced = source.model(request, &self.tools(), &mut Pipeline::default())?;
        let mut texture = sourced.texture;
        let memory = match &sourced.asset {
            Some(bytes) => remembered(&parsed(bytes)?)?,
            None => sourced.memory,
        };
        let model = editor.prompt_compiler().model();
        if let Some(memory) = memory.filter(|memory| model.has_latent_of(memory.model_crc32)) {
            return Ok(FromLatents {
                warnings: sourced.warnings,
                ..FromLatents::remembered(texture, memory)
            });
        }
        let part = Part::recorded(&texture);
        let latents = encode(editor, &texture, part)?.latents;
        if sourced.asset.is_none() {
            texture.name.clone_from(&entry.name);
        }
        let provenance = editor.prompt_compiler().model().provenance("build");
        Ok(FromLatents {
            warnings: sourced.warnings,
            ..FromLatents::encoded(texture, latents, part, provenance)
        })
    }
}
