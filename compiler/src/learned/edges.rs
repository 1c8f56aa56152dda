//! Edge models: they close the grid between its bins and the borders of the rectangle.
//!
//! Every vertex of the bins' hull that faces a border is copied onto that border, and onto the
//! corners. The copy keeps the shape of the spectrum. Its level follows the powers of speed and
//! force that the grid itself shows, and is zero at rest and without touch.

use asperity_texture::model::{GridVertex, VertexKind};

/// Range of the exponents; what lies beyond comes from noise.
const EXPONENTS: (f64, f64) = (0.0, 2.0);

/// The interior vertices followed by the edge models that close
/// `[0, max_speed_mm_s] × [0, max_force_n]`.
#[must_use]
pub fn close(interior: Vec<GridVertex>, max_speed_mm_s: f64, max_force_n: f64) -> Vec<GridVertex> {
    let (speed_exponent, force_exponent) = growth(&interior);
    let edge = |like: &GridVertex, speed_mm_s: f64, force_n: f64| {
        let ratio = |x: f64, y: f64, exponent: f64| libm::pow(x / y, exponent);
        let silent = speed_mm_s == 0.0 || force_n == 0.0;
        GridVertex {
            speed_mm_s,
            force_n,
            kind: VertexKind::Edge,
            sigma_m_s2: if silent {
                0.0
            } else {
                like.sigma_m_s2
                    * ratio(speed_mm_s, like.speed_mm_s, speed_exponent)
                    * ratio(force_n, like.force_n, force_exponent)
            },
            ..like.clone()
        }
    };
    let mut edges = Vec::new();
    // Towards each border: (distance along it, height above it).
    let along_speed = |v: &GridVertex| v.speed_mm_s;
    let along_force = |v: &GridVertex| v.force_n;
    for like in facing(&interior, along_speed, |v| v.force_n) {
        edges.push(edge(like, like.speed_mm_s, 0.0));
    }
    for like in facing(&interior, along_speed, |v| -v.force_n) {
        edges.push(edge(like, like.speed_mm_s, max_force_n));
    }
    for like in facing(&interior, along_force, |v| v.speed_mm_s) {
        edges.push(edge(like, 0.0, like.force_n));
    }
    for like in facing(&interior, along_force, |v| -v.speed_mm_s) {
        edges.push(edge(like, max_speed_mm_s, like.force_n));
    }
    for speed_mm_s in [0.0, max_speed_mm_s] {
        for force_n in [0.0, max_force_n] {
            let distance = |v: &GridVertex| {
                let x = (v.speed_mm_s - speed_mm_s) / max_speed_mm_s;
                let y = (v.force_n - force_n) / max_force_n;
                x * x + y * y
            };
            let nearest = interior
                .iter()
                .min_by(|a, b| distance(a).total_cmp(&distance(b)));
            edges.extend(nearest.map(|like| edge(like, speed_mm_s, force_n)));
        }
    }
    let mut all = interior;
    all.extend(edges);
    all
}

/// The part of the convex hull that faces a border, in ascending order along it.
fn facing(
    vertices: &[GridVertex],
    along: impl Fn(&GridVertex) -> f64,
    height: impl Fn(&GridVertex) -> f64,
) -> Vec<&GridVertex> {
    let mut sorted: Vec<&GridVertex> = vertices.iter().collect();
    sorted.sort_by(|a, b| {
        along(a)
            .total_cmp(&along(b))
            .then(height(a).total_cmp(&height(b)))
    });
    sorted.dedup_by(|later, earlier| along(later) == along(earlier));
    let mut chain: Vec<&GridVertex> = Vec::new();
    for vertex in sorted {
        while let [.., a, b] = chain[..] {
            let turn = (along(b) - along(a)) * (height(vertex) - height(a))
                - (height(b) - height(a)) * (along(vertex) - along(a));
            if turn > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(vertex);
    }
    chain
}

/// Exponents of speed and force that fit ln σ over the vertices best.
fn growth(vertices: &[GridVertex]) -> (f64, f64) {
    let points: Vec<[f64; 3]> = vertices
        .iter()
        .filter(|v| v.sigma_m_s2 > 0.0 && v.speed_mm_s > 0.0 && v.force_n > 0.0)
        .map(|v| {
            [
                libm::log(v.speed_mm_s),
                libm::log(v.force_n),
                libm::log(v.sigma_m_s2),
            ]
        })
        .collect();
    let count = points.len().max(1) as f64;
    let mean: [f64; 3] = std::array::from_fn(|k| points.iter().map(|p| p[k]).sum::<f64>() / count);
    let product = |i: usize, j: usize| -> f64 {
        points
            .iter()
            .map(|p| (p[i] - mean[i]) * (p[j] - mean[j]))
            .sum()
    };
    let (vv, ff, vf) = (product(0, 0), product(1, 1), product(0, 1));
    let (vs, fs) = (product(0, 2), product(1, 2));
    let determinant = vv * ff - vf * vf;
    if determinant <= 1e-9 * vv * ff {
        return (0.0, 0.0);
    }
    let (low, high) = EXPONENTS;
    (
        ((vs * ff - fs * vf) / determinant).clamp(low, high),
        ((fs * vv - vs * vf) / determinant).clamp(low, high),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_texture::model::triangulate;
    use asperity_texture::model::{ModelGrid, Numerator, mesh};

    fn interior() -> Vec<GridVertex> {
        // A scattered cloud with σ = (v/100)^0.9·F^0.3.
        (0..18)
            .map(|n| {
                let speed_mm_s = 20.0 + 11.3 * f64::from(n);
                let force_n = 0.3 + 2.5 * (f64::from(n) * 0.618).fract();
                GridVertex {
                    speed_mm_s,
                    force_n,
                    kind: VertexKind::Interior,
                    lsf_rad: vec![1.0, 2.0],
                    ma_lsf_rad: None,
                    gain: 1.0,
                    sigma_m_s2: libm::pow(speed_mm_s / 100.0, 0.9) * libm::pow(force_n, 0.3),
                }
            })
            .collect()
    }

    #[test]
    fn a_power_law_goes_on_to_the_far_borders_and_is_silent_at_the_near_ones() {
        for vertex in close(interior(), 250.0, 3.5) {
            let expected =
                libm::pow(vertex.speed_mm_s / 100.0, 0.9) * libm::pow(vertex.force_n, 0.3);
            assert!((vertex.sigma_m_s2 - expected).abs() < 1e-9, "{vertex:?}");
        }
    }

    #[test]
    fn the_rectangle_is_tiled() {
        let vertices = close(interior(), 250.0, 3.5);
        let grid = ModelGrid {
            sample_rate_hz: 1000.0,
            order: 2,
            numerator: Numerator::Nyquist,
            triangles: triangulate::delaunay(&vertices),
            vertices,
        };
        assert_eq!(mesh::check(&grid), Ok(()));
        assert_eq!(mesh::corner(&grid), (250.0, 3.5));
    }
}
