//! Presentation of text: names, prompts and lines of files from outside; counts and sizes with units.

use std::{borrow::Cow, fmt::Display};

/// Characters of a line that an excerpt keeps at its beginning and at its end.
const KEPT_CHARS: (usize, usize) = (300, 150);
/// Lines that an excerpt keeps at its beginning and at its end.
const KEPT_LINES: (usize, usize) = (12, 4);

/// Most names that a suggestion holds.
const SUGGESTED: usize = 3;

/// Suggests names near a missing one: `did you mean "cork" or "fork"?`, the nearest spelling first. `None` where
/// nothing is near. Case, spaces, hyphens and underscores are ignored.
#[must_use]
pub fn suggestion<'n>(wanted: &str, names: impl IntoIterator<Item = &'n str>) -> Option<String> {
    let folded = |name: &str| -> String {
        let letters = name.chars().filter(|c| !matches!(c, ' ' | '-' | '_'));
        letters.flat_map(char::to_lowercase).collect()
    };
    let wanted = folded(wanted);
    // One letter in three may be wrong: more is another name.
    let most = (wanted.chars().count() / 3).clamp(1, 4);
    let mut near: Vec<(usize, &str)> = names
        .into_iter()
        .map(|name| (strsim::osa_distance(&wanted, &folded(name)), name))
        .filter(|(distance, _)| *distance <= most)
        .collect();
    near.sort();
    near.dedup();
    let near: Vec<String> = near
        .into_iter()
        .take(SUGGESTED)
        .map(|(_, name)| format!("{:?}", plain(name)))
        .collect();
    (!near.is_empty()).then(|| format!("did you mean {}?", near.join(" or ")))
}

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

/// Returns true if a character controls a terminal rather than being shown.
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

/// A text as one word of a POSIX shell: as it is where the shell takes every character of it for itself, else in
/// single quotes.
#[must_use]
pub fn shell_word(text: &str) -> Cow<'_, str> {
    let plain = |c: char| c.is_alphanumeric() || "/._-".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(format!("'{}'", text.replace('\'', r"'\''")))
    }
}

/// A count with its noun: `1 fault`, `2 faults`.
#[must_use]
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, one: &str, many: &str) -> String {
    let noun = if count == N::from(1) { one } else { many };
    format!("{count} {noun}")
}

/// A value rounded to so many digits behind the point, where zero has no minus sign.
#[must_use]
pub fn rounded(value: f64, digits: i32) -> f64 {
    let scale = 10_f64.powi(digits);
    (value * scale).round() / scale + 0.0
}

/// A size in the largest unit in which it is at least 1, with one digit behind the point.
#[must_use]
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1_000 => counted(bytes, "byte", "bytes"),
        1_000..999_950 => format!("{:.1} kB", bytes as f64 / 1e3),
        999_950..999_950_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

/// The longest beginning of whole characters within a number of bytes.
#[must_use]
pub fn shortened(text: &str, bytes: usize) -> &str {
    let mut end = text.len().min(bytes);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
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

/// Cuts the middle of a long line.
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
    fn what_rounds_to_zero_has_no_sign() {
        assert_eq!(format!("{:+.1}", rounded(-0.04, 1)), "+0.0");
        assert_eq!(format!("{:.0}", rounded(-0.4, 0)), "0");
        assert_eq!([rounded(-0.06, 1), rounded(2.449, 2)], [-0.1, 2.45]);
    }

    #[test]
    fn a_name_that_is_not_there_is_likened_to_those_that_are() {
        let names = ["cork", "oak board", "Silk", "prompt", "fork"];
        let suggested = |wanted: &str| suggestion(wanted, names);
        let is = |text: &str| Some(text.to_owned());
        assert_eq!(suggested("Crok"), is("did you mean \"cork\"?"));
        assert_eq!(suggested("oak_bord"), is("did you mean \"oak board\"?"));
        assert_eq!(suggested("SILK"), is("did you mean \"Silk\"?"));
        assert_eq!(suggested("prompts"), is("did you mean \"prompt\"?"));
        assert_eq!(suggested("work"), is("did you mean \"cork\" or \"fork\"?"));
        assert_eq!(suggested("granite"), None);
        assert_eq!(suggested(""), None);
    }

    #[test]
    fn counts_and_sizes_have_their_units() {
        let faults = |count: usize| counted(count, "fault", "faults");
        assert_eq!(
            [0, 1, 2].map(faults),
            ["0 faults", "1 fault", "2 faults"].map(str::to_owned)
        );
        for (bytes, shown) in [
            (1, "1 byte"),
            (999, "999 bytes"),
            (52_367, "52.4 kB"),
            (999_950, "1.0 MB"),
            (3_740_000, "3.7 MB"),
            (2_000_000_000, "2.0 GB"),
        ] {
            assert_eq!(size(bytes), shown);
        }
        assert_eq!(shortened("a é", 3), "a ");
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
