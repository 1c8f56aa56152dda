//! The reference corpus: materials that we describe ourselves, and textures that the [`generator`]
//! makes of them. It is synthetic and free of other people's rights.

pub mod check;
pub mod directions;
pub mod lexicon;
pub mod names;
pub mod schema;

use crate::{
    Corpus, Material, UnifiedGrid, augment,
    error::CorpusError,
    generator::{
        self, Physical,
        constants::{ConstantSet, Constants},
    },
};
use asperity_io::input::{self, InputKind};
use rayon::prelude::*;
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

pub use directions::{Direction, directions};
pub use lexicon::LexiconEntry;

macro_rules! embedded {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../corpora/", $name)))),*]
    };
}

/// The committed files, in the order of the corpus.
const EMBEDDED: &[(&str, &str)] = embedded![
    "abrasives.toml",
    "animals.toml",
    "boards.toml",
    "carpets.toml",
    "ceramics.toml",
    "cloths.toml",
    "fabrics.toml",
    "floors.toml",
    "foams.toml",
    "foods.toml",
    "gels.toml",
    "glass.toml",
    "granular.toml",
    "groceries.toml",
    "grounds.toml",
    "leathers.toml",
    "meshes.toml",
    "metals.toml",
    "metalware.toml",
    "organic.toml",
    "papers.toml",
    "piles.toml",
    "plants.toml",
    "plastics.toml",
    "ropes.toml",
    "rubbers.toml",
    "scrubbers.toml",
    "skins.toml",
    "sportsgear.toml",
    "stationery.toml",
    "stones.toml",
    "synthetics.toml",
    "walls.toml",
    "wet.toml",
    "woods.toml",
];
/// The files of the lexicon.
const EMBEDDED_LEXICON: &[(&str, &str)] = embedded![
    "everyday.toml",
    "lexicon/animals.csv",
    "lexicon/bases.csv",
    "lexicon/body.csv",
    "lexicon/buildings.csv",
    "lexicon/clothing.csv",
    "lexicon/comparisons.csv",
    "lexicon/finishes.csv",
    "lexicon/food.csv",
    "lexicon/household.csv",
    "lexicon/leisure.csv",
    "lexicon/modifiers.csv",
    "lexicon/nature.csv",
    "lexicon/negations.csv",
    "lexicon/objects.csv",
    "lexicon/plants.csv",
    "lexicon/substances.csv",
    "lexicon/tools.csv",
    "lexicon/vehicles.csv",
    "lexicon/words.csv",
];
/// In the same folders but no part of the corpus: prompts of the evaluation, constants of the generator, directions of
/// materials, ratings of the same phrases again, to compare.
const BESIDE: [&str; 5] = [
    "pairs.toml",
    "probes.toml",
    "generator.toml",
    "directions.toml",
    "anchors.csv",
];
/// The lexicon beside the family files of a folder, and the folder of its further files.
const LEXICON_FILE: &str = "everyday.toml";
const LEXICON_FOLDER: &str = "lexicon";

/// Options for loading and augmenting the reference corpus.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceOptions {
    /// A folder of family files and `everyday.toml`; the committed corpus if `None`.
    pub folder: Option<PathBuf>,
    /// Augmented instances of each material.
    pub instances: usize,
    /// Seed of the augmentation.
    pub seed: u64,
    /// Constants of the generator.
    pub constants: ConstantSet,
}

impl Default for ReferenceOptions {
    fn default() -> Self {
        Self {
            folder: None,
            instances: 20,
            seed: 1,
            constants: ConstantSet::default(),
        }
    }
}

/// Loads, checks and generates the corpus, with the lexicon.
///
/// # Errors
/// [`CorpusError`] with every fault found, by file, material and field.
pub fn load(options: &ReferenceOptions) -> Result<(Corpus, Vec<LexiconEntry>), CorpusError> {
    let sources = sources(options.folder.as_deref())?;
    let constants = Constants::embedded(options.constants)?;
    let crc32 = checksum(&sources, &constants);
    let (lexicon, families): (Vec<_>, Vec<_>) =
        sources.iter().partition(|(file, _)| is_lexicon(file));
    let lexicon = lexicon
        .iter()
        .map(|(file, text)| (file.as_str(), text.as_str()));
    let lexicon = lexicon::parse(lexicon)?;
    let families = families
        .iter()
        .map(|(file, text)| Ok((file.clone(), schema::parse(file, text)?)));
    let families: Vec<_> = families.collect::<Result<_, CorpusError>>()?;
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
    let make = |physical: &Physical| generator::instance(&constants, physical, &grid);
    let prototypes: Vec<_> = described
        .par_iter()
        .map(|(_, entry)| make(&entry.physical.values()))
        .collect();
    let materials = described
        .into_par_iter()
        .enumerate()
        .map(|(index, (family, entry))| {
            let physical = entry.physical.values();
            let instances = augment::instances(
                &physical,
                make,
                &prototypes,
                index,
                options.instances,
                options.seed,
            );
            Material {
                family,
                synonyms: entry.synonyms,
                training: entry.training,
                held_out: entry.held_out,
                rating: Some(entry.attributes),
                mu: generator::friction::mu(&constants, &physical),
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
            licence: format!(
                "MIT OR Apache-2.0 (written for Asperity; textures are synthetic, by a generator \
                 whose constants are {})",
                match options.constants {
                    ConstantSet::Calibrated => "calibrated on aggregates of measured materials",
                    ConstantSet::Open => "from physics and open data",
                }
            ),
            crc32,
            grid,
            tap_speeds_m_s: generator::tap_speeds_m_s(),
            taps_synthetic: true,
            materials,
        },
        lexicon,
    ))
}

/// The physical parameters of every material of the committed corpus, by its name.
///
/// # Errors
/// [`CorpusError::Syntax`].
pub fn physical() -> Result<BTreeMap<String, Physical>, CorpusError> {
    let mut all = BTreeMap::new();
    for (file, text) in EMBEDDED {
        let materials = schema::parse(file, text)?.material.into_iter();
        all.extend(materials.map(|m| (m.name, m.physical.values())));
    }
    Ok(all)
}

/// Returns true if a file, named from the folder, belongs to the lexicon.
fn is_lexicon(file: &str) -> bool {
    file == LEXICON_FILE || Path::new(file).starts_with(LEXICON_FOLDER)
}

/// File names and contents, sorted by name.
fn sources(folder: Option<&Path>) -> Result<Vec<(String, String)>, CorpusError> {
    let Some(folder) = folder else {
        let all = EMBEDDED.iter().chain(EMBEDDED_LEXICON);
        return Ok(all
            .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
            .collect());
    };
    let mut all = files(folder, "toml", "")?;
    let lexicon = folder.join(LEXICON_FOLDER);
    if lexicon.is_dir() {
        all.extend(files(&lexicon, "csv", "lexicon/")?);
    }
    all.sort();
    if all.iter().all(|(name, _)| is_lexicon(name)) {
        return Err(CorpusError::Empty {
            path: folder.to_owned(),
        });
    }
    Ok(all)
}

/// The files of a folder that end so and are part of the corpus, with `before` in front of their names.
fn files(folder: &Path, ending: &str, before: &str) -> Result<Vec<(String, String)>, CorpusError> {
    let unreadable = |path: &Path| {
        let path = path.to_owned();
        move |source| CorpusError::Unreadable { path, source }
    };
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable(folder))? {
        let path = entry.map_err(unreadable(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.extension().is_some_and(|own| own == ending) && !BESIDE.contains(&&*name) {
            let text = input::read_text(&path, InputKind::Corpus)
                .map_err(|problem| unreadable(&path)(problem.into()))?;
            all.push((format!("{before}{name}"), text));
        }
    }
    Ok(all)
}

fn checksum(sources: &[(String, String)], constants: &Constants) -> u32 {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let mut digest = crc.digest();
    for (name, text) in sources {
        digest.update(name.as_bytes());
        digest.update(text.as_bytes());
    }
    for value in constants.to_array() {
        digest.update(&value.to_le_bytes());
    }
    digest.finalize()
}

#[cfg(test)]
mod tests;
