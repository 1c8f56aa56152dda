//! Tokens divided where letters and digits meet: "60a" is 60 and a, "#80" is # and 80.

use crate::words::Token;

/// A run of letters, digits or signs of a token; an empty one for a mark between clauses.
#[derive(Debug, Clone, Copy)]
struct Part<'a> {
    text: &'a str,
    /// Tokens up to here, if this part ends one.
    tokens: Option<usize>,
}

/// Tokens that are looked at.
const MOST: usize = 10;

/// A place in the parts of a text; reading moves it where it succeeds.
#[derive(Debug, Clone)]
pub(super) struct Parts<'a> {
    all: Vec<Part<'a>>,
    at: usize,
    /// True if a space or a point may group thousands.
    pub(super) grouped: bool,
}

impl<'a> Parts<'a> {
    pub(super) fn new(tokens: &'a [Token], grouped: bool) -> Self {
        let mut all = Vec::new();
        for (n, token) in tokens.iter().take(MOST).enumerate() {
            let mut rest = match token {
                // A hyphen before a number that comes first is rather a dash: "sandpaper -80 grit".
                Token::Word(word) if n == 0 => word.trim_start_matches('-'),
                Token::Word(word) => word.as_str(),
                Token::Break(_) => "",
            };
            loop {
                let end = run(rest);
                let (text, after) = rest.split_at(end);
                let tokens = after.is_empty().then_some(n + 1);
                all.push(Part { text, tokens });
                rest = after;
                if rest.is_empty() {
                    break;
                }
            }
        }
        Self {
            all,
            at: 0,
            grouped,
        }
    }

    fn part(&self) -> Option<Part<'a>> {
        self.all.get(self.at).copied()
    }

    /// The next part.
    pub(super) fn text(&self) -> Option<&'a str> {
        Some(self.part()?.text)
    }

    /// Returns true if the next part belongs to the same token.
    pub(super) fn is_glued(&self) -> bool {
        self.at
            .checked_sub(1)
            .is_some_and(|before| self.all[before].tokens.is_none())
    }

    /// Passes over a part.
    pub(super) fn next(&mut self) {
        self.at += 1;
    }

    /// Reads one of these words.
    pub(super) fn eat(&mut self, words: &[&str]) -> bool {
        let found = self.part().is_some_and(|part| words.contains(&part.text));
        self.at += usize::from(found);
        found
    }

    /// Reads these words, one after the other.
    pub(super) fn eat_all(&mut self, words: &[&str]) -> bool {
        let start = self.at;
        let found = words.iter().all(|word| self.eat(&[word]));
        if !found {
            self.at = start;
        }
        found
    }

    /// Passes over any of these words, and over marks.
    pub(super) fn pass(&mut self, words: &[&str]) {
        while self.eat(&[""]) || self.eat(words) {}
    }

    /// The letter that follows a number without a space.
    pub(super) fn glued_letter(&mut self, letters: &[&'static str]) -> Option<&'static str> {
        let text = self.part().filter(|_| self.is_glued())?.text;
        let found = letters.iter().find(|letter| **letter == text)?;
        self.at += 1;
        Some(found)
    }

    /// Number of whole tokens that were read.
    pub(super) fn tokens(&self) -> Option<usize> {
        self.all.get(self.at.checked_sub(1)?)?.tokens
    }
}

/// Bytes of the first run of one kind.
fn run(text: &str) -> usize {
    let digit = |c: char| c.is_ascii_digit() || ['.', ',', '/'].contains(&c);
    let mut characters = text.char_indices();
    let Some((_, first)) = characters.next() else {
        return 0;
    };
    let kind = |c: char| (digit(c), c.is_alphabetic());
    let end = characters.find(|(_, c)| kind(*c) != kind(first));
    end.map_or(text.len(), |(end, _)| end)
}
