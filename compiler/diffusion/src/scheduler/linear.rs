//! Linear functions of the latent and the UNet's output, in which all formulas of a step stand.

use std::ops::{Add, Div, Mul, Sub};

/// `sample`·x + `output`·(what the UNet gives).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Linear {
    pub(super) sample: f64,
    pub(super) output: f64,
}

/// The latent x.
pub(super) const SAMPLE: Linear = Linear {
    sample: 1.0,
    output: 0.0,
};

/// The output of the UNet.
pub(super) const OUTPUT: Linear = Linear {
    sample: 0.0,
    output: 1.0,
};

impl Add for Linear {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            sample: self.sample + other.sample,
            output: self.output + other.output,
        }
    }
}

impl Mul<f64> for Linear {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            sample: self.sample * factor,
            output: self.output * factor,
        }
    }
}

impl Sub for Linear {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Div<f64> for Linear {
    type Output = Self;

    fn div(self, divisor: f64) -> Self {
        Self {
            sample: self.sample / divisor,
            output: self.output / divisor,
        }
    }
}
