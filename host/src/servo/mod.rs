//! The servo loop: a thread of its own that reads a device, renders, and writes the force, once a
//! period.
//!
//! | file | holds |
//! |---|---|
//! | `periods` | the loop, generic over device, renderer, clock and observer |
//! | `deadlines` | due times without drift, and missed periods |
//! | `clock` | the system's monotonic clock, and a virtual one |
//! | `pace` | how many periods lie between two readings |
//! | `last_reading` | what the supervised device said, for the records |
//! | `recovery` | when a device that fails is asked to recover |
//! | `event` | what is reported once: faults, their end, recoveries that failed |
//! | `render` | the runtime behind one trait: a texture, an exchange of textures, a scene |
//! | `record`, `times` | what a tick leaves behind |
//! | `record_writer` | records and events to another thread |
//! | `privileges` | real-time policy, locked memory, a processor of its own |
//! | `thread` | all of it on a thread |
//!
//! Faults are the matter of [`Supervised`](crate::device::supervised::Supervised), through which the
//! loop reads and writes its device.
//!
//! What must stay absent from the loop: allocation, locks, printing, files, and waiting for anyone
//! but the clock and the device. `tests/no_alloc.rs` runs it under an allocator that counts.

mod clock;
mod deadlines;
mod event;
mod last_reading;
mod pace;
mod periods;
pub mod privileges;
mod record;
mod record_queue;
mod recovery;
mod render;
mod report;
mod settings;
mod thread;
mod times;

pub use clock::{Clock, Monotonic, SECOND_NS, Virtual};
pub use deadlines::Schedule;
pub use event::Event;
pub use pace::Pace;
pub use periods::ServoLoop;
pub use record::{Observer, Record};
pub use record_queue::{RecordReader, RecordWriter, queues};
pub use render::{Render, SceneRender, SingleTexture, SwappableTexture};
pub use report::{End, Report};
pub use settings::{Overrun, RATES_HZ, Settings, SettingsError};
pub use thread::{Servo, Start};
pub use times::{Stage, Times};
