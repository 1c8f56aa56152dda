//! A prompt into what it is about and what changes it.

use crate::{lexicon::closed_class::is, words::grade::Grade};

use super::{
    Phrase, compound,
    quality::{self, Use},
    table,
};

/// Divides the words of a prompt. A name of several words is one of them, so that none of its own
/// changes it.
#[must_use]
pub fn parse(words: &[String]) -> Phrase {
    between(words)
        .or_else(|| covered(words))
        .or_else(|| changed(words))
        .or_else(|| graded(words))
        .or_else(|| compound::made(words))
        .or_else(|| compound::part(words))
        .unwrap_or(Phrase::Plain)
}

/// A text of words that name something; `None` where nothing is named.
fn thing(words: &[String]) -> Option<String> {
    let named = |word: &&String| !is(word, &["empty"]);
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

/// Returns true if a participle says that one object covers another.
#[must_use]
pub fn is_cover(word: &str) -> bool {
    const VERBS: [&str; 6] = [
        "covered",
        "coated",
        "wrapped",
        "clad",
        "upholstered",
        "lined",
    ];
    VERBS.contains(&word)
}

/// "A covered with B".
fn covered(words: &[String]) -> Option<Phrase> {
    let verb = words.iter().position(|word| is_cover(word))?;
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

fn changed(words: &[String]) -> Option<Phrase> {
    let (changes, base) = quality::divide(words, Use::Thing)?;
    Some(Phrase::Changed {
        base: thing(&tidy(base))?,
        changes,
    })
}

/// "P80 sandpaper", "rubber of Shore A 60". A number by itself says what it is of.
fn graded(words: &[String]) -> Option<Phrase> {
    let mut base = words.to_vec();
    let grades: Vec<Grade> = words.iter().filter_map(|word| Grade::of(word)).collect();
    let first = grades.first()?;
    base.retain(|word| Grade::of(word).is_none());
    let base = thing(&tidy(base)).unwrap_or_else(|| first.thing().to_owned());
    Some(Phrase::Graded { base, grades })
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
    let leads = |word: &&String| LEADING.contains(&word.as_str());
    let leading = base.iter().take_while(leads).count();
    base.drain(..leading.min(base.len().saturating_sub(1)));
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
    use super::{super::Change, *};
    use crate::words::normalise;

    fn parse(prompt: &str) -> Phrase {
        let tokens = normalise(prompt).into_iter();
        let words = tokens.filter_map(|token| token.word().map(str::to_owned));
        super::parse(&words.collect::<Vec<_>>())
    }

    /// The base, and where rough, slippery and hard go.
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
            ("rubber with less grip", "rubber", [0.0, 1.0, 0.0]),
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
