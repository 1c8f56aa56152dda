//! The intermediate model: one texture in f64 and SI units, and what follows from it alone.
//!
//! Every source ends here, and all that emits or shows a texture starts here.

pub mod attributes;
pub mod defaults;
mod friction_law;
pub mod mesh;
pub mod mixture;
pub mod shift;
pub mod tap_synthesis;
mod texture;
pub mod triangulate;

pub use friction_law::{FrictionLaw, LawPoint};
pub use texture::{
    Friction, FrictionAnchor, Gains, GridVertex, ModelGrid, Numerator, Provenance, TapBank,
    TapTrace, TextureModel, VertexKind, Wall,
};
