//! The predictions of every measured model from the others.

use super::method::{Exponents, Method, Prediction, Region};
use crate::pareto::{
    difference::{Band, Difference},
    kernel::Kernel,
};
use asperity::{
    learned::edges,
    model::{
        GridVertex, ModelGrid, VertexKind,
        mixture::{Field, Place},
        triangulate,
    },
    signal::{reflection, spectrum::ArmaModel},
};
use asperity_kernels::design::{Arithmetic, Design, Level, Shape};

/// Exponents of speed and force that fit the measured levels of a grid, within 0 to 2.
#[must_use]
pub fn exponents(grid: &ModelGrid) -> (f64, f64) {
    edges::growth(&with_levels(&measured(grid)))
}

/// Every interior model predicted from the others, by every method that applies.
#[must_use]
pub fn predictions(grid: &ModelGrid) -> Vec<Prediction> {
    let band = Band::new(grid.sample_rate_hz);
    let measured = measured(grid);
    let silent: Vec<&GridVertex> = grid
        .vertices
        .iter()
        .filter(|v| v.sigma_m_s2 == 0.0 && (v.speed_mm_s == 0.0 || v.force_n == 0.0))
        .collect();
    (0..measured.len())
        .flat_map(|out| predict(grid, &band, &measured, &silent, out))
        .collect()
}

/// Interior models that vibrate, each filter once.
fn measured(grid: &ModelGrid) -> Vec<GridVertex> {
    let mut distinct: Vec<GridVertex> = Vec::new();
    for vertex in &grid.vertices {
        let sounds = vertex.kind == VertexKind::Interior && vertex.sigma_m_s2 > 0.0;
        if sounds && !distinct.iter().any(|other| same_shape(other, vertex)) {
            distinct.push(vertex.clone());
        }
    }
    distinct
}

fn same_shape(x: &GridVertex, y: &GridVertex) -> bool {
    x.lsf_rad == y.lsf_rad && x.ma_lsf_rad == y.ma_lsf_rad
}

/// The vertices with a gain of 1 and gain·σ as σ, for fits of the level.
fn with_levels(vertices: &[GridVertex]) -> Vec<GridVertex> {
    vertices
        .iter()
        .map(|vertex| GridVertex {
            sigma_m_s2: vertex.gain * vertex.sigma_m_s2,
            gain: 1.0,
            ..vertex.clone()
        })
        .collect()
}

fn predict(
    grid: &ModelGrid,
    band: &Band,
    measured: &[GridVertex],
    silent: &[&GridVertex],
    out: usize,
) -> Vec<Prediction> {
    let target = &measured[out];
    let truth = band.powers(&ArmaModel::at_vertex(grid, target));
    let others: Vec<GridVertex> = measured
        .iter()
        .enumerate()
        .filter(|(index, _)| *index != out)
        .map(|(_, vertex)| vertex.clone())
        .collect();
    let (width, height) = asperity::model::mesh::corner(grid);
    let distance = |x: &GridVertex, y: &GridVertex| {
        let (dv, df) = (
            (x.speed_mm_s - y.speed_mm_s) / width,
            (x.force_n - y.force_n) / height,
        );
        dv * dv + df * df
    };
    let nearest_to = |vertex: &GridVertex| {
        others
            .iter()
            .min_by(|a, b| distance(a, vertex).total_cmp(&distance(b, vertex)))
    };
    if others.len() < 3 {
        return Vec::new();
    }
    let mut vertices = others.clone();
    for edge in silent {
        // An edge model copies an interior filter, perhaps of the very model that is left out.
        if let Some(like) = nearest_to(edge) {
            vertices.push(GridVertex {
                speed_mm_s: edge.speed_mm_s,
                force_n: edge.force_n,
                kind: VertexKind::Edge,
                sigma_m_s2: 0.0,
                ..like.clone()
            });
        }
    }
    let around = ModelGrid {
        triangles: triangulate::delaunay(&vertices),
        vertices,
        ..grid.clone()
    };
    let powers = |model: ArmaModel| {
        let fine = model.level_m_s2 > 0.0 && reflection::is_stable(&model.a);
        fine.then(|| Difference::of(&truth, &band.powers(&model)))
    };
    let (place, (speed_mm_s, force_n)) = located(&around, target);
    let Some(place) = place else {
        return Vec::new();
    };
    let beyond = (speed_mm_s, force_n) != (target.speed_mm_s, target.force_n);
    let touches_silence = place
        .vertices
        .iter()
        .zip(place.weights)
        .any(|(&v, w)| w > 1e-9 && around.vertices[v].sigma_m_s2 == 0.0);
    let region = match (beyond, touches_silence) {
        (true, _) => Region::Beyond,
        (false, true) => Region::TowardsRest,
        (false, false) => Region::Inside,
    };
    let mut all = Vec::new();
    let mut add = |method, model: Option<ArmaModel>| {
        all.push(Prediction {
            model: out,
            method,
            region,
            difference: model.and_then(powers),
        });
    };
    add(
        Method::Nearest,
        nearest_to(target).map(|vertex| ArmaModel::at_vertex(grid, vertex)),
    );
    if beyond {
        let model = Field::new(&around).model(&place);
        let fitted = edges::growth(&with_levels(&others));
        for exponents in Exponents::ALL {
            let (v, f) = match exponents {
                Exponents::Fitted => fitted,
                Exponents::Fixed(v, f) => (v, f),
            };
            let growth = libm::pow(target.speed_mm_s / speed_mm_s, v)
                * libm::pow(target.force_n / force_n, f);
            let level_m_s2 = model.level_m_s2 * growth;
            add(
                Method::Powers(exponents),
                Some(ArmaModel {
                    level_m_s2,
                    ..model.clone()
                }),
            );
        }
        return all;
    }
    for shape in Shape::ALL {
        add(
            Method::Shape(shape),
            mixed(&around, &place, shape, Level::Rms),
        );
    }
    for level in Level::ALL {
        // Silence has no logarithm.
        if region == Region::Inside || level != Level::Log {
            add(
                Method::Level(level),
                mixed(&around, &place, Shape::LsfCosine, level),
            );
        }
    }
    all
}

/// The mixture that a kernel renders, in f64.
fn mixed(grid: &ModelGrid, place: &Place, shape: Shape, level: Level) -> Option<ArmaModel> {
    let design = Design {
        shape,
        level,
        arithmetic: Arithmetic::F64,
        ..Design::ORACLE
    };
    let mut kernel = Kernel::new(&design, grid)?;
    kernel.settle(place);
    Some(kernel.model())
}

// Where a model lies among the triangles of the others.

/// The mixture at a vertex's position, or at the nearest point of the triangles' border, and
/// that point in mm/s and N.
fn located(grid: &ModelGrid, target: &GridVertex) -> (Option<Place>, (f64, f64)) {
    let (width, height) = asperity::model::mesh::corner(grid);
    let at = |v: usize| {
        let vertex = &grid.vertices[v];
        (vertex.speed_mm_s, vertex.force_n)
    };
    let goal = (target.speed_mm_s, target.force_n);
    let mut best: Option<(f64, Place, (f64, f64))> = None;
    for &triangle in &grid.triangles {
        let corners = triangle.map(at);
        if let Some(weights) = weights_inside(corners, goal) {
            let place = Place {
                vertices: triangle,
                weights,
            };
            return (Some(place), goal);
        }
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (p, q) = (corners[i], corners[j]);
            let (dx, dy) = ((q.0 - p.0) / width, (q.1 - p.1) / height);
            let (gx, gy) = ((goal.0 - p.0) / width, (goal.1 - p.1) / height);
            let square = dx * dx + dy * dy;
            if square == 0.0 {
                continue;
            }
            let t = ((gx * dx + gy * dy) / square).clamp(0.0, 1.0);
            let (rx, ry) = (gx - t * dx, gy - t * dy);
            let distance = rx * rx + ry * ry;
            if best.as_ref().is_none_or(|(least, ..)| distance < *least) {
                let mut weights = [0.0; 3];
                (weights[i], weights[j]) = (1.0 - t, t);
                let place = Place {
                    vertices: triangle,
                    weights,
                };
                let point = (p.0 + t * (q.0 - p.0), p.1 + t * (q.1 - p.1));
                best = Some((distance, place, point));
            }
        }
    }
    match best {
        Some((_, place, point)) => (Some(place), point),
        None => (None, goal),
    }
}

fn weights_inside(corners: [(f64, f64); 3], (x, y): (f64, f64)) -> Option<[f64; 3]> {
    let [(x0, y0), (x1, y1), (x2, y2)] = corners;
    let twice_area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
    if twice_area == 0.0 {
        return None;
    }
    let w1 = ((y2 - y0) * (x - x0) + (x0 - x2) * (y - y0)) / twice_area;
    let w2 = ((y0 - y1) * (x - x0) + (x1 - x0) * (y - y0)) / twice_area;
    let weights = [1.0 - w1 - w2, w1, w2];
    weights.iter().all(|w| *w >= 0.0).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::sources::builtin;

    /// A grid whose cosines and levels are linear in speed and force.
    fn linear() -> ModelGrid {
        let mut grid = builtin::texture().grid;
        let order = grid.order;
        for (index, vertex) in grid.vertices.iter_mut().enumerate() {
            let bend = 1e-4 * vertex.speed_mm_s + 0.005 * vertex.force_n;
            vertex.lsf_rad = (1..=order)
                .map(|k| {
                    let x = 1.0 - 2.0 * k as f64 / (order + 1) as f64;
                    libm::acos(0.8 * x + bend)
                })
                .collect();
            vertex.sigma_m_s2 = vertex.speed_mm_s * 0.01 + vertex.force_n;
            // Each interior model counts once, and all of them vibrate.
            vertex.kind = if index % 2 == 0 {
                VertexKind::Interior
            } else {
                VertexKind::Edge
            };
        }
        grid
    }

    #[test]
    fn what_is_linear_is_predicted_exactly_by_what_mixes_it_linearly() {
        let all = predictions(&linear());
        let inside = |method: Method| {
            all.iter()
                .filter(move |p| p.method == method && p.region == Region::Inside)
                .map(|p| p.difference.expect("stable").distortion_db)
        };
        assert!(inside(Method::Nearest).count() > 2);
        assert!(inside(Method::Shape(Shape::LsfCosine)).all(|db| db < 1e-6));
        assert!(inside(Method::Level(Level::Variance)).any(|db| db > 0.05));
        assert!(inside(Method::Nearest).all(|db| db > 0.1));
    }

    #[test]
    fn a_power_law_goes_on_beyond_the_border() {
        let mut grid = linear();
        let same = grid.vertices[0].lsf_rad.clone();
        for (index, vertex) in grid.vertices.iter_mut().enumerate() {
            // The shapes differ by far less than can be heard, but they are distinct.
            vertex.lsf_rad = same.iter().map(|w| w + 1e-9 * index as f64).collect();
            let speed = vertex.speed_mm_s.max(1.0);
            vertex.sigma_m_s2 = speed.powf(1.0) * vertex.force_n.max(0.01).powf(0.5);
        }
        let growth = exponents(&grid);
        assert!((growth.0 - 1.0).abs() < 1e-6 && (growth.1 - 0.5).abs() < 1e-6);
    }
}
