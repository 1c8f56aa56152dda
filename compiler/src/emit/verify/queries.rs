//! The runtime's answer to queries of speed and force: convex weights, stable filters.

use super::error::VerifyError;
use asperity_runtime::{Filter, HostTexture};
use asperity_texture::{
    model::{ModelGrid, mesh},
    signal::reflection::{LANES, largest_reflections},
};

/// Steps of the query grid along each axis, from below zero to beyond the border.
const GRID_STEPS: usize = 40;
/// Points of the walk along each side of the border.
const BORDER_STEPS: usize = 200;
/// Weights may differ from a sum of one by this, in f32.
const SUM_TOLERANCE: f32 = 1e-5;

/// Checks every place worth asking for; returns their number and the largest reflection
/// coefficient.
///
/// # Errors
/// [`VerifyError::Weights`] and [`VerifyError::Unstable`] with the query.
pub(super) fn check(slot: &HostTexture, grid: &ModelGrid) -> Result<(usize, f64), VerifyError> {
    let places = places(grid);
    let mut largest = 0.0_f64;
    for together in places.chunks(LANES) {
        largest = largest.max(check_queries(slot, grid, together)?);
    }
    Ok((places.len(), largest))
}

/// Vertices, the middles of edges and triangles, a grid, the border and beyond it, and values
/// that are no place at all.
fn places(grid: &ModelGrid) -> Vec<(f32, f32)> {
    let mut places = Vec::new();
    for vertex in &grid.vertices {
        places.push((vertex.speed_mm_s, vertex.force_n));
    }
    let at = |v: usize| (grid.vertices[v].speed_mm_s, grid.vertices[v].force_n);
    for &[a, b, c] in &grid.triangles {
        let (a, b, c) = (at(a), at(b), at(c));
        for (p, q) in [(a, b), (b, c), (c, a)] {
            places.push(((p.0 + q.0) / 2.0, (p.1 + q.1) / 2.0));
        }
        places.push(((a.0 + b.0 + c.0) / 3.0, (a.1 + b.1 + c.1) / 3.0));
    }
    let (width, height) = mesh::corner(grid);
    for i in 0..=GRID_STEPS {
        for j in 0..=GRID_STEPS {
            let fraction = |k: usize| 1.5 * k as f64 / GRID_STEPS as f64 - 0.25;
            places.push((fraction(i) * width, fraction(j) * height));
        }
    }
    for step in 0..=BORDER_STEPS {
        let fraction = step as f64 / BORDER_STEPS as f64;
        places.extend([
            (fraction * width, 0.0),
            (fraction * width, height),
            (0.0, fraction * height),
            (width, fraction * height),
        ]);
    }
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1e30];
    for v in odd {
        for f in odd {
            places.push((v, f));
        }
    }
    places
        .into_iter()
        .map(|(v, f)| (v as f32, f as f32))
        .collect()
}

/// Checks up to [`LANES`] queries, whose filters are stepped down side by side; returns the
/// largest reflection coefficient.
fn check_queries(
    slot: &HostTexture,
    grid: &ModelGrid,
    queries: &[(f32, f32)],
) -> Result<f64, VerifyError> {
    // Lanes without a query hold A(z) = 1.
    let mut monic = vec![[0.0; LANES]; grid.order + 1];
    monic[0] = [1.0; LANES];
    for (lane, &(speed_mm_s, force_n)) in queries.iter().enumerate() {
        let filter = check_query(slot, grid, speed_mm_s, force_n)?;
        for (row, &coefficient) in monic[1..].iter_mut().zip(&filter.a) {
            row[lane] = f64::from(coefficient);
        }
    }
    let largest = largest_reflections(&mut monic);
    if let Some((_, &(speed_mm_s, force_n))) = largest
        .iter()
        .zip(queries)
        .find(|(reflection, _)| reflection.is_infinite())
    {
        return Err(VerifyError::Unstable {
            speed_mm_s,
            force_n,
        });
    }
    Ok(largest.into_iter().fold(0.0, f64::max))
}

/// Returns true if the weights are a convex combination of valid vertices, out of `count`.
fn is_convex(weights: &[f32], vertices: &[u8], count: usize) -> bool {
    let sum: f32 = weights.iter().sum();
    weights.iter().all(|w| (0.0..=1.0).contains(w))
        && (sum - 1.0).abs() <= SUM_TOLERANCE
        && vertices.iter().all(|&v| usize::from(v) < count)
}

/// Checks the weights of a query and that its filter is finite.
fn check_query(
    slot: &HostTexture,
    grid: &ModelGrid,
    speed_mm_s: f32,
    force_n: f32,
) -> Result<Filter, VerifyError> {
    let found = slot.weights_at(speed_mm_s, force_n);
    if !is_convex(&found.values(), &found.vertices, grid.vertices.len()) {
        return Err(VerifyError::Weights {
            speed_mm_s,
            force_n,
            vertices: found.vertices,
            weights: found.values(),
        });
    }
    let filter = slot.filter_of(&found);
    let finite = filter.b.iter().all(|b| b.is_finite())
        && filter.level_m_s2.is_finite()
        && filter.level_m_s2 >= 0.0;
    if !finite {
        return Err(VerifyError::Unstable {
            speed_mm_s,
            force_n,
        });
    }
    Ok(filter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;

    /// Claim: the places are all vertices, the middles of all edges and triangles, every side of the
    /// border from end to end, and a quarter of the grid beyond it on all sides.
    #[test]
    fn every_kind_of_place_is_asked_for() {
        let grid = builtin::texture().grid;
        let places = places(&grid);
        let near = |(v, f): (f64, f64)| {
            let close = |a: f32, b: f64| (f64::from(a) - b).abs() <= 1e-4 * (1.0 + b.abs());
            places
                .iter()
                .any(|place| close(place.0, v) && close(place.1, f))
        };
        let at = |index: usize| {
            (
                grid.vertices[index].speed_mm_s,
                grid.vertices[index].force_n,
            )
        };
        assert!((0..grid.vertices.len()).all(|index| near(at(index))));
        for triangle in &grid.triangles {
            let corners = triangle.map(at);
            let mean = |of: &[(f64, f64)]| {
                let n = of.len() as f64;
                let sum = of.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
                (sum.0 / n, sum.1 / n)
            };
            assert!(near(mean(&corners)), "the middle of {triangle:?}");
            for side in [[0, 1], [1, 2], [2, 0]] {
                assert!(near(mean(&side.map(|n| corners[n]))), "{triangle:?}");
            }
        }
        let (width, height) = mesh::corner(&grid);
        for step in 0..=BORDER_STEPS {
            let t = step as f64 / BORDER_STEPS as f64;
            let border = [
                (t * width, 0.0),
                (t * width, height),
                (0.0, t * height),
                (width, t * height),
            ];
            assert!(border.into_iter().all(near), "{t} of the border");
        }
        let outside = [(-0.25, -0.25), (1.25, -0.25), (-0.25, 1.25), (1.25, 1.25)];
        assert!(
            outside
                .into_iter()
                .all(|(v, f)| near((v * width, f * height)))
        );
        assert!(
            places
                .iter()
                .any(|place| place.0.is_nan() && place.1.is_nan())
        );
    }

    /// Claim: weights are convex if each is from 0 to 1, their sum is 1, and their vertices are there.
    #[test]
    fn weights_are_convex_by_all_three_rules() {
        let is = |weights: [f32; 3], vertices: [u8; 3]| is_convex(&weights, &vertices, 40);
        assert!(is([0.2, 0.3, 0.5], [0, 7, 39]) && is([1.0, 0.0, 0.0], [5, 5, 5]));
        assert!(!is([1.2, -0.2, 0.0], [0, 1, 2]), "outside 0 to 1");
        assert!(!is([0.2, 0.3, 0.4], [0, 1, 2]), "a sum below 1");
        assert!(!is([0.5, 0.5, 0.5], [0, 1, 2]), "a sum above 1");
        assert!(!is([0.2, 0.3, 0.5], [0, 1, 40]), "no such vertex");
        assert!(!is([f32::NAN, 0.5, 0.5], [0, 1, 2]));
    }
}
