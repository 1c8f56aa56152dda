//! The factors of a kernel: one differs from the default at a time, or several as named.

use alloc::{
    format,
    string::{String, ToString as _},
    vec::Vec,
};
use core::fmt;

/// What three vertices are mixed in.
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

/// How levels are mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// σ², as the paper writes it.
    Variance,
    /// σ.
    Rms,
    /// ln σ, with a floor 60 dB below the loudest vertex: a logarithm has no zero.
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

/// How a sample is made.
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

/// What the filter of the asset is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// As the source has it, with its own numerator.
    Full,
    /// This many poles over 1 + z⁻¹.
    WithZero(usize),
    /// This many poles over 1.
    AllPole(usize),
    /// What `--fidelity auto` keeps of the order; the vertices all stay.
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
    /// 32 bits, 24 after the point, products summed in 64 bits.
    Fixed32,
    /// Parameters in 32 bits; coefficients and signals in 16 bits, 12 after the point,
    /// products summed in 32 bits.
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

/// What happens between two conversions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Transition {
    /// Coefficients are held.
    Hold,
    /// Parameters pass a one-pole of 5 ms before conversion; coefficients are held.
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

/// One way to render.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Design {
    /// What shapes are mixed in.
    pub shape: Shape,
    /// What levels are mixed in.
    pub level: Level,
    /// How a sample is made.
    pub structure: Structure,
    /// What the filter is.
    pub order: Order,
    /// What is computed with.
    pub arithmetic: Arithmetic,
    /// Ticks from one conversion to the next.
    pub every: usize,
    /// What happens between two conversions.
    pub transition: Transition,
    /// Bits of a stored LSF, at most 16.
    pub lsf_bits: u32,
}

impl Design {
    /// What the product renders with when nothing is reduced. The runtime also spreads the work
    /// of one conversion over the ticks before it takes effect; that lag is not an error here.
    pub const DEFAULT: Self = Self {
        shape: Shape::LsfCosine,
        level: Level::Rms,
        structure: Structure::Direct,
        order: Order::Full,
        arithmetic: Arithmetic::F32,
        every: 6,
        transition: Transition::Smooth,
        lsf_bits: 16,
    };
    /// What errors are measured against: the default in f64, converted every tick, its LSFs
    /// not rounded.
    pub const ORACLE: Self = Self {
        arithmetic: Arithmetic::F64,
        every: 1,
        lsf_bits: u32::MAX,
        ..Self::DEFAULT
    };
}

/// A factor, or `cross` where several differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Factor {
    /// The default itself.
    Default,
    /// What shapes are mixed in.
    Shape,
    /// What levels are mixed in.
    Level,
    /// How a sample is made.
    Structure,
    /// What the filter is.
    Order,
    /// What is computed with.
    Arithmetic,
    /// When parameters change.
    Update,
    /// Bits of a stored LSF.
    Quantisation,
    /// Several at once.
    Cross,
}

impl Factor {
    /// Those with variants of their own, in the order of the charts.
    pub const VARIED: [Self; 8] = [
        Self::Shape,
        Self::Level,
        Self::Structure,
        Self::Order,
        Self::Arithmetic,
        Self::Update,
        Self::Quantisation,
        Self::Cross,
    ];

    /// Its name in tables and charts.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Shape => "interpolation of shape",
            Self::Level => "interpolation of level",
            Self::Structure => "structure",
            Self::Order => "order and numerator",
            Self::Arithmetic => "arithmetic",
            Self::Update => "parameter update",
            Self::Quantisation => "LSF quantisation",
            Self::Cross => "crosses",
        }
    }
}

/// A design with its place in the comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variant {
    /// What it varies.
    pub factor: Factor,
    /// What it is called among the variants of its factor.
    pub name: String,
    /// The design.
    pub design: Design,
}

/// The default, every factor varied alone, and the named crosses.
#[must_use]
pub fn variants() -> Vec<Variant> {
    const D: Design = Design::DEFAULT;
    let mut all = Vec::new();
    let mut add = |factor, name: String, design: Design| {
        if design != D || factor == Factor::Default {
            all.push(Variant {
                factor,
                name,
                design,
            });
        }
    };
    add(Factor::Default, "default".into(), D);
    for shape in Shape::ALL {
        add(Factor::Shape, shape.name().into(), Design { shape, ..D });
    }
    for level in Level::ALL {
        add(Factor::Level, level.name().into(), Design { level, ..D });
    }
    for structure in [
        Structure::DirectLsp,
        Structure::Lattice,
        Structure::NormalisedLattice,
    ] {
        add(
            Factor::Structure,
            structure.name().into(),
            Design { structure, ..D },
        );
    }
    for order in [16, 12, 8, 6, 4, 3, 2] {
        for order in [Order::WithZero(order), Order::AllPole(order)] {
            add(Factor::Order, order.to_string(), Design { order, ..D });
        }
    }
    for arithmetic in [Arithmetic::F64, Arithmetic::Fixed32, Arithmetic::Fixed16] {
        add(
            Factor::Arithmetic,
            arithmetic.name().into(),
            Design { arithmetic, ..D },
        );
    }
    for transition in [Transition::Hold, Transition::Smooth, Transition::Crossfade] {
        for every in [1, 2, 4, 6, 8, 16] {
            // Nothing lies between two conversions that follow each other.
            if (transition, every) != (Transition::Crossfade, 1) {
                add(
                    Factor::Update,
                    format!("{every}, {}", transition.name()),
                    Design {
                        every,
                        transition,
                        ..D
                    },
                );
            }
        }
    }
    for lsf_bits in 8..16 {
        add(
            Factor::Quantisation,
            format!("{lsf_bits} bits"),
            Design { lsf_bits, ..D },
        );
    }
    for (name, design) in crosses() {
        add(Factor::Cross, name.into(), design);
    }
    all
}

/// Combinations that somebody would build.
fn crosses() -> [(&'static str, Design); 7] {
    const D: Design = Design::DEFAULT;
    let paper = Design {
        shape: Shape::Coefficients,
        level: Level::Variance,
        every: 1,
        transition: Transition::Hold,
        ..D
    };
    let lattice = Design {
        shape: Shape::Reflection,
        structure: Structure::Lattice,
        ..D
    };
    [
        ("the paper", paper),
        ("reflection, lattice", lattice),
        (
            "reflection, lattice, fixed 16",
            Design {
                arithmetic: Arithmetic::Fixed16,
                ..lattice
            },
        ),
        (
            "log-area, normalised lattice",
            Design {
                shape: Shape::LogArea,
                structure: Structure::NormalisedLattice,
                ..D
            },
        ),
        (
            "order 4, 1 + z⁻¹, 10 bits",
            Design {
                order: Order::WithZero(4),
                lsf_bits: 10,
                ..D
            },
        ),
        (
            "order 4, 1 + z⁻¹, fixed 16",
            Design {
                order: Order::WithZero(4),
                arithmetic: Arithmetic::Fixed16,
                ..D
            },
        ),
        (
            "auto order",
            Design {
                order: Order::Auto,
                ..D
            },
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_of_a_factor_differs_in_that_factor_alone() {
        for variant in variants() {
            let (d, v) = (Design::DEFAULT, variant.design);
            let differs = [
                (Factor::Shape, d.shape != v.shape),
                (Factor::Level, d.level != v.level),
                (Factor::Structure, d.structure != v.structure),
                (Factor::Order, d.order != v.order),
                (Factor::Arithmetic, d.arithmetic != v.arithmetic),
                (
                    Factor::Update,
                    (d.every, d.transition) != (v.every, v.transition),
                ),
                (Factor::Quantisation, d.lsf_bits != v.lsf_bits),
            ];
            let found: Vec<Factor> = differs
                .iter()
                .filter(|(_, differs)| *differs)
                .map(|(factor, _)| *factor)
                .collect();
            match variant.factor {
                Factor::Default => assert!(found.is_empty()),
                Factor::Cross => assert!(!found.is_empty()),
                factor => assert_eq!(found, [factor], "{}", variant.name),
            }
        }
    }

    #[test]
    fn names_tell_variants_apart() {
        let all = variants();
        for (index, variant) in all.iter().enumerate() {
            let twin = |other: &Variant| {
                (other.factor, &other.name) == (variant.factor, &variant.name)
                    || other.design == variant.design
            };
            assert!(!all[..index].iter().any(twin), "{}", variant.name);
        }
    }
}
