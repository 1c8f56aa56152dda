//! A prompt as words: what is typed in different ways becomes the same.

use std::borrow::Cow;
use unicode_normalization::UnicodeNormalization as _;

/// A word, or a mark that divides clauses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Token {
    /// A lower-case word in British spelling.
    Word(String),
    /// A comma, a bracket, a full stop, a line.
    Break,
}

/// American spellings, and the British ones that the corpus has.
const SPELLINGS: &str = include_str!("spellings.tsv");
/// Pictures that name a material, and its name.
const EMOJI: [(char, &str); 17] = [
    ('🧱', "brick"),
    ('🪨', "rock"),
    ('🪵', "wood"),
    ('🧊', "ice"),
    ('🧽', "sponge"),
    ('🪶', "feather"),
    ('🧶', "wool"),
    ('🍫', "chocolate"),
    ('🍞', "bread"),
    ('🧀', "cheese"),
    ('🥥', "coconut"),
    ('🍑', "peach"),
    ('🍂', "dead leaves"),
    ('🌵', "cactus"),
    ('🐚', "seashell"),
    ('🪞', "mirror"),
    ('🧻', "toilet paper"),
];

/// Divides a prompt into words: compatibility forms (NFKC) in lower case, without marks that show
/// nothing, with one apostrophe, in British spelling. "isn't" is "is not".
#[must_use]
pub fn normalise(prompt: &str) -> Vec<Token> {
    let text = shown(prompt).nfkc().collect::<String>().to_lowercase();
    let mut tokens = Vec::new();
    let mut word = String::new();
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        let digit = characters.peek().is_some_and(char::is_ascii_digit);
        match character {
            '’' | '‘' | 'ʼ' | '`' | '´' | '\'' => word.push('\''),
            _ if character.is_alphanumeric() || is_accent(character) => word.push(character),
            // "#80" is a grit, "#cork" a word.
            '#' if word.is_empty() && digit => word.push('#'),
            // "1,000" and "0,8"
            ',' if digit && is_grouped(&word, characters.clone()) => {}
            ',' if digit && word == "0" => word.push('.'),
            // "2.5"
            '.' if digit && word.ends_with(|c: char| c.is_ascii_digit()) => word.push('.'),
            _ => {
                end(&mut word, &mut tokens);
                let divides = matches!(
                    character,
                    ',' | ';' | ':' | '.' | '!' | '?' | '(' | ')' | '[' | ']' | '\n' | '–' | '—'
                );
                if divides && tokens.last().is_some_and(|last| *last != Token::Break) {
                    tokens.push(Token::Break);
                }
            }
        }
    }
    end(&mut word, &mut tokens);
    while tokens.last() == Some(&Token::Break) {
        tokens.pop();
    }
    tokens
}

/// A prompt without the characters that show nothing and join nothing, and with the names of what
/// pictures show.
#[must_use]
pub fn shown(prompt: &str) -> String {
    let hidden = |c: &char| {
        matches!(*c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
            || (c.is_control() && !c.is_whitespace())
    };
    let mut text = String::with_capacity(prompt.len());
    for character in prompt.chars().filter(|c| !hidden(c)) {
        match EMOJI.iter().find(|(emoji, _)| *emoji == character) {
            Some((_, name)) => text.extend([" ", name, " "]),
            None => text.push(character),
        }
    }
    text
}

/// Whether a comma after these digits groups thousands: three digits follow it.
fn is_grouped(before: &str, after: impl Iterator<Item = char>) -> bool {
    let digits = after.take_while(char::is_ascii_digit).count();
    let group = (1..=3).contains(&before.len()) && !before.starts_with('0');
    group && digits == 3 && before.bytes().all(|byte| byte.is_ascii_digit())
}

fn is_accent(character: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&character)
}

fn end(word: &mut String, tokens: &mut Vec<Token>) {
    let raw = std::mem::take(word);
    let said = raw.trim_matches('\'');
    let mut push = |word: &str| tokens.push(Token::Word(spelled(word).into_owned()));
    match said.strip_suffix("n't") {
        Some(verb) => {
            push(match verb {
                "ca" => "can",
                "wo" => "will",
                _ => verb,
            });
            push("not");
        }
        None if said.is_empty() => {}
        None => push(said),
    }
}

/// A word in British spelling.
fn spelled(word: &str) -> Cow<'_, str> {
    let line = |line: &'static str| line.split_once('\t');
    let found = SPELLINGS.lines().filter_map(line);
    let british = |stem: &str| {
        let mut found = found.clone();
        found.find_map(|(american, british)| (american == stem).then_some(british))
    };
    if let Some(british) = british(word) {
        return british.into();
    }
    match word.strip_suffix('s').and_then(british) {
        Some(british) => format!("{british}s").into(),
        None => word.into(),
    }
}

/// A word in the singular, by its ending: the key of a name, never what an encoder sees.
#[must_use]
pub(crate) fn singular(word: &str) -> Cow<'_, str> {
    const IRREGULAR: &[(&str, &str)] = &[
        ("leaves", "leaf"),
        ("loaves", "loaf"),
        ("knives", "knife"),
        ("shelves", "shelf"),
        ("scarves", "scarf"),
        ("hooves", "hoof"),
        ("teeth", "tooth"),
        ("feet", "foot"),
    ];
    // Without their s they are adjectives.
    const PAIRS: &[&str] = &["tights", "shorts", "briefs", "overalls"];
    const SAME: &[&str] = &["ss", "us", "is", "os", "'s"];
    let replaced = |ending: &str, other: &str| {
        let stem = word.strip_suffix(ending)?;
        (stem.len() > 2).then(|| format!("{stem}{other}"))
    };
    if let Some((_, one)) = IRREGULAR.iter().find(|(many, _)| *many == word) {
        return (*one).into();
    }
    if !word.ends_with('s')
        || word.len() < 4
        || PAIRS.contains(&word)
        || SAME.iter().any(|same| word.ends_with(same))
    {
        return word.into();
    }
    replaced("ies", "y")
        .or_else(|| replaced("sses", "ss"))
        .or_else(|| replaced("shes", "sh"))
        .or_else(|| replaced("ches", "ch"))
        .or_else(|| replaced("xes", "x"))
        .or_else(|| replaced("s", ""))
        .map_or_else(|| word.into(), Cow::Owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(prompt: &str) -> String {
        let words = normalise(prompt).into_iter().map(|token| match token {
            Token::Word(word) => word,
            Token::Break => "/".into(),
        });
        words.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn what_shows_nothing_or_only_form_goes() {
        for (prompt, expected) in [
            ("sand\u{200b}paper", "sandpaper"),
            ("\u{feff}KNURLED  brass.", "knurled brass"),
            ("\u{201c}Knurled-Brass\u{201d}!!", "knurled brass"),
            ("ﬁne ｓａｎｄ", "fine sand"),
            ("a towel that isn’t rough", "a towel that is not rough"),
            ("gray aluminum, molded", "grey aluminium / moulded"),
            ("baby’s cheek", "baby's cheek"),
            ("🧱", "brick"),
            ("#80 (Ra 2.5)", "#80 / ra 2.5"),
            ("1,000 grit, 0,8 or 3,5", "1000 grit / 0.8 or 3 / 5"),
            ("'cork'…", "cork"),
            ("#cork", "cork"),
        ] {
            assert_eq!(words(prompt), expected, "{prompt:?}");
        }
    }

    #[test]
    fn plurals_have_the_key_of_their_singular() {
        for (plural, one) in [
            ("pebbles", "pebble"),
            ("brushes", "brush"),
            ("berries", "berry"),
            ("glass", "glass"),
            ("moss", "moss"),
            ("leaves", "leaf"),
            ("gas", "gas"),
        ] {
            assert_eq!(singular(plural), one);
        }
    }
}
