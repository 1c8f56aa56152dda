//! Maps from values to colours.

use crate::color::{Color, ink};
use crate::range::widened;

/// A perceptually uniform, colour-blind safe map from 0..=1 to colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorMap {
    /// For levels of a texture. The palest end is left out, so that points show on white.
    Viridis,
    /// For speeds. The palest end is left out, so that lines show on white.
    Plasma,
    /// For spectrograms.
    Inferno,
}

impl ColorMap {
    /// The colour at `t`, clamped to 0..=1; NaN is grey.
    #[must_use]
    pub fn at(self, t: f64) -> Color {
        if t.is_nan() {
            return ink::LIGHT;
        }
        let t = t.clamp(0.0, 1.0);
        let color = match self {
            Self::Viridis => colorous::VIRIDIS.eval_continuous(t * 0.95),
            Self::Plasma => colorous::PLASMA.eval_continuous(t * 0.88),
            Self::Inferno => colorous::INFERNO.eval_continuous(t),
        };
        Color::rgb(color.r, color.g, color.b)
    }
}

/// A colour map with the range of values it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorScale {
    /// The map.
    pub map: ColorMap,
    /// Value of the first colour.
    pub min: f64,
    /// Value of the last colour; above `min`.
    pub max: f64,
}

impl ColorScale {
    /// A scale over `min..=max`; an empty range is widened by one unit.
    #[must_use]
    pub fn new(map: ColorMap, min: f64, max: f64) -> Self {
        let (min, max) = widened(min, max);
        Self { map, min, max }
    }

    /// The colour of a value, clamped to the range.
    #[must_use]
    pub fn color(&self, value: f64) -> Color {
        self.map.at((value - self.min) / (self.max - self.min))
    }
}
