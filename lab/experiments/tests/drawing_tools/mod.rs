//! Held against what others measured: the drawing tools of Piovarči, Levin, Kaufman and Didyk (2018).
//!
//! `ASPERITY_DRAWING_TOOLS` names a copy of their repository
//! `misop/Perception-Aware-Modeling-and-Fabrication-of-Digital-Drawing-Tools`. Nothing of it is in this
//! project, so these tests run only when they are asked for: `-- --ignored`.

mod strokes;
mod trajectories;

use std::path::PathBuf;

/// The copy.
fn folder() -> PathBuf {
    let folder = std::env::var_os("ASPERITY_DRAWING_TOOLS").map(PathBuf::from);
    folder.expect("ASPERITY_DRAWING_TOOLS names a copy of the measurements")
}
