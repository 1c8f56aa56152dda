//! Time-outs of a pipe.

use std::time::Duration;

/// Longest time that a pipe may give nothing.
pub const MAX_SILENCE: Duration = Duration::from_millis(1500);
/// Longest time that all waits for a pipe may take together.
pub const MAX_WAIT: Duration = Duration::from_secs(30);
