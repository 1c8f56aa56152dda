//! What a prediction is made by, where, and what comes of it.

use crate::labs::difference::Difference;
use asperity_kernels::design::{Level, Shape};

/// Where a model lies among the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Region {
    /// Between measured models.
    Inside,
    /// Between measured models and silence.
    TowardsRest,
    /// Beyond them, where an edge model goes on.
    Beyond,
}

impl Region {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::TowardsRest => "towards rest",
            Self::Beyond => "beyond",
        }
    }
}

/// What a prediction was made by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// An interpolation of shape; levels as RMS.
    Shape(Shape),
    /// An interpolation of level; shapes in cos ω.
    Level(Level),
    /// The model at the nearest neighbour as it is.
    Nearest,
    /// Powers of speed and force beyond the border.
    Powers(Exponents),
}

/// How the level of an edge model grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exponents {
    /// As the others grow, within 0 to 2: what the compiler does.
    Fitted,
    /// These, for speed and force.
    Fixed(f64, f64),
}

impl Exponents {
    /// What is compared.
    pub const ALL: [Self; 5] = [
        Self::Fitted,
        Self::Fixed(0.0, 0.0),
        Self::Fixed(0.5, 0.5),
        Self::Fixed(1.0, 0.5),
        Self::Fixed(1.0, 1.0),
    ];
}

impl Method {
    /// What it varies, and its name, for tables.
    #[must_use]
    pub fn names(self) -> (&'static str, String) {
        match self {
            Self::Shape(shape) => ("shape", shape.name().into()),
            Self::Level(level) => ("level", level.name().into()),
            Self::Nearest => ("floor", "nearest neighbour".into()),
            Self::Powers(Exponents::Fitted) => ("edge exponents", "fitted".into()),
            Self::Powers(Exponents::Fixed(v, f)) => ("edge exponents", format!("v^{v} F^{f}")),
        }
    }
}

/// One prediction of one model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Which model of the grid, counted among those that were measured.
    pub model: usize,
    /// By what.
    pub method: Method,
    /// Where.
    pub region: Region,
    /// How far from the measured one; `None` where the filter is not stable or the level
    /// is nothing.
    pub difference: Option<Difference>,
}
