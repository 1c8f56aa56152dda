//! A row of a table as text, with the floats that `asperity render` prints: the fewest digits that read back to the same
//! bits, and no exponent.

use core::fmt::{self, Write as _};

/// Longest text of a float, with its comma: a sign and "0." before 53 digits.
const LONGEST: usize = 57;
/// Bytes of a row.
pub const CAPACITY: usize = 9 * LONGEST;

/// The text of a row.
#[derive(Debug, Clone, Copy)]
pub struct RowText {
    /// The text, up to what [`RowText::print`] returns.
    pub text: [u8; CAPACITY],
    length: usize,
}

impl RowText {
    /// An empty row.
    pub const EMPTY: Self = Self {
        text: [0; CAPACITY],
        length: 0,
    };

    /// Prints numbers with commas between them. Returns the bytes of the text.
    pub fn print(&mut self, numbers: &[f32; 9]) -> usize {
        self.length = 0;
        for (n, number) in numbers.iter().enumerate() {
            let comma = if n == 0 { "" } else { "," };
            // Nine of the longest texts have room.
            let _ = write!(self, "{comma}{number}");
        }
        self.length
    }
}

impl fmt::Write for RowText {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let end = self.length + text.len();
        let room = self.text.get_mut(self.length..end).ok_or(fmt::Error)?;
        room.copy_from_slice(text.as_bytes());
        self.length = end;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_float_has_room_and_reads_back() {
        let mut row = RowText::EMPTY;
        let longest = (0..2000).map(|n| f32::from_bits(1 + 4201 * n));
        let longest = longest.max_by_key(|x| x.to_string().len()).unwrap();
        for number in [
            -longest,
            f32::MIN,
            -f32::from_bits(1),
            -0.0,
            0.1,
            16_777_216.0,
        ] {
            let length = row.print(&[number; 9]);
            let text = core::str::from_utf8(&row.text[..length]).unwrap();
            let read: Vec<f32> = text.split(',').map(|x| x.parse().unwrap()).collect();
            assert_eq!(read.len(), 9);
            assert!(
                read.iter().all(|x| x.to_bits() == number.to_bits()),
                "{text}"
            );
        }
    }
}
