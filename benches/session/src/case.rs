//! The textures that are measured, each with a slot of just its size.

use asperity_runtime::{Capacities, Float, Texture};

/// The library that the firmware carries; `cortex-m library` writes it.
pub static LIBRARY: &[u8] = include_bytes!("../textures.aspl");

/// 40 vertices, 56 triangles, 13 taps; orders in multiples of 4.
pub type Arma20<A = Float> = Texture<Capacities<40, 56, 20, 20, TAP_SAMPLES>, A>;
/// Order 21, as prompts give it, fits too.
pub type Nyquist20<A = Float> = Texture<Capacities<40, 56, 24, 0, TAP_SAMPLES>, A>;
/// The cheapest that is felt as the original.
pub type Nyquist4<A = Float> = Texture<Capacities<40, 56, 4, 0, TAP_SAMPLES>, A>;

/// 100 samples at 10 kHz last 10 ticks at 1 kHz and ring for some more.
const TAP_SAMPLES: usize = 13 * 40;

/// A measured texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Case {
    /// Name of the firmware and of its limits.
    pub name: &'static str,
    /// Name in the library.
    pub texture: &'static str,
    /// Bytes of the slot.
    pub slot_bytes: usize,
}

/// Order 20 with MA part.
pub const ARMA_20: Case = Case {
    name: "arma20",
    texture: "order 20, ARMA",
    slot_bytes: size_of::<Arma20>(),
};
/// Order 20 with a zero at Nyquist.
pub const NYQUIST_20: Case = Case {
    name: "nyquist20",
    texture: "order 20, zero at Nyquist",
    slot_bytes: size_of::<Nyquist20>(),
};
/// Order 4 with a zero at Nyquist.
pub const NYQUIST_4: Case = Case {
    name: "nyquist4",
    texture: "order 4, zero at Nyquist",
    slot_bytes: size_of::<Nyquist4>(),
};

/// Every case.
pub const CASES: [Case; 3] = [ARMA_20, NYQUIST_20, NYQUIST_4];
