//! The reference corpus: materials that we describe ourselves, and textures that the [`generator`]
//! makes of them. It is synthetic and free of other people's rights.

pub mod check;
pub mod lexicon;
pub mod schema;

use crate::{
    Corpus, Material, UnifiedGrid,
    augment::{self, Augmentation},
    error::CorpusError,
    generator,
};
use asperity::input::{self, Kind};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

pub use lexicon::LexiconEntry;

macro_rules! embedded {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../corpora/", $name)))),*]
    };
}

/// The committed files, in the order of the corpus.
const EMBEDDED: &[(&str, &str)] = embedded![
    "abrasives.toml",
    "carpets.toml",
    "ceramics.toml",
    "fabrics.toml",
    "foams.toml",
    "foods.toml",
    "gels.toml",
    "glass.toml",
    "granular.toml",
    "leathers.toml",
    "meshes.toml",
    "metals.toml",
    "organic.toml",
    "papers.toml",
    "piles.toml",
    "plastics.toml",
    "rubbers.toml",
    "stones.toml",
    "wet.toml",
    "woods.toml",
];
const EMBEDDED_LEXICON: &str = include_str!("../../../corpora/everyday.toml");
/// Name of the lexicon beside the family files.
const LEXICON_FILE: &str = "everyday.toml";

/// What to load and how to augment it.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceOptions {
    /// A folder of family files and `everyday.toml`; the committed corpus if `None`.
    pub folder: Option<PathBuf>,
    /// Augmented instances of each material.
    pub instances: usize,
    /// How instances differ.
    pub augmentation: Augmentation,
    /// Seed of the augmentation.
    pub seed: u64,
}

impl Default for ReferenceOptions {
    fn default() -> Self {
        Self {
            folder: None,
            instances: 20,
            augmentation: Augmentation::default(),
            seed: 1,
        }
    }
}

/// Loads, checks and generates the corpus, with the lexicon.
///
/// # Errors
/// [`CorpusError`] with every fault found, by file, material and field.
pub fn load(options: &ReferenceOptions) -> Result<(Corpus, Vec<LexiconEntry>), CorpusError> {
    let sources = sources(options.folder.as_deref())?;
    let mut digest = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let crc32 = checksum(&mut digest, &sources);
    let mut lexicon = Vec::new();
    let mut families = Vec::new();
    for (file, text) in &sources {
        if file == LEXICON_FILE {
            lexicon = lexicon::parse(file, text)?;
        } else {
            families.push((file.clone(), schema::parse(file, text)?));
        }
    }
    check::check(&families)?;
    let grid = UnifiedGrid::reference();
    let described: Vec<(String, schema::MaterialEntry)> = families
        .into_iter()
        .flat_map(|(_, family)| {
            let name = family.family;
            family
                .material
                .into_iter()
                .map(move |entry| (name.clone(), entry))
        })
        .collect();
    let prototypes: Vec<_> = described
        .par_iter()
        .map(|(_, entry)| generator::instance(&entry.physical.values(), &grid))
        .collect();
    let materials = described
        .into_par_iter()
        .enumerate()
        .map(|(index, (family, entry))| {
            let physical = entry.physical.values();
            let instances = augment::instances(
                &physical,
                &grid,
                &prototypes,
                index,
                options.instances,
                &options.augmentation,
                options.seed,
            );
            Material {
                family,
                training: entry.training,
                held_out: entry.held_out,
                rating: Some(entry.attributes),
                mu: physical.mu,
                stiffness_n_m: generator::wall_stiffness_n_m(&physical),
                prototype: prototypes[index].clone(),
                instances,
                name: entry.name,
            }
        })
        .collect();
    Ok((
        Corpus {
            name: "reference".into(),
            licence: "MIT OR Apache-2.0 (written for Asperity; textures are synthetic)".into(),
            crc32,
            grid,
            tap_speeds_m_s: generator::tap_speeds_m_s(),
            taps_synthetic: true,
            materials,
        },
        lexicon,
    ))
}

/// File names and contents, sorted by name.
fn sources(folder: Option<&Path>) -> Result<Vec<(String, String)>, CorpusError> {
    let Some(folder) = folder else {
        let mut all: Vec<(String, String)> = EMBEDDED
            .iter()
            .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
            .collect();
        all.push((LEXICON_FILE.into(), EMBEDDED_LEXICON.into()));
        return Ok(all);
    };
    let unreadable = |path: &Path| {
        let path = path.to_owned();
        move |source| CorpusError::Unreadable { path, source }
    };
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable(folder))? {
        let path = entry.map_err(unreadable(folder))?.path();
        let is_toml = path
            .extension()
            .is_some_and(|extension| extension == "toml");
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned());
        // Prompts of the evaluation are in the same folder but do not belong to the corpus.
        if let (true, Some(name)) = (is_toml, name)
            && name != "pairs.toml"
            && name != "probes.toml"
        {
            let text = input::read_text(&path, Kind::Corpus)
                .map_err(|problem| unreadable(&path)(problem.into()))?;
            all.push((name, text));
        }
    }
    all.sort();
    if all.iter().all(|(name, _)| name == LEXICON_FILE) {
        return Err(CorpusError::Empty {
            path: folder.to_owned(),
        });
    }
    Ok(all)
}

fn checksum(crc: &mut crc::Crc<u32>, sources: &[(String, String)]) -> u32 {
    let mut digest = crc.digest();
    for (name, text) in sources {
        digest.update(name.as_bytes());
        digest.update(text.as_bytes());
    }
    digest.finalize()
}

#[cfg(test)]
mod tests;
