//! From a manifest to a library: keys, cache, what is missing in parallel, pack.

use super::{
    cache::Cache,
    facts::Facts,
    lock::Pinned,
    make::Maker,
    manifest::{Manifest, Options, Origin, order},
    report::{Report, TextureReport},
    shard::Shard,
    spill::{Packed, Slot, Spill, no_room},
};
use crate::{
    edit_memory::AXES,
    learned::{Certainty, contact, direction, modulus},
    pipeline::{Clock, Pass, Pipeline, Timings},
    sources::{
        Tools,
        key::{Key, Parts},
        latents::{Edit, LatentEditor},
        libraries::OpenLibraries,
        prompt::PromptCompiler,
    },
};
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failure, Failures, Fault, all, one};
use rayon::prelude::*;
use std::{
    path::Path,
    sync::{Mutex, PoisonError, atomic::AtomicBool},
};

/// Prompts that are read together before the first of them is made.
const TOGETHER: usize = 64;

/// Build options besides the manifest. By default there is no cache.
#[derive(Debug, Default)]
pub struct Request<'a> {
    /// Where textures are kept between builds.
    pub cache: Option<&'a Cache>,
    /// Which part is built; all of it if `None`.
    pub shard: Option<Shard>,
    /// Program identifier besides its version: programs that may give different bytes differ in it.
    pub program: String,
    /// Versions and model, which the cache and the lock file tell builds apart by.
    pub pinned: Pinned,
    /// Clock that times the passes.
    pub clock: Clock,
    /// The least certainty of a prompt; any if `None`.
    pub min_certainty: Option<Certainty>,
    /// The folder where a temporary file keeps textures until the library is written; that of the
    /// system if `None`.
    pub scratch: Option<&'a Path>,
    /// Set, by another thread, once no more is wanted: textures that were not begun are then refused.
    pub stop: Option<&'a AtomicBool>,
}

/// A library that was built.
#[derive(Debug)]
pub struct Built {
    /// The library, ready to be written.
    pub library: Packed,
    /// Textures that were built, and textures taken from the cache.
    pub report: Report,
    /// The time of every pass, on all threads together.
    pub timings: Timings,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// A build whose keys are known.
pub struct Build<'a> {
    manifest: &'a Manifest,
    request: &'a Request<'a>,
    libraries: OpenLibraries,
    /// Indices in the manifest with their keys, in order of name.
    chosen: Vec<(usize, Key)>,
}

/// A texture that waits for the others.
struct Texture {
    slot: Slot,
    facts: Facts,
    cached: bool,
}

impl<'a> Build<'a> {
    /// Reads what decides the bytes of every texture.
    ///
    /// # Errors
    /// A [`Fault`] for every file that cannot be read.
    pub fn new(manifest: &'a Manifest, request: &'a Request<'a>) -> Result<Self, Failures> {
        let libraries = OpenLibraries::default();
        let keys = keys(manifest, request, &libraries)?;
        let chosen = keys.into_iter().enumerate();
        let chosen = chosen.filter(|(place, _)| request.shard.is_none_or(|s| s.holds(*place)));
        Ok(Self {
            manifest,
            request,
            libraries,
            chosen: chosen.collect(),
        })
    }

    /// Restricts the build to these indices of the manifest.
    #[must_use]
    pub fn only(mut self, indices: &[usize]) -> Self {
        self.chosen.retain(|(index, _)| indices.contains(index));
        self
    }

    /// Number of textures.
    #[must_use]
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    /// Returns true if the part has no texture.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.chosen.is_empty()
    }

    /// Makes what the cache does not hold, and packs all. The bytes do not depend on the cache, the
    /// order or the number of threads. `open` gives a prompt compiler; `done` is called once a texture, from
    /// any thread.
    ///
    /// # Errors
    /// A [`Fault`] for every texture that could not be made. The others are in the cache then.
    pub fn run(
        &self,
        open: &dyn Fn() -> Result<PromptCompiler, Failures>,
        done: &(dyn Fn() + Sync),
    ) -> Result<Built, Failures> {
        let mut pipeline = Pipeline::timed(self.request.clock);
        let spill = Spill::new(self.request.scratch);
        let cached = pipeline.run(Pass::Read, || self.cached(&spill, done));
        let entries = &self.manifest.entries;
        let missing: Vec<usize> = (0..cached.len()).filter(|&n| cached[n].is_none()).collect();
        let learned = |n: &usize| entries[self.chosen[*n].0].origin.is_learned();
        let opened = missing.iter().any(learned).then(open).transpose()?;
        let editor = opened.as_ref().map(LatentEditor::new);
        let (clock, stop) = (self.request.clock, self.request.stop);
        let maker = Maker::new(self.manifest, editor.as_ref(), &self.libraries, clock, stop);
        let shared = Mutex::new((Timings::default(), None));
        let together = TOGETHER.min(missing.len().div_ceil(rayon::current_num_threads()));
        let made: Vec<Result<Texture, Fault>> = missing
            .par_chunks(together.max(1))
            .flat_map(|some| {
                let mut reading = Pipeline::timed(self.request.clock);
                reading.run(Pass::Text, || {
                    maker.read_ahead(some.iter().map(|&n| self.chosen[n].0));
                });
                let mut all = shared.lock().unwrap_or_else(PoisonError::into_inner);
                all.0.merge(reading.timings());
                drop(all);
                some.par_iter().map(|&n| {
                    let made = self.made(n, &maker, &spill, &shared);
                    done();
                    made
                })
            })
            .collect();
        let (timings, unwritable) = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
        pipeline.merge(&timings);
        let mut textures = cached;
        let mut failures: Failures = Vec::new();
        for (n, made) in missing.iter().zip(made) {
            match made {
                Ok(texture) => textures[*n] = Some(texture),
                Err(error) => failures.push(Box::new(error)),
            }
        }
        if !failures.is_empty() {
            let is_kept = self.request.cache.is_some() && unwritable.is_none();
            let kept = if is_kept {
                "in the cache"
            } else {
                "lost, because there is no cache"
            };
            let what = format!(
                "no library was written: {} of {} textures failed, the others are {kept}",
                failures.len(),
                self.len()
            );
            let remedy =
                "correct the textures that failed and build again: only they are compiled then";
            failures.push(Box::new(Fault::new(what, remedy)));
            return Err(failures);
        }
        let textures: Vec<Texture> = textures.into_iter().flatten().collect();
        self.sure(&textures)?;
        let named = self
            .chosen
            .iter()
            .zip(&textures)
            .map(|((index, _), texture)| {
                (self.manifest.entries[*index].name.as_str(), texture.slot)
            });
        let library = pipeline
            .run(Pass::Pack, || Packed::new(named, spill))
            .map_err(one)?;
        let rows = self.rows(&textures);
        let mut warnings: Vec<String> = unwritable.into_iter().collect();
        for row in &rows {
            let own = row.facts.warnings.iter();
            warnings.extend(own.map(|warning| format!("{:?}: {warning}", row.name)));
        }
        Ok(Built {
            report: Report::new(rows, library.len(), self.request.shard),
            library,
            timings: pipeline.timings().clone(),
            warnings,
        })
    }

    fn cached(&self, spill: &Spill, done: &(dyn Fn() + Sync)) -> Vec<Option<Texture>> {
        let get = |(_, key): &(usize, Key)| {
            let (asset, facts) = self.request.cache?.get(key)?;
            // Where it cannot wait, it is made again, which says why.
            let slot = take(spill, &asset).ok()?;
            done();
            Some(Texture {
                slot,
                facts,
                cached: true,
            })
        };
        self.chosen.par_iter().map(get).collect()
    }

    fn made(
        &self,
        n: usize,
        maker: &Maker<'_>,
        spill: &Spill,
        shared: &Mutex<(Timings, Option<String>)>,
    ) -> Result<Texture, Fault> {
        let (index, key) = &self.chosen[n];
        let entry = &self.manifest.entries[*index];
        let made = maker.make(*index).map_err(|cause| entry.fault(&*cause))?;
        let (bytes, facts) = (&made.lowered.bytes, Facts::of(&made));
        let kept = match self.request.cache {
            Some(cache) => cache.put(key, bytes, &facts).map_err(|error| {
                let folder = cache.folder().display();
                format!("{folder}: nothing more is cached: {error}")
            }),
            None => Ok(()),
        };
        let slot = take(spill, bytes).map_err(|error| entry.fault(&no_room(error)))?;
        let mut shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
        shared.0.merge(&made.timings);
        if let Err(why) = kept {
            shared.1.get_or_insert(why);
        }
        Ok(Texture {
            slot,
            facts,
            cached: false,
        })
    }

    /// Refuses textures whose prompts are less certain than is asked for.
    fn sure(&self, textures: &[Texture]) -> Result<(), Failures> {
        let least = self.request.min_certainty;
        let unsure = self
            .chosen
            .iter()
            .zip(textures)
            .filter_map(|((index, _), texture)| {
                let (found, least) = (texture.facts.certainty_level?, least?);
                if found >= least {
                    return None;
                }
                let what = format!(
                    "the certainty of the prompt is {:?}, but --min-certainty requires {:?}",
                    found.to_string(),
                    least.to_string()
                );
                let remedy = "name a material, or see how the prompt is read with `asperity compile PROMPT -o FILE --explain`";
                Some(self.manifest.entries[*index].fault(&Fault::new(what, remedy)))
            });
        let mut unsure: Vec<Fault> = unsure.collect();
        unsure.sort_by_key(|fault| fault.line);
        let failures = all(unsure);
        if failures.is_empty() {
            Ok(())
        } else {
            Err(failures)
        }
    }

    fn rows(&self, textures: &[Texture]) -> Vec<TextureReport> {
        let pairs = self.chosen.iter().zip(textures);
        pairs
            .map(|((index, key), texture)| TextureReport {
                name: self.manifest.entries[*index].name.clone(),
                source: self.manifest.entries[*index].origin.key(),
                key: key.to_string(),
                cached: texture.cached,
                bytes: texture.slot.len as usize,
                facts: texture.facts.clone(),
            })
            .collect()
    }
}

/// Lets an asset wait. It parses: it was made, or is what the cache holds.
fn take(spill: &Spill, asset: &[u8]) -> std::io::Result<Slot> {
    let parsed = Asset::parse(asset).map_err(std::io::Error::other)?;
    spill.take(asset, parsed.haptic_len())
}

/// The key of every texture, in the order of the manifest.
fn keys(
    manifest: &Manifest,
    request: &Request<'_>,
    libraries: &OpenLibraries,
) -> Result<Vec<Key>, Failures> {
    let entries = &manifest.entries;
    let tools = Tools {
        libraries: Some(libraries),
        ..Tools::default()
    };
    // Files are read in parallel; a texture of others has no file.
    let contents: Vec<Result<Option<Parts>, Failure>> = entries
        .par_iter()
        .map(|entry| match &entry.origin {
            Origin::Source { key, source } => source.key(Parts::new(key), &tools).map(Some),
            _ => Ok(None),
        })
        .collect();
    let mut failures: Failures = Vec::new();
    let mut sources = Vec::with_capacity(entries.len());
    for (entry, content) in entries.iter().zip(contents) {
        match content {
            Ok(parts) => sources.push(parts),
            Err(cause) => {
                failures.push(Box::new(entry.fault(&*cause)));
                sources.push(None);
            }
        }
    }
    if !failures.is_empty() {
        return Err(failures);
    }
    // Where a texture lies, in an order in which those that it is made of come first. A checked manifest has no cycle.
    let mut places: Vec<Option<Key>> = vec![None; entries.len()];
    for index in order(entries).unwrap_or_default() {
        let entry = &entries[index];
        let parts = Parts::new(entry.origin.key());
        let of = |parts: Parts, other: usize| {
            let name = parts.text(&entries[other].name);
            name.part(places[other].as_ref().map_or(&[][..], |key| key.bytes()))
        };
        let parts = match &entry.origin {
            Origin::Source { .. } => sources[index].take().unwrap_or(parts),
            Origin::Of(other) => of(parts, *other),
            Origin::Blend { a, b, t } => of(of(parts, *a), *b).number(*t),
            Origin::Compose {
                tap,
                slide,
                friction,
            } => of(of(of(parts, *tap), *slide), *friction),
        };
        places[index] = Some(edited(parts, &entry.options).key());
    }
    let tables = contact::TABLES.concat() + direction::TABLE + modulus::TABLE;
    let laws = Key::of(tables.as_bytes());
    let all = entries.iter().zip(&places);
    Ok(all
        .map(|(entry, place)| {
            let options = &entry.options;
            let parts = Parts::new("texture 1").text(&request.program);
            let pinned = &request.pinned;
            let parts = if entry.origin.is_learned() {
                let crcs = [pinned.model_crc32, pinned.text_encoder_crc32];
                let crcs = crcs.map(u32::to_le_bytes).concat();
                let parts = parts.text(&pinned.backend).text(&pinned.reader);
                parts.part(&crcs).part(laws.bytes())
            } else {
                parts
            };
            let parts = parts
                .text(&pinned.asperity)
                .text(&entry.name)
                .part(place.as_ref().map_or(&[][..], |key| key.bytes()))
                .text(&options.request.fidelity.to_string())
                .number(options.request.rate_hz.unwrap_or(0.0))
                .number(options.request.loudness_db.unwrap_or(f64::INFINITY))
                .part(&options.request.preview_px.unwrap_or(0).to_le_bytes());
            let servo_rate_hz = options.request.servo_rate_hz;
            servo_rate_hz.into_iter().fold(parts, Parts::number).key()
        })
        .collect())
}

/// With the edit, and what it is measured on: the asset, at its fidelity and rate.
fn edited(parts: Parts, options: &Options) -> Parts {
    if options.edit.is_still() {
        return parts;
    }
    let parts = parts
        .text(&options.request.fidelity.to_string())
        .number(options.request.rate_hz.unwrap_or(0.0));
    let servo_rate_hz = options.request.servo_rate_hz;
    let parts = servo_rate_hz.into_iter().fold(parts, Parts::number);
    match &options.edit {
        Edit::Steps(sliders) => AXES
            .into_iter()
            .fold(parts, |parts, axis| parts.number(sliders.along(axis))),
        Edit::Words(words) => parts.text(words),
    }
}
