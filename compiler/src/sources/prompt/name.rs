//! Texts of a length that an asset can hold.

use asperity_formats::limits;

/// A name that an asset can hold: the beginning of the prompt, without control characters.
pub(super) fn title(prompt: &str) -> String {
    let plain = prompt.replace(char::is_control, " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    shortened(&words.join(" "), limits::MAX_NAME_BYTES).to_owned()
}

/// The longest beginning of whole characters within a number of bytes.
pub(super) fn shortened(text: &str, bytes: usize) -> &str {
    let mut end = text.len().min(bytes);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    text[..end].trim_end()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_ends_at_a_whole_character_within_the_limit() {
        assert_eq!(title(" wet\u{0}ice\n"), "wet ice");
        let long = title(&"ä".repeat(40));
        assert_eq!(long, "ä".repeat(32));
        assert_eq!(shortened("a é", 3), "a");
    }
}
