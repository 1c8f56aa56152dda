//! The direction of a stroke in a prompt: "along the ribs", "against the nap", "lengthwise".
//!
//! These words say how a material is stroked, and nothing of the material. So they are taken out before the prompt is
//! read, and the texture becomes that of strokes in their direction.

use crate::learned::direction::Stroke;
use asperity_texture::model::Bearing;
use std::{borrow::Cow, ops::Range, sync::LazyLock};

/// Names of what lies along an axis.
static NOUNS: LazyLock<Vec<Noun>> = LazyLock::new(|| {
    let rows = include_str!("axis_nouns.tsv").lines();
    let row = |line: &'static str| {
        let mut fields = line.split('\t');
        let (like, kind) = (fields.next()?, fields.next()?);
        let names = fields.next()?.split(", ");
        Some(names.map(move |name| Noun {
            name,
            like,
            leans: kind == "nap",
        }))
    };
    rows.filter_map(row).flatten().collect()
});

/// A name of what lies along an axis.
#[derive(Debug)]
struct Noun {
    name: &'static str,
    /// A material that has it: its direction is that of what says that it has such, where the model knows none.
    like: &'static str,
    /// True if it leans one way, so that strokes along it have two senses.
    leans: bool,
}

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
/// Words that may stand between a preposition and what lies along the axis, with up to two others behind them: "the raised
/// grain".
const BETWEEN: [&str; 9] = [
    "the", "its", "their", "this", "that", "a", "an", "one", "each",
];
const ADJECTIVES: usize = 2;
/// How prepositions go with an axis. What stands first is tried first.
const WAYS: [(&str, Option<Way>); 21] = [
    ("along with", None),
    ("along the length of", Some(Way::Along)),
    ("along", Some(Way::Along)),
    ("down the length of", Some(Way::Along)),
    ("down", Some(Way::Down)),
    ("downward", Some(Way::Down)),
    ("up", Some(Way::Up)),
    ("upward", Some(Way::Up)),
    ("parallel to", Some(Way::Along)),
    ("parallel with", Some(Way::Along)),
    ("in the direction of", Some(Way::With)),
    ("following", Some(Way::Along)),
    ("between", Some(Way::Along)),
    ("across", Some(Way::Across)),
    ("over", Some(Way::Across)),
    ("crossing", Some(Way::Across)),
    ("perpendicular to", Some(Way::Across)),
    ("at right angles to", Some(Way::Across)),
    ("transverse to", Some(Way::Across)),
    ("with", Some(Way::With)),
    ("against", Some(Way::Against)),
];
/// Words of a prompt at most, of which some say a direction: a sentence tells of a stroke, and asks for the material.
const MOST_WORDS: usize = 14;
/// Words of a phrase at most.
const LONGEST: usize = 8;

/// The prompt without its words of direction, and the stroke that they say. A prompt that says two, that denies one or that
/// says nothing else stays as it is.
pub(crate) fn split_stroke(prompt: &str) -> (Cow<'_, str>, Option<Stroke>) {
    let words = words(prompt);
    if words.len() > MOST_WORDS || words.iter().any(|word| is_of_clause(&lower(prompt, word))) {
        return (prompt.into(), None);
    }
    let mut found: Vec<(Range<usize>, Stroke)> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let Some((count, stroke)) = phrase(prompt, &words[at..]) else {
            at += 1;
            continue;
        };
        found.push((at..at + count, stroke));
        at += count;
    }
    // "Lengthwise across the rings": what names the rings says more.
    let said = || found.iter().map(|(_, stroke)| *stroke);
    let named = said().find(|stroke| stroke.like.is_some());
    let Some(stroke) = named.or_else(|| said().next()) else {
        return (prompt.into(), None);
    };
    let other = |other: Stroke| {
        other.bearing != stroke.bearing && other.like.is_some() == stroke.like.is_some()
    };
    if said().any(other) {
        return (prompt.into(), None);
    }
    let word = |n: usize| lower(prompt, &words[n]);
    let mut rest: Vec<&str> = Vec::new();
    let mut begin = 0;
    for (range, _) in &found {
        let mut from = range.start;
        if from > 0 && ["not", "never", "no"].contains(&word(from - 1).as_str()) {
            return (prompt.into(), None);
        }
        while from > 0 && STROKED.contains(&word(from - 1).as_str()) {
            from -= 1;
        }
        rest.push(&prompt[begin..words[from].start.max(begin)]);
        begin = words[range.end - 1].end;
    }
    rest.push(&prompt[begin..]);
    let is_joint = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':' | '-' | '(' | ')');
    let rest: Vec<&str> = (rest.into_iter())
        .map(|part| part.trim_matches(is_joint))
        .filter(|part| !part.is_empty())
        .collect();
    if rest.is_empty() {
        return (prompt.into(), None);
    }
    let rest = rest.join(", ");
    // "Board with flutes, lengthwise".
    let said: Vec<String> = self::words(&rest)
        .iter()
        .map(|word| lower(&rest, word))
        .collect();
    let lying = || (0..said.len()).find_map(|at| Some(longest(&said[at..])?.1.like));
    let like = stroke.like.or_else(lying);
    (rest.into(), Some(Stroke { like, ..stroke }))
}

/// The stroke of a phrase at the beginning of these words, and how many of them it takes.
fn phrase(text: &str, words: &[Range<usize>]) -> Option<(usize, Stroke)> {
    let said: Vec<String> = words
        .iter()
        .take(LONGEST)
        .map(|word| lower(text, word))
        .collect();
    let alone = || {
        let (count, bearing) =
            (ALONE.iter()).find_map(|(alone, bearing)| Some((starts(&said, alone)?, *bearing)))?;
        Some((
            count,
            Stroke {
                bearing,
                like: None,
            },
        ))
    };
    named(&said).or_else(alone)
}

/// The number of words of a phrase that stands at the beginning of others.
fn starts(said: &[String], phrase: &str) -> Option<usize> {
    let parts: Vec<&str> = phrase.split(' ').collect();
    (said.get(..parts.len())? == parts.as_slice()).then_some(parts.len())
}

/// What lies along an axis at the beginning of these words, and how many of them it takes. "Growth rings" comes before
/// "growth".
fn longest(said: &[String]) -> Option<(usize, &'static Noun)> {
    let found = (NOUNS.iter()).filter_map(|noun| Some((starts(said, noun.name)?, noun)));
    found.max_by_key(|(count, _)| *count)
}

/// The stroke of a preposition and what lies along the axis.
fn named(said: &[String]) -> Option<(usize, Stroke)> {
    let (from, way) = WAYS
        .iter()
        .find_map(|(phrase, way)| Some((starts(said, phrase)?, *way)))?;
    let way = way?;
    let determined = said
        .get(from)
        .is_some_and(|word| BETWEEN.contains(&word.as_str()));
    let from = from + usize::from(determined);
    // "With a deep pile" has one, "with the tiny barbs" follows them.
    let skipped = match way {
        _ if !determined => 0,
        Way::With => usize::from(said.get(from - 1).is_some_and(|word| word == "the")),
        _ => ADJECTIVES,
    };
    let (at, (count, noun)) =
        (from..=from + skipped).find_map(|at| Some((at, longest(said.get(at..)?)?)))?;
    let bearing = match (way, noun.leans) {
        (Way::Along, _) => Bearing::Along,
        (Way::Across, _) => Bearing::Across,
        // "corduroy with ribs" has them.
        (Way::With | Way::Down | Way::Up, _) if !determined => return None,
        (Way::With | Way::Down, true) => Bearing::With,
        (Way::Against | Way::Up, true) => Bearing::Against,
        (Way::With | Way::Down | Way::Up, false) => Bearing::Along,
        // Of wood and cloth it is said of strokes that cross what lies along them.
        (Way::Against, false) => Bearing::Across,
    };
    let like = Some(noun.like);
    Some((at + count, Stroke { bearing, like }))
}

/// Returns true for a word that only a clause has: "before you gut the bream, run a finger against the scales".
fn is_of_clause(word: &str) -> bool {
    const WORDS: [&str; 14] = [
        "i", "you", "he", "she", "we", "they", "my", "your", "his", "her", "have", "before",
        "after", "when",
    ];
    WORDS.contains(&word)
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
            ("a hose, lengthwise over the rings", "a hose", Across),
            (
                "cedar fence, following the raised grain",
                "cedar fence",
                Along,
            ),
            ("a file drawn against the tiny teeth", "a file", Against),
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
            let (found, stroke) = split_stroke(prompt);
            assert_eq!(
                (&*found, stroke.map(|stroke| stroke.bearing)),
                (rest, Some(bearing)),
                "{prompt}"
            );
        }
    }

    #[test]
    fn every_noun_has_a_material_with_a_direction() {
        assert_eq!(include_str!("axis_nouns.tsv").lines().count(), 1 + 20);
        for noun in NOUNS.iter() {
            let found = crate::learned::direction::materials().any(|name| name == noun.like);
            assert!(found, "{noun:?}");
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
            "before you gut the bream, run a finger against the scales",
        ] {
            assert_eq!(split_stroke(prompt), (prompt.into(), None), "{prompt}");
        }
    }
}
