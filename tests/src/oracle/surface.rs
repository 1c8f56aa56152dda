//! Signed distances and normals.

use super::{Vector, dot, norm, plus, times};
use asperity_runtime::Solid;

/// Signed distance (m, negative inside) and outward normal of a position.
#[must_use]
pub fn distance_and_normal(surface: &Solid, position: Vector) -> (f64, Vector) {
    match *surface {
        Solid::Plane { point_m, normal } => {
            let normal = normal.map(f64::from);
            let normal = times(normal, 1.0 / norm(normal));
            (
                dot(plus(position, point_m.map(f64::from), -1.0), normal),
                normal,
            )
        }
        Solid::Sphere { center_m, radius_m } => {
            let out = plus(position, center_m.map(f64::from), -1.0);
            let length = norm(out);
            let normal = if length > 1e-9 {
                times(out, 1.0 / length)
            } else {
                [0.0, 0.0, 1.0]
            };
            (length - f64::from(radius_m), normal)
        }
        Solid::Box {
            center_m,
            half_extents_m,
        } => {
            let out = plus(position, center_m.map(f64::from), -1.0);
            let half = half_extents_m.map(f64::from);
            let beyond: Vector = std::array::from_fn(|i| out[i] - out[i].clamp(-half[i], half[i]));
            let length = norm(beyond);
            if length > 1e-9 {
                return (length, times(beyond, 1.0 / length));
            }
            // Inside: the nearest face.
            let depth = |i: usize| half[i] - out[i].abs();
            let face = (0..3)
                .min_by(|&i, &j| depth(i).total_cmp(&depth(j)))
                .unwrap_or(0);
            let mut normal = [0.0; 3];
            normal[face] = if out[face] < 0.0 { -1.0 } else { 1.0 };
            (-depth(face), normal)
        }
    }
}
