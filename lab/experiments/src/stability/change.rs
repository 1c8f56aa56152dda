//! A change of the texture in the middle of a stroke.

use super::unbounded;
use asperity::{emit::lower::lower, signal::lsf};
use asperity_formats::Asset;
use asperity_runtime::{Exchange, Renderer, Sample, State, stage::excitation::Excitation};

use super::error::StabilityError;
use super::filters::resonant;
use super::material::Material;
use super::methods::AllPole;
use super::row::{ScenarioResult, Words};
use crate::signal::rms;

/// Ticks between changes.
const PERIOD: usize = 500;
/// Number of changes.
const CHANGES: usize = 40;

/// Two textures of one filter each, with poles of radius 0.986 at 60 Hz and at 400 Hz. The
/// second is an eighth as loud.
fn textures() -> Result<[Material; 2], StabilityError> {
    let like = asperity::sources::builtin::texture();
    let texture = |hz: f64, level_m_s2: f64| {
        let lsf_rad = lsf::from_polynomial(&resonant(hz)).expect("a stable filter");
        let mut vertex = like.grid.vertices[0].clone();
        let power: f64 = impulse_response(&resonant(hz)).map(|h| h * h).sum();
        (vertex.lsf_rad, vertex.sigma_m_s2) = (lsf_rad, level_m_s2 / power.sqrt());
        Material::constant(&like, &vertex)
    };
    Ok([texture(60.0, 2.0)?, texture(400.0, 0.25)?])
}

/// Two textures that hardly vibrate, of walls of 500 and 250 N/m, 2 mm deep, and μ of 0.7 and 0.2.
fn walls() -> Result<[Material; 2], StabilityError> {
    let like = asperity::sources::builtin::texture();
    let texture = |stiffness_n_m: f64, mu: f64| {
        let mut vertex = like.grid.vertices[0].clone();
        vertex.sigma_m_s2 = 1e-6;
        let mut like = like.clone();
        (like.wall.stiffness_n_m, like.friction.mu) = (stiffness_n_m, mu);
        Material::constant(&like, &vertex)
    };
    Ok([texture(500.0, 0.7)?, texture(250.0, 0.2)?])
}

fn impulse_response(monic: &[f64]) -> impl Iterator<Item = f64> {
    let mut filter = AllPole::default();
    (0..4000).map(move |n| filter.step(monic, if n == 0 { 1.0 } else { 0.0 }))
}

/// Loudest 20 ms after a change relative to the loudest 20 ms elsewhere, dB. The texture of
/// `signal` changes every [`PERIOD`] ticks.
fn rise_db(signal: &[f64]) -> f64 {
    let (mut after, mut elsewhere) = (0.0_f64, 0.0_f64);
    for stretch in signal.chunks_exact(PERIOD).skip(1) {
        for (n, block) in stretch.chunks_exact(20).enumerate() {
            let level = rms(block);
            if n == 0 {
                after = after.max(level);
            } else {
                elsewhere = elsewhere.max(level);
            }
        }
    }
    20.0 * (after / elsewhere).log10()
}

/// A sample of a stroke at 100 mm/s, 2 mm deep: 1 N on a wall of 500 N/m.
fn stroke(tick: usize) -> Sample {
    Sample::at([1e-4 * tick as f32, 0.0, -2e-3])
}

/// The vibration of the stroke over textures that take turns.
fn ours(textures: &[Material; 2], seed: u64) -> Vec<f64> {
    let renderer = Renderer::new(&unbounded()).expect("the default");
    let mut state = State::new(seed);
    (0..PERIOD * CHANGES)
        .map(|n| {
            let texture = &textures[n / PERIOD % 2].slot;
            let output = renderer.tick(texture, &mut state, &stroke(n));
            f64::from(output.vib_m_s2)
        })
        .collect()
}

/// Distance of two forces, N.
fn step_n([from, to]: [[f32; 3]; 2]) -> f64 {
    let squares = (0..3).map(|i| (f64::from(to[i]) - f64::from(from[i])).powi(2));
    squares.sum::<f64>().sqrt()
}

/// The largest step of the force in the stroke, N, over textures that are exchanged in turn.
fn largest_step_n(textures: [Material; 2], seed: u64) -> Result<f64, StabilityError> {
    let [first, second] = textures.each_ref().map(|m| lower(&m.model, None));
    let bytes = [first?.bytes, second?.bytes];
    let renderer = Renderer::new(&unbounded()).expect("the default");
    let [mut playing, mut spare] = textures.map(|material| material.slot);
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut spare], seed);
    let (mut last, mut largest) = ([0.0; 3], 0.0_f64);
    for n in 0..PERIOD * CHANGES {
        if n > 0 && n % PERIOD == 0 {
            let asset = Asset::parse(&bytes[n / PERIOD % 2]).expect("the compiler's own bytes");
            let prepared = preparer.prepare(&asset, 1000.0);
            prepared.expect("the spare slot is back");
        }
        let force_n = renderer.tick_player(&mut player, &stroke(n)).force_n;
        if n > PERIOD / 2 {
            largest = largest.max(step_n([last, force_n]));
        }
        last = force_n;
    }
    Ok(largest)
}

/// Step of the force, N, where wall and friction change at once.
fn step_at_once_n(textures: &[Material; 2], seed: u64) -> f64 {
    let renderer = Renderer::new(&unbounded()).expect("the default");
    step_n(textures.each_ref().map(|material| {
        let mut state = State::new(seed);
        let mut tick = |n| renderer.tick(&material.slot, &mut state, &stroke(n));
        (0..PERIOD).map(&mut tick).last().expect("a tick").force_n
    }))
}

/// The same vibration by a transposed direct form II. Its state holds products with the old
/// coefficients when they change. The level is applied before the filter.
fn transposed(textures: &[Material; 2], seed: u64) -> Vec<f64> {
    let mut noise = Excitation::new(seed);
    let models = textures
        .each_ref()
        .map(|m| (m.monic(100.0, 1.0), m.slot.filter_at(100.0, 1.0).level_m_s2));
    let mut state = vec![0.0; models[0].0.len()];
    (0..PERIOD * CHANGES)
        .map(|n| {
            let (monic, level) = &models[n / PERIOD % 2];
            let y = f64::from(level * noise.next_gaussian()) + state[0];
            for k in 1..monic.len() {
                state[k - 1] = state.get(k).copied().unwrap_or(0.0) - monic[k] * y;
            }
            y
        })
        .collect()
}

/// The same vibration with coefficients a_k that crossfade over 20 ms.
fn faded(textures: &[Material; 2], seed: u64) -> Vec<f64> {
    let mut filter = AllPole::default();
    let mut noise = Excitation::new(seed);
    let models = textures.each_ref().map(|m| {
        (
            m.monic(100.0, 1.0),
            f64::from(m.slot.filter_at(100.0, 1.0).level_m_s2),
        )
    });
    (0..PERIOD * CHANGES)
        .map(|n| {
            let (now, before) = (&models[n / PERIOD % 2], &models[(n / PERIOD + 1) % 2]);
            let faded = ((n % PERIOD) as f64 / 20.0).min(1.0);
            let mix = |a: f64, b: f64| faded * a + (1.0 - faded) * b;
            let monic: Vec<f64> = now
                .0
                .iter()
                .zip(&before.0)
                .map(|(a, b)| mix(*a, *b))
                .collect();
            filter.step(
                &monic,
                mix(now.1, before.1) * f64::from(noise.next_gaussian()),
            )
        })
        .collect()
}

const CHANGE: Words = Words {
    theme: "change",
    quantity: "loudest 20 ms after a change over the loudest elsewhere (dB)",
    fails: "a state that holds products with old coefficients, or halfway coefficients, is a shock",
    instead: "the level enters before the filter, the past is in m/s², LSFs follow in 5 ms",
};
const FORCE: Words = Words {
    theme: "change",
    quantity: "largest step of the force in a tick (N)",
    fails: "stiffness and μ that change at once step the force by Δk·δ",
    instead: "in an exchange, wall, gains and friction go to the new texture as a one-pole",
};

/// The rows.
///
/// # Errors
/// None for these textures.
pub fn rows(seed: u64) -> Result<Vec<ScenarioResult>, StabilityError> {
    let (textures, walls) = (textures()?, walls()?);
    let vibration = ours(&textures, seed);
    let at_once_n = step_at_once_n(&walls, seed);
    let every = format!("take turns every {PERIOD} ms of a stroke, {CHANGES} times");
    Ok(vec![
        CHANGE.row(
            format!("two textures {every}"),
            rise_db(&vibration),
            0.0,
            &[
                ("transposed form", rise_db(&transposed(&textures, seed))),
                ("a_k faded in 20 ms", rise_db(&faded(&textures, seed))),
            ],
        ),
        FORCE.row(
            format!("walls of 500 and 250 N/m, μ 0.7 and 0.2, {every}"),
            largest_step_n(walls, seed)?,
            0.2,
            &[("at once", at_once_n)],
        ),
    ])
}
