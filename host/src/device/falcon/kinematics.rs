//! From the angles of the thighs to the position of the grip, and back.
//!
//! For a leg in direction φ the position x = (x, y, z) has the radial part U = x·cos φ + y·sin φ −
//! r + c and the tangential part V = y·cos φ − x·sin φ − s + f. The knee is at a·(cos θ, sin θ) in
//! the plane of U and z. The distance q of (U, z) from the knee is what the joints and the shin
//! span:
//!
//! ```text
//! g(x, θ) = (q − (d + e))² + V² − b² = 0,   q² = (U − a·cos θ)² + (z − a·sin θ)²
//! ```
//!
//! The inverse solves g = 0 for θ in closed form. The forward way solves the three equations for x
//! by Newton's method. The Jacobian follows from the implicit function: dθ/dx = −(∂g/∂x)/(∂g/∂θ).

use super::geometry::{
    BASE_RADIAL_M, BASE_TANGENTIAL_M, CENTRE_M, JOINTS_M, LEGS, PLATFORM_RADIAL_M,
    PLATFORM_TANGENTIAL_M, SHIN_M, THIGH_M,
};

/// Newton steps at most; within the workspace it takes four to six.
const STEPS: usize = 16;
/// A step this short ends the search, m.
const CLOSE_M: f64 = 1e-12;

/// The three rows dθ_i/dx, rad/m.
pub type Jacobian = [[f64; 3]; 3];

/// Angles of the thighs where the grip is at `position_m` in the device's frame, rad. `None` where
/// the legs do not reach.
#[must_use]
pub fn inverse(position_m: [f64; 3]) -> Option<[f64; 3]> {
    let mut angles = [0.0; 3];
    for (angle, leg) in angles.iter_mut().zip(&LEGS) {
        let (u, v) = in_leg(position_m, leg);
        let z = position_m[2];
        let shin = SHIN_M * SHIN_M - v * v;
        if shin < 0.0 {
            return None;
        }
        let q = JOINTS_M + shin.sqrt();
        let distance = (u * u + z * z).sqrt();
        let cosine = (distance * distance + THIGH_M * THIGH_M - q * q) / (2.0 * THIGH_M * distance);
        // Of the two knees the outer one: the legs of a Falcon bend outwards.
        if !(-1.0..=1.0).contains(&cosine) {
            return None;
        }
        *angle = libm::atan2(z, u) - libm::acos(cosine);
    }
    Some(angles)
}

/// Position of the grip in the device's frame, m, at angles of the thighs in rad. `None` if no
/// position of the workspace has these angles.
#[must_use]
pub fn forward(angles: [f64; 3]) -> Option<[f64; 3]> {
    let knees = angles.map(|angle| [THIGH_M * libm::cos(angle), THIGH_M * libm::sin(angle)]);
    let mut position = CENTRE_M;
    for _ in 0..STEPS {
        let mut gradients = [[0.0; 3]; 3];
        let mut values = [0.0; 3];
        for leg in 0..3 {
            let constraint = Constraint::at(position, knees[leg], &LEGS[leg]);
            gradients[leg] = constraint.by_position;
            values[leg] = constraint.value;
        }
        let step = solve(&gradients, values)?;
        // A long step is cut, so that the search stays where the mechanism has one solution.
        let length = norm(step);
        let scale = if length > 0.03 { 0.03 / length } else { 1.0 };
        for axis in 0..3 {
            position[axis] -= scale * step[axis];
        }
        if length < CLOSE_M {
            return position.iter().all(|x| x.is_finite()).then_some(position);
        }
    }
    None
}

/// Derivatives of the angles with respect to the position; `None` at a singularity.
#[must_use]
pub fn jacobian(position_m: [f64; 3], angles: [f64; 3]) -> Option<Jacobian> {
    let mut rows = [[0.0; 3]; 3];
    for leg in 0..3 {
        let knee = [
            THIGH_M * libm::cos(angles[leg]),
            THIGH_M * libm::sin(angles[leg]),
        ];
        let constraint = Constraint::at(position_m, knee, &LEGS[leg]);
        if constraint.by_angle.abs() < 1e-9 {
            return None;
        }
        rows[leg] = constraint.by_position.map(|g| -g / constraint.by_angle);
    }
    Some(rows)
}

/// g and its derivatives.
struct Constraint {
    value: f64,
    by_position: [f64; 3],
    by_angle: f64,
}

impl Constraint {
    fn at(position_m: [f64; 3], knee: [f64; 2], leg: &[f64; 2]) -> Self {
        let [cos, sin] = *leg;
        let (u, v) = in_leg(position_m, leg);
        let z = position_m[2];
        let [along, up] = [u - knee[0], z - knee[1]];
        let q = (along * along + up * up).sqrt();
        let h = q - JOINTS_M;
        let pull = 2.0 * h / q;
        Self {
            value: h * h + v * v - SHIN_M * SHIN_M,
            by_position: [
                pull * along * cos - 2.0 * v * sin,
                pull * along * sin + 2.0 * v * cos,
                pull * up,
            ],
            by_angle: pull * (u * knee[1] - z * knee[0]),
        }
    }
}

/// Radial and tangential coordinates of the platform's joint, m.
fn in_leg(position_m: [f64; 3], leg: &[f64; 2]) -> (f64, f64) {
    let ([cos, sin], [x, y, _]) = (*leg, position_m);
    (
        x * cos + y * sin - BASE_RADIAL_M + PLATFORM_RADIAL_M,
        y * cos - x * sin - BASE_TANGENTIAL_M + PLATFORM_TANGENTIAL_M,
    )
}

/// The vector x with rows·x = values. `None` if there is none or the rows are nearly dependent.
pub(crate) fn solve(rows: &[[f64; 3]; 3], values: [f64; 3]) -> Option<[f64; 3]> {
    let [a, b, c] = *rows;
    let [bc, ca, ab] = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, bc);
    let size = norm(a) * norm(b) * norm(c);
    // Also false for NaN.
    if determinant.abs() > 1e-6 * size {
        Some(std::array::from_fn(|n| {
            (values[0] * bc[n] + values[1] * ca[n] + values[2] * ab[n]) / determinant
        }))
    } else {
        None
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::geometry::{angle, count};
    use super::*;

    /// Radius of the ball around the centre that positions are specified for, m.
    const WORKSPACE_RADIUS_M: f64 = 0.045;

    /// Positions of the workspace on a grid of 5 mm.
    fn workspace() -> Vec<[f64; 3]> {
        let steps = -9..=9_i32;
        let mut all = Vec::new();
        for x in steps.clone() {
            for y in steps.clone() {
                for z in steps.clone() {
                    let offset = [x, y, z].map(|n| f64::from(n) * 0.005);
                    if norm(offset) <= WORKSPACE_RADIUS_M {
                        all.push(std::array::from_fn(|n| CENTRE_M[n] + offset[n]));
                    }
                }
            }
        }
        assert!(all.len() > 2500);
        all
    }

    #[test]
    fn forward_of_inverse_is_the_position_over_the_workspace() {
        for position in workspace() {
            let angles = inverse(position).unwrap_or_else(|| panic!("{position:?}"));
            let back = forward(angles).unwrap_or_else(|| panic!("{position:?}"));
            let error: [f64; 3] = std::array::from_fn(|n| back[n] - position[n]);
            assert!(norm(error) < 1e-10, "{position:?}: {error:?}");
        }
    }

    #[test]
    fn a_position_read_by_encoders_is_off_by_less_than_a_count_of_each() {
        for position in workspace() {
            let angles = inverse(position).expect("reachable");
            let read = forward(angles.map(|a| angle(count(a)))).expect("reachable");
            let error: [f64; 3] = std::array::from_fn(|n| read[n] - position[n]);
            // A count moves a knee by 38 µm; near the border the grip moves more.
            assert!(norm(error) < 1.5e-4, "{position:?}: {error:?}");
        }
    }

    #[test]
    fn the_jacobian_is_the_slope_of_the_inverse() {
        let step = 1e-6;
        for position in workspace() {
            let angles = inverse(position).expect("reachable");
            let rows = jacobian(position, angles).expect("regular");
            for axis in 0..3 {
                let moved = |by: f64| {
                    let mut there = position;
                    there[axis] += by;
                    inverse(there).expect("reachable")
                };
                let (ahead, behind) = (moved(step), moved(-step));
                for leg in 0..3 {
                    let slope = (ahead[leg] - behind[leg]) / (2.0 * step);
                    assert!(
                        (rows[leg][axis] - slope).abs() < 1e-5 * (1.0 + slope.abs()),
                        "{position:?}: {} and {slope}",
                        rows[leg][axis]
                    );
                }
            }
        }
    }

    #[test]
    fn at_the_middle_the_legs_do_the_same_turned_by_a_third() {
        let angles = inverse(CENTRE_M).expect("the centre");
        assert!((angles[0] - angles[1]).abs() < 1e-12 && (angles[1] - angles[2]).abs() < 1e-12);
        // As far as an independent solution of the published equations goes: 27.7°.
        assert!(
            (angles[0].to_degrees() - 27.7).abs() < 0.1,
            "{}",
            angles[0].to_degrees()
        );
    }

    #[test]
    fn what_is_out_of_reach_or_no_number_gives_nothing() {
        for far in [[0.0, 0.0, 0.3], [0.2, 0.0, 0.1], [0.0, -0.5, 0.1]] {
            assert_eq!(inverse(far), None, "{far:?}");
        }
        assert_eq!(forward([f64::NAN; 3]), None);
        assert_eq!(forward([f64::INFINITY, 0.5, 0.5]), None);
        // Encoders may say anything.
        for n in 0..4096_u32 {
            let counts = [
                n.wrapping_mul(40_503),
                n.wrapping_mul(30_011),
                n.wrapping_mul(7_919),
            ];
            let angles = counts.map(|c| angle(c as i16));
            if let Some(position) = forward(angles) {
                assert!(position.iter().all(|x| x.is_finite() && x.abs() < 1.0));
            }
        }
    }
}
