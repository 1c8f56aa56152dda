//! Monotonic time, and sleeping until a moment of it.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering::Relaxed},
};
use std::time::Duration;

/// Nanoseconds of a second.
pub const SECOND_NS: u64 = 1_000_000_000;

/// A clock that never goes back.
pub trait Clock {
    /// Time since an arbitrary start, ns.
    fn now_ns(&self) -> u64;

    /// Returns at `until_ns` or later; at once if that has passed.
    fn sleep_until(&self, until_ns: u64);
}

/// The system's monotonic clock.
///
/// On Linux it sleeps until absolute times (`clock_nanosleep` with `TIMER_ABSTIME`), so that a late
/// start of the sleep does not make its end late. On other systems it sleeps for the time that is
/// left, which no hardware has confirmed.
#[derive(Debug, Clone, Copy, Default)]
pub struct Monotonic {
    spin_ns: u64,
}

impl Monotonic {
    /// A clock that sleeps until `spin` before the end and then reads the time over and over. That
    /// hides the wake-up latency up to this length, and costs as much of a processor.
    #[must_use]
    pub fn spinning(spin: Duration) -> Self {
        Self {
            spin_ns: u64::try_from(spin.as_nanos()).unwrap_or(u64::MAX),
        }
    }

    fn spin_until(self, until_ns: u64) {
        while self.now_ns() < until_ns {
            std::hint::spin_loop();
        }
    }
}

impl Clock for Monotonic {
    #[inline]
    fn now_ns(&self) -> u64 {
        system::now_ns()
    }

    fn sleep_until(&self, until_ns: u64) {
        let sleep_ns = until_ns.saturating_sub(self.spin_ns);
        if sleep_ns > self.now_ns() {
            system::sleep_until(sleep_ns);
        }
        if self.spin_ns > 0 {
            self.spin_until(until_ns);
        }
    }
}

#[cfg(target_os = "linux")]
mod system {
    use super::SECOND_NS;
    use rustix::{
        io::Errno,
        thread::{ClockId, clock_nanosleep_absolute},
        time::{Timespec, clock_gettime},
    };

    /// Read from the kernel's shared page, without a system call where the clock source allows it.
    #[inline]
    pub(super) fn now_ns() -> u64 {
        let now = clock_gettime(ClockId::Monotonic);
        now.tv_sec as u64 * SECOND_NS + now.tv_nsec as u64
    }

    pub(super) fn sleep_until(until_ns: u64) {
        let until = Timespec {
            tv_sec: (until_ns / SECOND_NS) as _,
            tv_nsec: (until_ns % SECOND_NS) as _,
        };
        // A signal ends the sleep early; the time to wake up is still the same.
        while clock_nanosleep_absolute(ClockId::Monotonic, &until) == Err(Errno::INTR) {}
    }
}

#[cfg(not(target_os = "linux"))]
mod system {
    use std::sync::OnceLock;
    use std::time::{Duration, Instant};

    static ORIGIN: OnceLock<Instant> = OnceLock::new();

    #[inline]
    pub(super) fn now_ns() -> u64 {
        ORIGIN.get_or_init(Instant::now).elapsed().as_nanos() as u64
    }

    pub(super) fn sleep_until(until_ns: u64) {
        std::thread::sleep(Duration::from_nanos(until_ns.saturating_sub(now_ns())));
    }
}

/// A clock that moves only when told to, for tests. Its copies share one time.
#[derive(Debug, Clone, Default)]
pub struct Virtual {
    now_ns: Arc<AtomicU64>,
    /// Wake-up latency, ns.
    late_ns: Arc<AtomicU64>,
}

impl Virtual {
    /// A clock at zero.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Lets time pass, ns.
    pub fn pass(&self, ns: u64) {
        self.now_ns.fetch_add(ns, Relaxed);
    }

    /// Sets the wake-up latency of every sleep from now on, ns.
    pub fn wake_late_by(&self, ns: u64) {
        self.late_ns.store(ns, Relaxed);
    }
}

impl Clock for Virtual {
    fn now_ns(&self) -> u64 {
        self.now_ns.load(Relaxed)
    }

    fn sleep_until(&self, until_ns: u64) {
        let late_ns = self.late_ns.load(Relaxed);
        self.now_ns
            .fetch_max(until_ns.saturating_add(late_ns), Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sleep_never_ends_early() {
        for clock in [
            Monotonic::default(),
            Monotonic::spinning(Duration::from_micros(200)),
        ] {
            for wait_ns in [0, 1_000, 300_000] {
                let until_ns = clock.now_ns() + wait_ns;
                clock.sleep_until(until_ns);
                assert!(clock.now_ns() >= until_ns);
            }
            clock.sleep_until(0);
        }
    }

    /// The longest that can be asked for spins all the time.
    #[test]
    fn a_clock_spins_for_as_long_as_it_is_asked_to() {
        let spun = |spin| Monotonic::spinning(spin).spin_ns;
        assert_eq!(spun(Duration::from_micros(200)), 200_000);
        assert_eq!(spun(Duration::MAX), u64::MAX);
    }

    #[test]
    fn virtual_time_is_shared_and_passes_on_request() {
        let clock = Virtual::new();
        let other = clock.clone();
        other.pass(5);
        clock.wake_late_by(2);
        clock.sleep_until(10);
        assert_eq!(other.now_ns(), 12);
        clock.sleep_until(3);
        assert_eq!(clock.now_ns(), 12, "it never goes back");
    }
}
