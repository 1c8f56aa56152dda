//! Which product and which quotient give which unit, and where they are cut.
//!
//! A cut is where a product ends in fixed point, at a value that no device produces; without one
//! the units show that the product is in range. Floats have no cuts.

use super::unit::*;
use crate::arithmetic::Cut;

/// Units whose product has a meaning.
pub trait Times<R: Unit>: Unit {
    /// The unit of the product.
    type Product: Unit;
    /// Where the product is cut.
    const CUT: Cut;
}

/// Units whose quotient has a meaning.
pub trait Over<R: Unit>: Unit {
    /// The unit of the quotient.
    type Quotient: Unit;
}

/// None of the forces that a tick adds up is beyond this, N.
const STRONGEST_N: f32 = 2048.0;

/// A fraction of anything has the unit of that thing.
impl<U: Unit> Times<U> for Fraction {
    type Product = U;
    const CUT: Cut = Cut::Never;
}

macro_rules! products {
    ($($left:ident * $right:ident = $product:ident $(, at most $limit:expr)?;)*) => {$(
        impl Times<$right> for $left {
            type Product = $product;
            const CUT: Cut = products!(@cut $($limit)?);
        }
    )*};
    (@cut) => { Cut::Never };
    (@cut $limit:expr) => { Cut::At($limit) };
}

products! {
    // Contact and motion.
    Metre * Fraction = Metre;
    MetrePerSecond * Fraction = MetrePerSecond;
    MetrePerSecond * MillimetrePerMetre = MillimetrePerSecond;
    // Forces.
    NewtonPerMetre * Metre = Newton, at most STRONGEST_N;
    NewtonPerMetre * Second = NewtonSecondPerMetre, at most 16_384.0;
    NewtonSecondPerMetre * MetrePerSecond = Newton, at most STRONGEST_N;
    SecondPerMetre * Newton = NewtonSecondPerMetre, at most 16_384.0;
    NewtonSecondPerMetre * PerNewton = SecondPerMetre, at most 2000.0;
    NewtonSecondPerSquareMetre * MetrePerSecond = NewtonPerMetre, at most 500_000.0;
    MetrePerSecond * Second = Metre, at most 1.0;
    FrictionCoefficient * FrictionFactor = FrictionCoefficient, at most 10.0;
    FrictionCoefficient * Newton = Newton;
    FrictionFactor * DirectionFactor = FrictionFactor;
    Newton * MetrePerNewton = Metre, at most 1.0;
    BristleNewtonPerMetre * Metre = Newton, at most 32_000.0;
    SecondSquaredPerMetre * Newton = Kilogram, at most 127.0;
    Kilogram * VibrationAcceleration = Newton, at most STRONGEST_N;
    Kilogram * TapAcceleration = Newton, at most STRONGEST_N;
    Newton * Fraction = Newton;
    Newton * Gain = Newton;
    // Impact speed.
    Metre * Count = WideMetre;
    WideMetre * Hertz = MetrePerSecond, at most 100.0;
    MetrePerSecond * Ratio = MetrePerSecond;
    // Direction.
    DirectionFactor * DirectionFactor = DirectionFactor;
    MillimetrePerSecond * DirectionFactor = MillimetrePerSecond, at most 32_000.0;
    ExcitationLevel * DirectionFactor = ExcitationLevel;
    // The model and its samples.
    Coordinate * Slope = Weight, at most FARTHEST_WEIGHT;
    Weight * Fraction = Fraction;
    LineCosine * LineCosine = LineCosine;
    ExcitationLevel * Gaussian = VibrationAcceleration, at most 2048.0;
    Coefficient * VibrationAcceleration = VibrationAcceleration;
}

/// The farthest that a weight falls outside its triangle.
pub(crate) const FARTHEST_WEIGHT: f32 = 256.0;

macro_rules! quotients {
    ($($left:ident / $right:ident = $quotient:ident;)*) => {$(
        impl Over<$right> for $left {
            type Quotient = $quotient;
        }
    )*};
}

quotients! {
    FineNewton / FineNewton = Fraction;
    MetrePerSecond / MetrePerSecond = Fraction;
    Count / Count = Ratio;
    Weight / Weight = Fraction;
    Fraction / Fraction = DirectionFactor;
    DirectionFactor / DirectionFactor = DirectionFactor;
}
