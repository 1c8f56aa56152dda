//! The time that passes, for those who work without a clock of their own.

use std::{
    sync::LazyLock,
    time::{Duration, Instant},
};

/// Time since this was first asked for.
#[must_use]
pub fn now() -> Duration {
    static FIRST: LazyLock<Instant> = LazyLock::new(Instant::now);
    FIRST.elapsed()
}
