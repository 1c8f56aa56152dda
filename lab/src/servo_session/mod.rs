//! A servo loop on a texture or a scene, on a device or a simulated one.
//!
//! | file | holds |
//! |---|---|
//! | `surface` | what is touched, read from a file |
//! | `open` | devices by name, `sim:` among them |
//! | `opened` | an open device, and what the runtime must know of it |
//! | `replay` | a recording as a device: its conditions, and whether forces repeat |
//! | `run` | one run of the loop on its thread |
//! | `real_surface` | one that renders nothing: the tool touches a real surface |
//! | `recorder` | every tick into a file, on a thread of its own |
//! | `trace` | every tick as a row of CSV |

mod error;
mod open;
mod opened;
mod real_surface;
mod recorder;
mod replay;
mod run;
mod surface;
mod trace;

pub use error::ServoSessionError;
pub use open::open;
pub use opened::{OpenDevice, Repeated, Replayed};
pub use real_surface::run_passive;
pub use recorder::{Form, Recorder, Written};
pub use run::{Attended, Setup, run};
pub use surface::Surface;
pub use trace::{COLUMNS, Trace};
