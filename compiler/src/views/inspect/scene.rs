//! Display of a scene's surface.

use asperity_formats::{self as formats, SceneSurface, limits::MAX_POSITION_M};
use serde::Serialize;
use std::fmt;

/// A surface of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SurfaceDocument {
    /// Name of its texture in the library.
    pub texture: String,
    /// The solid.
    #[serde(flatten)]
    pub solid: Solid,
    /// Lower corner of the region where it can be touched, m.
    pub from_m: [f32; 3],
    /// Upper corner, m.
    pub to_m: [f32; 3],
}

/// A solid, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Solid {
    Plane {
        point_m: [f32; 3],
        normal: [f32; 3],
    },
    Sphere {
        center_m: [f32; 3],
        radius_m: f32,
    },
    Box {
        center_m: [f32; 3],
        half_extents_m: [f32; 3],
    },
}

impl SurfaceDocument {
    /// Describes a surface, given the names of the library's textures.
    #[must_use]
    pub fn of(surface: &SceneSurface, names: &[String]) -> Self {
        let name = names.get(usize::from(surface.texture));
        Self {
            texture: name.cloned().unwrap_or_default(),
            solid: match surface.solid {
                formats::Solid::Plane { point_m, normal } => Solid::Plane { point_m, normal },
                formats::Solid::Sphere { center_m, radius_m } => {
                    Solid::Sphere { center_m, radius_m }
                }
                formats::Solid::Box {
                    center_m,
                    half_extents_m,
                } => Solid::Box {
                    center_m,
                    half_extents_m,
                },
            },
            from_m: surface.from_m,
            to_m: surface.to_m,
        }
    }
}

impl fmt::Display for SurfaceDocument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.solid {
            Solid::Plane { point_m, normal } => {
                write!(f, "plane through {point_m:?} m, normal {normal:?}")
            }
            Solid::Sphere { center_m, radius_m } => {
                write!(f, "sphere around {center_m:?} m, radius {radius_m} m")
            }
            Solid::Box {
                center_m,
                half_extents_m,
            } => write!(f, "box around {center_m:?} m, half {half_extents_m:?} m"),
        }?;
        let everywhere = ([-MAX_POSITION_M; 3], [MAX_POSITION_M; 3]);
        if (self.from_m, self.to_m) != everywhere {
            write!(f, ", within {:?} to {:?} m", self.from_m, self.to_m)?;
        }
        write!(f, ": {}", self.texture)
    }
}
