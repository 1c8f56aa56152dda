//! Words that a prompt may hold, for suggestions while someone types one.

use super::phrase;
use asperity_language::lexicon;

/// Names of materials and things, and the qualities that the grammar or the lexicon knows: in lower case but for
/// proper names, sorted, each once.
#[must_use]
pub fn suggestions() -> Vec<&'static str> {
    let mut words: Vec<&str> = lexicon::names()
        .chain(lexicon::qualities())
        .chain(phrase::quality_words())
        .collect();
    words.sort_unstable();
    words.dedup();
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_and_qualities_are_suggested_once_each() {
        let words = suggestions();
        for word in ["cork", "80-grit sandpaper", "bumpy", "bristly", "battered"] {
            assert_eq!(words.iter().filter(|w| **w == word).count(), 1, "{word}");
        }
        assert!(words.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(
            words
                .iter()
                .all(|word| !word.is_empty() && !word.contains('\t'))
        );
    }
}
