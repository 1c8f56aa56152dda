//! Compiles a scene into a library that holds no more than the scene needs: the textures that its
//! surfaces wear, each once. They are those of a manifest, or, within a budget of instructions and
//! bytes, each at the fidelity that the budget allows. `docs/scenes.md` describes the file.
//!
//! [`Description`] reads and checks a scene, [`build()`] compiles it:
//!
//! ```
//! use asperity::{scene::Description, sources::Registry};
//! use asperity_io::input::Reach;
//! use std::path::Path;
//!
//! let text = r#"
//!     [[texture]]
//!     name = "cork"
//!     prompt = "cork"
//!     [[surface]]
//!     texture = "cork"
//!     sphere = { center_m = [0, 0, 0], radius_m = 0.1 }
//! "#;
//! let scene = Description::within(Path::new("desk.toml"), text, Reach::Anywhere, &Registry::default());
//! let scene = scene.expect("a valid scene");
//! assert_eq!((scene.surfaces.len(), scene.worn()), (1, vec![0]));
//! ```

mod budget;
mod build;
mod cost;
mod counted;
mod description;
mod fidelity;
mod report;
mod target;

pub use budget::{Budget, DEFAULT_SHARE};
pub use build::{Built, build};
pub use cost::Surfaces;
pub use description::{Description, SurfaceEntry};
pub use report::{Report, TextureCost};
pub use target::Target;
