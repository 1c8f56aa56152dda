//! The direction of a stroke in a prompt: "along the ribs", "against the nap", "lengthwise".
//!
//! These words say how a material is stroked, and nothing of the material. So they are taken out before the prompt is
//! read, and the texture becomes that of strokes in their direction.

use asperity_texture::model::Bearing;
use std::{borrow::Cow, ops::Range};

/// What lies along an axis and leans neither way.
const LINES: [&str; 52] = [
    "rib",
    "ribs",
    "ribbing",
    "ridge",
    "ridges",
    "groove",
    "grooves",
    "furrow",
    "furrows",
    "flute",
    "flutes",
    "wale",
    "wales",
    "cord",
    "cords",
    "line",
    "lines",
    "stripe",
    "stripes",
    "corrugation",
    "corrugations",
    "grain",
    "figure",
    "fibre",
    "fibres",
    "fiber",
    "fibers",
    "thread",
    "threads",
    "warp",
    "weave",
    "twill",
    "lay",
    "strand",
    "strands",
    "string",
    "strings",
    "reed",
    "reeds",
    "layers",
    "growth rings",
    "brush marks",
    "brush strokes",
    "brushstrokes",
    "brushing",
    "scratches",
    "sanding marks",
    "saw marks",
    "tool marks",
    "machining marks",
    "slats",
    "veins",
];
/// What leans one way, so that strokes along it have two senses.
const NAPS: [&str; 22] = [
    "nap",
    "pile",
    "fur",
    "hair",
    "hairs",
    "scale",
    "scales",
    "wool",
    "barb",
    "barbs",
    "lie",
    "teeth",
    "whiskers",
    "stubble",
    "bristles",
    "feathers",
    "coat",
    "fuzz",
    "tufts",
    "denticles",
    "blades",
    "vanes",
];
/// Words that say a direction by themselves.
const ALONE: [(&str, Bearing); 12] = [
    ("lengthwise", Bearing::Along),
    ("lengthways", Bearing::Along),
    ("longways", Bearing::Along),
    ("along its length", Bearing::Along),
    ("along the length", Bearing::Along),
    ("crosswise", Bearing::Across),
    ("crossways", Bearing::Across),
    ("widthwise", Bearing::Across),
    ("widthways", Bearing::Across),
    ("sideways", Bearing::Across),
    ("across its width", Bearing::Across),
    ("across the width", Bearing::Across),
];
/// Words before such a phrase that say no more than that something is stroked.
const STROKED: [&str; 16] = [
    "stroked", "stroking", "rubbed", "rubbing", "dragged", "dragging", "swiped", "swiping",
    "drawn", "moving", "moved", "running", "run", "sliding", "slid", "going",
];
/// Words between a preposition and what it goes with.
const BETWEEN: [&str; 5] = ["the", "its", "their", "this", "that"];
/// Words of a phrase at most.
const LONGEST: usize = 6;

/// The prompt without its words of direction, and the bearing that they say. A prompt that says two, that denies one or that
/// says nothing else stays as it is.
pub(crate) fn split(prompt: &str) -> (Cow<'_, str>, Option<Bearing>) {
    let words = words(prompt);
    let mut found: Vec<(Range<usize>, Bearing)> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let Some((count, bearing)) = phrase(prompt, &words[at..]) else {
            at += 1;
            continue;
        };
        found.push((at..at + count, bearing));
        at += count;
    }
    let [(range, bearing)] = &found[..] else {
        return (prompt.into(), None);
    };
    let word = |n: usize| lower(prompt, &words[n]);
    let mut from = range.start;
    if from > 0 && ["not", "never", "no"].contains(&word(from - 1).as_str()) {
        return (prompt.into(), None);
    }
    while from > 0 && STROKED.contains(&word(from - 1).as_str()) {
        from -= 1;
    }
    let (before, after) = (
        &prompt[..words[from].start],
        &prompt[words[range.end - 1].end..],
    );
    let is_joint = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':' | '-' | '(' | ')');
    let (before, after) = (
        before.trim_end_matches(is_joint),
        after.trim_start_matches(is_joint),
    );
    let rest = match (before.trim().is_empty(), after.trim().is_empty()) {
        (true, true) => return (prompt.into(), None),
        (true, false) => after.to_owned(),
        (false, true) => before.to_owned(),
        (false, false) => format!("{before}, {after}"),
    };
    (rest.into(), Some(*bearing))
}

/// The bearing of a phrase at the beginning of these words, and how many of them it takes.
fn phrase(text: &str, words: &[Range<usize>]) -> Option<(usize, Bearing)> {
    let said: Vec<String> = words
        .iter()
        .take(LONGEST)
        .map(|word| lower(text, word))
        .collect();
    let is = |at: usize, phrase: &str| {
        let parts: Vec<&str> = phrase.split(' ').collect();
        let here = said.get(at..at + parts.len())?;
        (here == parts.as_slice()).then_some(parts.len())
    };
    if let Some(alone) = ALONE
        .iter()
        .find_map(|(phrase, bearing)| Some((is(0, phrase)?, *bearing)))
    {
        return Some(alone);
    }
    let (mut at, way) = [
        ("along with", None),
        ("along", Some(Way::Along)),
        ("down", Some(Way::Down)),
        ("up", Some(Way::Up)),
        ("parallel to", Some(Way::Along)),
        ("parallel with", Some(Way::Along)),
        ("in the direction of", Some(Way::With)),
        ("following", Some(Way::Along)),
        ("across", Some(Way::Across)),
        ("perpendicular to", Some(Way::Across)),
        ("at right angles to", Some(Way::Across)),
        ("transverse to", Some(Way::Across)),
        ("with", Some(Way::With)),
        ("against", Some(Way::Against)),
    ]
    .into_iter()
    .find_map(|(phrase, way)| Some((is(0, phrase)?, way)))?;
    let way = way?;
    let determined = said
        .get(at)
        .is_some_and(|word| BETWEEN.contains(&word.as_str()));
    at += usize::from(determined);
    let one_of = |names: &[&str]| names.iter().find_map(|name| is(at, name));
    let (line, nap) = (one_of(&LINES), one_of(&NAPS));
    let bearing = match (way, nap.is_some()) {
        (Way::Along, _) => Bearing::Along,
        (Way::Across, _) => Bearing::Across,
        // "corduroy with ribs" has them.
        (Way::With | Way::Down | Way::Up, _) if !determined => return None,
        (Way::With, true) | (Way::Down, true) => Bearing::With,
        (Way::Against | Way::Up, true) => Bearing::Against,
        (Way::With | Way::Down | Way::Up, false) => Bearing::Along,
        // Of wood and cloth it is said of strokes that cross what lies along them.
        (Way::Against, false) => Bearing::Across,
    };
    Some((at + line.or(nap)?, bearing))
}

/// How a preposition goes with an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Along,
    Across,
    With,
    Against,
    Down,
    Up,
}

/// The words of a text, as ranges of its bytes.
fn words(text: &str) -> Vec<Range<usize>> {
    let mut words: Vec<Range<usize>> = Vec::new();
    let mut begin = None;
    for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (c.is_alphanumeric() || c == '\'' || c == '’', begin) {
            (true, None) => begin = Some(at),
            (false, Some(from)) => {
                words.push(from..at);
                begin = None;
            }
            _ => {}
        }
    }
    words
}

fn lower(text: &str, word: &Range<usize>) -> String {
    text[word.clone()].to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;
    use Bearing::{Across, Against, Along, With};

    #[test]
    fn words_of_direction_are_taken_out_of_a_prompt() {
        for (prompt, rest, bearing) in [
            ("corduroy along the ribs", "corduroy", Along),
            ("Corduroy, across the ribs", "Corduroy", Across),
            ("with the grain of an oak plank", "of an oak plank", Along),
            (
                "oak plank, against the grain, oiled",
                "oak plank, oiled",
                Across,
            ),
            ("velvet against the nap", "velvet", Against),
            ("velvet stroked with the nap", "velvet", With),
            ("rabbit fur down its hair", "rabbit fur", With),
            ("shark skin up the scales", "shark skin", Against),
            ("brushed steel lengthwise", "brushed steel", Along),
            ("aluminium brushed lengthwise", "aluminium brushed", Along),
            ("a rope parallel to its strands", "a rope", Along),
            ("bamboo mat (crosswise)", "bamboo mat", Across),
            (
                "across the growth rings of driftwood",
                "of driftwood",
                Across,
            ),
            (
                "corrugated card running perpendicular to the flutes",
                "corrugated card",
                Across,
            ),
        ] {
            assert_eq!(split(prompt), (rest.into(), Some(bearing)), "{prompt}");
        }
    }

    #[test]
    fn other_prompts_stay_as_they_are() {
        for prompt in [
            "",
            "corduroy",
            "corduroy with ribs",
            "corduroy with deep ribs along the sleeve",
            "with the grain",
            "smooth along the grain, rough across the grain",
            "wood, not along the grain",
            "sand across the floor",
            "a wall along the road",
            "a cat with fur",
            "rough against the skin",
            "hair along with feathers",
        ] {
            assert_eq!(split(prompt), (prompt.into(), None), "{prompt}");
        }
    }
}
