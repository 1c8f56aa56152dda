//! Contact with a plane, a sphere or a box: signed distance and outward normal.

use crate::{
    config::ConfigError,
    lanes::F4,
    math::{Vec3, dot, max, min, norm, rsqrt, scale, sqrt_with, sub},
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
    #[inline]
    #[must_use]
    pub fn contact(&self, position_m: Vec3) -> Contact {
        let (distance_m, normal) = self.touch(F4::vec3(position_m));
        Contact {
            distance_m,
            normal: normal.xyz(),
        }
    }

    /// [`Surface::contact`] on lanes: distance, m, and normal.
    #[inline(always)]
    pub(crate) fn touch(&self, position_m: F4) -> (f32, F4) {
        if let Self::Plane { point_m, normal } = *self {
            let normal = F4::vec3(normal);
            return ((position_m - F4::vec3(point_m)).dot3(normal), normal);
        }
        let contact = self.curved(position_m.xyz());
        (contact.distance_m, F4::vec3(contact.normal))
    }

    /// The solids that are not flat.
    fn curved(&self, position_m: Vec3) -> Contact {
        match *self {
            Self::Plane { point_m, normal } => Contact {
                distance_m: dot(sub(position_m, point_m), normal),
                normal,
            },
            Self::Sphere { center_m, radius_m } => {
                let r = sub(position_m, center_m);
                let squared = dot(r, r);
                let inverse = rsqrt(squared);
                Contact {
                    distance_m: sqrt_with(squared, inverse) - radius_m,
                    normal: if squared > 1e-18 {
                        scale(r, inverse)
                    } else {
                        [0.0, 0.0, 1.0]
                    },
                }
            }
            Self::Box {
                center_m,
                half_extents_m,
            } => box_contact(sub(position_m, center_m), half_extents_m),
        }
    }
}

/// `v` at unit length, rounded once: a unit normal stays what it is.
fn unit(v: Vec3) -> Vec3 {
    let v = v.map(f64::from);
    let squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    // The guess is good to 5e-7; one Newton step squares that.
    let guess = f64::from(rsqrt(squared as f32));
    let inverse = guess * (1.5 - 0.5 * squared * guess * guess);
    v.map(|x| (x * inverse) as f32)
}

fn box_contact(r: Vec3, half: Vec3) -> Contact {
    let sign = r.map(|x| if x < 0.0 { -1.0 } else { 1.0 });
    let q = [
        r[0] * sign[0] - half[0],
        r[1] * sign[1] - half[1],
        r[2] * sign[2] - half[2],
    ];
    let outside = q.map(|x| max(x, 0.0));
    let squared = dot(outside, outside);
    let inverse = rsqrt(squared);
    let deepest = max(max(q[2], q[1]), q[0]);
    let face = if q[0] >= deepest {
        [sign[0], 0.0, 0.0]
    } else if q[1] >= deepest {
        [0.0, sign[1], 0.0]
    } else {
        [0.0, 0.0, sign[2]]
    };
    let away = [
        outside[0] * sign[0],
        outside[1] * sign[1],
        outside[2] * sign[2],
    ];
    let is_outside = squared > 1e-18;
    Contact {
        distance_m: sqrt_with(squared, inverse) + min(deepest, 0.0),
        normal: if is_outside {
            scale(away, inverse)
        } else {
            face
        },
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
mod tests {
    extern crate std;
    use super::*;

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
