//! A prompt as words: what is typed in different ways becomes the same.

use super::homoglyphs::latin;
use std::borrow::Cow;
use unicode_normalization::UnicodeNormalization as _;

/// A word, or a mark that divides clauses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Token {
    /// A lower-case word in British spelling.
    Word(String),
    /// A comma, a bracket, a full stop, a line: the first of those that stand together.
    Break(char),
}

impl Token {
    /// The word, unless it is a mark.
    #[must_use]
    pub fn word(&self) -> Option<&str> {
        match self {
            Self::Word(word) => Some(word),
            Self::Break(_) => None,
        }
    }
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
/// nothing, with one apostrophe, in British spelling, and without letters of other scripts in Latin words. "isn't" is
/// "is not". A number is one word: "1,000" and "1'000" are "1000", "½" is "1/2", "3,5" stays.
#[must_use]
pub fn normalise(prompt: &str) -> Vec<Token> {
    let text = in_letters(&shown(prompt)).to_lowercase();
    let mut tokens = Vec::new();
    let mut word = String::new();
    let (mut rest, mut before) = (text.as_str(), ' ');
    while let Some(character) = rest.chars().next() {
        if character.is_ascii_digit() && !word.ends_with(['.', '/']) {
            let (length, number) = number(rest);
            for (n, number) in number.split(' ').enumerate() {
                if n > 0 {
                    end(&mut word, &mut tokens);
                    tokens.push(Token::Break(','));
                }
                word.push_str(number);
            }
            rest = &rest[length..];
            before = '0';
            continue;
        }
        rest = &rest[character.len_utf8()..];
        let digit = rest.starts_with(|c: char| c.is_ascii_digit());
        match character {
            '’' | '‘' | 'ʼ' | '`' | '´' | '\'' => word.push('\''),
            _ if character.is_alphanumeric() || is_accent(character) => word.push(character),
            // "#80" is a grit, "#cork" a word.
            '#' if word.is_empty() && digit => word.push('#'),
            // "A -5", but not "80-120" and not "A-60"
            '-' | '–' if digit && before.is_whitespace() => word.push('-'),
            '−' if digit && before.is_whitespace() => word.push('−'),
            // "2.5"
            '.' if digit && word.ends_with(|c: char| c.is_ascii_digit()) => word.push('.'),
            _ => {
                end(&mut word, &mut tokens);
                let divides = matches!(
                    character,
                    ',' | ';' | ':' | '.' | '!' | '?' | '(' | ')' | '[' | ']' | '\n' | '–' | '—'
                );
                if divides && tokens.last().is_some_and(|last| last.word().is_some()) {
                    tokens.push(Token::Break(character));
                }
            }
        }
        before = character;
    }
    end(&mut word, &mut tokens);
    while tokens.last().is_some_and(|last| last.word().is_none()) {
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

/// A text in the letters that it is read in: compatibility forms, and Latin letters for what looks like them in a word.
#[must_use]
pub fn in_letters(text: &str) -> String {
    latin(&measured(text).nfkc().collect::<String>())
}

/// A text with fractions apart from what stands before them ("1½" is no 11⁄2), the mark of inches behind a number as a
/// word, and without the marks of trade.
fn measured(text: &str) -> String {
    let mut measured = String::with_capacity(text.len());
    let mut quoted = false;
    for character in text.chars() {
        let behind_digit = measured.ends_with(|c: char| c.is_numeric());
        match character {
            '¼'..='¾' | '\u{2150}'..='\u{215f}' => measured.extend([' ', character]),
            '″' if behind_digit => measured.push_str(" inch "),
            '"' if behind_digit && !quoted => measured.push_str(" inch "),
            '™' | '℠' => {}
            _ => {
                quoted ^= character == '"';
                measured.push(character);
            }
        }
    }
    measured
}

/// The number that a text begins with, and its bytes there: thousands joined, a fraction with its stroke, and a comma
/// before any other decimals. Numbers of a list are apart.
fn number(text: &str) -> (usize, String) {
    const COMMAS: [char; 3] = [',', '\'', '’'];
    let of_number = |c: char| c.is_ascii_digit() || COMMAS.contains(&c);
    let run = &text[..text.find(|c| !of_number(c)).unwrap_or(text.len())];
    let run = run.trim_end_matches(COMMAS);
    let parts: Vec<&str> = run.split(COMMAS).filter(|part| !part.is_empty()).collect();
    let joined = match &parts[..] {
        [whole] => return fraction(text, whole),
        [first, groups @ ..]
            if first.len() < 4
                && !first.starts_with('0')
                && groups.iter().all(|g| g.len() == 3) =>
        {
            parts.concat()
        }
        // "0,8" is no list.
        ["0", decimals] => format!("0.{decimals}"),
        [whole, decimals] if run.contains(',') && whole.len() < 4 && decimals.len() < 3 => {
            format!("{whole},{decimals}")
        }
        list => list.join(" "),
    };
    (run.len(), joined)
}

/// "1/2", or the whole number before anything else.
fn fraction(text: &str, whole: &str) -> (usize, String) {
    let after = text[whole.len()..].strip_prefix(['/', '⁄']);
    let below = after.map_or("", |after| {
        &after[..after.bytes().take_while(u8::is_ascii_digit).count()]
    });
    let behind = after.map_or("", |after| &after[below.len()..]);
    let is_one = |digits: &str| (1..=2).contains(&digits.len());
    if is_one(whole) && is_one(below) && !behind.starts_with(['/', '⁄']) {
        return (text.len() - behind.len(), format!("{whole}/{below}"));
    }
    (whole.len(), whole.to_owned())
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
pub(crate) fn spelled(word: &str) -> Cow<'_, str> {
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

/// A text without the accents of its letters.
#[must_use]
pub(crate) fn without_accents(text: &str) -> Cow<'_, str> {
    if text.is_ascii() {
        return text.into();
    }
    text.nfd().filter(|c| !is_accent(*c)).collect()
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
            Token::Break(_) => "/".into(),
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
            ("1,000 grit, 0,8 or 3,5", "1000 grit / 0.8 or 3,5"),
            (
                "P1,000, 1'000,000 or 80,120,400",
                "p1000 / 1000000 or 80120400",
            ),
            ("60,80,120 grit", "60 / 80 / 120 grit"),
            ("1½ inch, ¾\" or 1/2 mm", "1 1/2 inch / 3/4 inch or 1/2 mm"),
            ("\"P80\" on 24/7/365", "p80 on 24 7 365"),
            (
                "Shore A -5, A-60 and 80-120",
                "shore a -5 / a 60 and 80 120",
            ),
            ("−20 and –20", "−20 and -20"),
            ("velcro™ vеlvet", "velcro velvet"),
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
