//! A recording of a surface: a device tells where the tool is, an accelerometer what it feels, and a
//! person is led through speeds and forces until the grid is covered.
//!
//! | file | holds |
//! |---|---|
//! | `sensor` | sensors by name: `serial:`, `wav:`, `sim:` |
//! | `columns` | what the columns of a sensor mean |
//! | `line` | the line protocol |
//! | `serial` | a serial port or a pipe (Unix) |
//! | `wav` | a WAV file that another program is writing |
//! | `simulated` | an accelerometer of known response, noise and delay on a simulated device |
//! | `source`, `samples`, `reader` | a sensor behind one trait, read on a thread of its own |
//! | `stamps` | time stamps as they come: wraps, and clocks that start anew |
//! | `clock` | from a sensor's own clock to the servo loop's |
//! | `coverage` | the grid of forces and speeds |
//! | `exploration` | air, taps and steady strokes, as they happen |
//! | `take` | everything of a recording, in memory |
//! | `folder` | the recording as a folder |

mod clock;
mod columns;
mod coverage;
mod error;
mod exploration;
mod folder;
mod line;
mod reader;
mod samples;
mod sensor;
#[cfg(unix)]
mod serial;
mod simulated;
mod source;
mod stamps;
mod take;
mod wav;

pub use clock::{ClockLine, line_under};
pub use columns::{Channel, Column, Layout};
pub use coverage::{Coverage, GridError};
pub use error::SensorError;
pub use exploration::{Exploration, NextStep, Now, Plan, TAPS_M_S};
pub use folder::{About, FILES, Part, part, write};
pub use line::LineDecoder;
pub use reader::{Batch, Reader, SensorDescription};
pub use samples::{Counts, Samples};
pub use sensor::{Sensor, SensorKind};
#[cfg(unix)]
pub use serial::Serial;
pub use simulated::Simulated;
pub use source::{LineSource, Port, Sent, Source};
pub use take::{Load, Take, Touch};
pub use wav::{Full, Wav};
