//! State shared by the scheduler's thread and the servo thread.
//!
//! Neither waits for the other. If the servo thread stops commanding forces, the scheduler's thread
//! ramps the force to zero: a servo loop that hangs or dies leaves no force behind.

use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering::Relaxed};

use asperity_runtime::math::norm;

use super::snapshot::Snapshot;

/// Periods without a new command after which the force goes to zero.
const PATIENCE: u32 = 10;
/// The largest change of force in a period while it goes to zero, or comes back, N.
const RELEASE_STEP_N: f32 = 0.25;

/// Measurement of a device, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Measured {
    /// Number of the measurement.
    pub(super) number: u32,
    /// Position, m.
    pub(super) position_m: [f32; 3],
    /// Held buttons.
    pub(super) buttons: u32,
}

/// State shared by both threads.
#[derive(Debug, Default)]
pub(super) struct Scheduled {
    measured: Snapshot<4>,
    wanted: Snapshot<3>,
    /// An error code, with a bit above it that says that there is one.
    fault: AtomicU64,
    stopping: AtomicBool,
    /// Periods so far.
    periods: AtomicU32,

    // Of the scheduler's thread alone.
    commands_seen: AtomicU32,
    periods_without: AtomicU32,
    releasing: AtomicBool,
    held: [AtomicU32; 3],
}

impl Scheduled {
    /// Commands a force in the device's frame, N. Servo thread.
    pub(super) fn command(&self, force_n: [f32; 3]) {
        // The runtime gives no such force. Nobody else's may reach an arm.
        let finite = force_n.iter().all(|x| x.is_finite());
        let force_n = if finite { force_n } else { [0.0; 3] };
        self.wanted.publish(force_n.map(f32::to_bits));
    }

    /// The newest measurement; `None` before the first. Servo thread.
    pub(super) fn newest(&self) -> Option<Measured> {
        let (number, [x, y, z, buttons]) = self.measured.newest()?;
        Some(Measured {
            number,
            position_m: [x, y, z].map(f32::from_bits),
            buttons,
        })
    }

    /// Takes the error of the last periods, if there was one. Servo thread.
    pub(super) fn take_fault(&self) -> Option<u32> {
        let fault = self.fault.swap(0, Relaxed);
        (fault != 0).then_some(fault as u32)
    }

    /// From now on the force goes to zero, whatever is commanded.
    pub(super) fn stop(&self) {
        self.stopping.store(true, Relaxed);
    }

    /// Returns true if no force is held.
    pub(super) fn is_released(&self) -> bool {
        self.held().iter().all(|&x| x == 0.0)
    }

    /// Periods so far, modulo 2³².
    pub(super) fn periods(&self) -> u32 {
        self.periods.load(Relaxed)
    }

    fn held(&self) -> [f32; 3] {
        [0, 1, 2].map(|axis| f32::from_bits(self.held[axis].load(Relaxed)))
    }

    /// The force of this period, N. Scheduler's thread, once a period.
    pub(super) fn force_n(&self) -> [f64; 3] {
        let (number, wanted) = self.wanted.newest().unwrap_or((0, [0; 3]));
        let without = if number == self.commands_seen.swap(number, Relaxed) {
            self.periods_without.load(Relaxed).saturating_add(1)
        } else {
            0
        };
        self.periods_without.store(without, Relaxed);
        let alone = self.stopping.load(Relaxed) || without > PATIENCE;
        let releasing = alone || self.releasing.load(Relaxed);
        let target = if alone {
            [0.0; 3]
        } else {
            wanted.map(f32::from_bits)
        };
        let held = if releasing {
            toward(self.held(), target)
        } else {
            target
        };
        self.releasing
            .store(alone || (releasing && held != target), Relaxed);
        for (axis, value) in held.into_iter().enumerate() {
            self.held[axis].store(value.to_bits(), Relaxed);
        }
        held.map(f64::from)
    }

    /// A good period. Scheduler's thread.
    pub(super) fn measured(&self, position_mm: [f64; 3], buttons: u32) {
        let [x, y, z] = position_mm.map(|mm| ((mm * 1e-3) as f32).to_bits());
        self.measured.publish([x, y, z, buttons]);
        self.periods.fetch_add(1, Relaxed);
    }

    /// A period with an error. Scheduler's thread.
    pub(super) fn failed(&self, code: u32) {
        self.fault.store(u64::from(code) | 1 << 32, Relaxed);
        self.periods.fetch_add(1, Relaxed);
    }
}

/// Steps from one force towards another, by at most [`RELEASE_STEP_N`].
fn toward(from: [f32; 3], to: [f32; 3]) -> [f32; 3] {
    let way: [f32; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
    let length = norm(way);
    if length <= RELEASE_STEP_N {
        return to;
    }
    let share = RELEASE_STEP_N / length;
    std::array::from_fn(|axis| from[axis] + share * way[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(v: [f64; 3]) -> f64 {
        v.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    #[test]
    fn a_servo_loop_that_hangs_leaves_no_force_behind_and_comes_back_by_small_steps() {
        let shared = Scheduled::default();
        shared.command([3.0, 0.0, 0.0]);
        assert_eq!(
            shared.force_n(),
            [3.0, 0.0, 0.0],
            "a command is passed on whole"
        );
        let mut last = 3.0;
        for _ in 0..PATIENCE {
            assert_eq!(length(shared.force_n()), 3.0, "a late command is forgiven");
        }
        let mut periods = 0;
        while !shared.is_released() {
            let now = length(shared.force_n());
            assert!(last - now <= f64::from(RELEASE_STEP_N) + 1e-6);
            last = now;
            periods += 1;
        }
        assert_eq!(periods, 12, "3 N by steps of 0.25 N");
        for n in 0..12 {
            shared.command([0.0, 3.0, 0.0]);
            let now = shared.force_n();
            assert!((now[1] - 0.25 * f64::from(n + 1)).abs() < 1e-6, "{now:?}");
        }
        shared.command([0.0, -3.0, 0.0]);
        assert_eq!(shared.force_n()[1], -3.0, "the watch is over");
    }

    #[test]
    fn stopping_wins_over_any_command() {
        let shared = Scheduled::default();
        shared.command([0.0, 0.0, 1.0]);
        shared.force_n();
        shared.stop();
        for _ in 0..4 {
            shared.command([0.0, 0.0, 1.0]);
            shared.force_n();
        }
        assert!(shared.is_released());
    }

    #[test]
    fn a_force_that_is_not_finite_never_reaches_the_device() {
        let shared = Scheduled::default();
        for bad in [f32::NAN, f32::INFINITY] {
            shared.command([1.0, 0.0, 0.0]);
            assert_eq!(shared.force_n(), [1.0, 0.0, 0.0]);
            shared.command([0.0, bad, 1.0]);
            assert_eq!(shared.force_n(), [0.0; 3]);
        }
    }

    #[test]
    fn an_error_is_taken_once() {
        let shared = Scheduled::default();
        shared.failed(0);
        assert_eq!(shared.take_fault(), Some(0));
        assert_eq!(shared.take_fault(), None);
    }
}
