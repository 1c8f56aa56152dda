//! Location of a point by a walk from triangle to triangle, with weights that are not cut at 0.
//!
//! This follows the description of the reference renderer: a point is inside a triangle if all
//! its weights are positive; otherwise the walk crosses an edge whose weight is not. For a point
//! on an edge both neighbours have a weight of zero, so the walk alternates between them
//! forever.

use asperity::model::ModelGrid;

/// Outcome of a walk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Walk {
    /// In a triangle, with these weights.
    Found(usize, [f64; 3]),
    /// At the border: the last triangle, with weights that extrapolate.
    Left(usize, [f64; 3]),
    /// It never ends.
    Endless,
}

/// Barycentric weights of a point in triangle `t`.
#[must_use]
pub fn weights(grid: &ModelGrid, t: usize, speed_mm_s: f64, force_n: f64) -> [f64; 3] {
    let [a, b, c] = grid.triangles[t].map(|v| {
        let vertex = &grid.vertices[v];
        (vertex.speed_mm_s, vertex.force_n)
    });
    let cross = |o: (f64, f64), p: (f64, f64), q: (f64, f64)| {
        (p.0 - o.0) * (q.1 - o.1) - (p.1 - o.1) * (q.0 - o.0)
    };
    let point = (speed_mm_s, force_n);
    let area = cross(a, b, c);
    let w1 = cross(a, point, c) / area;
    let w2 = cross(a, b, point) / area;
    [1.0 - w1 - w2, w1, w2]
}

/// The triangle on the other side of the edge opposite to `corner`, if there is one.
fn across(grid: &ModelGrid, t: usize, corner: usize) -> Option<usize> {
    let edge: Vec<usize> = (0..3)
        .filter(|&i| i != corner)
        .map(|i| grid.triangles[t][i])
        .collect();
    (0..grid.triangles.len())
        .find(|&other| other != t && edge.iter().all(|v| grid.triangles[other].contains(v)))
}

/// Walks from triangle 0. A walk counts as endless once it has visited ten times as many
/// triangles as the grid has.
#[must_use]
pub fn walk(grid: &ModelGrid, speed_mm_s: f64, force_n: f64) -> Walk {
    let mut t = 0;
    for _ in 0..10 * grid.triangles.len() {
        let w = weights(grid, t, speed_mm_s, force_n);
        let smallest = (0..3).min_by(|&i, &j| w[i].total_cmp(&w[j])).unwrap_or(0);
        if w[smallest] > 0.0 {
            return Walk::Found(t, w);
        }
        match across(grid, t, smallest) {
            Some(next) => t = next,
            None => return Walk::Left(t, w),
        }
    }
    Walk::Endless
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_walk_finds_what_lies_inside_and_not_what_lies_on_an_edge() {
        let grid = asperity::sources::builtin::texture().grid;
        let corners = grid.triangles[7].map(|v| &grid.vertices[v]);
        let mean = |f: fn(&asperity::model::GridVertex) -> f64, n: usize| {
            corners[..n].iter().map(|v| f(v)).sum::<f64>() / n as f64
        };
        let centre = walk(&grid, mean(|v| v.speed_mm_s, 3), mean(|v| v.force_n, 3));
        assert!(matches!(centre, Walk::Found(7, _)), "{centre:?}");
    }
}
