//! Reading files of strangers: every file that a command reads comes through here.
//!
//! A file is opened once and read up to the limit of its [`InputKind`]. Devices, sockets and folders are
//! refused before they are opened. A pipe is read by a thread of its own, and a wait for its bytes
//! ends in an error. What is of another known format than its kind is refused by that
//! format's name. `docs/limits.md` lists every limit.

mod documents;
mod format;
mod kind;
mod lenient_json;
mod open;
mod pipe;
mod pipe_timeout;
mod problem;
mod reach;
mod read;
mod signatures;
#[cfg(test)]
mod tests;
mod xml;

pub use format::{Format, HEAD};
pub use kind::InputKind;
pub use lenient_json::{json_fault, lenient_json};
pub use open::{Opened, format_of, open, open_as};
pub use pipe_timeout::{MAX_SILENCE, MAX_WAIT};
pub use problem::{InputError, InputProblem};
pub use reach::{Outside, Reach};
pub use read::{admit, read, read_text, text, to_end};
pub use xml::{MAX_ATTRIBUTES, MAX_DEPTH, MAX_NAMESPACES, Nesting, NestingProblem, check_nesting};
