//! The session on the host: prints, for the case and the arithmetic that are named, the hash
//! after each phase.
#![forbid(unsafe_code)]

use asperity_runtime::{Arithmetic, Fixed, Float, State, Texture};
use asperity_session::{ARMA_20, Arma20, Case, NYQUIST_4, NYQUIST_20, Nyquist4, Nyquist20, SEED};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let case = words.next().unwrap_or_default();
    match words.next().as_deref() {
        Some("float") => of::<Float>(&case),
        Some("fixed") => of::<Fixed>(&case),
        other => Err(format!("no arithmetic {other:?}").into()),
    }
}

fn of<A: Arithmetic>(case: &str) -> Result<(), Box<dyn Error>> {
    match case {
        "arma20" => run::<_, _, _, _, _, A>(&ARMA_20, Arma20::new()),
        "nyquist20" => run::<_, _, _, _, _, A>(&NYQUIST_20, Nyquist20::new()),
        "nyquist4" => run::<_, _, _, _, _, A>(&NYQUIST_4, Nyquist4::new()),
        other => Err(format!("no case {other:?}").into()),
    }
}

fn run<
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
    A: Arithmetic,
>(
    case: &Case,
    mut slot: Texture<V, T, P, Q, K, A>,
) -> Result<(), Box<dyn Error>> {
    asperity_session::load(case, &mut slot)?;
    let renderer = asperity_session::renderer()?;
    asperity_session::run(
        &mut State::new(SEED),
        |state, sample| renderer.tick(&slot, state, sample),
        |phase, hash| println!("{} {hash:016x}", phase.name()),
    );
    Ok(())
}
