//! The units of a tick, each with its binary point in fixed point.
//!
//! The range follows from the point: 31 bits and a sign, of which as many as the table says stand
//! behind the point. `docs/fixed-point.md` derives why a tick stays in these ranges. Where one SI
//! unit appears in two ranges, as the acceleration of a vibration and of a tap, each has a type
//! of its own.

use crate::arithmetic::Point;
use core::fmt::Debug;
use fixed::types::extra::{U10, U12, U15, U16, U19, U20, U22, U24, U25, U26, U28, U30};

/// The unit of a quantity.
pub trait Unit: Copy + Debug + Default + PartialEq + 'static {
    /// Bits behind the binary point in fixed point.
    type Point: Point;
}

/// Declares units: name, point, and what they stand for.
macro_rules! units {
    ($($name:ident $point:ident $about:literal;)*) => {$(
        #[doc = $about]
        #[derive(Debug, Clone, Copy, Default, PartialEq)]
        pub struct $name;

        impl Unit for $name {
            type Point = $point;
        }
    )*};
}

units! {
    // unit                  point  range and step in fixed point
    Metre                    U28 "Positions, distances, deflections, m: ±8 m, 3.7 nm.";
    WideMetre                U24 "Weighted sums of distances, m: ±128 m, 60 nm.";
    MetrePerSecond           U24 "Speeds, m/s: ±128 m/s, 0.06 µm/s.";
    MillimetrePerMetre       U20 "The factor 1000 between two units of speed: ±2048.";
    MillimetrePerSecond      U15 "Speeds as the grid has them, mm/s: ±65,536 mm/s, 0.03 µm/s.";
    Newton                   U16 "Forces, N: ±32,768 N, 15 µN.";
    FineNewton               U19 "Forces beside a leak that is a tenth of a millinewton at 10 kHz, N: ±4,096 N, 2 µN.";
    RelaxingNewton           U25 "Force of a Maxwell branch, which relaxes by a millionth of it in a tick, N: ±64 N, 30 nN.";
    PerNewton                U20 "Reciprocals of forces, 1/N: ±2,048, 10⁻⁶.";
    SecondPerMetre           U20 "Damping over load, s/m: ±2,048 s/m, 1 µs/m.";
    NewtonSecondPerSquareMetre U12 "Viscous drag over depth, N·s/m²: ±524,288 N·s/m², 0.24 mN·s/m².";
    NewtonPerMetre           U12 "Stiffness of a wall, N/m: ±524,288 N/m, 0.24 mN/m.";
    BristleNewtonPerMetre    U12 "Stiffness of the bristle of friction, N/m: ±524,288 N/m, 0.24 mN/m.";
    MetrePerNewton           U30 "Compliance of the bristle, m/N: ±2 m/N, 1 nm/N.";
    NewtonSecondPerMetre     U16 "Damping, N·s/m: ±32,768 N·s/m, 15 µN·s/m.";
    Second                   U30 "What a unit of stiffness takes of the damping, s: ±2 s, 1 ns.";
    Hertz                    U16 "Rates, Hz: ±32,768 Hz, 15 µHz.";
    Kilogram                 U24 "Effective masses, kg: ±128 kg, 0.06 mg.";
    SecondSquaredPerMetre    U20 "Gain of the vibration before F_max, s²/m: ±2,048, 10⁻⁶.";
    FrictionCoefficient      U20 "Coefficient of kinetic friction μ: ±2,048, 10⁻⁶.";
    FrictionFactor           U28 "Factor of μ at a speed: ±8, 4·10⁻⁹.";
    DirectionFactor          U26 "Factors of speed, level and μ in a direction, and squares of its sine: ±32, 1.5·10⁻⁸.";
    VibrationAcceleration    U16 "Samples of the vibration, m/s²: ±32,768 m/s², 15 µm/s².";
    TapAcceleration          U10 "Samples of a tap, m/s²: ±2·10⁶ m/s², 1 mm/s².";
    ExcitationLevel          U20 "gain·σ, m/s²: ±2,048 m/s², 1 µm/s².";
    Gaussian                 U28 "The excitation ε of variance 1: ±8, 4·10⁻⁹.";
    Coefficient              U22 "Coefficients of A(z) and B(z): ±512, 2·10⁻⁷.";
    LineCosine               U28 "−2 cos ω of a line spectral frequency, sums and products of two: ±8, 4·10⁻⁹.";
    Residue                  U28 "Residues of the upsampler: ±8, 4·10⁻⁹.";
    Fraction                 U30 "Parts of a whole, barycentric weights, components of unit vectors, poles: ±2, 10⁻⁹.";
    Gain                     U28 "The part of the force that the gate lets through: ±8, 4·10⁻⁹.";
    Count                    U20 "Whole numbers: ±2,048.";
    Ratio                    U20 "Ratios of counts: ±2,048, 10⁻⁶.";
    Coordinate               U20 "Speed, mm/s, or force, N, as a coordinate of the grid: ±2,048, 10⁻⁶.";
    Slope                    U20 "Change of a weight along a coordinate, 1/(mm/s) or 1/N: ±2,048, 10⁻⁶.";
    Weight                   U20 "A barycentric weight while triangles are compared: ±2,048, 10⁻⁶.";
}

/// A finer or coarser unit of the same dimension.
pub trait ConvertTo<U: Unit>: Unit {}

impl ConvertTo<FineNewton> for Newton {}
impl ConvertTo<Newton> for RelaxingNewton {}
impl ConvertTo<Coordinate> for MillimetrePerSecond {}
impl ConvertTo<Coordinate> for Newton {}
impl ConvertTo<LineCosine> for Coefficient {}
