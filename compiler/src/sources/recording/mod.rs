//! Recordings as a source: the sensor files of a tool on a surface become a texture.
//!
//! [`asperity_recording`] reads, checks and aligns the files, and finds segments, friction and impacts. Here they
//! become a [`TextureModel`](asperity_texture::model::TextureModel). What was not recorded is completed by the
//! learned model and marked so. [`analyse()`] goes from the files to a grid, friction and impacts, and [`texture()`]
//! from there to the model; [`RecordingFolder`] does both for the [driver](crate::driver). `docs/recording.md`
//! describes what a folder holds.

mod analyse;
mod complete;
mod report;
mod sheet;
mod source;
mod texture;

pub use analyse::{Analysis, analyse, check};
pub use complete::{Completed, Nearest, complete};
pub use sheet::{HEIGHT_PX, WIDTH_PX};
pub use source::{KIND, Recorded, RecordingFolder};
pub use texture::{Parts, texture};
