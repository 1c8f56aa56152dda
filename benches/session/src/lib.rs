//! The scripted session that firmware and host both run: the same samples, made of
//! + − × ÷ alone, and a hash of every bit that comes out.
#![no_std]
#![forbid(unsafe_code)]

mod case;
mod hash;
mod phase;
mod scenes;

pub use case::{ARMA_20, Arma20, CASES, Case, LIBRARY, NYQUIST_4, NYQUIST_20, Nyquist4, Nyquist20};
pub use hash::Hash;
pub use phase::{PHASE_TICKS, Phase};
pub use scenes::{
    CaseError, CostScene, CostSlot, SCENE_BYTES, SCENE_CASES, SceneCase, TOUCHED, run_scene,
};

use asperity_formats::{Asset, Library};
use asperity_runtime::{
    Capacity, Config, ConfigError, Fixed, Float, LoadError, Output, RenderArithmetic, Renderer,
    Sample, State, Texture,
};

/// Seed of the excitation.
pub const SEED: u64 = 7;

/// Loads a case's texture from the embedded library into `slot`, at 1 kHz.
///
/// # Errors
/// What the library or the slot says.
pub fn load<S: Capacity, A: RenderArithmetic>(
    case: &Case,
    slot: &mut Texture<S, A>,
) -> Result<(), LoadError> {
    let library = Library::parse(LIBRARY)?;
    let index = library.index().find(case.texture).unwrap_or(usize::MAX);
    slot.load(
        &Asset::parse_haptic(library.bytes(index)?)?,
        Config::default().servo_rate_hz,
    )
}

/// A slot of one of the cases. Loading is compiled here, for size, and the tick where it is
/// called, for speed.
pub trait Slot {
    /// [`load`].
    ///
    /// # Errors
    /// What the library or the slot says.
    fn load(&mut self, case: &Case) -> Result<(), LoadError>;
}

macro_rules! slots {
    ($($slot:ty),*) => {
        $(impl Slot for $slot {
            #[inline(never)]
            fn load(&mut self, case: &Case) -> Result<(), LoadError> {
                load(case, self)
            }
        })*
    };
}

slots!(
    Arma20<Float>,
    Nyquist20<Float>,
    Nyquist4<Float>,
    Arma20<Fixed>,
    Nyquist20<Fixed>,
    Nyquist4<Fixed>
);

/// Runs every phase, [`PHASE_TICKS`] ticks each, through `tick`, and tells `report`
/// after each the hash of all outputs and counters so far.
pub fn run<A: RenderArithmetic>(
    state: &mut State<A>,
    mut tick: impl FnMut(&mut State<A>, &Sample<A>) -> Output<A>,
    mut report: impl FnMut(Phase, u64),
) {
    let mut hash = Hash::new();
    for phase in Phase::ALL {
        for n in 0..PHASE_TICKS {
            hash.output(&tick(state, &Sample::of(&phase.sample(n))));
        }
        hash.counters(state.counters());
        report(phase, hash.value());
    }
}

/// The default renderer: a Touch at 1 kHz over the plane z = 0.
///
/// # Errors
/// Never, while the default configuration is a valid one.
pub fn renderer<A: RenderArithmetic>() -> Result<Renderer<A>, ConfigError> {
    Renderer::prepare(&Config::default())
}
