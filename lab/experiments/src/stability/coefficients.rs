//! Poles near the unit circle, and coefficients in 16 bits.

use std::f64::consts::PI;

use asperity::model::{GridVertex, Numerator, VertexKind};
use asperity::signal::lsf;
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::filters::{random_lsf, resonant};
use super::material::Material;
use super::methods::all_pole::is_stable;
use super::methods::fixed_point::{block_16, q1_15};
use super::row::{ScenarioResult, Words};

/// Number of random filters.
const FILTERS: usize = 200;

/// |A(e^{jω})|².
fn squared(monic: &[f64], omega: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (k, a) in monic.iter().enumerate() {
        re += a * (omega * k as f64).cos();
        im -= a * (omega * k as f64).sin();
    }
    re * re + im * im
}

/// Largest difference of two all-pole spectra over 10–490 Hz, dB; infinite if the second filter
/// is unstable.
fn distance_db(exact: &[f64], found: &[f64]) -> f64 {
    if !is_stable(found) {
        return f64::INFINITY;
    }
    (10..=490)
        .map(|hz| {
            let omega = PI * f64::from(hz) / 500.0;
            (10.0 * (squared(exact, omega) / squared(found, omega)).log10()).abs()
        })
        .fold(0.0, f64::max)
}

/// The filter that the runtime makes of these LSFs: 16-bit codes, cosines in f32.
fn rendered(lsf_rad: &[f64]) -> Vec<f64> {
    let mut like = asperity::sources::builtin::texture();
    like.grid.numerator = Numerator::None;
    let vertex = GridVertex {
        speed_mm_s: 0.0,
        force_n: 0.0,
        kind: VertexKind::Edge,
        lsf_rad: lsf_rad.to_vec(),
        ma_lsf_rad: None,
        gain: 1.0,
        sigma_m_s2: 0.1,
    };
    Material::constant(&like, &vertex)
        .expect("a texture of one filter")
        .monic(77.0, 1.3)
}

/// Largest error over a set of filters, dB: of ours, of Q1.15, and of 16 bits with a common
/// exponent.
fn worst(filters: &[Vec<f64>]) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for lsf_rad in filters {
        let exact = lsf::to_polynomial(lsf_rad);
        let found = [rendered(lsf_rad), q1_15(&exact), block_16(&exact)];
        for (worst, found) in worst.iter_mut().zip(&found) {
            *worst = worst.max(distance_db(&exact, found));
        }
    }
    worst
}

const POLES: Words = Words {
    theme: "coefficients",
    quantity: "largest error of the spectrum (dB; ∞ is unstable)",
    fails: "near the circle a last bit of a coefficient moves the peak, or the pole out",
    instead: "LSFs in 16 bits, expanded low and high in turn in f32: the error stays far below \
              what is felt",
};
const BITS: Words = Words {
    fails: "two thirds of real filters have a coefficient above 1, which Q1.15 cuts",
    ..POLES
};

/// The rows.
#[must_use]
pub fn rows(materials: &[Material], seed: u64) -> Vec<ScenarioResult> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let resonances: Vec<Vec<f64>> = (1..49)
        .filter_map(|n| lsf::from_polynomial(&resonant(10.0 * f64::from(n))))
        .collect();
    let order_24: Vec<Vec<f64>> = (0..FILTERS)
        .map(|_| random_lsf(&mut rng, 24, 0.038))
        .collect();
    let line = |words: Words, scenario: String, filters: &[Vec<f64>]| {
        let [ours, q15, block] = worst(filters);
        words.row(
            scenario,
            ours,
            0.5,
            &[
                ("Q1.15 saturating", q15),
                ("16 bits, common exponent", block),
            ],
        )
    };
    let mut rows = vec![
        line(
            POLES,
            format!(
                "{} filters of order 20 with poles of radius 0.986",
                resonances.len()
            ),
            &resonances,
        ),
        line(
            BITS,
            format!(
                "{} random filters of order 24, LSFs 0.038 rad apart",
                order_24.len()
            ),
            &order_24,
        ),
    ];
    for material in materials {
        let grid = &material.model.grid;
        let filters: Vec<Vec<f64>> = grid.vertices.iter().map(|v| v.lsf_rad.clone()).collect();
        rows.push(line(
            BITS,
            format!(
                "{}: all {} filters, order {}",
                material.name,
                filters.len(),
                grid.order
            ),
            &filters,
        ));
    }
    rows
}
