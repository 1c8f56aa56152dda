//! A whole case in one call, for machines that have room for a slot on the stack.
//!
//! The crate of the session must not have it: a tick compiled there, for size, would find its way
//! into the firmware, whose tick is compiled for speed.

use asperity_runtime::{
    Capacity, ConfigError, Fixed, Float, LoadError, RenderArithmetic, State, Texture,
};
use asperity_session::{
    ARMA_20, Arma20, Case, NYQUIST_4, NYQUIST_20, Nyquist4, Nyquist20, Phase, SEED, load, renderer,
    run,
};
use core::{error::Error, fmt};

/// Arithmetic of a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numbers {
    /// [`Float`].
    Float,
    /// [`Fixed`].
    Fixed,
}

impl Numbers {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Float, Self::Fixed];

    /// In a word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Fixed => "fixed",
        }
    }
}

/// Why a case has no hashes: never, while the library that comes with it is whole.
#[derive(Debug)]
pub enum HashesError {
    /// No slot is known for the case.
    Unknown,
    /// The texture is refused.
    Load(LoadError),
    /// The configuration is refused.
    Config(ConfigError),
}

impl fmt::Display for HashesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => f.write_str("no slot is known for the case"),
            Self::Load(error) => error.fmt(f),
            Self::Config(error) => error.fmt(f),
        }
    }
}

impl Error for HashesError {}

/// Loads a case, runs the session, and returns the hash of all outputs and counters after
/// each phase.
///
/// # Errors
/// [`HashesError`].
pub fn hashes(case: &Case, numbers: Numbers) -> Result<[u64; Phase::ALL.len()], HashesError> {
    match numbers {
        Numbers::Float => with::<Float>(case),
        Numbers::Fixed => with::<Fixed>(case),
    }
}

fn with<A: RenderArithmetic>(case: &Case) -> Result<[u64; Phase::ALL.len()], HashesError> {
    match *case {
        ARMA_20 => in_slot(case, Arma20::<A>::new()),
        NYQUIST_20 => in_slot(case, Nyquist20::<A>::new()),
        NYQUIST_4 => in_slot(case, Nyquist4::<A>::new()),
        _ => Err(HashesError::Unknown),
    }
}

fn in_slot<S: Capacity, A: RenderArithmetic>(
    case: &Case,
    mut slot: Texture<S, A>,
) -> Result<[u64; Phase::ALL.len()], HashesError> {
    load(case, &mut slot).map_err(HashesError::Load)?;
    let renderer = renderer().map_err(HashesError::Config)?;
    let mut hashes = [0; Phase::ALL.len()];
    let mut places = hashes.iter_mut();
    run(
        &mut State::new(SEED),
        |state, sample| renderer.tick(&slot, state, sample),
        |_, hash| {
            if let Some(place) = places.next() {
                *place = hash;
            }
        },
    );
    Ok(hashes)
}
