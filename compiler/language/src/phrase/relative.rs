//! Parsing of edits in words: "less gritty, more waxy", "a bit softer, more like leather".

use super::{
    Changes,
    quality::{self, Use},
    table,
};
use crate::{
    lexicon::closed_class::is,
    words::{Token, normalise},
};

/// A parsed edit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Relative {
    /// Where attributes go from the texture at hand.
    pub changes: Changes,
    /// A material that it becomes more like.
    pub towards: Option<Towards>,
    /// Words that say something that is not understood.
    pub unread: Vec<String>,
}

/// A material that a texture becomes more like.
#[derive(Debug, Clone, PartialEq)]
pub struct Towards {
    /// The material.
    pub thing: String,
    /// The way to it, up to 1; negative for away from it.
    pub share: f64,
}

impl Relative {
    /// Returns true if the edit asks for nothing.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        self.changes == Changes::default() && self.towards.is_none()
    }
}

/// Shares of the way to a material: with a weak degree, without a degree, with a strong one.
const SHARE: (f64, f64, f64) = (0.25, 0.5, 0.75);
/// Reads an edit.
#[must_use]
pub fn relative(text: &str) -> Relative {
    // "more like silk, firmer": the material ends at a comma.
    let words: Vec<String> = normalise(text)
        .into_iter()
        .map(|token| match token {
            Token::Word(word) => word,
            Token::Break(_) => "and".into(),
        })
        .collect();
    let (head, towards) = towards(&words);
    let (changes, rest) =
        quality::divide(&head, Use::Edit).unwrap_or_else(|| (Changes::default(), head.clone()));
    let says = |word: &String| !is(word, &["filler"]) && table::degree(word).is_none();
    Relative {
        changes,
        towards,
        unread: rest.into_iter().filter(says).collect(),
    }
}

/// "more like leather", "closer to silk", "towards wood": the words before it, and the material.
fn towards(words: &[String]) -> (Vec<String>, Option<Towards>) {
    let place = |n: usize| words.get(n).map(String::as_str);
    let found = (0..words.len()).find_map(|n| match (place(n)?, place(n + 1)) {
        // "I would like it softer" and "like it was sanded" are no likenesses.
        ("like", Some(next)) if next != "it" => {
            let wish = n > 0 && ["would", "i", "i'd"].contains(&place(n - 1)?);
            (!wish).then_some((n, n + 1))
        }
        ("closer" | "nearer" | "halfway", Some("to")) => Some((n, n + 2)),
        ("towards" | "toward" | "resembling", Some(_)) => Some((n, n + 1)),
        _ => None,
    });
    let Some((mut from, to)) = found else {
        return (words.to_vec(), None);
    };
    // A likeness ends where the next change begins.
    let ends = |word: &String| ["but", "and", "with"].contains(&word.as_str());
    let end = words[to..]
        .iter()
        .position(ends)
        .map_or(words.len(), |n| to + n);
    let thing = words[to..end].join(" ");
    if thing.is_empty() {
        return (words.to_vec(), None);
    }
    let mut share = SHARE.1;
    while let Some(before) = from.checked_sub(1) {
        match (words[before].as_str(), table::degree(&words[before])) {
            (_, Some(range)) if range.1 < 1.0 => share = SHARE.0.copysign(share),
            (_, Some(_)) => share = SHARE.2.copysign(share),
            // Away from a material leads out of the known ones, so not far.
            ("less", None) => share = -SHARE.0,
            ("more" | "a" | "rather", None) => {}
            _ => break,
        }
        from = before;
    }
    let head = [&words[..from], &words[end..]].concat();
    (head, Some(Towards { thing, share }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signs(text: &str) -> [f64; 3] {
        let changes = relative(text).changes;
        [changes.rough, changes.slippery, changes.hard]
            .map(|change| change.map_or(0.0, |c| (c.least + c.most).signum()))
    }

    #[test]
    fn each_attribute_goes_where_the_words_say() {
        for (text, expected) in [
            ("less gritty, more waxy", [-1.0, 1.0, 0.0]),
            ("make it a bit rougher", [1.0, 0.0, 0.0]),
            ("too slippery", [0.0, -1.0, 0.0]),
            ("not hard enough", [0.0, 0.0, 1.0]),
            ("it isn't soft enough", [0.0, 0.0, -1.0]),
            ("add some grit and reduce the friction", [1.0, 1.0, 0.0]),
            ("turn the friction down a little", [0.0, 1.0, 0.0]),
            ("turn up the grip", [0.0, -1.0, 0.0]),
            ("much firmer, slightly smoother", [-1.0, 0.0, 1.0]),
            ("I would like it softer", [0.0, 0.0, -1.0]),
            ("make the vibration weaker", [-1.0, 0.0, 0.0]),
            ("not so rough", [-1.0, 0.0, 0.0]),
            ("without the stickiness", [0.0, 1.0, 0.0]),
            ("not as hard", [0.0, 0.0, -1.0]),
            ("twice as hard", [0.0, 0.0, 1.0]),
            ("half as hard", [0.0, 0.0, -1.0]),
        ] {
            assert_eq!(signs(text), expected, "{text}");
        }
    }

    #[test]
    fn degrees_are_in_order_before_and_after() {
        let far = |text: &str| relative(text).changes.hard.expect(text).least;
        for [little, plain, much] in [
            ["a bit harder", "harder", "much harder"],
            ["harder, but only slightly", "harder", "harder by a lot"],
        ] {
            assert!(
                far(little) < far(plain) && far(plain) < far(much),
                "{plain}"
            );
        }
        assert!(far("less hard by a lot") < far("less hard"));
        assert!(far("less hard") < far("less hard, but only slightly"));
    }

    #[test]
    fn a_likeness_is_a_way_to_a_thing() {
        let found = relative("softer and a lot more like suede leather");
        let towards = found.towards.expect("a likeness");
        assert_eq!(
            (towards.thing.as_str(), towards.share),
            ("suede leather", 0.75)
        );
        assert!(found.changes.hard.is_some() && found.unread.is_empty());
        let comma = relative("more like silk, firmer");
        assert_eq!(comma.towards.map(|t| t.thing).as_deref(), Some("silk"));
        assert!(comma.changes.hard.is_some());
        assert!(relative("I would like it smoother").towards.is_none());
    }

    #[test]
    fn what_is_not_understood_is_named() {
        let found = relative("make it more purple");
        assert!(found.is_nothing());
        assert_eq!(found.unread, ["purple"]);
        assert!(relative("").is_nothing());
    }

    /// Claim: a likeness names its material, whichever words lead to it.
    #[test]
    fn a_likeness_names_its_material() {
        for text in [
            "more like silk",
            "closer to silk",
            "nearer to silk",
            "halfway to silk",
            "towards silk",
            "resembling silk",
        ] {
            let towards = relative(text).towards.expect(text);
            assert_eq!(towards.thing, "silk", "{text}");
        }
    }
}
