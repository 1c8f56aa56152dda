//! Tolerance for hand-written JSON that strict readers refuse: a comma after the last entry of a list or an object, and
//! integers with a fraction of zeros.

use crate::shown::shortened;
use std::{borrow::Cow, ops::Range};

/// The text with spaces for each comma that only a closing bracket follows, and for `.0` behind a whole number: all
/// places stay where they are.
#[must_use]
pub fn lenient_json(text: &str) -> Cow<'_, str> {
    let bytes = text.as_bytes();
    let mut blanks: Vec<Range<usize>> = Vec::new();
    let (mut in_text, mut escaped) = (false, false);
    // A comma behind an entry, and whether an entry comes right before this place.
    let (mut comma, mut entry) = (None, false);
    for (at, &byte) in bytes.iter().enumerate() {
        if in_text {
            in_text = escaped || byte != b'"';
            escaped = !escaped && byte == b'\\';
            continue;
        }
        match byte {
            b' ' | b'\t' | b'\r' | b'\n' => continue,
            b',' => {
                comma = entry.then_some(at);
                entry = false;
                continue;
            }
            b']' | b'}' => {
                blanks.extend(comma.map(|comma| comma..comma + 1));
                entry = true;
            }
            b'[' | b'{' | b':' => entry = false,
            b'"' => (in_text, entry) = (true, true),
            b'.' => blanks.extend(zeros(bytes, at)),
            _ => entry = true,
        }
        comma = None;
    }
    if blanks.is_empty() {
        return text.into();
    }
    let mut plain = String::with_capacity(text.len());
    let mut from = 0;
    for blank in blanks {
        plain.push_str(&text[from..blank.start]);
        plain.extend(blank.clone().map(|_| ' '));
        from = blank.end;
    }
    plain.push_str(&text[from..]);
    plain.into()
}

/// The fraction that begins with the point at a place, if it is one of zeros and ends its number.
fn zeros(bytes: &[u8], point: usize) -> Option<Range<usize>> {
    let digits = bytes[point + 1..]
        .iter()
        .take_while(|&&b| b == b'0')
        .count();
    let end = point + 1 + digits;
    let goes_on = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'+' | b'-');
    let is_whole = point > 0 && bytes[point - 1].is_ascii_digit() && digits > 0;
    (is_whole && !bytes.get(end).is_some_and(goes_on)).then_some(point..end)
}

/// Rewords a parse error for text that is not JSON: numbers such as NaN, Python literals, single quotes, comments.
/// `text` is the input of the parser.
#[must_use]
pub fn json_fault(text: &str, error: &serde_json::Error) -> String {
    let said = error.to_string();
    if !error.is_syntax() {
        return said;
    }
    let line = text
        .lines()
        .nth(error.line().saturating_sub(1))
        .unwrap_or_default();
    let begun = shortened(line, error.column().saturating_sub(1));
    // The reader stops within a word.
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '-' | '+' | '_' | '#' | '.');
    let start = begun.trim_end_matches(is_word).len();
    let rest = &line[start..];
    let word = rest.trim_start_matches(['-', '+']);
    let sign = rest.len() - word.len();
    let word = &word[..word.find(|c| !is_word(c)).unwrap_or(word.len())];
    let mark = ["'", "//", "/*", "#"]
        .into_iter()
        .find(|mark| rest.starts_with(mark));
    let (why, shown) = match (word.to_lowercase().as_str(), mark) {
        ("nan" | "inf" | "infinity" | "1.#inf" | "1.#ind" | "1.#qnan", _) => (
            "JSON has no NaN and no infinity: write a number, or leave the key out",
            &rest[..sign + word.len()],
        ),
        ("none" | "true" | "false" | "undefined", _) => {
            ("JSON writes true, false and null, in small letters", word)
        }
        (_, Some("'")) => ("JSON has double quotes, not single ones", "'"),
        (_, Some(mark)) => ("JSON has no comments", mark),
        _ => return said,
    };
    // No more of the text than what is known: a link in its place leads to any file.
    let place = said.rfind(" at line ").map_or("", |from| &said[from..]);
    format!("{shown}{place}: {why}")
}
