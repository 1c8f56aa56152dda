//! Style of a line.

use crate::color::{Color, ink};

/// Colour, width and dashes of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// Its width, pixels.
    pub width: f32,
    /// Lengths of dash and gap, pixels; `None` for a solid line.
    pub dash: Option<[f32; 2]>,
}

impl Stroke {
    /// A solid line.
    #[must_use]
    pub const fn new(color: Color, width: f32) -> Self {
        Self {
            color,
            width,
            dash: None,
        }
    }

    /// The line of category `index`, counted from 0: a colour of [`ink::category`] and dashes of
    /// its own, so that lines can be told apart in grey. Five dashes and six colours repeat.
    #[must_use]
    pub const fn category(index: usize, width: f32) -> Self {
        const DASHES: [Option<[f32; 2]>; 5] = [
            None,
            Some([16.0, 6.0]),
            Some([4.0, 5.0]),
            Some([34.0, 8.0]),
            Some([9.0, 9.0]),
        ];
        Self {
            color: ink::category(index),
            width,
            dash: DASHES[index % DASHES.len()],
        }
    }

    /// The same line, dashed.
    #[must_use]
    pub const fn dashed(self) -> Self {
        Self {
            dash: Some([10.0, 7.0]),
            ..self
        }
    }

    /// The same line, dotted.
    #[must_use]
    pub const fn dotted(self) -> Self {
        Self {
            dash: Some([3.0, 5.0]),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance as the eye weighs the channels, 0..=1, gamma ignored.
    fn luma(Color { r, g, b, .. }: Color) -> f32 {
        (0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b)) / 255.0
    }

    /// Claim: without colour, any two of six lines differ in their dashes or clearly in lightness.
    #[test]
    fn categories_differ_in_grey() {
        let lines: Vec<Stroke> = (0..6).map(|index| Stroke::category(index, 2.0)).collect();
        for (index, one) in lines.iter().enumerate() {
            for other in &lines[..index] {
                let lightness = (luma(one.color) - luma(other.color)).abs();
                assert!(
                    one.dash != other.dash || lightness > 0.2,
                    "{one:?} {other:?}"
                );
            }
        }
    }
}
