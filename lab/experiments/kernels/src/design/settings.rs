//! The settings of one kernel.

use core::fmt;

/// Representation of the spectral shape in which three vertices are mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Coefficients of A(z), as the paper writes it.
    Coefficients,
    /// Line spectral frequencies ω.
    LsfOmega,
    /// cos ω.
    LsfCosine,
    /// Reflection coefficients k.
    Reflection,
    /// Log-area ratios ln((1 + k)/(1 − k)).
    LogArea,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Coefficients,
        Self::LsfOmega,
        Self::LsfCosine,
        Self::Reflection,
        Self::LogArea,
    ];

    /// Its name in tables and charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coefficients => "AR coefficients",
            Self::LsfOmega => "LSF in ω",
            Self::LsfCosine => "LSF in cos ω",
            Self::Reflection => "reflection",
            Self::LogArea => "log-area ratios",
        }
    }
}

/// Representation of the level in which vertices are mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// σ², as the paper writes it.
    Variance,
    /// σ.
    Rms,
    /// ln σ, with a floor 60 dB below the loudest vertex, since ln 0 does not exist.
    Log,
}

impl Level {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Variance, Self::Rms, Self::Log];

    /// Its name in tables and charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Variance => "variance",
            Self::Rms => "RMS",
            Self::Log => "log",
        }
    }
}

/// Filter structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// Direct form, after conversion to coefficients.
    Direct,
    /// Chains of second-order sections in cos ω: no conversion.
    DirectLsp,
    /// The two-multiplier lattice.
    Lattice,
    /// The four-multiplier, power-preserving lattice.
    NormalisedLattice,
}

impl Structure {
    /// Its name in tables and charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct form",
            Self::DirectLsp => "direct LSP",
            Self::Lattice => "lattice",
            Self::NormalisedLattice => "normalised lattice",
        }
    }
}

/// Which filter the asset holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// As the source has it, with its own numerator.
    Full,
    /// This many poles over 1 + z⁻¹.
    WithZero(usize),
    /// This many poles over 1.
    AllPole(usize),
    /// The order that `--fidelity auto` chooses; all vertices stay.
    Auto,
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full => f.write_str("full"),
            Self::WithZero(order) => write!(f, "{order}, 1 + z⁻¹"),
            Self::AllPole(order) => write!(f, "{order}, all-pole"),
            Self::Auto => f.write_str("auto"),
        }
    }
}

/// Numbers that a kernel computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arithmetic {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
    /// 32 bits with 24 after the binary point; products are summed in 64 bits.
    Fixed32,
    /// Parameters in 32 bits; coefficients and signals in 16 bits with 12 after the binary
    /// point; products are summed in 32 bits.
    Fixed16,
}

impl Arithmetic {
    /// Its name in tables and charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
            Self::Fixed32 => "fixed 32",
            Self::Fixed16 => "fixed 16",
        }
    }
}

/// Behaviour between two conversions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Transition {
    /// Coefficients are held.
    Hold,
    /// Parameters pass a one-pole filter of 5 ms before conversion; coefficients are held.
    Smooth,
    /// Coefficients are ramped from one conversion to the next.
    Crossfade,
}

impl Transition {
    /// Its name in tables and charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hold => "held",
            Self::Smooth => "smoothed",
            Self::Crossfade => "crossfaded",
        }
    }
}

/// A rendering design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Design {
    /// Representation for mixing spectral shapes.
    pub shape: Shape,
    /// Representation for mixing levels.
    pub level: Level,
    /// Filter structure.
    pub structure: Structure,
    /// Which filter is rendered.
    pub order: Order,
    /// The numbers that are computed with.
    pub arithmetic: Arithmetic,
    /// Ticks from one conversion to the next.
    pub update_ticks: usize,
    /// Behaviour between two conversions.
    pub transition: Transition,
    /// Bits of a stored LSF, at most 16.
    pub lsf_bits: u32,
}

impl Design {
    /// The product's design when nothing is reduced.
    ///
    /// The runtime also spreads the work of a conversion over several ticks. The resulting delay is not modelled here.
    pub const DEFAULT: Self = Self {
        shape: Shape::LsfCosine,
        level: Level::Rms,
        structure: Structure::Direct,
        order: Order::Full,
        arithmetic: Arithmetic::F32,
        update_ticks: 6,
        transition: Transition::Smooth,
        lsf_bits: 16,
    };
    /// Reference for all errors: the default in f64, converted every tick, with unrounded LSFs.
    pub const ORACLE: Self = Self {
        arithmetic: Arithmetic::F64,
        update_ticks: 1,
        lsf_bits: u32::MAX,
        ..Self::DEFAULT
    };
}
