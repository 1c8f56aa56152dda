//! A servo loop on a texture or a scene, on a device or a simulated one.
//!
//! | file | holds |
//! |---|---|
//! | `surface` | what is touched, read from a file |
//! | `open` | devices by name, `sim:` among them |
//! | `opened` | an open device, and what the runtime must know of it |
//! | `sim_device` | the simulated device and hand behind the host's trait |
//! | `replay` | a recording as a device: its conditions, and whether forces repeat |
//! | `run` | one run of the loop on its thread |
//! | `unfelt` | one that renders nothing: the tool touches a real surface |
//! | `recorder` | every tick into a file, on a thread of its own |
//! | `trace` | every tick as a row of CSV |

mod error;
mod open;
mod opened;
mod recorder;
mod replay;
mod run;
mod sim_device;
mod surface;
mod trace;
mod unfelt;

pub use error::DeskError;
pub use open::open;
pub use opened::{Desk, Repeated, Replayed};
pub use recorder::{Form, Recorder, Written};
pub use run::{Attended, Setup, run};
pub use sim_device::{Hands, Pace, SimDevice};
pub use surface::Surface;
pub use trace::{COLUMNS, Trace};
pub use unfelt::run_unfelt;
