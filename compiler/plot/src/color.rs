//! Colours, and the inks that every picture draws with.

/// An opaque or translucent sRGB colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Opacity: 255 is opaque.
    pub a: u8,
}

impl Color {
    /// An opaque colour.
    #[must_use]
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// The same colour with an opacity in 0..=255.
    #[must_use]
    pub const fn alpha(self, a: u8) -> Self {
        Self { a, ..self }
    }
}

/// Inks that colour-blind readers can tell apart (Okabe and Ito, 2008), and greys.
pub mod ink {
    use super::Color;

    /// The ground of every picture.
    pub const PAPER: Color = Color::rgb(255, 255, 255);
    /// Text and frames.
    pub const BLACK: Color = Color::rgb(26, 26, 26);
    /// Secondary text.
    pub const GREY: Color = Color::rgb(100, 100, 100);
    /// Construction lines.
    pub const LIGHT: Color = Color::rgb(190, 190, 190);
    /// Grid lines behind data.
    pub const GRID: Color = Color::rgb(232, 232, 232);
    /// Okabe–Ito blue.
    pub const BLUE: Color = Color::rgb(0, 114, 178);
    /// Okabe–Ito orange.
    pub const ORANGE: Color = Color::rgb(230, 159, 0);
    /// Okabe–Ito bluish green.
    pub const GREEN: Color = Color::rgb(0, 158, 115);
    /// Okabe–Ito vermilion.
    pub const VERMILION: Color = Color::rgb(213, 94, 0);
    /// Okabe–Ito reddish purple.
    pub const PURPLE: Color = Color::rgb(204, 121, 167);
    /// Okabe–Ito sky blue.
    pub const SKY: Color = Color::rgb(86, 180, 233);

    /// The colour of category `index`, counted from 0; six colours repeat.
    #[must_use]
    pub const fn category(index: usize) -> Color {
        const CATEGORIES: [Color; 6] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY];
        CATEGORIES[index % CATEGORIES.len()]
    }
}
