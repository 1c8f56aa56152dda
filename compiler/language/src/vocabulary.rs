//! A vocabulary of word pieces, searched in the text that is its file.

use std::cmp::Ordering;

/// Pieces and their ids. Nothing is read before a piece is looked up.
#[derive(Debug, Clone, Copy)]
pub struct Vocabulary {
    text: &'static str,
}

impl Vocabulary {
    /// A vocabulary with one line `piece TAB id` for each piece, sorted by the bytes of the piece.
    /// Pieces of other lines are not found.
    #[must_use]
    pub const fn new(text: &'static str) -> Self {
        Self { text }
    }

    /// The id of the piece that is `prefix` and `rest` in one.
    #[must_use]
    pub fn id(&self, prefix: &str, rest: &str) -> Option<u32> {
        let (_, id) = self.line(prefix, rest)?.split_once('\t')?;
        id.parse().ok()
    }

    /// The line whose first field, up to a tab or its end, is `prefix` and `rest` in one.
    #[must_use]
    pub fn line(&self, prefix: &str, rest: &str) -> Option<&'static str> {
        let bytes = self.text.as_bytes();
        // The piece's line begins in low..high, if it is there.
        let (mut low, mut high) = (0, bytes.len());
        while low < high {
            let middle = low + (high - low) / 2;
            let before = bytes[low..middle].iter().rposition(|&byte| byte == b'\n');
            let start = before.map_or(low, |position| low + position + 1);
            let length = bytes[start..].iter().position(|&byte| byte == b'\n');
            let end = length.map_or(bytes.len(), |length| start + length);
            let line = &self.text[start..end];
            let piece = line.split_once('\t').map_or(line, |(piece, _)| piece);
            let wanted = prefix.bytes().chain(rest.bytes());
            match piece.bytes().cmp(wanted) {
                Ordering::Less => low = (end + 1).min(bytes.len()),
                Ordering::Greater => high = start,
                Ordering::Equal => return Some(line),
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::Vocabulary;

    #[test]
    fn every_piece_is_found_and_no_other() {
        let pieces = ["!", "##a", "##ab", "a", "ab", "abc", "b", "é"];
        for count in 0..=pieces.len() {
            let lines = pieces[..count].iter().zip(10..);
            let text: String = lines
                .map(|(piece, id)| format!("{piece}\t{id}\n"))
                .collect();
            let vocabulary = Vocabulary::new(text.leak());
            for (index, piece) in pieces.iter().enumerate() {
                let id = (index < count).then_some(10 + index as u32);
                assert_eq!(vocabulary.id("", piece), id, "{piece} of {count}");
                if let Some(rest) = piece.strip_prefix("##") {
                    assert_eq!(vocabulary.id("##", rest), id);
                }
            }
            for other in ["", " ", "#", "##", "aa", "abcd", "z", "\t", "\n"] {
                assert_eq!(vocabulary.id("", other), None, "{other:?} of {count}");
            }
        }
    }

    #[test]
    fn a_text_that_is_no_vocabulary_has_no_pieces() {
        for text in ["\n\n\n", "a", "a\tb\n", "a\n", "\t\n", "b\t1\na\t2"] {
            assert_eq!(Vocabulary::new(text).id("", "a").filter(|id| *id > 2), None);
        }
    }
}
