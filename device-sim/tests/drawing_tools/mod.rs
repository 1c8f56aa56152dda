//! Held against what others measured: the drawing tools of Piovarči, Levin, Kaufman and Didyk (2018).
//!
//! `ASPERITY_DRAWING_TOOLS` names a copy of their repository
//! `misop/Perception-Aware-Modeling-and-Fabrication-of-Digital-Drawing-Tools`. Nothing of it is in this
//! project. Without it these tests say that they were skipped.

mod strokes;
mod trajectories;

use std::path::PathBuf;

/// The copy, or `None` after saying so.
fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("ASPERITY_DRAWING_TOOLS").map(PathBuf::from);
    if folder.is_none() {
        eprintln!("skipped: ASPERITY_DRAWING_TOOLS names no copy of the measurements");
    }
    folder
}
