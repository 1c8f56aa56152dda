//! The table of materials: `data/materials.toml`, read once.

use crate::{
    color::{self, Rgb},
    pattern::Pattern,
    stems::stems,
};
use serde::{Deserialize, Deserializer, de::Error as _};
use std::{collections::BTreeMap, sync::LazyLock};

/// Appearance of a material.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Material {
    pub(crate) pattern: Pattern,
    /// Colours of the pattern's parts.
    #[serde(deserialize_with = "colors")]
    pub(crate) colors: Vec<Rgb>,
    /// Features a patch; the pattern's own number if `None`.
    #[serde(default)]
    pub(crate) cells: Option<f32>,
    /// Depth, a factor.
    #[serde(default = "one")]
    pub(crate) relief: f32,
    /// Gloss, 0..=1; the pattern's own if `None`.
    #[serde(default)]
    pub(crate) gloss: Option<f32>,
}

/// Effect of a word such as "wet" on a material.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Finish {
    /// A factor.
    pub(crate) brightness: f32,
    /// Added, −1..=1.
    pub(crate) gloss: f32,
}

fn one() -> f32 {
    1.0
}

fn colors<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Rgb>, D::Error> {
    let texts = Vec::<String>::deserialize(deserializer)?;
    let parsed: Option<Vec<Rgb>> = texts.iter().map(|text| color::parse(text)).collect();
    parsed
        .filter(|colors| !colors.is_empty())
        .ok_or_else(|| D::Error::custom(format!("colours are \"#rrggbb\", not {texts:?}")))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    material: BTreeMap<String, Material>,
    noun: BTreeMap<String, String>,
    color: BTreeMap<String, String>,
    finish: BTreeMap<String, Finish>,
    family: BTreeMap<String, String>,
}

/// The table, by stems of words.
#[derive(Debug)]
pub(crate) struct Table {
    /// Rows, by the stems of their names and of other words for them.
    by_stems: BTreeMap<Vec<String>, Material>,
    by_family: BTreeMap<String, Material>,
    pub(crate) colors: BTreeMap<String, Rgb>,
    pub(crate) finishes: BTreeMap<String, Finish>,
    /// Words of the longest name.
    pub(crate) longest: usize,
}

impl Table {
    fn read(text: &str) -> Result<Self, String> {
        let file: File = toml::from_str(text).map_err(|error| error.to_string())?;
        let row = |word: &str, name: &str| {
            let material = file.material.get(name).cloned();
            material.ok_or_else(|| format!("{word:?} stands for {name:?}, which has no row"))
        };
        let mut by_stems = BTreeMap::new();
        for (noun, name) in &file.noun {
            by_stems.insert(stems(noun), row(noun, name)?);
        }
        let mut by_family = BTreeMap::new();
        for (family, name) in &file.family {
            by_family.insert(family.clone(), row(family, name)?);
        }
        for (name, material) in file.material {
            by_stems.insert(stems(&name), material);
        }
        let mut colors = BTreeMap::new();
        for (word, hex) in &file.color {
            let color =
                color::parse(hex).ok_or_else(|| format!("{word:?}: {hex:?} is no colour"))?;
            colors.insert(word.clone(), color);
        }
        let longest = by_stems.keys().map(Vec::len).max().unwrap_or(0);
        Ok(Self {
            by_stems,
            by_family,
            colors,
            finishes: file.finish,
            longest,
        })
    }

    /// The row of a name or another word for it, given as stems.
    pub(crate) fn material(&self, stems: &[String]) -> Option<&Material> {
        self.by_stems.get(stems)
    }

    /// The row that stands for a family of the reference corpus.
    pub(crate) fn family(&self, family: &str) -> Option<&Material> {
        self.by_family.get(family)
    }
}

const TEXT: &str = include_str!("../data/materials.toml");

/// The table that the crate carries; a test reads it, so it is well formed.
pub(crate) static TABLE: LazyLock<Table> = LazyLock::new(|| match Table::read(TEXT) {
    Ok(table) => table,
    Err(error) => unreachable!("data/materials.toml: {error}"),
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_well_formed_and_every_pattern_is_used() {
        let table = Table::read(TEXT).unwrap();
        for pattern in Pattern::ALL {
            assert!(
                table.by_stems.values().any(|m| m.pattern == *pattern),
                "{pattern:?} has no row"
            );
        }
        for material in table.by_stems.values() {
            assert!((0.0..=6.0).contains(&material.relief));
            assert!(
                material
                    .gloss
                    .is_none_or(|gloss| (0.0..=1.0).contains(&gloss))
            );
            assert!(
                material
                    .cells
                    .is_none_or(|cells| (1.0..=200.0).contains(&cells))
            );
        }
    }

    #[test]
    fn a_word_for_a_missing_row_is_named() {
        let text = TEXT.replace("[noun]", "[noun]\n\"thing\" = \"nothing\"");
        assert!(
            Table::read(&text)
                .unwrap_err()
                .contains("\"thing\" stands for \"nothing\"")
        );
    }
}
