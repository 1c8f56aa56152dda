//! Mixtures of models, and models that change every sample.

use asperity::signal::lsf;
use asperity_runtime::quantity::Quantity;
use asperity_runtime::stage::excitation::Excitation;
use asperity_runtime::stage::vibration::Vibration;
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::filters::random_lsf;
use super::material::{HARD, Material};
use super::methods::AllPole;
use super::methods::all_pole::{is_stable, mixed, polynomials};
use super::row::{ScenarioResult, Words};
use crate::signal::rms;
use asperity_sim::random::unit;

/// Number of points in each material, and of pairs of random filters.
const POINTS: usize = 20_000;
/// Number of pairs of vertices that alternate, ticks of each, and first ticks that are left out.
const PAIRS: usize = 60;
const TICKS: usize = 2500;
const SETTLE: usize = 500;
/// Time constant of the parameters, ticks at 1 kHz: the default's 5 ms.
const FOLLOW_TICKS: f64 = 5.0;
/// Ticks of a block whose loudness counts: 20 ms.
pub const BLOCK: usize = 20;

/// Percentage of unstable filters at random points of a grid: of ours, and of mixed a_k.
fn unstable(material: &Material, seed: u64) -> [f64; 2] {
    let grid = &material.model.grid;
    let polynomials = polynomials(grid);
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut count = [0_usize; 2];
    for _ in 0..POINTS {
        // A random triangle, and a uniform point in it.
        let triangle = grid.triangles[(unit(&mut rng) * grid.triangles.len() as f64) as usize];
        let (mut s, mut t) = (unit(&mut rng), unit(&mut rng));
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        let w = [1.0 - s - t, s, t];
        let at = |f: fn(&asperity::model::GridVertex) -> f64| -> f64 {
            (0..3).map(|i| w[i] * f(&grid.vertices[triangle[i]])).sum()
        };
        let ours = material.monic(at(|v| v.speed_mm_s), at(|v| v.force_n));
        count[0] += usize::from(!is_stable(&ours));
        let corners = triangle.map(|v| polynomials[v].as_slice());
        count[1] += usize::from(!is_stable(&mixed(corners, w)));
    }
    count.map(|n| 100.0 * n as f64 / POINTS as f64)
}

/// Percentage of unstable halfway mixtures of random pairs of filters of order 20: of cosines of
/// LSFs, and of coefficients.
fn unstable_pairs(seed: u64) -> [f64; 2] {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut count = [0_usize; 2];
    for _ in 0..POINTS {
        let [a, b] = [(); 2].map(|()| random_lsf(&mut rng, 20, 0.038));
        let between: Vec<f64> = a
            .iter()
            .zip(&b)
            .map(|(a, b)| (0.5 * (a.cos() + b.cos())).acos())
            .collect();
        count[0] += usize::from(!is_stable(&lsf::to_polynomial(&between)));
        let [a, b] = [a, b].map(|x| lsf::to_polynomial(&x));
        count[1] += usize::from(!is_stable(&mixed([&a, &b, &b], [0.5, 0.25, 0.25])));
    }
    count.map(|n| 100.0 * n as f64 / POINTS as f64)
}

/// RMS of the loudest block.
fn loudest(signal: &[f64]) -> f64 {
    signal.chunks_exact(BLOCK).map(rms).fold(0.0, f64::max)
}

/// A query: speed, mm/s, and force, N.
type Query = (f32, f32);

/// Which of two places is queried at every tick.
///
/// It is the first one until everything has settled, then either at random, so that no interval
/// between conversions always samples the same one.
fn turns(seed: u64) -> impl Iterator<Item = usize> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    (0..TICKS).map(move |n| {
        let second = unit(&mut rng) < 0.5;
        usize::from(n >= SETTLE && second)
    })
}

/// The vibration of the runtime while speed and force take turns.
fn runtime(material: &Material, places: [Query; 2], seed: u64) -> Vec<f64> {
    let fraction = 1.0 - (-f64::from(material.slot.cycle_samples()) / FOLLOW_TICKS).exp();
    let mut vibration = Vibration::new(seed);
    turns(seed)
        .map(|turn| {
            let (speed_mm_s, force_n) = places[turn];
            let (speed, force) = (Quantity(speed_mm_s), Quantity(force_n));
            let fraction = Quantity(fraction as f32);
            let sounded = vibration.step(&material.slot, speed, force, fraction, true);
            f64::from(sounded.y.value())
        })
        .skip(SETTLE)
        .collect()
}

/// The same vibration by direct forms whose coefficients change at once.
fn direct(material: &Material, places: [Query; 2], seed: u64) -> Vec<f64> {
    let mut filter = AllPole::default();
    let mut noise = Excitation::new(seed);
    let models = places.map(|(speed_mm_s, force_n)| {
        let level = material.slot.filter_at(speed_mm_s, force_n).level_m_s2;
        (material.monic(speed_mm_s.into(), force_n.into()), level)
    });
    turns(seed)
        .map(|turn| {
            let (monic, level) = &models[turn];
            filter.step(monic, f64::from(level * noise.next_gaussian()))
        })
        .skip(SETTLE)
        .collect()
}

/// Renders a material at two places that take turns, from a seed.
type Method = fn(&Material, [Query; 2], u64) -> Vec<f64>;

/// The vibration while the models of a random pair of vertices take turns.
struct Pair {
    /// Vibration of the runtime, and of direct forms that change at once.
    signals: [Vec<f64>; 2],
    /// Their loudest blocks relative to the louder steady RMS, dB.
    rise_db: [f64; 2],
}

/// [`PAIRS`] random pairs of a material's vertices.
fn pairs(material: &Material, seed: u64) -> Vec<Pair> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let sounding = material.model.grid.vertices.iter();
    let places: Vec<Query> = sounding
        .filter(|v| v.sigma_m_s2 > 0.0)
        .map(|v| (v.speed_mm_s as f32, v.force_n as f32))
        .collect();
    let methods: [Method; 2] = [runtime, direct];
    let steady: Vec<[f64; 2]> = places
        .iter()
        .map(|&place| methods.map(|method| rms(&method(material, [place; 2], seed))))
        .collect();
    (0..PAIRS)
        .map(|_| {
            let [i, j] = [(); 2].map(|()| (unit(&mut rng) * places.len() as f64) as usize);
            let signals = methods.map(|method| method(material, [places[i], places[j]], seed));
            let rise_db = [0, 1].map(|k| {
                let db = 20.0 * (loudest(&signals[k]) / steady[i][k].max(steady[j][k])).log10();
                if db.is_nan() { f64::INFINITY } else { db }
            });
            Pair { signals, rise_db }
        })
        .collect()
}

/// The signals of the pair that is worst for a direct form: the runtime's, and the direct form's.
#[must_use]
pub fn worst_pair(material: &Material, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let worst = pairs(material, seed)
        .into_iter()
        .max_by(|a, b| a.rise_db[1].total_cmp(&b.rise_db[1]));
    worst.map_or_else(Default::default, |pair| pair.signals.into())
}

const MIX: Words = Words {
    theme: "mixing",
    quantity: "unstable filters (%)",
    fails: "a convex mixture of stable a_k need not be stable",
    instead: "cosines of LSFs are mixed: ordered, hence stable, whatever the weights",
};
const ALTERNATE: Words = Words {
    theme: "mixing",
    quantity: "loudest 20 ms over the louder steady RMS (dB)",
    fails: "two stable filters that alternate are one unstable system",
    instead: "LSFs follow in 5 ms and are converted then: the recursion sees a filter that moves \
              slowly",
};

/// The rows.
#[must_use]
pub fn rows(materials: &[Material], seed: u64) -> Vec<ScenarioResult> {
    let mut rows = Vec::new();
    let [ours, mixed] = unstable_pairs(seed);
    rows.push(MIX.row(
        format!("{POINTS} random pairs of filters of order 20, halfway"),
        ours,
        0.0,
        &[("mixed a_k", mixed)],
    ));
    for name in std::iter::once("Built-in Grit").chain(HARD) {
        let scenario = format!("{name}: {POINTS} random points");
        match materials.iter().find(|m| m.name == name) {
            Some(material) => {
                let [ours, mixed] = unstable(material, seed);
                rows.push(MIX.row(scenario, ours, 0.0, &[("mixed a_k", mixed)]));
            }
            None => rows.push(MIX.skipped(scenario, "needs the HaTT materials: --hatt DIR")),
        }
    }
    for material in materials {
        let pairs = pairs(material, seed);
        let [ours, at_once] = [0, 1].map(|k| {
            let rises = pairs.iter().map(|pair| pair.rise_db[k]);
            rises.fold(f64::NEG_INFINITY, f64::max)
        });
        rows.push(ALTERNATE.row(
            format!(
                "{}: two vertices take turns, at random every sample; {PAIRS} pairs",
                material.name
            ),
            ours,
            12.0,
            &[("direct form at once", at_once)],
        ));
    }
    rows
}
