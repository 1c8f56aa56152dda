//! Qualities in a text: "very rough", "not at all slippery", "without its grit", "more grip".

use crate::lexicon::closed_class::is;

use super::{
    Change, Changes,
    table::{self, LITTLE, NOT, NOT_AT_ALL, NOT_VERY, PLAIN, Range, Signs, VERY},
};

/// Subject of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    /// A material, which a prompt names beside its qualities.
    Thing,
    /// An edit of a texture at hand. More words count, and "too rough" asks for less.
    Edit,
}

/// Words between a direction and its noun: "more of the grip", "add some grit".
const BETWEEN: [&str; 10] = [
    "of", "the", "its", "a", "an", "any", "some", "in", "that", "all",
];

/// Returns true for a quality, plain, compared or as a noun: "rough", "rougher", "grit".
#[must_use]
pub fn is_quality(word: &str) -> bool {
    adjective(word, Use::Thing).is_some()
        || compared(word, Use::Thing).is_some()
        || table::noun(word).is_some()
}

/// Returns true for a quality that is inherent to a material, not the result of a process.
#[must_use]
pub fn is_lasting(word: &str) -> bool {
    table::adjective(word).is_some()
        || table::compared(word, table::adjective).is_some()
        || table::noun(word).is_some()
}

/// Returns true for an adjective or a state, of a material or in an edit: "wet".
#[must_use]
pub fn is_adjective(word: &str) -> bool {
    adjective(word, Use::Edit).is_some() || compared(word, Use::Edit).is_some()
}

/// Strength of a word of degree, 1 for none: "very" above, "slightly" below it.
#[must_use]
pub fn degree(word: &str) -> Option<f64> {
    let (least, most) = table::degree(word)?;
    Some((least + most) / (PLAIN.0 + PLAIN.1))
}

/// Returns true for a word of degree: "very", "slightly".
#[must_use]
pub fn is_degree(word: &str) -> bool {
    table::degree(word).is_some()
}

/// A quality that was found, and the words that it took.
struct QualityMatch {
    signs: Signs,
    range: Range,
    /// Words from..to.
    from: usize,
    to: usize,
}

/// Divides words into qualities and all others; `None` where there is no quality.
pub(super) fn divide(words: &[String], about: Use) -> Option<(Changes, Vec<String>)> {
    let mut changes = Changes::default();
    let mut base: Vec<String> = Vec::new();
    let mut any = false;
    let mut at = 0;
    while at < words.len() {
        if let Some(found) = quality(words, at, about) {
            apply(&mut changes, &found);
            any = true;
            // Words of degree and denial before it were taken already.
            let taken = at - found.from;
            base.truncate(base.len().saturating_sub(taken));
            at = found.to;
        } else {
            base.push(words[at].clone());
            at += 1;
        }
    }
    any.then_some((changes, base))
}

/// The quality whose adjective stands here, or whose noun follows "without" or "more" here.
fn quality(words: &[String], at: usize, about: Use) -> Option<QualityMatch> {
    let word = words[at].as_str();
    if ["without", "no", "lacking"].contains(&word) {
        return lacked(words, at, about);
    }
    if let Some(found) = directed(words, at, about) {
        return Some(found);
    }
    let (signs, compared) = match adjective(word, about) {
        Some(signs) => (signs, false),
        None => (compared(word, about)?, true),
    };
    let (mut from, mut to) = (at, at + 1);
    let mut range = PLAIN;
    let mut denied = false;
    let mut stressed = false;
    let mut less = false;
    let mut too = false;
    while let Some(before) = from.checked_sub(1) {
        let word = words[before].as_str();
        match word {
            // "not at all rough"
            "all" if before > 0 && words[before - 1] == "at" => stressed = true,
            "at" if stressed => {}
            "not" | "never" | "non" => denied = true,
            "more" => {}
            "less" | "least" => less = true,
            "a" if range == LITTLE => {}
            "being" | "be" if before > 0 && words[before - 1] == "without" => {}
            "without" => denied = true,
            // "as rough as bark", "not as rough", "twice as rough", "half as rough"
            "as" if words.get(to).is_some_and(|word| word == "as")
                || (before > 0
                    && ["not", "twice", "half"].contains(&words[before - 1].as_str())) =>
            {
                if before == 0 || !["twice", "half"].contains(&words[before - 1].as_str()) {
                    range = VERY;
                }
            }
            "half" if words[before + 1] == "as" => less = true,
            "too" if about == Use::Edit => too = true,
            _ => match table::degree_before(word) {
                // "ever so slightly": the nearest degree counts.
                Some(found) if range == PLAIN => range = found,
                Some(_) => {}
                None => break,
            },
        }
        from = before;
    }
    let next = |to: usize| words.get(to).map(String::as_str);
    if next(to) == Some("at") && next(to + 1) == Some("all") {
        to += 2;
        stressed |= denied;
    }
    if about == Use::Edit && next(to) == Some("enough") {
        // "not rough enough" asks for more.
        to += 1;
    } else if denied && stressed {
        range = NOT_AT_ALL;
    } else if denied {
        range = if range == VERY { NOT_VERY } else { NOT };
    } else if less || too {
        range = (-range.1, -range.0);
    }
    if compared && next(to) == Some("than") {
        // "a rougher cloth than X": what is compared with follows.
        to += 1;
    }
    // "stone as soft as a pillow" is no pillow.
    let named = |word: &String| !is(word, &["empty"]) && word != "yet" && word != "but";
    if next(to) == Some("as") && from < at && words[..from].iter().any(named) {
        let ends = |word: &String| ["and", "but", "with", "yet"].contains(&word.as_str());
        to = words[to..]
            .iter()
            .position(ends)
            .map_or(words.len(), |n| to + n);
    }
    let found = QualityMatch {
        signs,
        range,
        from,
        to,
    };
    Some(afterwards(words, found, about))
}

/// The degree that follows: "rougher by a lot", "softer, but only slightly".
fn afterwards(words: &[String], found: QualityMatch, about: Use) -> QualityMatch {
    if about != Use::Edit {
        return found;
    }
    const JOIN: [&str; 7] = ["and", "by", "but", "only", "just", "a", "though"];
    let mut to = found.to;
    while words
        .get(to)
        .is_some_and(|word| JOIN.contains(&word.as_str()))
    {
        to += 1;
    }
    let Some(range) = words.get(to).and_then(|word| table::degree(word)) else {
        return found;
    };
    // "rougher, much softer": the degree belongs to what follows.
    let follows = words.get(to + 1).is_some_and(|word| {
        word == "more"
            || word == "less"
            || adjective(word, about).is_some()
            || compared(word, about).is_some()
    });
    let less = (-PLAIN.1, -PLAIN.0);
    let range = match found.range {
        _ if follows || range.0 < 0.0 => return found,
        PLAIN => range,
        was if was == less => (-range.1, -range.0),
        _ => return found,
    };
    QualityMatch {
        range,
        to: to + 1,
        ..found
    }
}

/// "without its roughness", "that has no tread".
fn lacked(words: &[String], at: usize, about: Use) -> Option<QualityMatch> {
    let mut to = at + 1;
    // "without its grit", "without so much grip"
    while words.get(to).is_some_and(|word| {
        is(word, &["empty"]) || (about == Use::Edit && table::degree(word).is_some())
    }) {
        to += 1;
    }
    let word = words.get(to)?;
    let signs = noun(word, about).or_else(|| adjective(word, about))?;
    Some(QualityMatch {
        signs,
        range: NOT,
        from: at,
        to: to + 1,
    })
}

/// "more grip", "a bit less friction"; of an edit also "add some grit", "reduce the roughness".
fn directed(words: &[String], at: usize, about: Use) -> Option<QualityMatch> {
    // "iron with rust"
    let has = words[at] == "with" && about == Use::Thing;
    let up = match table::direction(&words[at], about == Use::Edit) {
        Some(up) => up,
        None if has => true,
        None => return turned(words, at, about),
    };
    let mut to = at + 1;
    let mut range = None;
    while let Some(word) = words.get(to) {
        if let Some(found) = table::degree(word).filter(|_| about == Use::Edit) {
            range = Some(found);
        } else if !BETWEEN.contains(&word.as_str()) {
            break;
        }
        to += 1;
    }
    // "more rough" is read from its adjective.
    let signs = words.get(to).and_then(|word| noun(word, about))?;
    let mut from = at;
    while let Some(before) = from.checked_sub(1) {
        match table::degree(&words[before]) {
            Some(found) => range = Some(found),
            None if words[before] == "a" && range == Some(LITTLE) => {}
            None => break,
        }
        from = before;
    }
    let (least, most) = range.filter(|range| range.0 > 0.0).unwrap_or(PLAIN);
    let range = if up { (least, most) } else { (-most, -least) };
    let found = QualityMatch {
        signs,
        range,
        from,
        to: to + 1,
    };
    Some(afterwards(words, found, about))
}

/// "the friction up", "grip down a little", of an edit alone.
fn turned(words: &[String], at: usize, about: Use) -> Option<QualityMatch> {
    let signs = noun(&words[at], about).filter(|_| about == Use::Edit)?;
    let range = match words.get(at + 1)?.as_str() {
        "up" | "higher" | "more" => PLAIN,
        "down" | "lower" | "less" => (-PLAIN.1, -PLAIN.0),
        _ => return None,
    };
    let found = QualityMatch {
        signs,
        range,
        from: at,
        to: at + 2,
    };
    Some(afterwards(words, found, about))
}

fn adjective(word: &str, about: Use) -> Option<Signs> {
    let edit = || table::edit_adjective(word).filter(|_| about == Use::Edit);
    table::adjective(word)
        .or_else(|| table::state(word))
        .or_else(edit)
}

fn compared(word: &str, about: Use) -> Option<Signs> {
    table::compared(word, |stem| adjective(stem, about))
}

fn noun(word: &str, about: Use) -> Option<Signs> {
    let edit = || table::edit_noun(word).filter(|_| about == Use::Edit);
    table::noun(word).or_else(edit)
}

fn apply(changes: &mut Changes, found: &QualityMatch) {
    let attributes = [&mut changes.rough, &mut changes.slippery, &mut changes.hard];
    for (change, sign) in attributes.into_iter().zip(found.signs) {
        if sign == 0 {
            continue;
        }
        let (least, most) = found.range;
        let new = if sign > 0 {
            Change { least, most }
        } else {
            Change {
                least: -most,
                most: -least,
            }
        };
        // The strongest word counts; they do not add up.
        let stronger = change.is_none_or(|old| strength(new) > strength(old));
        if stronger {
            *change = Some(new);
        }
    }
}

fn strength(change: Change) -> f64 {
    (change.least + change.most).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// "the friction up": as far as a plain comparative, in an edit alone.
    #[test]
    fn a_direction_behind_a_noun_turns_it() {
        let range = |second: &str, about: Use| {
            let words = ["friction", second].map(str::to_owned);
            turned(&words, 0, about).map(|found| found.range)
        };
        for up in ["up", "higher", "more"] {
            assert_eq!(range(up, Use::Edit), Some(PLAIN), "{up}");
            assert_eq!(range(up, Use::Thing), None, "{up}");
        }
        for down in ["down", "lower", "less"] {
            assert_eq!(range(down, Use::Edit), Some((-PLAIN.1, -PLAIN.0)), "{down}");
        }
        assert_eq!(range("sideways", Use::Edit), None);
    }

    /// Adjectives, their comparatives, and nouns of qualities; not states, into which something came.
    #[test]
    fn a_material_has_a_lasting_quality_by_itself() {
        let lasting = ["rough", "rougher", "roughness"].map(is_lasting);
        assert_eq!(lasting, [true; 3]);
        assert_eq!(["boiled", "towel", "very", ""].map(is_lasting), [false; 4]);
    }

    /// Claim: a denial of the degree, of the quality and of all of it go ever further.
    #[test]
    fn a_denial_is_as_far_as_it_is_stressed() {
        for (text, expected) in [
            ("rough", PLAIN),
            ("very rough", VERY),
            ("not rough", NOT),
            ("not very rough", NOT_VERY),
            ("not as rough", NOT_VERY),
            ("not rough at all", NOT_AT_ALL),
            ("not at all rough", NOT_AT_ALL),
        ] {
            let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
            let at = words
                .iter()
                .position(|word| word == "rough")
                .expect("rough");
            let found = quality(&words, at, Use::Thing).expect(text);
            assert_eq!(found.range, expected, "{text}");
        }
    }

    /// Claim: words that name a quality only where something is to be changed do so in edits alone, and a
    /// degree stands between "without" and its noun in edits alone.
    #[test]
    fn what_only_an_edit_says_is_read_in_edits_alone() {
        assert_eq!(noun("adhesion", Use::Thing), None);
        assert!(noun("adhesion", Use::Edit).is_some());
        assert_eq!(adjective("buzzy", Use::Thing), None);
        assert!(adjective("buzzy", Use::Edit).is_some());
        for word in ["bumps", "rough"] {
            let of = |about| noun(word, about).or_else(|| adjective(word, about));
            assert!(
                of(Use::Thing).is_some() && of(Use::Thing) == of(Use::Edit),
                "{word}"
            );
        }
        let words = ["without", "much", "bumps"].map(str::to_owned);
        let read = |about| lacked(&words, 0, about).map(|found| (found.range, found.to));
        assert_eq!(read(Use::Edit), Some((NOT, 3)));
        assert_eq!(read(Use::Thing), None);
    }

    /// Claim: "being" belongs to a denial before it, and to nothing else.
    #[test]
    fn without_being_is_a_denial() {
        let found = |text: &str| {
            let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
            let found = quality(&words, words.len() - 1, Use::Thing).expect(text);
            (found.from, found.range)
        };
        assert_eq!(found("without being rough"), (0, NOT));
        assert_eq!(found("without rough"), (0, NOT));
        assert_eq!(found("to be rough"), (2, PLAIN));
        assert_eq!(found("being rough"), (1, PLAIN));
    }

    /// Claim: more and less of a noun are each other's mirror.
    #[test]
    fn a_direction_before_a_noun_turns_it() {
        let range = |text: &str| {
            let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
            directed(&words, 0, Use::Edit).map(|found| found.range)
        };
        assert_eq!(range("more friction"), Some(PLAIN));
        assert_eq!(range("less friction"), Some((-PLAIN.1, -PLAIN.0)));
    }
}
