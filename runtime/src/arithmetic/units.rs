//! The binary point of each quantity in fixed point. The range follows; `docs/fixed-point.md`
//! derives why a tick stays in it.
//!
//! | quantity | point | range | step |
//! |---|---|---|---|
//! | [`Metre`] | 28 | ±8 m | 3.7 nm |
//! | [`MetrePerSecond`] | 24 | ±128 m/s | 0.06 µm/s |
//! | [`MillimetrePerSecond`] | 15 | ±65,536 mm/s | 0.03 µm/s |
//! | [`Newton`] | 16 | ±32,768 N | 15 µN |
//! | [`Leak`] (of the bristle in a tick) | 19 | ±4,096 N | 2 µN |
//! | [`NewtonPerMetre`] | 12 | ±524,288 N/m | 0.24 mN/m |
//! | [`NewtonSecondPerMetre`] | 16 | ±32,768 N·s/m | 15 µN·s/m |
//! | [`Acceleration`] (vibration) | 16 | ±32,768 m/s² | 15 µm/s² |
//! | [`TapAcceleration`] | 10 | ±2·10⁶ m/s² | 1 mm/s² |
//! | [`Kilogram`] | 24 | ±128 kg | 0.06 mg |
//! | [`Level`] | 20 | ±2,048 m/s² | 1 µm/s² |
//! | [`Unit`] (normals, shares, weights, filters) | 30 | ±2 | 10⁻⁹ |
//! | [`Ratio`] | 20 | ±2,048 | 10⁻⁶ |
//! | [`Hertz`] | 16 | ±32,768 Hz | 15 µHz |
//! | [`Pair`] (−2 cos ω and sums of two) | 28 | ±8 | 4·10⁻⁹ |
//! | [`Coefficient`] | 22 | ±512 | 2·10⁻⁷ |
//! | [`Gaussian`], [`Gain`] | 28 | ±8 | 4·10⁻⁹ |
//! | [`Coordinate`], [`Slope`], [`Weight`] (location) | 20 | ±2,048 | 10⁻⁶ |

use fixed::types::extra::{U10, U12, U15, U16, U19, U20, U22, U24, U28, U30};

/// Positions, distances, deflections, m.
pub type Metre = U28;
/// Speeds, m/s.
pub type MetrePerSecond = U24;
/// Speeds, mm/s.
pub type MillimetrePerSecond = U15;
/// Forces, N.
pub type Newton = U16;
/// The leak of the bristle in a tick, and the normal force beside it, N: at 10 kHz it is a tenth
/// of a millinewton.
pub type Leak = U19;
/// Stiffness, N/m.
pub type NewtonPerMetre = U12;
/// Damping, N·s/m.
pub type NewtonSecondPerMetre = U16;
/// Samples of the vibration, m/s².
pub type Acceleration = U16;
/// Samples of a tap, m/s².
pub type TapAcceleration = U10;
/// Effective masses, kg.
pub type Kilogram = U24;
/// gain·σ, m/s².
pub type Level = U20;
/// Components of unit vectors, shares, weights, coefficients of low-passes, s.
pub type Unit = U30;
/// μ, gains, counts of ticks.
pub type Ratio = U20;
/// Rates, Hz.
pub type Hertz = U16;
/// −2 cos ω, and sums and products of two.
pub type Pair = U28;
/// Coefficients of A(z) and B(z).
pub type Coefficient = U22;
/// The share of the force that is let through: a sum of two is taken.
pub type Gain = U28;
/// ε.
pub type Gaussian = U28;
/// Speed, mm/s, or force, N, of a query in the grid; the same point as [`Slope`]'s.
pub type Coordinate = U20;
/// A barycentric weight while triangles are compared.
pub type Weight = U20;
/// Its change along a coordinate, 1/(mm/s) or 1/N.
pub type Slope = U20;

/// No component of a velocity enters its low-pass beyond this, m/s.
pub(crate) const FASTEST_M_S: f32 = 16.0;
/// None of the forces that a tick adds up is beyond this, N.
pub(crate) const STRONGEST_N: f32 = 2048.0;
/// A weight does not fall further outside its triangle.
pub(crate) const FAR: f32 = 256.0;
/// What a low-pass holds and gives stays within this, m/s².
pub(crate) const LOUDEST_M_S2: f32 = 16_000.0;
