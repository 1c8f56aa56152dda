//! A reference to compare with: what the HaTT's published renderer does in a tick, written from
//! its description.
//!
//! Location walks from the last triangle across the edge with the most negative weight, to a
//! neighbour that a table names. Mixed LSFs become coefficients by multiplying out the complex
//! conjugate roots of P and Q in f64, in ascending order, one root at a time and in place,
//! without an allocation. The recursion runs in f64. The walk is bounded here. The original's is
//! not: on an edge it can run for ever.

use asperity_formats::{Asset, Numerator};
use std::f64::consts::PI;

/// The most steps that a walk may take.
const STEPS: usize = 128;

#[derive(Debug, Clone, Copy)]
struct Complex {
    re: f64,
    im: f64,
}

impl Complex {
    fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

struct Vertex {
    speed_mm_s: f64,
    force_n: f64,
    lsf: Vec<f64>,
    ma_lsf: Vec<f64>,
    level_m_s2: f64,
}

/// A texture, and where the walk ended.
pub struct Reference {
    vertices: Vec<Vertex>,
    triangles: Vec<[usize; 3]>,
    /// The triangle across the edge opposite each corner.
    neighbours: Vec<[Option<usize>; 3]>,
    numerator: Numerator,
    at: usize,
    past_e: [f64; 24],
    past_y: [f64; 24],
}

/// Coefficients and level of a query.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// a_1.. of A(z), zeros above the order.
    pub a: [f64; 24],
    /// b_1.. of B(z), zeros above the order.
    pub b: [f64; 24],
    /// gain·σ, m/s².
    pub level_m_s2: f64,
}

/// A polynomial in z⁻¹ of degree up to 25, monic.
struct Polynomial {
    c: [Complex; 26],
    degree: usize,
}

impl Polynomial {
    const ONE: Self = {
        let mut c = [Complex { re: 0.0, im: 0.0 }; 26];
        c[0].re = 1.0;
        Self { c, degree: 0 }
    };

    /// Multiplies by 1 − r z⁻¹, in place.
    fn root(&mut self, r: Complex) {
        self.degree += 1;
        for k in (1..=self.degree).rev() {
            let term = r.times(self.c[k - 1]);
            self.c[k].re -= term.re;
            self.c[k].im -= term.im;
        }
    }

    /// The roots e^{±jω} of every second frequency, and real ones.
    fn product<'a>(omegas: impl Iterator<Item = &'a f64>, real: &[f64]) -> Self {
        let mut product = Self::ONE;
        for (im, re) in omegas.step_by(2).map(|omega| omega.sin_cos()) {
            product.root(Complex { re, im });
            product.root(Complex { re, im: -im });
        }
        for &re in real {
            product.root(Complex { re, im: 0.0 });
        }
        product
    }
}

/// Coefficients 1.. of (P + Q)/2, from roots on the unit circle.
fn coefficients(lsf: &[f64], out: &mut [f64]) {
    let (of_q, of_p): (&[f64], &[f64]) = if lsf.len().is_multiple_of(2) {
        (&[-1.0], &[1.0])
    } else {
        (&[], &[1.0, -1.0])
    };
    let q = Polynomial::product(lsf.iter(), of_q);
    let p = Polynomial::product(lsf.iter().skip(1), of_p);
    for (k, a) in out.iter_mut().enumerate().take(lsf.len()) {
        *a = 0.5 * (q.c[k + 1].re + p.c[k + 1].re);
    }
}

impl Reference {
    /// From an asset.
    #[must_use]
    pub fn new(asset: &Asset<'_>) -> Self {
        let grid = asset.grid();
        let models: Vec<_> = grid.models().collect();
        let omegas = |codes: &mut dyn Iterator<Item = u16>| -> Vec<f64> {
            codes.map(|bits| PI * f64::from(bits) / 65536.0).collect()
        };
        let vertices = grid
            .vertices()
            .map(|vertex| {
                let model = &models[usize::from(vertex.model)];
                Vertex {
                    speed_mm_s: vertex.speed_mm_s.into(),
                    force_n: vertex.force_n.into(),
                    lsf: omegas(&mut model.lsf().map(|code| code.to_bits())),
                    ma_lsf: omegas(&mut model.ma_lsf().map(|code| code.to_bits())),
                    level_m_s2: f64::from(model.gain) * f64::from(vertex.sigma_m_s2),
                }
            })
            .collect();
        let triangles: Vec<[usize; 3]> = grid.triangles().map(|t| t.map(usize::from)).collect();
        let across = |t: usize, corner: usize| {
            let edge = [
                triangles[t][(corner + 1) % 3],
                triangles[t][(corner + 2) % 3],
            ];
            (0..triangles.len())
                .find(|&other| other != t && edge.iter().all(|v| triangles[other].contains(v)))
        };
        let neighbours = (0..triangles.len())
            .map(|t| std::array::from_fn(|corner| across(t, corner)))
            .collect();
        Self {
            vertices,
            triangles,
            neighbours,
            numerator: grid.numerator(),
            at: 0,
            past_e: [0.0; 24],
            past_y: [0.0; 24],
        }
    }

    fn weights(&self, t: usize, speed_mm_s: f64, force_n: f64) -> [f64; 3] {
        let [a, b, c] = self.triangles[t].map(|v| &self.vertices[v]);
        let (bx, by) = (b.speed_mm_s - a.speed_mm_s, b.force_n - a.force_n);
        let (cx, cy) = (c.speed_mm_s - a.speed_mm_s, c.force_n - a.force_n);
        let (x, y) = (speed_mm_s - a.speed_mm_s, force_n - a.force_n);
        let area = bx * cy - cx * by;
        let (wb, wc) = ((x * cy - cx * y) / area, (bx * y - x * by) / area);
        [1.0 - wb - wc, wb, wc]
    }

    /// The model at a query inside the grid.
    pub fn model(&mut self, speed_mm_s: f64, force_n: f64) -> Model {
        let mut weights = self.weights(self.at, speed_mm_s, force_n);
        for _ in 0..STEPS {
            let corner = (0..3).fold(0, |least, i| {
                if weights[i] < weights[least] {
                    i
                } else {
                    least
                }
            });
            match self.neighbours[self.at][corner] {
                Some(next) if weights[corner] < 0.0 => self.at = next,
                _ => break,
            }
            weights = self.weights(self.at, speed_mm_s, force_n);
        }
        let [i, j, k] = self.triangles[self.at].map(|v| &self.vertices[v]);
        let [wi, wj, wk] = weights;
        let convert = |lsf: fn(&Vertex) -> &[f64]| {
            let (mut mixed, mut out) = ([0.0; 24], [0.0; 24]);
            let rows = lsf(i).iter().zip(lsf(j)).zip(lsf(k));
            for (place, ((i, j), k)) in mixed.iter_mut().zip(rows) {
                *place = wi * i + wj * j + wk * k;
            }
            coefficients(&mixed[..lsf(i).len()], &mut out);
            out
        };
        let mut model = Model {
            a: convert(|v| &v.lsf),
            b: [0.0; 24],
            level_m_s2: wi * i.level_m_s2 + wj * j.level_m_s2 + wk * k.level_m_s2,
        };
        match self.numerator {
            Numerator::None => {}
            Numerator::Nyquist => model.b[0] = 1.0,
            Numerator::Lsf => model.b = convert(|v| &v.ma_lsf),
        }
        model
    }

    /// Location, conversion and one sample; `epsilon` is the excitation.
    pub fn tick(&mut self, speed_mm_s: f64, force_n: f64, epsilon: f64) -> f64 {
        let model = self.model(speed_mm_s, force_n);
        let past = |c: &[f64], line: &[f64]| c.iter().zip(line).map(|(c, x)| c * x).sum::<f64>();
        let e = model.level_m_s2 * epsilon;
        let y = e + past(&model.b, &self.past_e) - past(&model.a, &self.past_y);
        for (line, newest) in [(&mut self.past_e, e), (&mut self.past_y, y)] {
            line.rotate_right(1);
            line[0] = newest;
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::texture;
    use asperity_runtime::HostTexture;

    /// At vertices, where mixing in ω and in cos ω agree, both convert to the same filters.
    #[test]
    fn the_reference_gives_the_filters_of_the_runtime() {
        for numerator in [Numerator::None, Numerator::Nyquist, Numerator::Lsf] {
            let bytes = texture(20, numerator);
            let asset = Asset::parse(&bytes).expect("a valid asset");
            let mut slot = Box::new(HostTexture::new());
            slot.load(&asset, 1000.0).expect("it fits");
            let mut reference = Reference::new(&asset);
            for vertex in asset.grid().vertices() {
                let (speed, force) = (vertex.speed_mm_s, vertex.force_n);
                let usual = reference.model(speed.into(), force.into());
                let ours = slot.filter_at(speed, force);
                for (usual, ours) in [(usual.a, ours.a), (usual.b, ours.b)] {
                    for (usual, ours) in usual.iter().zip(ours) {
                        assert!((usual - f64::from(ours)).abs() < 2e-5, "{usual} {ours}");
                    }
                }
                assert!((usual.level_m_s2 - f64::from(ours.level_m_s2)).abs() < 1e-5);
            }
        }
    }
}
