//! The designs that are compared: one setting differs from the default at a time, or several
//! as named.

use super::settings::{Arithmetic, Design, Level, Order, Shape, Structure, Transition};
use alloc::{
    format,
    string::{String, ToString as _},
    vec::Vec,
};

/// Which setting differs from the default, or `Cross` where several do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Factor {
    /// The default itself.
    Default,
    /// Mixing of spectral shapes.
    Shape,
    /// Mixing of levels.
    Level,
    /// Filter structure.
    Structure,
    /// Which filter is rendered.
    Order,
    /// The numbers that are computed with.
    Arithmetic,
    /// When parameters change.
    Update,
    /// Bits of a stored LSF.
    Quantisation,
    /// Several at once.
    Cross,
}

impl Factor {
    /// The factors that have variants, in the order of the charts.
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
    /// The varied factor.
    pub factor: Factor,
    /// Name among the variants of its factor.
    pub name: String,
    /// The design.
    pub design: Design,
}

/// The default, every factor varied alone, and named combinations.
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
        for update_ticks in [1, 2, 4, 6, 8, 16] {
            // With a conversion at every tick there is nothing to crossfade.
            if (transition, update_ticks) != (Transition::Crossfade, 1) {
                add(
                    Factor::Update,
                    format!("{update_ticks}, {}", transition.name()),
                    Design {
                        update_ticks,
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

/// Combinations that one might build.
fn crosses() -> [(&'static str, Design); 7] {
    const D: Design = Design::DEFAULT;
    let paper = Design {
        shape: Shape::Coefficients,
        level: Level::Variance,
        update_ticks: 1,
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
                    (d.update_ticks, d.transition) != (v.update_ticks, v.transition),
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
