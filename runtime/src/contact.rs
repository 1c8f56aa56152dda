//! Contact with a plane, a sphere or a box: signed distance and outward normal.

use crate::{
    arithmetic::{
        Arithmetic, Float, Four, Number,
        units::{Metre, Unit},
    },
    config::ConfigError,
    math::{Vec3, norm, sqrt},
};

/// A solid that the stylus touches; the texture is the same everywhere on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// A half-space.
    Plane {
        /// A point of the plane, m.
        point_m: Vec3,
        /// Outward normal, any length above 0.
        normal: Vec3,
    },
    /// A ball, touched from outside.
    Sphere {
        /// Centre, m.
        center_m: Vec3,
        /// Radius, m.
        radius_m: f32,
    },
    /// A box along the world's axes, touched from outside.
    Box {
        /// Centre, m.
        center_m: Vec3,
        /// Half the edge lengths, m.
        half_extents_m: Vec3,
    },
}

/// A [`Surface`] prepared for the tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Solid<A: Arithmetic = Float> {
    /// A half-space: a point, and the normal of unit length.
    Plane {
        point_m: Four<A, Metre>,
        normal: Four<A, Unit>,
    },
    Sphere {
        center_m: Four<A, Metre>,
        radius_m: Number<A, Metre>,
    },
    Box {
        center_m: Four<A, Metre>,
        half_extents_m: Four<A, Metre>,
    },
}

/// Signed distance, m, and normal.
type Touch<A> = (Number<A, Metre>, Four<A, Unit>);

impl<A: Arithmetic> Solid<A> {
    /// Of a checked surface; a plane's normal has unit length.
    #[must_use]
    pub(crate) fn new(surface: &Surface) -> Self {
        let vec3 = |[x, y, z]: Vec3| Four::of([x, y, z, 0.0]);
        match *surface {
            Surface::Plane { point_m, normal } => Self::Plane {
                point_m: vec3(point_m),
                normal: {
                    let [x, y, z] = unit(normal);
                    Four::of([x, y, z, 0.0])
                },
            },
            Surface::Sphere { center_m, radius_m } => Self::Sphere {
                center_m: vec3(center_m),
                radius_m: Number::of(radius_m),
            },
            Surface::Box {
                center_m,
                half_extents_m,
            } => Self::Box {
                center_m: vec3(center_m),
                half_extents_m: vec3(half_extents_m),
            },
        }
    }

    /// Distance and normal at a position: see [`Surface::contact`].
    #[inline(always)]
    pub(crate) fn touch(&self, position_m: Four<A, Metre>) -> Touch<A> {
        match *self {
            Self::Plane { point_m, normal } => ((position_m - point_m).dot3(normal), normal),
            Self::Sphere { center_m, radius_m } => sphere(position_m - center_m, radius_m),
            Self::Box {
                center_m,
                half_extents_m,
            } => cuboid(position_m - center_m, half_extents_m),
        }
    }
}

#[inline]
fn sphere<A: Arithmetic>(r: Four<A, Metre>, radius_m: Number<A, Metre>) -> Touch<A> {
    let square = r.square();
    let polar = A::polar(square);
    let normal = if A::is_some(square) {
        r.direction(polar)
    } else {
        Four::whole([0, 0, 1, 0])
    };
    (Number::<A, Metre>(A::length(polar)) - radius_m, normal)
}

#[inline]
fn cuboid<A: Arithmetic>(r: Four<A, Metre>, half_extents_m: Four<A, Metre>) -> Touch<A> {
    let zero = Number::<A, Metre>::ZERO;
    let (r, half) = (r.xyz().map(Number), half_extents_m.xyz().map(Number));
    let below = r.map(|x: Number<A, Metre>| x < zero);
    let signed = |x: Number<A, Metre>, axis: usize| if below[axis] { -x } else { x };
    let q = [0, 1, 2].map(|axis| signed(r[axis], axis) - half[axis]);
    let outside = q.map(|x| x.max(zero));
    let away = [0, 1, 2].map(|axis| signed(outside[axis], axis).0);
    let away = Four::<A, Metre>::vec3(away);
    let square = away.square();
    let polar = A::polar(square);
    let deepest = q[2].max(q[1]).max(q[0]);
    let first = q[0] >= deepest;
    let second = !first && q[1] >= deepest;
    let face = [first, second, !first && !second];
    let normal = if A::is_some(square) {
        away.direction(polar)
    } else {
        let outward = |axis: usize| {
            let sign = if below[axis] { -1 } else { 1 };
            A::whole(if face[axis] { sign } else { 0 })
        };
        Four::vec3([0, 1, 2].map(outward))
    };
    let length_m = Number::<A, Metre>(A::length(polar));
    (length_m + deepest.min(zero), normal)
}

/// Where the stylus is relative to a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Signed distance, m: negative inside.
    pub distance_m: f32,
    /// Outward unit normal.
    pub normal: Vec3,
}

impl Surface {
    pub(crate) fn check(&self) -> Result<(), ConfigError> {
        let finite = |field, v: Vec3| match v.iter().find(|x| x.is_nan() || x.abs() > 1e4) {
            Some(&value) => Err(ConfigError {
                field,
                value,
                rule: "finite, at most 1e4",
            }),
            None => Ok(()),
        };
        let positive = |field, value: f32| {
            if value > 1e-6 && value <= 1e4 {
                Ok(())
            } else {
                Err(ConfigError {
                    field,
                    value,
                    rule: "above 1e-6, at most 1e4",
                })
            }
        };
        match *self {
            Self::Plane { point_m, normal } => {
                finite("surface.point_m", point_m)?;
                finite("surface.normal", normal)?;
                positive("surface.normal length", norm(normal))
            }
            Self::Sphere { center_m, radius_m } => {
                finite("surface.center_m", center_m)?;
                positive("surface.radius_m", radius_m)
            }
            Self::Box {
                center_m,
                half_extents_m,
            } => {
                finite("surface.center_m", center_m)?;
                half_extents_m
                    .into_iter()
                    .try_for_each(|h| positive("surface.half_extents_m", h))
            }
        }
    }

    /// With a plane's normal of unit length.
    #[must_use]
    pub(crate) fn normalised(self) -> Self {
        match self {
            Self::Plane { point_m, normal } => Self::Plane {
                point_m,
                normal: unit(normal),
            },
            other => other,
        }
    }

    /// Signed distance and normal at `position_m`, exact for the three solids. At a
    /// sphere's centre the normal is +z; inside a box it is that of the nearest
    /// face, of the first axis where two are equally near.
    #[must_use]
    pub fn contact(&self, position_m: Vec3) -> Contact {
        let (distance_m, normal) = Solid::<Float>::new(self).touch(Four::vec3(position_m));
        Contact {
            distance_m: distance_m.0,
            normal: normal.xyz(),
        }
    }
}

/// `v` at unit length, rounded once: a unit normal stays what it is.
fn unit(v: Vec3) -> Vec3 {
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
    use crate::math::sub;

    fn near(a: Vec3, b: Vec3) -> bool {
        norm(sub(a, b)) < 1e-5
    }

    #[test]
    fn a_box_is_touched_at_faces_edges_and_corners() {
        let cube = Surface::Box {
            center_m: [1.0, 0.0, 0.0],
            half_extents_m: [0.5; 3],
        };
        let inside = cube.contact([1.0, 0.45, 0.1]);
        assert!((inside.distance_m + 0.05).abs() < 1e-6);
        assert_eq!(inside.normal, [0.0, 1.0, 0.0]);
        let corner = cube.contact([1.6, 0.6, -0.6]);
        assert!((corner.distance_m - 0.1 * 3.0_f32.sqrt()).abs() < 1e-6);
        let third = 1.0 / 3.0_f32.sqrt();
        assert!(near(corner.normal, [third, third, -third]));
    }

    #[test]
    fn depth_on_a_plane_is_exact() {
        let plane = Surface::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 2.0],
        };
        let touch = plane.normalised().contact([0.01, 0.02, -2e-3]);
        assert_eq!(touch.normal, [0.0, 0.0, 1.0]);
        assert_eq!(touch.distance_m, -2e-3);
    }

    #[test]
    fn a_spheres_normal_is_radial_and_defined_at_its_centre() {
        let ball = Surface::Sphere {
            center_m: [0.0; 3],
            radius_m: 0.02,
        };
        let touch = ball.contact([0.0, -0.019, 0.0]);
        assert!((touch.distance_m + 0.001).abs() < 1e-7);
        assert!(near(touch.normal, [0.0, -1.0, 0.0]));
        assert_eq!(ball.contact([0.0; 3]).normal, [0.0, 0.0, 1.0]);
    }
}
