//! Commas behind the last entry of a list or an object, which strict JSON has not.

use std::borrow::Cow;

/// The text with a space for each comma that only a closing bracket follows: all places stay where they are.
pub fn without_trailing_commas(text: &str) -> Cow<'_, str> {
    let mut commas = Vec::new();
    let (mut in_text, mut escaped) = (false, false);
    // A comma behind an entry, and whether an entry comes right before this place.
    let (mut comma, mut entry) = (None, false);
    for (at, byte) in text.bytes().enumerate() {
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
                commas.extend(comma);
                entry = true;
            }
            b'[' | b'{' | b':' => entry = false,
            b'"' => (in_text, entry) = (true, true),
            _ => entry = true,
        }
        comma = None;
    }
    if commas.is_empty() {
        return text.into();
    }
    let mut plain = String::with_capacity(text.len());
    let mut from = 0;
    for comma in commas {
        plain.push_str(&text[from..comma]);
        plain.push(' ');
        from = comma + 1;
    }
    plain.push_str(&text[from..]);
    plain.into()
}
