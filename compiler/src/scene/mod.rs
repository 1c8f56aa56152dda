//! A scene into a library that holds no more than the scene needs: the textures that its
//! surfaces wear, each once. They are those of a manifest, or, within a budget of instructions and
//! bytes, each at the fidelity that the budget allows.

mod budget;
mod build;
mod cost;
mod counted;
mod description;
mod error;
mod fidelity;
mod report;
mod target;

pub use budget::{Budget, DEFAULT_SHARE};
pub use build::{Built, build};
pub use cost::Surfaces;
pub use description::{Description, SurfaceEntry};
pub use error::{SceneError, SceneProblem};
pub use report::{Report, Row};
pub use target::Target;
