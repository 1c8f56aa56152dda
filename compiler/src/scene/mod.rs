//! A scene into a library that holds no more than the scene needs: the textures that its
//! surfaces wear, each once, at the fidelity that a budget of instructions and bytes allows.

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
pub use build::{Built, Prompter, build};
pub use cost::Surfaces;
pub use description::{Description, Origin, SurfaceEntry, TextureEntry};
pub use error::{SceneError, SceneProblem};
pub use report::{Report, Row};
pub use target::Target;
