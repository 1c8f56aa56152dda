//! Quantities, their units, and the factors to SI.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Acceleration of the tool.
    Acceleration,
    /// Force between tool and surface.
    Force,
    /// Torque; read and checked, not used.
    Torque,
    /// Position of the tool's tip.
    Position,
    /// Speed of the tool's tip.
    Speed,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Acceleration => "acceleration",
            Self::Force => "force",
            Self::Torque => "torque",
            Self::Position => "position",
            Self::Speed => "speed",
        })
    }
}

/// A unit of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As a description writes it.
    pub name: &'static str,
    /// The quantity that it measures.
    pub quantity: Quantity,
    /// SI units in one of it.
    pub to_si: f64,
}

const fn unit(name: &'static str, quantity: Quantity, to_si: f64) -> Unit {
    Unit {
        name,
        quantity,
        to_si,
    }
}

/// Standard gravity, m/s².
pub const GRAVITY_M_S2: f64 = 9.806_65;

const UNITS: [Unit; 20] = [
    unit("m/s^2", Quantity::Acceleration, 1.0),
    unit("m/s²", Quantity::Acceleration, 1.0),
    unit("mm/s^2", Quantity::Acceleration, 1e-3),
    unit("g", Quantity::Acceleration, GRAVITY_M_S2),
    unit("mg", Quantity::Acceleration, 1e-3 * GRAVITY_M_S2),
    unit("N", Quantity::Force, 1.0),
    unit("mN", Quantity::Force, 1e-3),
    unit("kN", Quantity::Force, 1e3),
    unit("kgf", Quantity::Force, GRAVITY_M_S2),
    unit("gf", Quantity::Force, 1e-3 * GRAVITY_M_S2),
    unit("lbf", Quantity::Force, 4.448_221_615_260_5),
    unit("N*m", Quantity::Torque, 1.0),
    unit("N*mm", Quantity::Torque, 1e-3),
    unit("m", Quantity::Position, 1.0),
    unit("mm", Quantity::Position, 1e-3),
    unit("um", Quantity::Position, 1e-6),
    unit("cm", Quantity::Position, 1e-2),
    unit("m/s", Quantity::Speed, 1.0),
    unit("mm/s", Quantity::Speed, 1e-3),
    unit("cm/s", Quantity::Speed, 1e-2),
];

impl Unit {
    /// The unit of a quantity with this name.
    #[must_use]
    pub fn named(name: &str, quantity: Quantity) -> Option<Self> {
        UNITS
            .into_iter()
            .find(|unit| unit.name == name && unit.quantity == quantity)
    }

    /// The unit with this name, of whichever quantity; no two have one name.
    #[must_use]
    pub(crate) fn any(name: &str) -> Option<Self> {
        UNITS.into_iter().find(|unit| unit.name == name)
    }

    /// The name of the first unit of a quantity whose factor to SI is the one that is asked for.
    #[must_use]
    pub(crate) fn worth(quantity: Quantity, is: impl Fn(f64) -> bool) -> Option<&'static str> {
        let mut all = UNITS.into_iter().filter(|unit| unit.quantity == quantity);
        all.find(|unit| is(unit.to_si)).map(|unit| unit.name)
    }

    /// All units of a quantity, for an error.
    #[must_use]
    pub fn all(quantity: Quantity) -> String {
        let names: Vec<&str> = UNITS
            .iter()
            .filter(|unit| unit.quantity == quantity)
            .map(|unit| unit.name)
            .collect();
        names.join(", ")
    }

    /// The unit in which the project reports a quantity: SI.
    #[must_use]
    pub fn si(quantity: Quantity) -> &'static str {
        match quantity {
            Quantity::Acceleration => "m/s²",
            Quantity::Force => "N",
            Quantity::Torque => "N*m",
            Quantity::Position => "m",
            Quantity::Speed => "m/s",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_is_worth_what_it_is_in_si_and_belongs_to_one_quantity() {
        use Quantity::{Acceleration, Force, Position, Speed, Torque};
        for (name, quantity, to_si) in [
            ("m/s^2", Acceleration, 1.0),
            ("mm/s^2", Acceleration, 0.001),
            ("g", Acceleration, 9.806_65),
            ("mg", Acceleration, 0.009_806_65),
            ("mN", Force, 0.001),
            ("kN", Force, 1000.0),
            ("kgf", Force, 9.806_65),
            ("gf", Force, 0.009_806_65),
            // 0.453 592 37 kg times standard gravity.
            ("lbf", Force, 4.448_221_615_260_5),
            ("N*mm", Torque, 0.001),
            ("um", Position, 0.000_001),
            ("cm", Position, 0.01),
            ("mm/s", Speed, 0.001),
            ("cm/s", Speed, 0.01),
        ] {
            let found = Unit::named(name, quantity).expect(name);
            assert!((found.to_si / to_si - 1.0).abs() < 1e-12, "{name}");
            assert_eq!(Unit::any(name), Some(found));
            for other in [Acceleration, Force, Torque, Position, Speed] {
                assert_eq!(Unit::named(name, other).is_some(), other == quantity);
            }
        }
        assert_eq!(Unit::any("gee"), None);
        assert_eq!(Unit::all(Torque), "N*m, N*mm");
        assert_eq!(Unit::all(Speed), "m/s, mm/s, cm/s");
    }
}
