//! Solids that a stylus touches.

/// A solid in the world frame; the texture is the same everywhere on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// A half-space.
    Plane {
        /// A point of the plane, m.
        point_m: [f32; 3],
        /// Outward normal, any length above 1e-6.
        normal: [f32; 3],
    },
    /// A ball, touched from outside.
    Sphere {
        /// Centre, m.
        center_m: [f32; 3],
        /// Radius, m, above 1e-6.
        radius_m: f32,
    },
    /// A box along the world's axes, touched from outside.
    Box {
        /// Centre, m.
        center_m: [f32; 3],
        /// Half the edge lengths, m, above 1e-6.
        half_extents_m: [f32; 3],
    },
}
