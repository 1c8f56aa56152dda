//! A prediction: its method, the region of the model, and its error.

use crate::pareto::difference::Difference;
use asperity_kernels::design::{Level, Shape};

/// Where a model lies among the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Region {
    /// Between measured models.
    Inside,
    /// Between measured models and silence.
    TowardsRest,
    /// Beyond the measured models, where edge models are extrapolated.
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

/// A prediction method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// An interpolation of shape; levels are mixed as RMS.
    Shape(Shape),
    /// An interpolation of level; shapes are mixed in cos ω.
    Level(Level),
    /// The nearest neighbour's model, unchanged.
    Nearest,
    /// The nearest model on the border, its level raised by powers of speed and force.
    Powers(Exponents),
}

/// Growth of an edge model's level with speed and force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exponents {
    /// With the exponents that fit the other models, within 0 to 2, as the compiler does.
    Fitted,
    /// With these exponents of speed and force.
    Fixed(f64, f64),
}

impl Exponents {
    /// All that are compared.
    pub const ALL: [Self; 5] = [
        Self::Fitted,
        Self::Fixed(0.0, 0.0),
        Self::Fixed(0.5, 0.5),
        Self::Fixed(1.0, 0.5),
        Self::Fixed(1.0, 1.0),
    ];
}

impl Method {
    /// Returns the varied factor and the method's name, for tables.
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

/// A method's prediction of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Index of the model among the grid's measured ones.
    pub model: usize,
    /// The method.
    pub method: Method,
    /// Where it lies.
    pub region: Region,
    /// Difference from the measured model; `None` where the filter is unstable or the level is 0.
    pub difference: Option<Difference>,
}
