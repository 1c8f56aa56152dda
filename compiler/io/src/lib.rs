//! Files of a command, and what it says of them.
//!
//! [`input`] reads files of strangers within bounds, and [`table`] the tables in them; [`output`] writes
//! whole files or none, and a [`diagnostic`] says what is wrong and what to do about it; [`system`] knows
//! the remedy where a limit of the system is the cause, and [`realtime`] knows the settings that decide how
//! punctual a loop is. A [`clock`] is passed to whoever has none. Text from outside is made fit for a
//! terminal by [`shown`] and [`toml_error`].
#![forbid(unsafe_code)]

pub mod clock;
pub mod diagnostic;
pub mod input;
pub mod output;
pub mod realtime;
pub mod shown;
pub mod system;
pub mod table;
pub mod toml_error;
