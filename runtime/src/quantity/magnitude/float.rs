//! Lengths in floats.

use super::Magnitudes;
use crate::{
    arithmetic::{Cut, Float, Point},
    lanes::F4,
    math::sqrt,
};

/// A length and its inverse in floats.
#[derive(Debug, Clone, Copy)]
pub struct FloatMagnitude {
    length: f32,
    inverse: f32,
}

impl FloatMagnitude {
    /// Too small to change a length in use. It makes the inverse of no length finite.
    const NO_LENGTH: f32 = 1.0e-18;
    /// Its square.
    const LEAST: f32 = 1.0e-36;
}

impl Magnitudes for Float {
    type Square = f32;
    type Magnitude = FloatMagnitude;
    /// The inner product and the inverse length.
    type Projection<F: Point> = (f32, f32);

    #[inline(always)]
    fn square<F: Point>(v: F4) -> f32 {
        v.dot3(v)
    }

    #[inline(always)]
    fn root<F: Point>(a: f32) -> f32 {
        sqrt(a)
    }

    #[inline(always)]
    fn is_some(square: f32) -> bool {
        square > 1e-18
    }

    #[inline(always)]
    fn magnitude(square: f32) -> FloatMagnitude {
        let length = sqrt(square);
        FloatMagnitude {
            length,
            inverse: 1.0 / (length + FloatMagnitude::NO_LENGTH),
        }
    }

    #[inline(always)]
    fn magnitude_above_zero<F: Point>(v: F4) -> FloatMagnitude {
        let [x, y, z, _] = (v * v).to_array();
        let length = sqrt((x + y) + (z + FloatMagnitude::LEAST));
        FloatMagnitude {
            length,
            inverse: 1.0 / length,
        }
    }

    #[inline(always)]
    fn magnitude_unguarded<F: Point>(v: F4) -> FloatMagnitude {
        let length = sqrt(v.dot3(v));
        FloatMagnitude {
            length,
            inverse: 1.0 / length,
        }
    }

    #[inline(always)]
    fn length<F: Point>(magnitude: FloatMagnitude) -> f32 {
        magnitude.length
    }

    #[inline(always)]
    fn direction<F: Point>(v: F4, magnitude: FloatMagnitude) -> F4 {
        v * F4::splat(magnitude.inverse)
    }

    #[inline(always)]
    fn project<F: Point>(v: F4, axis: F4, magnitude: FloatMagnitude) -> (f32, f32) {
        (v.dot3(axis), magnitude.inverse)
    }

    #[inline(always)]
    fn scale_projection<F: Point, G: Point, H: Point>(
        (product, inverse): (f32, f32),
        factor: f32,
        _: Cut,
    ) -> f32 {
        product * factor * inverse
    }

    #[inline(always)]
    fn ratio<F: Point>(reach: f32, magnitude: FloatMagnitude) -> f32 {
        reach * magnitude.inverse
    }
}
