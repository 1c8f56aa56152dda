//! Taps of a material that has none, synthesised from the hardness that we state for it.

use crate::{
    TAP_SAMPLES, TAPS,
    generator::{self, Physical},
};

/// Modulus at hardness 0, decades re 1 MPa, and hardness per decade. Jelly has 0.01 MPa, granite
/// about seven decades more.
const SOFTEST_DECADES: f64 = -2.0;
const HARDNESS_PER_DECADE: f64 = 14.0;

/// A surface with the parameters that taps and wall depend on: a modulus of 10^(−2 + hard/14) MPa
/// and the losses of its family. Other parameters stay neutral. `None` for an unknown family.
pub(super) fn surface(hard: f64, family: &str, mu: f64) -> Option<Physical> {
    Some(Physical {
        wavelength_mm: 1.0,
        spread_octaves: 1.0,
        height_um: 1.0,
        modulus_mpa: libm::exp10(SOFTEST_DECADES + hard / HARDNESS_PER_DECADE),
        loss_factor: loss_factor(family)?,
        mu,
    })
}

/// Typical loss factor of a family, estimated as in the reference corpus.
pub(super) fn loss_factor(family: &str) -> Option<f64> {
    Some(match family {
        "metal" => 0.005,
        "stone" | "tile" => 0.01,
        "carbon fibre" => 0.03,
        "wood" => 0.05,
        "plastic" | "paper" => 0.08,
        "fabric" => 0.2,
        "carpet" => 0.25,
        "foam" => 0.3,
        _ => return None,
    })
}

/// The bank of traces, m/s² at 10 kHz, by impact speed.
pub(super) fn bank(surface: &Physical) -> [[f32; TAP_SAMPLES]; TAPS] {
    generator::tap::bank(surface)
}
