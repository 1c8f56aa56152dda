//! Contact with a plane, a sphere or a box: depth δ and outward normal n̂.
//!
//! The signed distance is exact for the three solids, negative inside; δ = max(−distance, 0). At a
//! sphere's centre the normal is +z; inside a box it is the normal of the nearest face. Where two
//! faces are equally near, the first axis wins.

use crate::{
    arithmetic::Float,
    math::{Vec3, sqrt},
    quantity::{
        Magnitude, Magnitudes, Quantity, Vector,
        unit::{Fraction, Metre},
    },
};
use asperity_formats::Solid;

/// Components of a normal are whole multiples of this, 2⁻²², so that their products with small motions
/// are normal floats.
pub(crate) const FLATTEST: f32 = f32::from_bits((127 - 22) << 23);

/// The signed distance from a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DistanceField<A: Magnitudes = Float> {
    /// The distance from a half-space.
    Plane {
        /// A point of the plane, m.
        point: Vector<A, Metre>,
        /// Outward normal of length 1.
        normal: Vector<A, Fraction>,
    },
    /// The distance from a ball.
    Sphere {
        /// Centre, m.
        center: Vector<A, Metre>,
        /// Radius, m.
        radius: Quantity<A, Metre>,
    },
    /// The distance from a box along the world's axes.
    Box {
        /// Centre, m.
        center: Vector<A, Metre>,
        /// Half the edge lengths, m.
        half_extents: Vector<A, Metre>,
    },
}

/// Where the stylus is relative to a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<A: Magnitudes = Float> {
    /// Signed distance, m: negative inside.
    pub distance: Quantity<A, Metre>,
    /// Outward unit normal n̂.
    pub normal: Vector<A, Fraction>,
}

impl<A: Magnitudes> Contact<A> {
    /// Depth δ, m; 0 outside.
    #[inline(always)]
    #[must_use]
    pub fn depth(&self) -> Quantity<A, Metre> {
        (-self.distance).max(Quantity::ZERO)
    }
}

impl<A: Magnitudes> DistanceField<A> {
    /// The field of a checked solid. The normal of a plane is brought to unit length here, in f64,
    /// because a tick has no time for it.
    #[must_use]
    pub fn new(solid: &Solid) -> Self {
        match *solid {
            Solid::Plane { point_m, normal } => Self::Plane {
                point: Vector::of(point_m),
                normal: Vector::of(unit(normal)).settled_within(FLATTEST),
            },
            Solid::Sphere { center_m, radius_m } => Self::Sphere {
                center: Vector::of(center_m),
                radius: Quantity::of(radius_m),
            },
            Solid::Box {
                center_m,
                half_extents_m,
            } => Self::Box {
                center: Vector::of(center_m),
                half_extents: Vector::of(half_extents_m),
            },
        }
    }

    /// Distance and normal at a position.
    #[inline(always)]
    #[must_use]
    pub fn step(&self, position: Vector<A, Metre>) -> Contact<A> {
        match *self {
            Self::Plane { point, normal } => Contact {
                distance: (position - point).dot(normal),
                normal,
            },
            Self::Sphere { center, radius } => sphere(position - center, radius),
            Self::Box {
                center,
                half_extents,
            } => cuboid(position - center, half_extents),
        }
    }
}

#[inline]
fn sphere<A: Magnitudes>(r: Vector<A, Metre>, radius: Quantity<A, Metre>) -> Contact<A> {
    let square = r.square();
    let magnitude = Magnitude::<A, Metre>::of_square(square);
    let normal = if A::is_some(square) {
        r.direction(magnitude).settled_within(FLATTEST)
    } else {
        Vector::whole([0, 0, 1])
    };
    Contact {
        distance: magnitude.length() - radius,
        normal,
    }
}

#[inline]
fn cuboid<A: Magnitudes>(r: Vector<A, Metre>, half_extents: Vector<A, Metre>) -> Contact<A> {
    let zero = Quantity::<A, Metre>::ZERO;
    let (r, half) = (r.components(), half_extents.components());
    let below = r.map(|x| x < zero);
    let signed = |x: Quantity<A, Metre>, axis: usize| if below[axis] { -x } else { x };
    let q = [0, 1, 2].map(|axis| signed(r[axis], axis) - half[axis]);
    let outside = q.map(|x| x.max(zero));
    let away = Vector::<A, Metre>::load([0, 1, 2].map(|axis| signed(outside[axis], axis).0));
    let square = away.square();
    let magnitude = Magnitude::<A, Metre>::of_square(square);
    let deepest = q[2].max(q[1]).max(q[0]);
    let first = q[0] >= deepest;
    let second = !first && q[1] >= deepest;
    let face = [first, second, !first && !second];
    let normal = if A::is_some(square) {
        away.direction(magnitude).settled_within(FLATTEST)
    } else {
        let outward = |axis: usize| {
            let sign = if below[axis] { -1 } else { 1 };
            if face[axis] { sign } else { 0 }
        };
        Vector::whole([0, 1, 2].map(outward))
    };
    Contact {
        distance: magnitude.length() + deepest.min(zero),
        normal,
    }
}

/// `v` at unit length, rounded once, so that a unit normal stays as it is.
pub(crate) fn unit(v: Vec3) -> Vec3 {
    let v = v.map(f64::from);
    let squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    // The guess is good to 1e-7; one Newton step squares that.
    let guess = 1.0 / f64::from(sqrt(squared as f32));
    let inverse = guess * (1.5 - 0.5 * squared * guess * guess);
    v.map(|x| (x * inverse) as f32)
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
mod tests {
    extern crate std;
    use super::*;
    use crate::math::{norm, sub};

    /// Distance and normal at a position.
    fn contact(solid: &Solid, position_m: Vec3) -> (f32, Vec3) {
        let contact = DistanceField::<Float>::new(solid).step(Vector::of(position_m));
        (contact.distance.value(), contact.normal.values())
    }

    fn near(a: Vec3, b: Vec3) -> bool {
        norm(sub(a, b)) < 1e-5
    }

    #[test]
    fn a_box_is_touched_at_faces_edges_and_corners() {
        let cube = Solid::Box {
            center_m: [1.0, 0.0, 0.0],
            half_extents_m: [0.5; 3],
        };
        let (distance_m, normal) = contact(&cube, [1.0, 0.45, 0.1]);
        assert!((distance_m + 0.05).abs() < 1e-6);
        assert_eq!(normal, [0.0, 1.0, 0.0]);
        let (distance_m, normal) = contact(&cube, [1.6, 0.6, -0.6]);
        assert!((distance_m - 0.1 * 3.0_f32.sqrt()).abs() < 1e-6);
        let third = 1.0 / 3.0_f32.sqrt();
        assert!(near(normal, [third, third, -third]));
    }

    #[test]
    fn depth_on_a_plane_is_exact() {
        let plane = Solid::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 2.0],
        };
        let (distance_m, normal) = contact(&plane, [0.01, 0.02, -2e-3]);
        assert_eq!(normal, [0.0, 0.0, 1.0]);
        assert_eq!(distance_m, -2e-3);
    }

    #[test]
    fn a_spheres_normal_is_radial_and_defined_at_its_centre() {
        let ball = Solid::Sphere {
            center_m: [0.0; 3],
            radius_m: 0.02,
        };
        let (distance_m, normal) = contact(&ball, [0.0, -0.019, 0.0]);
        assert!((distance_m + 0.001).abs() < 1e-7);
        assert!(near(normal, [0.0, -1.0, 0.0]));
        assert_eq!(contact(&ball, [0.0; 3]).1, [0.0, 0.0, 1.0]);
    }
}
