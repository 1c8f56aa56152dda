//! The time that passes, for those who work without a clock of their own.

use std::time::Duration;

/// Time since this was first asked for. A module of WebAssembly has no clock, so that no time passes there.
#[must_use]
pub fn now() -> Duration {
    #[cfg(target_family = "wasm")]
    return Duration::ZERO;
    #[cfg(not(target_family = "wasm"))]
    elapsed()
}

#[cfg(not(target_family = "wasm"))]
fn elapsed() -> Duration {
    use std::{sync::LazyLock, time::Instant};

    static FIRST: LazyLock<Instant> = LazyLock::new(Instant::now);
    FIRST.elapsed()
}
