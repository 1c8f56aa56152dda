//! CLIP's tokenizer from `vocab.json` and `merges.txt`, padded as `tokenizer_config.json` says.

use crate::{
    error::{DiffusionError, Problem},
    folder::{MERGES, TOKENIZER_CONFIG, VOCABULARY},
    json,
};
use instant_clip_tokenizer::{Token, Tokenizer};
use serde::{
    Deserialize, Deserializer,
    de::{Error as _, MapAccess, Visitor},
};
use std::{collections::HashMap, fmt};

/// Tokens that CLIP reads, start and end marks included; shorter texts are padded.
pub const CONTEXT: usize = 77;
/// Names of the marks, the last two entries of a vocabulary.
const MARKS: [&str; 2] = ["<|startoftext|>", "<|endoftext|>"];
/// Bytes of a text that are read: far more than [`CONTEXT`] tokens have, and few enough that a
/// single word of that length takes no time.
const TEXT_BYTES: usize = 8192;
/// Tokens of single bytes, within a word and at its end.
const BYTES: usize = 512;

/// A tokenizer.
pub struct Tokens {
    tokenizer: Tokenizer,
    padding: i64,
}

/// A text as the text encoder reads it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Encoded {
    /// [`CONTEXT`] ids.
    pub ids: Vec<i64>,
    /// Tokens that did not fit, of the first 8 KiB.
    pub cut: usize,
}

/// Tokens and their ids. More than a tokenizer can have are refused before they are read.
struct Vocabulary(HashMap<String, u32>);

impl<'de> Deserialize<'de> for Vocabulary {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Tokens;

        impl<'de> Visitor<'de> for Tokens {
            type Value = Vocabulary;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("tokens with their ids")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Vocabulary, M::Error> {
                let mut tokens = HashMap::new();
                while let Some((token, id)) = map.next_entry()? {
                    if tokens.len() == usize::from(u16::MAX) {
                        return Err(M::Error::custom("there are more than 65535 tokens"));
                    }
                    tokens.insert(token, id);
                }
                Ok(Vocabulary(tokens))
            }
        }

        deserializer.deserialize_map(Tokens)
    }
}

#[derive(Deserialize)]
struct Settings {
    pad_token: Option<PadToken>,
    model_max_length: Option<f64>,
}

/// `"!"` or `{"content": "!", …}`.
#[derive(Deserialize)]
#[serde(untagged)]
enum PadToken {
    Plain(String),
    Added { content: String },
}

impl Tokens {
    /// Reads the three files of a tokenizer.
    ///
    /// # Errors
    /// [`DiffusionError`] for files that are not of one CLIP tokenizer: an id of the vocabulary
    /// must be the place of its merge.
    pub fn parse(
        vocabulary: &str,
        merges: &str,
        settings: Option<&str>,
    ) -> Result<Self, DiffusionError> {
        let Vocabulary(vocabulary) =
            json::parse(vocabulary).map_err(|problem| problem.of(VOCABULARY))?;
        // The header is optional; the tokenizer skips one line whatever it holds.
        let rules: Vec<&str> = merges
            .lines()
            .map(str::trim_end)
            .filter(|line| !line.is_empty() && !line.contains("#version"))
            .collect();
        let size = BYTES + rules.len() + MARKS.len();
        let Some(count) = u16::try_from(size)
            .ok()
            .filter(|_| vocabulary.len() == size)
        else {
            let text = format!(
                "{} tokens, and {MERGES} makes {size} of its {} merges; CLIP has 49408 of 48894",
                vocabulary.len(),
                rules.len()
            );
            return Err(Problem::Vocabulary(text).of(VOCABULARY));
        };
        check(&vocabulary, &rules)?;
        let text = format!("#version\n{}\n", rules.join("\n"));
        let tokenizer = Tokenizer::with_vocabulary(text.as_bytes(), count)
            .map_err(|error| Problem::Vocabulary(error.to_string()).of(MERGES))?;
        let end = MARKS[1].to_owned();
        let padding = match settings {
            Some(settings) => padding(settings)?.unwrap_or(end),
            None => end,
        };
        let Some(&id) = vocabulary.get(&padding) else {
            let problem = Problem::Field {
                field: "pad_token",
                found: format!("`{padding}`"),
                expected: format!("a token of {VOCABULARY}"),
            };
            return Err(problem.of(TOKENIZER_CONFIG));
        };
        Ok(Self {
            tokenizer,
            padding: id.into(),
        })
    }

    /// The ids of a text.
    #[must_use]
    pub fn encode(&self, text: &str) -> Encoded {
        let mut end = text.len().min(TEXT_BYTES);
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let mut found = Vec::new();
        self.tokenizer.encode(&text[..end], &mut found);
        let room = CONTEXT - MARKS.len();
        let cut = found.len().saturating_sub(room);
        found.truncate(room);
        let id = |token: Token| i64::from(token.to_u16());
        let mut ids = vec![id(self.tokenizer.start_of_text())];
        ids.extend(found.into_iter().map(id));
        ids.push(id(self.tokenizer.end_of_text()));
        ids.resize(CONTEXT, self.padding);
        Encoded { ids, cut }
    }
}

/// The padding token that the settings name.
fn padding(settings: &str) -> Result<Option<String>, DiffusionError> {
    let settings: Settings =
        json::parse(settings).map_err(|problem| problem.of(TOKENIZER_CONFIG))?;
    // Exporters write 1e30 where there is no limit.
    let length = settings.model_max_length.filter(|length| *length < 1e6);
    if let Some(length) = length.filter(|length| *length != CONTEXT as f64) {
        let problem = Problem::Field {
            field: "model_max_length",
            found: length.to_string(),
            expected: format!("{CONTEXT}, as CLIP reads"),
        };
        return Err(problem.of(TOKENIZER_CONFIG));
    }
    Ok(settings.pad_token.map(|token| match token {
        PadToken::Plain(content) | PadToken::Added { content } => content,
    }))
}

/// Compares every id of a vocabulary with the place that the merges give it.
fn check(vocabulary: &HashMap<String, u32>, rules: &[&str]) -> Result<(), DiffusionError> {
    let expect = |token: &str, id: usize| match vocabulary.get(token) {
        Some(&found) if found as usize == id => Ok(()),
        found => {
            let found = found.map_or("missing".to_owned(), |id| format!("token {id}"));
            let text = format!("`{token}` is {found}; {MERGES} makes it token {id}");
            Err(Problem::Vocabulary(text).of(VOCABULARY))
        }
    };
    for (id, letter) in byte_letters().enumerate() {
        expect(&letter.to_string(), id)?;
        expect(&format!("{letter}</w>"), id + BYTES / 2)?;
    }
    for (n, rule) in rules.iter().enumerate() {
        let mut parts = rule.split_whitespace();
        let (Some(first), Some(second), None) = (parts.next(), parts.next(), parts.next()) else {
            let text = format!("merge {} is `{rule}`, not two tokens", n + 1);
            return Err(Problem::Vocabulary(text).of(MERGES));
        };
        expect(&format!("{first}{second}"), BYTES + n)?;
    }
    for (n, mark) in MARKS.into_iter().enumerate() {
        expect(mark, BYTES + rules.len() + n)?;
    }
    Ok(())
}

/// The letter of each byte: itself where it can be printed, else one from 256 on.
pub(crate) fn byte_letters() -> impl Iterator<Item = char> {
    let printed = ('!'..='~').chain('¡'..='¬').chain('®'..='ÿ');
    printed.chain('\u{100}'..='\u{143}')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tiny;

    fn file(part: &str) -> String {
        let files = tiny::folder(&tiny::Options::default());
        let (_, bytes) = files.into_iter().find(|(name, _)| *name == part).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    fn tokens(settings: Option<&str>) -> Result<Tokens, DiffusionError> {
        Tokens::parse(&file(VOCABULARY), &file(MERGES), settings)
    }

    #[test]
    fn a_letter_stands_for_every_byte() {
        assert_eq!(byte_letters().count(), BYTES / 2);
    }

    #[test]
    fn texts_are_marked_padded_and_cut() {
        let tokens = tokens(None).unwrap();
        let end = i64::try_from(BYTES + tiny::MERGES.len() + 1).unwrap();
        let encoded = tokens.encode("Cork");
        // c, o, r, k</w> merge to "cork</w>", the last merge of the tiny folder.
        assert_eq!(encoded.ids[..3], [end - 1, end - 2, end]);
        assert_eq!(encoded.ids.len(), CONTEXT);
        assert!(encoded.ids[3..].iter().all(|id| *id == end));
        assert_eq!(encoded.cut, 0);
        let long = tokens.encode(&"cork ".repeat(100));
        assert_eq!((long.ids.len(), long.cut), (CONTEXT, 25));
        assert_eq!(long.ids[CONTEXT - 1], end);
    }

    #[test]
    fn padding_is_what_the_settings_say() {
        for settings in [
            r#"{"pad_token": "!"}"#,
            r#"{"pad_token": {"content": "!"}, "model_max_length": 77}"#,
        ] {
            assert_eq!(tokens(Some(settings)).unwrap().encode("").ids[2..], [0; 75]);
        }
        let wrong = |settings| tokens(Some(settings)).err().unwrap().to_string();
        assert!(wrong(r#"{"pad_token": "<pad>"}"#).contains("pad_token"));
        assert!(wrong(r#"{"model_max_length": 512}"#).contains("77"));
        assert!(wrong("[").starts_with("tokenizer/tokenizer_config.json"));
    }

    #[test]
    fn a_vocabulary_that_does_not_fit_is_refused() {
        let wrong = |vocabulary: &str, merges: &str| {
            let error = Tokens::parse(vocabulary, merges, None).err().unwrap();
            error.to_string()
        };
        let (vocabulary, merges) = (file(VOCABULARY), file(MERGES));
        let swapped = merges.replace("c o\nr k</w>", "r k</w>\nc o");
        assert_ne!(swapped, merges);
        assert!(wrong(&vocabulary, &swapped).contains("makes it token 512"));
        let shorter = merges.replace("c o\n", "");
        assert!(wrong(&vocabulary, &shorter).contains("merges"));
        assert!(wrong("{}", &merges).contains("0 tokens"));
        assert!(wrong(&vocabulary, "").contains("0 merges"));
        let many: Vec<String> = (0..70_000).map(|n| format!("\"{n}\":{n}")).collect();
        let many = format!("{{{}}}", many.join(","));
        assert!(wrong(&many, &merges).contains("more than 65535 tokens"));
        let long = "a b\n".repeat(70_000);
        assert!(wrong(&vocabulary, &long).contains("70000 merges"));
        let three = merges.replace("c o\n", "c o o\n");
        assert!(wrong(&vocabulary, &three).contains("not two tokens"));
    }
}
