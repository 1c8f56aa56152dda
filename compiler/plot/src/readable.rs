//! Text in scripts that the embedded type face cannot set, spelt in letters that it can.
//!
//! DejaVu Sans has no Chinese, Japanese or Korean and few emoji. Of scripts that are written from
//! right to left, or whose letters join, it has glyphs, but setting them takes a shaper. A reader
//! of a sheet wants to recognise a name, so these characters are spelt by their sound or their
//! meaning, and as `U+XXXX` where they have neither.

use std::borrow::Cow;

/// The text with what cannot be set spelt in Latin letters. `has_glyph` tells of the type face.
pub(crate) fn readable(text: &str, has_glyph: impl Fn(char) -> bool) -> Cow<'_, str> {
    let is_set = |c: char| c.is_control() || (has_glyph(c) && !needs_shaping(c));
    if text.chars().all(is_set) {
        return Cow::Borrowed(text);
    }
    let mut readable = String::with_capacity(2 * text.len());
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        if is_set(character) {
            readable.push(character);
            continue;
        }
        if is_silent(character) {
            continue;
        }
        let Some(spelt) = deunicode::deunicode_char(character) else {
            readable.push_str(&format!("U+{:04X}", u32::from(character)));
            continue;
        };
        if spelt.trim().is_empty() {
            readable.push_str(spelt);
            continue;
        }
        // What a picture shows, and a syllable, is a word of its own.
        let is_word = is_symbol(character) || spelt.ends_with(' ');
        if is_word
            && readable
                .chars()
                .next_back()
                .is_some_and(char::is_alphanumeric)
        {
            readable.push(' ');
        }
        readable.push_str(spelt.trim());
        let follows = |&next: &char| next.is_alphanumeric() || is_symbol(next);
        if is_word && characters.peek().is_some_and(follows) {
            readable.push(' ');
        }
    }
    Cow::Owned(readable.trim_end().to_owned())
}

/// Scripts that are written from right to left, or whose letters change shape beside each other.
fn needs_shaping(character: char) -> bool {
    matches!(
        character,
        '\u{590}'..='\u{8ff}'
            | '\u{900}'..='\u{109f}'
            | '\u{1780}'..='\u{17ff}'
            | '\u{fb1d}'..='\u{fdff}'
            | '\u{fe70}'..='\u{fefe}'
            | '\u{10800}'..='\u{10fff}'
            | '\u{1e800}'..='\u{1efff}'
    )
}

/// Pictures and signs, as emoji are.
fn is_symbol(character: char) -> bool {
    matches!(character, '\u{2190}'..='\u{2bff}' | '\u{1f000}'..='\u{1faff}')
}

/// Characters that only join or change those beside them.
fn is_silent(character: char) -> bool {
    matches!(
        character,
        '\u{200b}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}'
            | '\u{1f3fb}'..='\u{1f3ff}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use ttf_parser::Face;

    fn drawn(text: &str) -> String {
        let face = Face::parse(dejavu::sans::regular(), 0).expect("the embedded type face");
        readable(text, |c| face.glyph_index(c).is_some()).into_owned()
    }

    #[test]
    fn what_the_type_face_has_stays() {
        for text in [
            "Cork",
            "Ärmel – μ 0.3 · 5 m/s²",
            "Шёлк",
            "μετάξι",
            "a\u{0}b",
        ] {
            assert_eq!(drawn(text), text);
        }
    }

    #[test]
    fn what_it_lacks_is_spelt_and_never_a_box() {
        for (text, spelt) in [
            ("木材", "Mu Cai"),
            ("rough 木材 fine", "rough Mu Cai fine"),
            ("“木材”  · 木 خشب", "“Mu Cai”  · Mu khshb"),
            ("나무", "namu"),
            ("خشب", "khshb"),
            ("wood🔥", "wood fire"),
            ("🪨🧽", "rock sponge"),
            ("\u{e000}", "U+E000"),
        ] {
            let drawn = drawn(text);
            assert_eq!(drawn, spelt, "{text}");
        }
    }
}
