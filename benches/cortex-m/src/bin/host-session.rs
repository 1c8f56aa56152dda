//! The session on the host: prints, for the case that is named, the hash after each phase.
#![forbid(unsafe_code)]

use asperity_runtime::{State, Texture};
use asperity_session::{ARMA_20, Arma20, Case, NYQUIST_4, NYQUIST_20, Nyquist4, Nyquist20, SEED};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let case = std::env::args().nth(1).unwrap_or_default();
    match case.as_str() {
        "arma20" => run(&ARMA_20, Arma20::new()),
        "nyquist20" => run(&NYQUIST_20, Nyquist20::new()),
        "nyquist4" => run(&NYQUIST_4, Nyquist4::new()),
        other => Err(format!("no case {other:?}").into()),
    }
}

fn run<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
    case: &Case,
    mut slot: Texture<V, T, P, Q, K>,
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
