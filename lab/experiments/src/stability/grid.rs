//! Queries on vertices and edges of a grid, on its border and beyond.

use asperity::model::ModelGrid;
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::material::Material;
use super::methods::all_pole::{is_stable, mixed, polynomials};
use super::methods::walk::{Walk, walk};
use super::row::{ScenarioResult, Words};
use asperity_sim::random::unit;

/// Every vertex, and five points of every edge.
fn on_edges(grid: &ModelGrid) -> Vec<(f64, f64)> {
    let at = |v: usize| (grid.vertices[v].speed_mm_s, grid.vertices[v].force_n);
    let mut points: Vec<_> = (0..grid.vertices.len()).map(at).collect();
    for triangle in &grid.triangles {
        for corner in 0..3 {
            let (a, b) = (at(triangle[corner]), at(triangle[(corner + 1) % 3]));
            points.extend(
                [0.1, 0.25, 0.5, 0.75, 0.9].map(|t| (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1))),
            );
        }
    }
    points
}

/// Highest speed, mm/s, and force, N, of the grid.
fn borders(grid: &ModelGrid) -> (f64, f64) {
    grid.vertices.iter().fold((0.0, 0.0), |(v, f), vertex| {
        (f64::max(v, vertex.speed_mm_s), f64::max(f, vertex.force_n))
    })
}

/// Random points on the border and up to three times as far.
fn beyond(grid: &ModelGrid, seed: u64) -> Vec<(f64, f64)> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let (speed, force) = borders(grid);
    (0..3000)
        .map(|n| {
            let (along, out) = (3.0 * unit(&mut rng), 1.0 + 2.0 * unit(&mut rng));
            match n % 4 {
                0 => (speed, along.min(1.0) * force),
                1 => (along.min(1.0) * speed, force),
                2 => (out * speed, along * force),
                _ => (along * speed, out * force),
            }
        })
        .collect()
}

/// Percentage of queries that the runtime answers badly: the weights are not convex, the filter
/// is unstable or the level is not finite.
fn bad_answers(material: &Material, points: &[(f64, f64)]) -> f64 {
    let bad = points
        .iter()
        .filter(|&&(speed, force)| {
            let weights = material
                .slot
                .weights_at(speed as f32, force as f32)
                .values();
            let filter = material.slot.filter_at(speed as f32, force as f32);
            let convex = weights.iter().all(|&w| (0.0..=1.0).contains(&w))
                && (weights.iter().sum::<f32>() - 1.0).abs() < 1e-6;
            !(convex && is_stable(&material.monic(speed, force)) && filter.level_m_s2.is_finite())
        })
        .count();
    100.0 * bad as f64 / points.len() as f64
}

/// Percentage of queries whose walk never ends.
fn endless(material: &Material, points: &[(f64, f64)]) -> f64 {
    let grid = &material.model.grid;
    let endless = points
        .iter()
        .filter(|&&(speed, force)| walk(grid, speed, force) == Walk::Endless)
        .count();
    100.0 * endless as f64 / points.len() as f64
}

/// Percentage of queries whose extrapolated weights give an unstable filter.
fn unstable_beyond(material: &Material, points: &[(f64, f64)]) -> f64 {
    let grid = &material.model.grid;
    let polynomials = polynomials(grid);
    let unstable = points
        .iter()
        .filter(|&&(speed, force)| match walk(grid, speed, force) {
            Walk::Found(t, w) | Walk::Left(t, w) => {
                let corners = grid.triangles[t].map(|v| polynomials[v].as_slice());
                !is_stable(&mixed(corners, w))
            }
            Walk::Endless => true,
        })
        .count();
    100.0 * unstable as f64 / points.len() as f64
}

const EDGES: Words = Words {
    theme: "grid",
    quantity: "queries without a usable answer (%)",
    fails: "a walk that asks for positive weights goes to and fro across an edge for good",
    instead: "every triangle is looked at every time; the largest smallest weight wins",
};
const BORDER: Words = Words {
    theme: "grid",
    quantity: "queries without a stable filter (%)",
    fails: "beyond the border the nearest triangle extrapolates: weights far below 0, poles outside",
    instead: "the query is moved to the border and weights are cut at 0: edge models, convex always",
};

/// The rows.
#[must_use]
pub fn rows(materials: &[Material], seed: u64) -> Vec<ScenarioResult> {
    let mut rows = Vec::new();
    for material in materials {
        let points = on_edges(&material.model.grid);
        rows.push(EDGES.row(
            format!(
                "{}: {} points on vertices and edges",
                material.name,
                points.len()
            ),
            bad_answers(material, &points),
            0.0,
            &[("walk", endless(material, &points))],
        ));
    }
    for material in materials {
        let points = beyond(&material.model.grid, seed);
        rows.push(BORDER.row(
            format!(
                "{}: {} points on the border and beyond",
                material.name,
                points.len()
            ),
            bad_answers(material, &points),
            0.0,
            &[("extrapolated a_k", unstable_beyond(material, &points))],
        ));
    }
    rows
}
