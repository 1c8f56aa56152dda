//! The barycentric mixture on the grid, in f64: what the runtime renders at a speed and a force.
//!
//! Line spectral frequencies are mixed as cos ω, and levels as gain·σ, with the barycentric
//! weights of the triangle around the query. A query outside the grid is moved to its border.
//!
//! ```
//! use asperity_texture::model::{GridVertex, ModelGrid, Numerator, VertexKind, mixture::Field};
//!
//! # let vertex = |speed_mm_s, force_n, sigma_m_s2| GridVertex {
//! #     speed_mm_s,
//! #     force_n,
//! #     kind: VertexKind::Edge,
//! #     lsf_rad: vec![1.0],
//! #     ma_lsf_rad: None,
//! #     gain: 1.0,
//! #     sigma_m_s2,
//! # };
//! // `vertex` gives a model at a speed, mm/s, and a force, N, with its level, m/s².
//! let grid = ModelGrid {
//!     sample_rate_hz: 1000.0,
//!     order: 1,
//!     numerator: Numerator::None,
//!     vertices: vec![vertex(0.0, 0.0, 0.0), vertex(200.0, 0.0, 0.0), vertex(200.0, 2.0, 3.0), vertex(0.0, 2.0, 0.0)],
//!     triangles: vec![[0, 1, 2], [0, 2, 3]],
//! };
//! let field = Field::new(&grid);
//! let level_m_s2 = |speed_mm_s, force_n| {
//!     field.locate(speed_mm_s, force_n).map(|place| field.mixture(&place).level_m_s2)
//! };
//! assert!(level_m_s2(100.0, 1.0).is_some_and(|level| (level - 1.5).abs() < 1e-9));
//! assert_eq!(level_m_s2(900.0, 9.0), level_m_s2(200.0, 2.0)); // the corner
//! ```

use crate::{
    model::{ModelGrid, Numerator, mesh},
    signal::{lsf, spectrum::ArmaModel},
};
use std::rc::Rc;

/// A triangle, by its vertices, and the weights of a query in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarycentricPoint {
    /// Indices of the vertices.
    pub vertices: [usize; 3],
    /// Barycentric weights, not negative, of sum 1.
    pub weights: [f64; 3],
}

/// cos ω of A(z) and of B(z).
#[derive(Debug, Clone)]
pub struct Cosines {
    ar: Vec<f64>,
    ma: Vec<f64>,
}

/// A mixture of models before its conversion to coefficients.
#[derive(Debug, Clone, PartialEq)]
pub struct Mixture {
    /// cos ω of A(z).
    pub ar_cosines: Vec<f64>,
    /// cos ω of B(z), where it is mixed.
    pub ma_cosines: Vec<f64>,
    /// gain·σ, m/s².
    pub level_m_s2: f64,
}

/// A grid prepared for queries.
#[derive(Debug, Clone)]
pub struct Field<'a> {
    grid: &'a ModelGrid,
    /// Cosines of the line spectral frequencies, per vertex.
    cosines: Vec<Rc<Cosines>>,
    corner: (f64, f64),
}

impl<'a> Field<'a> {
    /// Prepares a grid, whose triangles must tile it.
    #[must_use]
    pub fn new(grid: &'a ModelGrid) -> Self {
        let cosines = |angles: &[f64]| angles.iter().map(|&w| libm::cos(w)).collect();
        Self {
            grid,
            cosines: grid
                .vertices
                .iter()
                .map(|vertex| {
                    let ma = vertex.ma_lsf_rad.as_deref().unwrap_or_default();
                    Rc::new(Cosines {
                        ar: cosines(&vertex.lsf_rad),
                        ma: cosines(ma),
                    })
                })
                .collect(),
            corner: mesh::corner(grid),
        }
    }

    /// Prepares a grid whose cosines are known, one entry for each vertex.
    pub fn with_cosines(grid: &'a ModelGrid, cosines: &[Rc<Cosines>]) -> Self {
        Self {
            grid,
            cosines: cosines.to_vec(),
            corner: mesh::corner(grid),
        }
    }

    /// The cosines, one entry for each vertex.
    pub fn cosines(&self) -> &[Rc<Cosines>] {
        &self.cosines
    }

    /// The triangle whose smallest weight is largest, as the runtime chooses; `None` for a
    /// grid without a triangle that has an area.
    #[must_use]
    pub fn locate(&self, speed_mm_s: f64, force_n: f64) -> Option<BarycentricPoint> {
        self.locate_among(&self.grid.triangles, speed_mm_s, force_n)
    }

    /// [`Field::locate`] among some of the triangles.
    pub fn locate_among(
        &self,
        triangles: &[[usize; 3]],
        speed_mm_s: f64,
        force_n: f64,
    ) -> Option<BarycentricPoint> {
        // A NaN counts as rest.
        let inside = |x: f64, max: f64| if x > 0.0 { x.min(max) } else { 0.0 };
        let (speed, force) = (
            inside(speed_mm_s, self.corner.0),
            inside(force_n, self.corner.1),
        );
        let near = triangles
            .iter()
            .filter(|triangle| self.may_hold(triangle, speed, force));
        let (vertices, weights) = self
            .best(near, speed, force)
            .filter(|(_, weights)| smallest(weights) >= 0.0)
            // A query in a gap, or on an edge by rounding, lies in none of them.
            .or_else(|| self.best(triangles.iter(), speed, force))?;
        let cut = weights.map(|w| w.max(0.0));
        let sum: f64 = cut.iter().sum();
        Some(BarycentricPoint {
            vertices,
            weights: cut.map(|w| w / sum),
        })
    }

    /// The triangle whose smallest weight is largest, and the weights.
    fn best<'t>(
        &self,
        triangles: impl Iterator<Item = &'t [usize; 3]>,
        speed: f64,
        force: f64,
    ) -> Option<([usize; 3], [f64; 3])> {
        triangles
            .filter_map(|&triangle| Some((triangle, self.weights(triangle, speed, force)?)))
            .reduce(|best, next| {
                if smallest(&next.1) > smallest(&best.1) {
                    next
                } else {
                    best
                }
            })
    }

    /// Returns true if a query lies within the bounding box of a triangle. Outside it, a barycentric weight is
    /// negative.
    fn may_hold(&self, triangle: &[usize; 3], speed: f64, force: f64) -> bool {
        let between = |[a, b, c]: [f64; 3], x: f64| a.min(b).min(c) <= x && x <= a.max(b).max(c);
        let corners = triangle.map(|v| &self.grid.vertices[v]);
        between(corners.map(|v| v.speed_mm_s), speed) && between(corners.map(|v| v.force_n), force)
    }

    fn weights(&self, triangle: [usize; 3], speed: f64, force: f64) -> Option<[f64; 3]> {
        let [(x0, y0), (x1, y1), (x2, y2)] = triangle.map(|v| {
            let vertex = &self.grid.vertices[v];
            (vertex.speed_mm_s, vertex.force_n)
        });
        let twice_area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
        if twice_area == 0.0 {
            return None;
        }
        let (ds, df) = (speed - x0, force - y0);
        let w1 = ((y2 - y0) * ds + (x0 - x2) * df) / twice_area;
        let w2 = ((y0 - y1) * ds + (x1 - x0) * df) / twice_area;
        Some([1.0 - w1 - w2, w1, w2])
    }

    /// Numerator of the grid.
    #[must_use]
    pub fn numerator(&self) -> Numerator {
        self.grid.numerator
    }

    /// Largest gain·σ of a vertex, m/s².
    #[must_use]
    pub fn loudest_m_s2(&self) -> f64 {
        let levels = self.grid.vertices.iter().map(|v| v.gain * v.sigma_m_s2);
        levels.fold(0.0, f64::max)
    }

    /// The mixture at a place.
    #[must_use]
    pub fn mixture(&self, place: &BarycentricPoint) -> Mixture {
        let parts = || place.vertices.into_iter().zip(place.weights);
        let rows = |side: fn(&Cosines) -> &[f64]| -> Vec<f64> {
            let mut mixed = vec![0.0; side(&self.cosines[place.vertices[0]]).len()];
            for (vertex, weight) in parts() {
                for (sum, x) in mixed.iter_mut().zip(side(&self.cosines[vertex])) {
                    *sum += weight * x;
                }
            }
            mixed
        };
        Mixture {
            ar_cosines: rows(|row| &row.ar),
            ma_cosines: rows(|row| &row.ma),
            level_m_s2: parts()
                .map(|(v, weight)| {
                    let vertex = &self.grid.vertices[v];
                    weight * vertex.gain * vertex.sigma_m_s2
                })
                .sum(),
        }
    }

    /// The model at a place.
    #[must_use]
    pub fn model(&self, place: &BarycentricPoint) -> ArmaModel {
        let mixture = self.mixture(place);
        ArmaModel {
            sample_rate_hz: self.grid.sample_rate_hz,
            a: lsf::from_cosines(&mixture.ar_cosines),
            b: match self.grid.numerator {
                Numerator::None => vec![1.0],
                Numerator::Nyquist => vec![1.0, 1.0],
                Numerator::Lsf => lsf::from_cosines(&mixture.ma_cosines),
            },
            level_m_s2: mixture.level_m_s2,
        }
    }
}

fn smallest(weights: &[f64; 3]) -> f64 {
    weights[0].min(weights[1]).min(weights[2])
}

/// Where spectra of two grids are compared: every vertex once, the middle of every edge and
/// the centroid of every triangle, (mm/s, N).
#[must_use]
pub fn places(grid: &ModelGrid) -> Vec<(f64, f64)> {
    let at = |v: usize| (grid.vertices[v].speed_mm_s, grid.vertices[v].force_n);
    let mut all: Vec<(f64, f64)> = (0..grid.vertices.len()).map(at).collect();
    let mut edges: Vec<(usize, usize)> = grid
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
        .map(|(a, b)| (a.min(b), a.max(b)))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    all.extend(edges.into_iter().map(|(a, b)| {
        let (p, q) = (at(a), at(b));
        ((p.0 + q.0) / 2.0, (p.1 + q.1) / 2.0)
    }));
    all.extend(grid.triangles.iter().map(|&[a, b, c]| {
        let (p, q, r) = (at(a), at(b), at(c));
        ((p.0 + q.0 + r.0) / 3.0, (p.1 + q.1 + r.1) / 3.0)
    }));
    all
}
