//! Pictures: the map of stable walls, and the worst waveforms.

mod layout;
mod wall_map;
mod waveforms;

pub use wall_map::wall_map;
pub use waveforms::waveforms;
