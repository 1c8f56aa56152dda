//! Where a model lies among the triangles of the others.

use asperity::{
    mixture::Place,
    model::{GridVertex, ModelGrid},
};

/// The mixture at a vertex's position, or at the nearest point of the triangles' border, and
/// that point in mm/s and N.
pub(super) fn located(grid: &ModelGrid, target: &GridVertex) -> (Option<Place>, (f64, f64)) {
    let (width, height) = asperity::mesh::corner(grid);
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
