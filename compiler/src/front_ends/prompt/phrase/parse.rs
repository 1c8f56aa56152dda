//! A prompt into what it is about and what changes it.

use super::{
    Change, Changes, Phrase,
    table::{self, LITTLE, NOT, NOT_AT_ALL, NOT_VERY, PLAIN, Range, Signs, VERY},
};

/// Words that name nothing by themselves.
const EMPTY: [&str; 24] = [
    "a",
    "an",
    "the",
    "some",
    "any",
    "something",
    "anything",
    "thing",
    "one",
    "ones",
    "it",
    "its",
    "of",
    "kind",
    "sort",
    "piece",
    "bits",
    "parts",
    "is",
    "are",
    "at",
    "all",
    "and",
    "only",
];

/// Divides a prompt.
#[must_use]
pub fn parse(prompt: &str) -> Phrase {
    let words = words(prompt);
    between(&words)
        .or_else(|| covered(&words))
        .or_else(|| changed(&words))
        .unwrap_or(Phrase::Plain)
}

/// Lower-case words; "isn't" is "is not".
fn words(prompt: &str) -> Vec<String> {
    let lower = prompt.to_lowercase().replace('’', "'");
    let mut words = Vec::new();
    for word in lower.split(|c: char| !(c.is_alphanumeric() || c == '\'')) {
        match word.strip_suffix("n't") {
            Some(verb) => words.extend([verb.to_owned(), "not".to_owned()]),
            None if word.is_empty() => {}
            None => words.push(word.trim_matches('\'').to_owned()),
        }
    }
    words
}

/// A text of words that name something; `None` where nothing is named.
fn thing(words: &[String]) -> Option<String> {
    let named = |word: &&String| !EMPTY.contains(&word.as_str());
    words.iter().find(named)?;
    Some(words.join(" "))
}

/// "between A and B", "halfway from A to B".
fn between(words: &[String]) -> Option<Phrase> {
    let start = words.iter().position(|word| word == "between")?;
    let after = &words[start + 1..];
    let middle = after.iter().position(|word| word == "and")?;
    Some(Phrase::Between(
        thing(&after[..middle])?,
        thing(&after[middle + 1..])?,
    ))
}

/// "A covered with B".
fn covered(words: &[String]) -> Option<Phrase> {
    const VERBS: [&str; 6] = [
        "covered",
        "coated",
        "wrapped",
        "clad",
        "upholstered",
        "lined",
    ];
    let verb = words
        .iter()
        .position(|word| VERBS.contains(&word.as_str()))?;
    let joined = words.get(verb + 1)?;
    if !["with", "in", "by"].contains(&joined.as_str()) {
        return None;
    }
    let inside = words[..verb]
        .iter()
        .filter(|word| *word != "thinly" && *word != "thickly");
    let cover = &words[verb + 2..];
    // What covers may be a quality: "covered with bumps".
    if cover.last().is_some_and(|word| table::noun(word).is_some()) {
        return None;
    }
    Some(Phrase::Covered {
        inside: thing(&inside.cloned().collect::<Vec<_>>())?,
        cover: thing(cover)?,
    })
}

/// A quality that was found, and the words that it took.
struct Found {
    signs: Signs,
    range: Range,
    /// Words from..to.
    from: usize,
    to: usize,
}

fn changed(words: &[String]) -> Option<Phrase> {
    let mut changes = Changes::default();
    let mut base: Vec<String> = Vec::new();
    let mut any = false;
    let mut at = 0;
    while at < words.len() {
        if let Some(found) = quality(words, at) {
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
    if !any {
        return None;
    }
    let base = tidy(base);
    Some(Phrase::Changed {
        base: thing(&base)?,
        changes,
    })
}

/// The quality whose adjective stands here, or whose noun follows "without" here.
fn quality(words: &[String], at: usize) -> Option<Found> {
    let word = words[at].as_str();
    if word == "without" || word == "no" || word == "lacking" {
        return lacked(words, at);
    }
    let (signs, compared) = match table::adjective(word) {
        Some(signs) => (signs, false),
        None => (table::compared(word)?, true),
    };
    let (mut from, mut to) = (at, at + 1);
    let mut range = PLAIN;
    let mut denied = false;
    let mut stressed = false;
    let mut less = false;
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
            _ => match table::degree(word) {
                Some(found) => range = found,
                None => break,
            },
        }
        from = before;
    }
    if words.get(to).is_some_and(|word| word == "at")
        && words.get(to + 1).is_some_and(|w| w == "all")
    {
        to += 2;
        if denied {
            return Some(Found {
                signs,
                range: NOT_AT_ALL,
                from,
                to,
            });
        }
    }
    if denied && stressed {
        range = NOT_AT_ALL;
    } else if denied {
        range = if range == VERY { NOT_VERY } else { NOT };
    } else if less {
        range = (-range.1, -range.0);
    }
    if compared && words.get(to).is_some_and(|word| word == "than") {
        // "a rougher cloth than X": what is compared with follows.
        to += 1;
    }
    Some(Found {
        signs,
        range,
        from,
        to,
    })
}

/// "without its roughness", "that has no tread".
fn lacked(words: &[String], at: usize) -> Option<Found> {
    let mut to = at + 1;
    while words
        .get(to)
        .is_some_and(|word| EMPTY.contains(&word.as_str()))
    {
        to += 1;
    }
    let word = words.get(to)?;
    let signs = table::noun(word).or_else(|| table::adjective(word))?;
    Some(Found {
        signs,
        range: NOT,
        from: at,
        to: to + 1,
    })
}

fn apply(changes: &mut Changes, found: &Found) {
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

/// The base without what only joined it to its changes.
fn tidy(mut base: Vec<String>) -> Vec<String> {
    // "a cloth than denim" after "rougher" was taken out, "something than paper".
    if let Some(than) = base.iter().position(|word| word == "than") {
        base.drain(..=than);
    }
    const LEADING: [&str; 14] = [
        "something",
        "anything",
        "like",
        "as",
        "but",
        "only",
        "feels",
        "and",
        "if",
        "just",
        "than",
        "more",
        "less",
        "is",
    ];
    while base.len() > 1 && LEADING.contains(&base[0].as_str()) {
        base.remove(0);
    }
    const TRAILING: [&str; 22] = [
        "but", "and", "that", "which", "is", "are", "has", "have", "had", "with", "its", "only",
        "feels", "yet", "though", "was", "does", "do", "it", "gone", "turned", "any",
    ];
    while base
        .last()
        .is_some_and(|word| TRAILING.contains(&word.as_str()))
    {
        base.pop();
    }
    base
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signs(prompt: &str) -> (String, [f64; 3]) {
        let Phrase::Changed { base, changes } = parse(prompt) else {
            panic!("{prompt}: {:?}", parse(prompt));
        };
        let middle =
            |change: Option<Change>| change.map_or(0.0, |c| (0.5 * (c.least + c.most)).signum());
        (
            base,
            [changes.rough, changes.slippery, changes.hard].map(middle),
        )
    }

    #[test]
    fn a_base_and_the_way_that_each_attribute_goes() {
        for (prompt, base, expected) in [
            ("hard velvet", "velvet", [0.0, 0.0, 1.0]),
            ("very rough sandpaper", "sandpaper", [1.0, 0.0, 0.0]),
            ("foam, but firmer", "foam", [0.0, 0.0, 1.0]),
            ("like silk but grippier", "silk", [0.0, -1.0, 0.0]),
            ("rougher than paper", "paper", [1.0, 0.0, 0.0]),
            (
                "something more slippery than rubber",
                "rubber",
                [0.0, 1.0, 0.0],
            ),
            ("a coarser cloth than denim", "denim", [1.0, 0.0, 0.0]),
            (
                "a towel that isn't rough at all",
                "a towel",
                [-1.0, 0.0, 0.0],
            ),
            ("wood without its roughness", "wood", [-1.0, 0.0, 0.0]),
            ("a sole that has no grip", "a sole", [0.0, 1.0, 0.0]),
            ("less gritty sandpaper", "sandpaper", [-1.0, 0.0, 0.0]),
            ("polished stone", "stone", [-1.0, 1.0, 0.0]),
        ] {
            assert_eq!(signs(prompt), (base.to_owned(), expected), "{prompt}");
        }
    }

    #[test]
    fn degrees_are_in_order() {
        let degrees = [
            "cloth that is not at all rough",
            "cloth that is not rough",
            "hardly rough cloth",
            "slightly rough cloth",
            "fairly rough cloth",
            "rough cloth",
            "very rough cloth",
            "extremely rough cloth",
        ];
        let ranges = degrees.map(|prompt| match parse(prompt) {
            Phrase::Changed { changes, .. } => changes.rough.expect(prompt),
            other => panic!("{prompt}: {other:?}"),
        });
        for (pair, names) in ranges.windows(2).zip(degrees.windows(2)) {
            assert!(pair[0].most < pair[1].least, "{names:?}");
        }
    }

    #[test]
    fn two_things() {
        assert_eq!(
            parse("halfway between towel and whiteboard"),
            Phrase::Between("towel".into(), "whiteboard".into())
        );
        assert_eq!(
            parse("wood covered with wax"),
            Phrase::Covered {
                inside: "wood".into(),
                cover: "wax".into()
            }
        );
    }

    #[test]
    fn what_is_only_a_thing_or_only_a_quality_is_left_to_the_vector() {
        for prompt in [
            "cork",
            "something rough",
            "rough",
            "",
            "the space between",
            "coated",
            "between and",
        ] {
            assert_eq!(parse(prompt), Phrase::Plain, "{prompt}");
        }
    }
}
