//! Visual content of a prompt: a material, a colour, a finish.

use crate::{
    color::Rgb,
    stems::stems,
    table::{Finish, Material, Table},
};

/// Words after which a prompt speaks of something beside its subject.
const BESIDE: &[&str] = &[
    "with", "on", "for", "from", "under", "over", "but", "and", "like", "as", "by", "in", "to",
    "at", "used", "covered", "that", "which",
];
/// Words that say what the subject is not.
const NOT: &[&str] = &["not", "no", "without", "than", "less", "never", "non"];

/// Visual content of the words.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct VisualContent<'a> {
    pub(crate) material: Option<&'a Material>,
    pub(crate) color: Option<Rgb>,
    /// All finishes together.
    pub(crate) brightness: f32,
    pub(crate) gloss: f32,
}

/// Reads a prompt. The material with the longest name counts; among equals the last one of the
/// first phrase that has any, which is where English puts the head of a noun.
pub(crate) fn read<'a>(text: &str, table: &'a Table) -> VisualContent<'a> {
    let mut content = VisualContent {
        brightness: 1.0,
        ..VisualContent::default()
    };
    // A separator ends a phrase as a preposition does.
    let phrases: Vec<Vec<String>> = text
        .split([',', ';', ':', '.', '(', ')', '!', '?'])
        .flat_map(|part| {
            let words = stems(part);
            let parts = words.split(|word| BESIDE.contains(&word.as_str()));
            parts.map(<[String]>::to_vec).collect::<Vec<_>>()
        })
        .collect();
    let mut best: Option<(usize, usize, usize, usize, &Material)> = None;
    for (p, phrase) in phrases.iter().enumerate() {
        for start in 0..phrase.len() {
            if negated(phrase, start) {
                continue;
            }
            for length in 1..=table.longest.min(phrase.len() - start) {
                let Some(material) = table.material(&phrase[start..start + length]) else {
                    continue;
                };
                let better = best.is_none_or(|(old, old_phrase, ..)| {
                    length > old || (length == old && p == old_phrase)
                });
                if better {
                    best = Some((length, p, start, start + length, material));
                }
            }
        }
    }
    content.material = best.map(|(.., material)| material);
    for (p, phrase) in phrases.iter().enumerate() {
        for (k, word) in phrase.iter().enumerate() {
            let in_name = best.is_some_and(|(_, q, from, to, _)| p == q && (from..to).contains(&k));
            if in_name || negated(phrase, k) {
                continue;
            }
            // A colour of something beside the subject counts only where it has none of its own.
            if let Some(color) = table.colors.get(word.as_str()) {
                content.color = content.color.or(Some(*color));
            }
            if let Some(Finish { brightness, gloss }) = table.finishes.get(word.as_str()) {
                content.brightness *= brightness;
                content.gloss += gloss;
            }
        }
    }
    content
}

fn negated(phrase: &[String], at: usize) -> bool {
    phrase[..at]
        .iter()
        .rev()
        .take(2)
        .any(|word| NOT.contains(&word.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{color::parse, pattern::Pattern, table::TABLE};

    fn pattern(prompt: &str) -> Option<Pattern> {
        read(prompt, &TABLE)
            .material
            .map(|material| material.pattern)
    }

    #[test]
    fn the_longest_name_counts_then_the_head_of_the_first_phrase() {
        assert_eq!(pattern("steel wool"), Some(Pattern::Tangle));
        assert_eq!(pattern("a rubber carpet"), Some(Pattern::CutPile));
        assert_eq!(pattern("velvet on a wooden chair"), Some(Pattern::Velvet));
        assert_eq!(pattern("Bricks, weathered"), Some(Pattern::Brick));
        assert_eq!(pattern("warm leaves"), Some(Pattern::Leaf));
        assert_eq!(pattern("something smooth"), None);
        assert_eq!(pattern("not wood but cork"), Some(Pattern::Cork));
    }

    #[test]
    fn colours_and_finishes_are_read_beside_the_name() {
        let content = read("wet dark red brick", &TABLE);
        assert_eq!(content.color, parse("#c8282c"));
        assert!(content.brightness < 0.6 && content.gloss > 0.3);
        assert_eq!(
            read("orange peel", &TABLE).color,
            None,
            "a part of the name"
        );
        assert_eq!(read("not red", &TABLE).color, None);
    }
}
