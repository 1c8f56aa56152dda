//! Validation that the triangles tile the rectangle of the grid.
//!
//! The runtime looks up the triangle around a speed and a force, so every point needs one, and none may overlap
//! another.
//!
//! ```
//! use asperity_texture::model::{GridVertex, ModelGrid, Numerator, VertexKind, mesh};
//!
//! # let vertex = |speed_mm_s, force_n| GridVertex {
//! #     speed_mm_s,
//! #     force_n,
//! #     kind: VertexKind::Edge,
//! #     lsf_rad: vec![1.0],
//! #     ma_lsf_rad: None,
//! #     gain: 1.0,
//! #     sigma_m_s2: 1.0,
//! # };
//! // `vertex` gives a model at a speed, mm/s, and a force, N.
//! let mut grid = ModelGrid {
//!     sample_rate_hz: 1000.0,
//!     order: 1,
//!     numerator: Numerator::None,
//!     vertices: vec![vertex(0.0, 0.0), vertex(200.0, 0.0), vertex(200.0, 2.0), vertex(0.0, 2.0)],
//!     triangles: vec![[0, 1, 2], [0, 2, 3]],
//! };
//! assert_eq!(mesh::check(&grid), Ok(()));
//! grid.triangles.pop();
//! assert_eq!(mesh::check(&grid), Err(mesh::MeshError::Hole { from: 0, to: 2 }));
//! ```

use crate::model::ModelGrid;
use std::collections::HashMap;
use thiserror::Error;

/// Relative tolerance of the area sum, because sources print coordinates with six decimals.
const AREA_TOLERANCE: f64 = 1e-6;

/// Why the triangles do not tile `[0, max_speed] × [0, max_force]`.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} refers to vertex {vertex}, the grid has {count}")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// Index of the vertex.
        vertex: usize,
        /// Vertices of the grid.
        count: usize,
    },
    /// A coordinate is not finite or negative.
    #[error(
        "vertex {vertex} lies at ({speed_mm_s} mm/s, {force_n} N), not in the positive quadrant"
    )]
    Coordinates {
        /// Index of the vertex.
        vertex: usize,
        /// Its speed.
        speed_mm_s: f64,
        /// Its force.
        force_n: f64,
    },
    /// Two triangles lie on the same side of a common edge, or more than two share it.
    #[error("triangle {triangle} overlaps another one at the edge of vertices {from} and {to}")]
    Overlap {
        /// Index of the later triangle.
        triangle: usize,
        /// First vertex of the edge.
        from: usize,
        /// Second vertex of the edge.
        to: usize,
    },
    /// An edge inside the rectangle has a triangle on one side only.
    #[error("the grid has a hole at the edge of vertices {from} and {to}")]
    Hole {
        /// First vertex of the edge.
        from: usize,
        /// Second vertex of the edge.
        to: usize,
    },
    /// The areas do not add up to the rectangle's.
    #[error("the triangles cover {area} mm·N/s, the rectangle has {rectangle}")]
    Area {
        /// Sum of the triangles' areas.
        area: f64,
        /// Area of the rectangle.
        rectangle: f64,
    },
}

/// Largest speed and force of the vertices: the upper right corner.
#[must_use]
pub fn corner(grid: &ModelGrid) -> (f64, f64) {
    grid.vertices.iter().fold((0.0, 0.0), |(v, f), vertex| {
        (vertex.speed_mm_s.max(v), vertex.force_n.max(f))
    })
}

/// Checks that the triangles tile the rectangle: they do not overlap across an edge,
/// every edge inside has two, and the areas add up. Slivers and vertices at one
/// position are accepted.
///
/// # Errors
/// [`MeshError`] naming the first triangle or edge at fault.
pub fn check(grid: &ModelGrid) -> Result<(), MeshError> {
    let at: Vec<(f64, f64)> = grid
        .vertices
        .iter()
        .map(|vertex| (vertex.speed_mm_s, vertex.force_n))
        .collect();
    for (vertex, &(speed_mm_s, force_n)) in at.iter().enumerate() {
        let fine = |x: f64| x.is_finite() && x >= 0.0;
        if !(fine(speed_mm_s) && fine(force_n)) {
            return Err(MeshError::Coordinates {
                vertex,
                speed_mm_s,
                force_n,
            });
        }
    }
    // Vertices at one position are one corner.
    let canonical: Vec<usize> = at
        .iter()
        .map(|p| at.iter().position(|q| p == q).unwrap_or_default())
        .collect();
    let mut edges: HashMap<(usize, usize), Vec<(usize, i8)>> = HashMap::new();
    let mut area = 0.0;
    for (index, triangle) in grid.triangles.iter().enumerate() {
        if let Some(&vertex) = triangle.iter().find(|&&v| v >= at.len()) {
            return Err(MeshError::NoSuchVertex {
                triangle: index,
                vertex,
                count: at.len(),
            });
        }
        let [a, b, c] = triangle.map(|v| canonical[v]);
        let twice =
            (at[b].0 - at[a].0) * (at[c].1 - at[a].1) - (at[c].0 - at[a].0) * (at[b].1 - at[a].1);
        area += twice.abs() / 2.0;
        if a == b || b == c || a == c {
            continue;
        }
        // A triangle without area has no side.
        let side = if twice == 0.0 {
            0
        } else {
            twice.signum() as i8
        };
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (key, side) = if from < to {
                ((from, to), side)
            } else {
                ((to, from), -side)
            };
            let sides = edges.entry(key).or_default();
            let same_side = side != 0 && sides.iter().any(|&(_, other)| other == side);
            sides.push((index, side));
            if same_side || sides.len() > 2 {
                return Err(MeshError::Overlap {
                    triangle: index,
                    from: key.0,
                    to: key.1,
                });
            }
        }
    }
    let (width, height) = corner(grid);
    let rectangle = width * height;
    let mut open: Vec<_> = edges
        .iter()
        .filter(|(_, sides)| sides.len() == 1)
        .map(|(key, _)| *key)
        .collect();
    open.sort_unstable();
    for (from, to) in open {
        let ((v0, f0), (v1, f1)) = (at[from], at[to]);
        let on_border =
            (v0 == v1 && (v0 == 0.0 || v0 == width)) || (f0 == f1 && (f0 == 0.0 || f0 == height));
        if !on_border {
            return Err(MeshError::Hole { from, to });
        }
    }
    if rectangle > 0.0 && (area / rectangle - 1.0).abs() <= AREA_TOLERANCE {
        Ok(())
    } else {
        Err(MeshError::Area { area, rectangle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{GridVertex, Numerator, VertexKind};

    fn grid(points: &[(f64, f64)], triangles: &[[usize; 3]]) -> ModelGrid {
        ModelGrid {
            sample_rate_hz: 1000.0,
            order: 1,
            numerator: Numerator::None,
            vertices: points
                .iter()
                .map(|&(speed_mm_s, force_n)| GridVertex {
                    speed_mm_s,
                    force_n,
                    kind: VertexKind::Edge,
                    lsf_rad: vec![1.0],
                    ma_lsf_rad: None,
                    gain: 1.0,
                    sigma_m_s2: 1.0,
                })
                .collect(),
            triangles: triangles.to_vec(),
        }
    }

    const SQUARE: [(f64, f64); 5] = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (1.0, 0.5)];

    #[test]
    fn a_fan_tiles_in_any_orientation() {
        let fan = [[0, 1, 4], [2, 1, 4], [2, 3, 4], [0, 3, 4]];
        assert_eq!(check(&grid(&SQUARE, &fan)), Ok(()));
    }

    #[test]
    fn a_sliver_without_area_and_a_twin_vertex_are_accepted() {
        let mut points = SQUARE.to_vec();
        points.push((1.0, 0.5));
        points.push((1.0, 0.0));
        let fan = [
            [0, 1, 6],
            [0, 6, 4],
            [6, 1, 5],
            [2, 1, 4],
            [2, 3, 5],
            [0, 3, 4],
        ];
        assert_eq!(check(&grid(&points, &fan)), Ok(()));
    }

    #[test]
    fn a_missing_triangle_is_a_hole() {
        let open = [[0, 1, 4], [2, 1, 4], [2, 3, 4]];
        assert_eq!(
            check(&grid(&SQUARE, &open)),
            Err(MeshError::Hole { from: 0, to: 4 })
        );
    }

    #[test]
    fn a_doubled_triangle_overlaps() {
        let twice = [[0, 1, 4], [0, 4, 1], [2, 1, 4], [2, 3, 4], [0, 3, 4]];
        assert!(matches!(
            check(&grid(&SQUARE, &twice)),
            Err(MeshError::Overlap { triangle: 1, .. })
        ));
    }

    #[test]
    fn foreign_vertices_and_coordinates_are_named() {
        assert_eq!(
            check(&grid(&SQUARE, &[[0, 1, 7]])),
            Err(MeshError::NoSuchVertex {
                triangle: 0,
                vertex: 7,
                count: 5
            })
        );
        let mut points = SQUARE;
        points[1].0 = f64::NAN;
        assert!(matches!(
            check(&grid(&points, &[])),
            Err(MeshError::Coordinates { vertex: 1, .. })
        ));
    }
}
