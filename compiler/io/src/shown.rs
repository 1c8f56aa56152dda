//! How text from outside is shown: names, prompts, lines of files.

use std::borrow::Cow;

/// Characters of a line that an excerpt keeps at its beginning and at its end.
const KEPT_CHARS: (usize, usize) = (300, 150);
/// Lines that an excerpt keeps at its beginning and at its end.
const KEPT_LINES: (usize, usize) = (12, 4);

/// The text with control characters as escapes, so that no terminal obeys them, and with the marks
/// that turn the direction of text. Line breaks and tabs stay.
#[must_use]
pub fn plain(text: &str) -> Cow<'_, str> {
    if !text.chars().any(commands) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len());
    for character in text.chars() {
        if commands(character) {
            plain.extend(character.escape_unicode());
        } else {
            plain.push(character);
        }
    }
    Cow::Owned(plain)
}

/// Whether a character commands a terminal rather than being shown.
fn commands(character: char) -> bool {
    match character {
        '\n' | '\t' => false,
        '\u{61c}'
        | '\u{200e}'..='\u{200f}'
        | '\u{2028}'..='\u{202e}'
        | '\u{2066}'..='\u{2069}'
        | '\u{feff}' => true,
        other => other.is_control(),
    }
}

/// The text with long lines, and many lines, cut in their middle, where `…` then stands.
#[must_use]
pub fn excerpt(text: &str) -> String {
    let lines: Vec<Cow<'_, str>> = text.split('\n').map(line).collect();
    let (first, last) = KEPT_LINES;
    if lines.len() <= first + last {
        return lines.join("\n");
    }
    let (head, tail) = (&lines[..first], &lines[lines.len() - last..]);
    format!("{}\n…\n{}", head.join("\n"), tail.join("\n"))
}

/// One line, cut in its middle.
fn line(text: &str) -> Cow<'_, str> {
    let (first, last) = KEPT_CHARS;
    let at = |n: usize| text.char_indices().nth(n).map(|(index, _)| index);
    let (Some(head), Some(_)) = (at(first), at(first + last)) else {
        return Cow::Borrowed(text);
    };
    let tail = text.char_indices().rev().nth(last - 1);
    let tail = tail.map_or(text.len(), |(index, _)| index);
    Cow::Owned(format!("{} … {}", &text[..head], &text[tail..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_without_commands_stays_as_it_is() {
        for text in ["", "Ärmel 木 🔥\nμ 0.3", "العربية"] {
            assert_eq!(plain(text), text);
            assert_eq!(excerpt(text), text);
        }
    }

    #[test]
    fn an_excerpt_keeps_both_ends() {
        let long = format!("beginning {} end", "ä".repeat(5000));
        let short = excerpt(&long);
        assert!(short.starts_with("beginning ") && short.ends_with(" end"));
        assert!(short.chars().count() <= 453);
        let just = "x".repeat(450);
        assert_eq!(excerpt(&just), just);
    }
}
