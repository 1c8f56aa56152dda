//! The grip: a mass on three legs, held by a hand that homes it, then strokes and taps.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use asperity_host::device::falcon::frame::{ALL_HOMED, Command};
use asperity_host::device::falcon::geometry::{CENTRE_M, count};
use asperity_host::device::falcon::kinematics::{Jacobian, inverse, jacobian};
use asperity_host::device::falcon::motors;

/// Steps of integration in a millisecond.
const STEP_S: f64 = 1.0 / 16_000.0;
/// Made up: a light grip with the hand's mass, and the damping that such a mechanism may have.
const MASS_KG: f64 = 0.3;
const DAMPING_N_S_M: f64 = 0.5;
/// Stiffness of the hand, N/m.
const HAND_N_M: f64 = 200.0;
const HAND_N_S_M: f64 = 8.0;
/// Grip position, 15 mm out, at which each thigh passes its encoder's index.
const INDEX_M: [f64; 3] = [CENTRE_M[0], CENTRE_M[1], CENTRE_M[2] + 0.015];
/// Travel of the grip to the end stops each way, m.
const STOP_M: f64 = 0.028;
/// Answers remembered; more than a computer may miss and still push.
pub const TOLD: usize = 32;

/// Statistics of motor commands and of the resulting forces.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotorStats {
    /// Commands.
    pub commands: u64,
    /// Largest magnitude of a motor's command, counts.
    pub largest_count: i16,
    /// Largest change of a motor's command, counts, but for the first after plugging in.
    pub largest_step: i32,
    /// First commands after plugging in that had a force. What the motors do while the computer is
    /// away is not known, so the first must have none.
    pub pushes_at_first: u64,
    /// Largest force at the grip, N.
    pub largest_force_n: f64,
    /// Largest force of a command where the grip was at one of the last [`TOLD`] answers, N. A
    /// computer knows no newer place: what `largest_force_n` is above this, the grip's way since
    /// then made.
    pub largest_meant_n: f64,
    /// Commands with a force while an encoder had not found its zero.
    pub unhomed_forces: u64,
    /// Time with a force, s.
    pub pushed_s: f64,
}

/// The grip and its hand.
#[derive(Debug, Clone)]
pub struct Grip {
    position_m: [f64; 3],
    velocity_m_s: [f64; 3],
    motors: [i16; 3],
    homing: bool,
    /// True until the first command after plugging in.
    first: bool,
    /// Encoder offsets until the index is passed, counts.
    offsets: [i16; 3],
    homed: u8,
    before: [f64; 3],
    index: [f64; 3],
    time_s: f64,
    /// True if the hand runs its script; otherwise it holds still.
    pub busy: bool,
    stats: MotorStats,
    /// Legs where the grip was at the last commands, each of which was answered.
    told: VecDeque<Jacobian>,
}

impl Grip {
    pub(super) fn new() -> Self {
        let angles = inverse(CENTRE_M).unwrap_or_default();
        let mut grip = Self {
            position_m: [0.0; 3],
            velocity_m_s: [0.0; 3],
            motors: [0; 3],
            homing: false,
            first: true,
            offsets: [0; 3],
            homed: 0,
            before: angles,
            index: inverse(INDEX_M).unwrap_or_default(),
            time_s: 0.0,
            busy: true,
            stats: MotorStats::default(),
            told: VecDeque::with_capacity(TOLD + 1),
        };
        grip.forget_zeros();
        grip
    }

    /// Returns the statistics so far.
    #[must_use]
    pub fn motor_stats(&self) -> MotorStats {
        self.stats
    }

    /// The last command to the motors, counts.
    #[must_use]
    pub fn motors(&self) -> [i16; 3] {
        self.motors
    }

    /// Position from the middle of the workspace, m.
    #[must_use]
    pub fn position_m(&self) -> [f64; 3] {
        self.position_m
    }

    /// Encoders count from where they are; the hand homes them again.
    pub(super) fn forget_zeros(&mut self) {
        self.offsets = self.before.map(count);
        self.homed = 0;
        self.motors = [0; 3];
        self.time_s = 0.0;
    }

    pub(super) fn plugged_in(&mut self) {
        self.first = true;
    }

    pub(super) fn command(&mut self, command: &Command) {
        let stats = &mut self.stats;
        stats.commands += 1;
        for (new, old) in command.motors.into_iter().zip(self.motors) {
            stats.largest_count = stats.largest_count.max(new.saturating_abs());
            let step = (i32::from(new) - i32::from(old)).abs();
            if !self.first {
                stats.largest_step = stats.largest_step.max(step);
            }
        }
        stats.pushes_at_first += u64::from(self.first && command.motors != [0; 3]);
        self.first = false;
        if self.homed != ALL_HOMED && command.motors != [0; 3] {
            stats.unhomed_forces += 1;
        }
        self.motors = command.motors;
        self.homing = command.homing;
        let Some(rows) = self.legs() else {
            return;
        };
        self.told.push_front(rows);
        self.told.truncate(TOLD);
        let size_n = |rows: &Jacobian| {
            let [x, y, z] = motors::force_n(command.motors, rows);
            (x * x + y * y + z * z).sqrt()
        };
        let stats = &mut self.stats;
        stats.largest_force_n = stats.largest_force_n.max(size_n(&rows));
        let meant_n = self.told.iter().map(size_n).fold(f64::INFINITY, f64::min);
        stats.largest_meant_n = stats.largest_meant_n.max(meant_n);
    }

    pub(super) fn encoders(&self) -> [i16; 3] {
        std::array::from_fn(|n| count(self.before[n]).wrapping_sub(self.offsets[n]))
    }

    pub(super) fn homed(&self) -> u8 {
        self.homed
    }

    /// Force of the motors at the grip, N.
    fn force_n(&self) -> [f64; 3] {
        self.legs()
            .map_or([0.0; 3], |rows| motors::force_n(self.motors, &rows))
    }

    fn legs(&self) -> Option<Jacobian> {
        let position = self.in_device();
        inverse(position).and_then(|angles| jacobian(position, angles))
    }

    fn in_device(&self) -> [f64; 3] {
        std::array::from_fn(|n| CENTRE_M[n] + self.position_m[n])
    }

    /// Lets time pass.
    pub(super) fn advance(&mut self, seconds: f64) {
        let steps = (seconds / STEP_S).round().max(1.0) as u32;
        let step_s = seconds / f64::from(steps);
        // The legs turn little in a millisecond.
        let force_n = self.force_n();
        for _ in 0..steps {
            self.time_s += step_s;
            let (target_m, target_m_s) = self.target();
            for n in 0..3 {
                // Backward Euler: it only takes energy away, however long a step is.
                let pull_n = force_n[n]
                    + HAND_N_M * (target_m[n] - self.position_m[n])
                    + HAND_N_S_M * target_m_s[n];
                let inertia =
                    MASS_KG + step_s * (DAMPING_N_S_M + HAND_N_S_M) + step_s * step_s * HAND_N_M;
                let momentum = MASS_KG * self.velocity_m_s[n] + step_s * pull_n;
                self.velocity_m_s[n] = momentum / inertia;
                self.position_m[n] += step_s * self.velocity_m_s[n];
                if self.position_m[n].abs() > STOP_M {
                    self.position_m[n] = self.position_m[n].clamp(-STOP_M, STOP_M);
                    self.velocity_m_s[n] = 0.0;
                }
            }
        }
        if force_n != [0.0; 3] {
            self.stats.pushed_s += seconds;
        }
        self.find_zeros();
    }

    fn find_zeros(&mut self) {
        let Some(angles) = inverse(self.in_device()) else {
            return;
        };
        for (n, angle) in angles.into_iter().enumerate() {
            let passed = (self.before[n] - self.index[n]) * (angle - self.index[n]) <= 0.0;
            if passed && self.homing {
                self.offsets[n] = 0;
                self.homed |= 1 << n;
            }
        }
        self.before = angles;
    }

    /// Where the hand wants the grip, from the middle of the workspace, m, and how fast, m/s.
    /// For a second it pulls out and pushes in, then strokes in circles and taps.
    fn target(&self) -> ([f64; 3], [f64; 3]) {
        let t = self.time_s;
        if !self.busy {
            return ([0.0; 3], [0.0; 3]);
        }
        if t < 1.0 {
            let (sin, cos) = (libm::sin(TAU * t), libm::cos(TAU * t));
            return ([0.0, 0.0, 0.026 * sin], [0.0, 0.0, 0.026 * TAU * cos]);
        }
        let wave = |metres: f64, hertz: f64, phase: f64| {
            let angle = TAU * (hertz * (t - 1.0) + phase);
            let fast = TAU * hertz * metres;
            (metres * libm::sin(angle), fast * libm::cos(angle))
        };
        let (x, vx) = wave(0.015, 0.8, 0.0);
        let (y, vy) = wave(0.015, 0.8, 0.25);
        let (z, vz) = wave(0.006, 1.7, 0.0);
        ([x, y, z], [vx, vy, vz])
    }
}
