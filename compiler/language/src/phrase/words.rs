//! The words of a text.

/// Words that name nothing by themselves.
pub(super) const EMPTY: [&str; 24] = [
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

/// Lower-case words; "isn't" is "is not".
pub(super) fn words(prompt: &str) -> Vec<String> {
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
