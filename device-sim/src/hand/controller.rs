//! The hand at work: it turns its script into one intent each tick.

use super::grip::Grip;
use super::intent::Intent;
use super::motion::Motion;
use super::path::{StrokePath, TapPath, min_jerk, scrub_m};
use super::script::Script;
use crate::axis::{AxisParams, AxisState};

/// Height from which the hand approaches the surface slowly, m.
const FEELER_M: f64 = 0.001;
/// Speed of that approach, m/s; slower than any tap.
const LANDING_M_S: f64 = 0.008;
/// Time of the descent to that height, s.
const DESCENT_S: f64 = 0.2;
/// Force at which the hand notices that it has landed, N.
const NOTICED_N: f64 = 0.05;
/// Depth at which the hand stops looking for a surface and goes on with its script, m.
const DEEPEST_M: f64 = 0.02;
/// Time over which the wanted force changes between motions, s.
const FORCE_RAMP_S: f64 = 0.15;
/// Time constant of what the hand feels, s.
const FELT_TIME_S: f64 = 0.02;
/// Errors of force that the hand does not correct, N.
const FORCE_DEAD_BAND_N: f64 = 0.02;
/// Felt force above which the hand learns the compliance of the surface, N.
const LEARNING_N: f64 = 0.2;
/// Time constant of that learning, s.
const LEARNING_S: f64 = 0.05;
/// Largest compliance that the hand can learn, m/N.
const SOFTEST_M_N: f64 = 0.01;
/// Largest correction that the hand adds, N.
const CORRECTION_N: f64 = 1.5;
/// Force of the grip's spring at the deepest intended point of a tap, N.
const TAP_FORCE_N: f64 = 1.0;

/// Phase of height control within the current motion.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// Through the air down to the feeler height.
    Descent { from_m: f64 },
    /// Slowly down until the hand feels a force.
    Landing,
    /// In contact, while the wanted force changes.
    Settle { from_n: f64 },
    /// The motion itself.
    Body,
}

/// A hand that works through a script.
#[derive(Debug, Clone)]
pub struct Hand {
    grip: Grip,
    script: Script,
    index: usize,
    stage: Stage,
    stage_s: f64,
    /// Intended position at the start of the motion, m.
    origin_m: [f64; 3],
    target_m: [f64; 3],
    felt_n: f64,
    /// Compliance of the surface, as learned, m/N.
    compliance_m_n: f64,
    /// Normal force with which a motion of changing force began, N.
    from_n: f64,
    holding: Option<Holding>,
}

/// A normal force being held.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Holding {
    wanted_n: f64,
    correction_n: f64,
}

impl Hand {
    /// A hand that starts at rest at `start_m`.
    #[must_use]
    pub fn new(grip: Grip, script: Script, start_m: [f64; 3]) -> Self {
        let mut hand = Self {
            grip,
            script,
            index: 0,
            stage: Stage::Body,
            stage_s: 0.0,
            origin_m: start_m,
            target_m: start_m,
            felt_n: 0.0,
            compliance_m_n: 0.0,
            from_n: 0.0,
            holding: None,
        };
        hand.begin();
        hand
    }

    /// The grip.
    #[must_use]
    pub fn grip(&self) -> &Grip {
        &self.grip
    }

    /// The script.
    #[must_use]
    pub fn script(&self) -> &Script {
        &self.script
    }

    /// Plans the next tick, which lasts `tick_s`; `None` once the script has ended.
    ///
    /// The hand knows the stylus's height, its mechanics with the hand's own mass, and the force
    /// that the device exerts on it along +z.
    pub fn plan(
        &mut self,
        tick_s: f64,
        stylus_z: &AxisState,
        axes: &[AxisParams; 3],
        device_force_z_n: f64,
    ) -> Option<Intent> {
        self.felt_n += (device_force_z_n - self.felt_n) * (tick_s / FELT_TIME_S).min(1.0);
        let motion = self.current(stylus_z)?;
        let now = self.path(&motion, 0.0);
        let next = self.path(&motion, tick_s);
        let after = self.path(&motion, 2.0 * tick_s);
        let mut intent = Intent {
            target_m: now,
            target_m_s: std::array::from_fn(|i| (next[i] - now[i]) / tick_s),
            feed_forward_n: std::array::from_fn(|i| {
                let speed_m_s = (next[i] - now[i]) / tick_s;
                let accel_m_s2 = (after[i] - 2.0 * next[i] + now[i]) / (tick_s * tick_s);
                known_force_n(&axes[i], speed_m_s, accel_m_s2)
            }),
            wanted_n: None,
            motion: self.index,
            in_body: self.stage == Stage::Body,
        };
        if holds_force(&motion) && matches!(self.stage, Stage::Settle { .. } | Stage::Body) {
            let wanted_n = self.wanted_n(&motion);
            intent.target_m[2] = self.hold(wanted_n, tick_s, stylus_z.position_m);
            intent.target_m_s[2] = 0.0;
            intent.feed_forward_n[2] = 0.0;
            intent.wanted_n = Some(wanted_n);
        } else if matches!(motion, Motion::Tap { .. }) && now[2] < 0.0 {
            // Below the surface the grip's spring alone acts against the wall.
            intent.feed_forward_n[2] = 0.0;
        }
        self.target_m = intent.target_m;
        self.stage_s += tick_s;
        Some(intent)
    }

    /// Advances to the stage and the motion that are due, and returns the motion.
    fn current(&mut self, stylus_z: &AxisState) -> Option<Motion> {
        loop {
            let motion = *self.script.motions().get(self.index)?;
            let next = match self.stage {
                Stage::Descent { .. } if self.stage_s >= DESCENT_S => Stage::Landing,
                Stage::Landing if self.felt_n > NOTICED_N || stylus_z.position_m < -DEEPEST_M => {
                    // The correction starts so that the target does not jump.
                    let free_n = self.grip.stiffness_n_m
                        * (-self.target_m[2] - self.felt_n * self.compliance_m_n)
                        - self.felt_n;
                    self.holding = Some(Holding {
                        wanted_n: self.felt_n,
                        correction_n: free_n.clamp(-CORRECTION_N, CORRECTION_N),
                    });
                    self.from_n = self.felt_n;
                    if changes_force(&motion) {
                        Stage::Body
                    } else {
                        Stage::Settle {
                            from_n: self.felt_n,
                        }
                    }
                }
                Stage::Settle { .. } if self.stage_s >= FORCE_RAMP_S => Stage::Body,
                Stage::Body if self.stage_s >= self.body_s(&motion) => {
                    self.index += 1;
                    self.begin();
                    continue;
                }
                _ => return Some(motion),
            };
            self.stage = next;
            self.stage_s = 0.0;
        }
    }

    /// Sets up the motion at `index`.
    fn begin(&mut self) {
        self.origin_m = self.target_m;
        self.stage_s = 0.0;
        let motion = self.script.motions().get(self.index);
        let holds = motion.is_some_and(holds_force);
        self.from_n = self.holding.map_or(0.0, |holding| holding.wanted_n);
        self.stage = match self.holding {
            Some(_) if motion.is_some_and(changes_force) => Stage::Body,
            Some(holding) if holds => Stage::Settle {
                from_n: holding.wanted_n,
            },
            None if holds => Stage::Descent {
                from_m: self.target_m[2],
            },
            _ => Stage::Body,
        };
        if !holds {
            self.holding = None;
        }
    }

    /// Duration of the motion itself, s.
    fn body_s(&self, motion: &Motion) -> f64 {
        match *motion {
            Motion::Approach { duration_s, .. }
            | Motion::Press { duration_s, .. }
            | Motion::Sweep { duration_s, .. }
            | Motion::Loop { duration_s, .. }
            | Motion::Rest { duration_s, .. }
            | Motion::Lift { duration_s, .. } => duration_s,
            Motion::Tap { speed_m_s } => self.tap(speed_m_s).duration_s(),
            Motion::Stroke {
                to_m, speed_m_s, ..
            } => self.stroke(to_m, speed_m_s).duration_s(),
            Motion::Scrub {
                frequency_hz,
                cycles,
                ..
            } => cycles / frequency_hz,
        }
    }

    fn tap(&self, speed_m_s: f64) -> TapPath {
        TapPath::new(
            self.origin_m[2],
            speed_m_s,
            TAP_FORCE_N / self.grip.stiffness_n_m,
        )
    }

    fn stroke(&self, to_m: [f64; 2], speed_m_s: f64) -> StrokePath {
        let distance_m = (to_m[0] - self.origin_m[0]).hypot(to_m[1] - self.origin_m[1]);
        StrokePath::new(distance_m, speed_m_s)
    }

    /// Intended position `ahead_s` after the start of this tick, m.
    fn path(&self, motion: &Motion, ahead_s: f64) -> [f64; 3] {
        let t_s = self.stage_s + ahead_s;
        let mut at_m = self.origin_m;
        match self.stage {
            Stage::Descent { from_m } => {
                at_m[2] = from_m + (FEELER_M - from_m) * min_jerk(t_s / DESCENT_S);
                return at_m;
            }
            Stage::Landing => {
                at_m[2] = FEELER_M - LANDING_M_S * t_s;
                return at_m;
            }
            Stage::Settle { .. } => return at_m,
            Stage::Body => {}
        }
        let blend = |from_m: f64, to_m: f64, duration_s: f64| {
            from_m + (to_m - from_m) * min_jerk(t_s / duration_s)
        };
        match *motion {
            Motion::Approach { to_m, duration_s } => {
                at_m = std::array::from_fn(|i| blend(self.origin_m[i], to_m[i], duration_s));
            }
            Motion::Lift {
                height_m,
                duration_s,
            } => {
                at_m[2] = blend(self.origin_m[2], height_m, duration_s);
            }
            Motion::Tap { speed_m_s } => at_m[2] = self.tap(speed_m_s).height_m(t_s),
            Motion::Stroke {
                to_m, speed_m_s, ..
            } => {
                let covered = self.stroke(to_m, speed_m_s).fraction(t_s);
                for i in 0..2 {
                    at_m[i] += (to_m[i] - self.origin_m[i]) * covered;
                }
            }
            Motion::Scrub {
                amplitude_m,
                frequency_hz,
                cycles,
                ..
            } => {
                at_m[0] += scrub_m(t_s, amplitude_m, frequency_hz, cycles);
            }
            Motion::Sweep {
                to_m,
                bow_m,
                duration_s,
                ..
            } => {
                let way_m = [to_m[0] - at_m[0], to_m[1] - at_m[1]];
                let length_m = way_m[0].hypot(way_m[1]).max(1e-9);
                let covered = min_jerk(t_s / duration_s);
                let aside_m = 4.0 * bow_m * covered * (1.0 - covered);
                at_m[0] += way_m[0] * covered - way_m[1] / length_m * aside_m;
                at_m[1] += way_m[1] * covered + way_m[0] / length_m * aside_m;
            }
            Motion::Loop {
                radius_m,
                aspect,
                turns,
                duration_s,
                ..
            } => {
                let (sin, cos) =
                    (std::f64::consts::TAU * turns * min_jerk(t_s / duration_s)).sin_cos();
                at_m[0] += radius_m * (1.0 - cos);
                at_m[1] += aspect * radius_m * sin;
            }
            Motion::Press { .. } | Motion::Rest { .. } => {}
        }
        at_m
    }

    /// Normal force wanted now, N.
    fn wanted_n(&self, motion: &Motion) -> f64 {
        let level_n = match *motion {
            // A press starts and ends at a tenth of its peak.
            Motion::Press { force_n, .. } => 0.1 * force_n,
            Motion::Rest { force_n, .. }
            | Motion::Stroke { force_n, .. }
            | Motion::Scrub { force_n, .. }
            | Motion::Sweep { force_n, .. }
            | Motion::Loop { force_n, .. } => force_n,
            Motion::Approach { .. } | Motion::Tap { .. } | Motion::Lift { .. } => 0.0,
        };
        match (self.stage, *motion) {
            (Stage::Settle { from_n }, _) => {
                from_n + (level_n - from_n) * min_jerk(self.stage_s / FORCE_RAMP_S)
            }
            (
                Stage::Body,
                Motion::Press {
                    force_n,
                    duration_s,
                },
            ) => {
                let s = (self.stage_s / duration_s).clamp(0.0, 1.0);
                let up_and_down = min_jerk(2.2 * s) * min_jerk(2.2 * (1.0 - s));
                level_n + (force_n - level_n) * up_and_down
            }
            (Stage::Body, Motion::Sweep { duration_s, .. } | Motion::Loop { duration_s, .. }) => {
                self.from_n + (level_n - self.from_n) * min_jerk(self.stage_s / duration_s)
            }
            _ => level_n,
        }
    }

    /// Height of the target that holds `wanted_n`, m.
    fn hold(&mut self, wanted_n: f64, tick_s: f64, stylus_z_m: f64) -> f64 {
        let felt_n = self.felt_n;
        if felt_n > LEARNING_N {
            let seen_m_n = (-stylus_z_m / felt_n).clamp(0.0, SOFTEST_M_N);
            self.compliance_m_n +=
                (seen_m_n - self.compliance_m_n) * (tick_s / LEARNING_S).min(1.0);
        }
        let Some(holding) = self.holding.as_mut() else {
            return self.target_m[2];
        };
        let error_n = wanted_n - felt_n;
        if error_n.abs() > FORCE_DEAD_BAND_N {
            let rate_s = std::f64::consts::TAU * self.grip.force_bandwidth_hz;
            holding.correction_n = (holding.correction_n + rate_s * tick_s * error_n)
                .clamp(-CORRECTION_N, CORRECTION_N);
        }
        holding.wanted_n = wanted_n;
        let spring_m = (wanted_n + holding.correction_n) / self.grip.stiffness_n_m;
        -spring_m - wanted_n * self.compliance_m_n
    }
}

/// Returns true if the motion holds a normal force.
fn holds_force(motion: &Motion) -> bool {
    match motion {
        Motion::Press { .. }
        | Motion::Stroke { .. }
        | Motion::Scrub { .. }
        | Motion::Sweep { .. }
        | Motion::Loop { .. }
        | Motion::Rest { .. } => true,
        Motion::Approach { .. } | Motion::Tap { .. } | Motion::Lift { .. } => false,
    }
}

/// Returns true if the motion varies the normal force.
fn changes_force(motion: &Motion) -> bool {
    matches!(motion, Motion::Sweep { .. } | Motion::Loop { .. })
}

/// Force that moves an axis as intended, N: `m·a + b·v + f_c·sgn(v)`, the sign
/// softened below 2 mm/s, where a hand cannot tell.
fn known_force_n(axis: &AxisParams, speed_m_s: f64, accel_m_s2: f64) -> f64 {
    axis.mass_kg * accel_m_s2
        + axis.damping_n_s_m * speed_m_s
        + axis.coulomb_n * (speed_m_s / 0.002).clamp(-1.0, 1.0)
}
