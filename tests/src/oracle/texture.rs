//! The models over the plane of speed and force: location, mixture, polynomials.

use asperity_formats::{Asset, Numerator};
use std::f64::consts::{PI, TAU};

/// A vertex with its model.
#[derive(Debug, Clone)]
pub struct Vertex {
    /// Speed, mm/s.
    pub speed_mm_s: f64,
    /// Force, N.
    pub force_n: f64,
    /// cos ω of A(z)'s LSFs.
    pub cosines: Vec<f64>,
    /// cos ω of B(z)'s LSFs.
    pub ma_cosines: Vec<f64>,
    /// gain·σ, m/s².
    pub level_m_s2: f64,
}

/// A texture's models.
#[derive(Debug, Clone)]
pub struct Texture {
    /// Sample rate, Hz.
    pub sample_rate_hz: f64,
    /// Kind of the numerator B(z).
    pub numerator: Numerator,
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Triangles.
    pub triangles: Vec<[usize; 3]>,
    /// Largest speed, mm/s.
    pub max_speed_mm_s: f64,
    /// Largest force, N.
    pub max_force_n: f64,
}

/// A mixed model.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// cos ω of A(z)'s LSFs.
    pub cosines: Vec<f64>,
    /// cos ω of B(z)'s LSFs.
    pub ma_cosines: Vec<f64>,
    /// gain·σ, m/s².
    pub level_m_s2: f64,
}

/// Points of the unit circle at which polynomials are evaluated, more than their degree of 25.
const POINTS: usize = 32;

/// Coefficients 1..=p of the monic polynomial with these LSF cosines. (P + Q)/2 is evaluated
/// on the unit circle, factor by factor, and transformed back.
#[must_use]
pub fn polynomial(cosines: &[f64]) -> Vec<f64> {
    let order = cosines.len();
    let value = |at: usize| {
        let angle = -TAU * at as f64 / POINTS as f64;
        let w = (angle.cos(), angle.sin());
        let multiply =
            |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        let square = multiply(w, w);
        let pair = |x: f64| (1.0 - 2.0 * x * w.0 + square.0, -2.0 * x * w.1 + square.1);
        let (sum, difference) = if order.is_multiple_of(2) {
            ((1.0 + w.0, w.1), (1.0 - w.0, -w.1))
        } else {
            ((1.0, 0.0), (1.0 - square.0, -square.1))
        };
        let product = |first: usize, start| {
            cosines
                .iter()
                .skip(first)
                .step_by(2)
                .fold(start, |product, &x| multiply(product, pair(x)))
        };
        let (q, p) = (product(0, sum), product(1, difference));
        ((q.0 + p.0) / 2.0, (q.1 + p.1) / 2.0)
    };
    let values: Vec<_> = (0..POINTS).map(value).collect();
    (1..=order)
        .map(|k| {
            let term = |(at, value): (usize, &(f64, f64))| {
                let angle = TAU * (at * k) as f64 / POINTS as f64;
                value.0 * angle.cos() - value.1 * angle.sin()
            };
            values.iter().enumerate().map(term).sum::<f64>() / POINTS as f64
        })
        .collect()
}

impl Texture {
    /// From an asset.
    #[must_use]
    pub fn new(asset: &Asset<'_>) -> Self {
        let grid = asset.grid();
        let models: Vec<_> = grid.models().collect();
        let cosine = |bits: u16| (PI * f64::from(bits) / 65536.0).cos();
        let vertices: Vec<_> = grid
            .vertices()
            .map(|vertex| {
                let model = &models[usize::from(vertex.model)];
                Vertex {
                    speed_mm_s: vertex.speed_mm_s.into(),
                    force_n: vertex.force_n.into(),
                    cosines: model.lsf().map(|code| cosine(code.to_bits())).collect(),
                    ma_cosines: model.ma_lsf().map(|code| cosine(code.to_bits())).collect(),
                    level_m_s2: f64::from(model.gain) * f64::from(vertex.sigma_m_s2),
                }
            })
            .collect();
        let largest = |f: fn(&Vertex) -> f64| vertices.iter().map(f).fold(0.0, f64::max);
        Self {
            sample_rate_hz: grid.sample_rate_hz().into(),
            numerator: grid.numerator(),
            max_speed_mm_s: largest(|v| v.speed_mm_s),
            max_force_n: largest(|v| v.force_n),
            triangles: grid.triangles().map(|t| t.map(usize::from)).collect(),
            vertices,
        }
    }

    /// Barycentric weights of a point in triangle `t`; `None` if the triangle has no area.
    #[must_use]
    pub fn weights(&self, t: usize, speed_mm_s: f64, force_n: f64) -> Option<[f64; 3]> {
        let corner =
            self.triangles[t].map(|v| (self.vertices[v].speed_mm_s, self.vertices[v].force_n));
        let area = |p: (f64, f64), q: (f64, f64)| {
            (p.0 - speed_mm_s) * (q.1 - force_n) - (q.0 - speed_mm_s) * (p.1 - force_n)
        };
        let parts = [
            area(corner[1], corner[2]),
            area(corner[2], corner[0]),
            area(corner[0], corner[1]),
        ];
        let whole: f64 = (corner[1].0 - corner[0].0) * (corner[2].1 - corner[0].1)
            - (corner[2].0 - corner[0].0) * (corner[1].1 - corner[0].1);
        (whole != 0.0).then(|| parts.map(|part| part / whole))
    }

    /// Triangle and weights of a query. A query outside the grid is moved to its border.
    ///
    /// # Panics
    /// If no triangle has an area.
    #[must_use]
    pub fn locate(&self, speed_mm_s: f64, force_n: f64) -> (usize, [f64; 3]) {
        let inside = |x: f64, max: f64| if x > 0.0 { x.min(max) } else { 0.0 };
        let speed = inside(speed_mm_s, self.max_speed_mm_s);
        let force = inside(force_n, self.max_force_n);
        let candidates =
            (0..self.triangles.len()).filter_map(|t| Some((t, self.weights(t, speed, force)?)));
        let (t, weights) = candidates
            .max_by(|(_, a), (_, b)| {
                let smallest = |w: &[f64; 3]| w[0].min(w[1]).min(w[2]);
                smallest(a).total_cmp(&smallest(b))
            })
            .expect("a triangle with an area");
        let cut = weights.map(|w| w.max(0.0));
        let sum: f64 = cut.iter().sum();
        (t, cut.map(|w| w / sum))
    }

    /// The model at a speed and a force.
    #[must_use]
    pub fn model(&self, speed_mm_s: f64, force_n: f64) -> Model {
        let (t, weights) = self.locate(speed_mm_s, force_n);
        self.mixture(self.triangles[t], weights)
    }

    /// The mixture of three vertices.
    #[must_use]
    pub fn mixture(&self, vertices: [usize; 3], weights: [f64; 3]) -> Model {
        let mix = |f: &dyn Fn(&Vertex) -> f64| {
            vertices
                .iter()
                .zip(weights)
                .map(|(&v, w)| w * f(&self.vertices[v]))
                .sum()
        };
        Model {
            cosines: (0..self.vertices[0].cosines.len())
                .map(|i| mix(&|v| v.cosines[i]))
                .collect(),
            ma_cosines: (0..self.vertices[0].ma_cosines.len())
                .map(|i| mix(&|v| v.ma_cosines[i]))
                .collect(),
            level_m_s2: mix(&|v| v.level_m_s2),
        }
    }

    /// Coefficients b_1.. of the numerator of a model.
    #[must_use]
    pub fn numerator(&self, model: &Model) -> Vec<f64> {
        match self.numerator {
            Numerator::None => vec![],
            Numerator::Nyquist => vec![1.0],
            Numerator::Lsf => polynomial(&model.ma_cosines),
        }
    }
}
