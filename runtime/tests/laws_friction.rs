//! Laws of friction: no change of sign at rest, no step over speed, no energy from closed paths.

use std::f64::consts::TAU;

use asperity_runtime::{
    Config,
    quantity::{Quantity, Vector},
    stage::friction::{Bristle, FrictionState},
};
use proptest::prelude::*;

/// Servo period, s.
const TICK_S: f64 = 1e-3;
/// Position resolution, m.
const COUNT_M: f64 = 0.055e-3;

/// Friction along one axis.
struct Axis {
    bristle: Bristle,
    state: FrictionState,
    last_m: f64,
    mu: f32,
}

impl Axis {
    fn new(mu: f32, delay_ticks: u32) -> Self {
        Self {
            bristle: Bristle::new(&Config::default().friction, delay_ticks, 1000.0),
            state: FrictionState::default(),
            last_m: 0.0,
            mu,
        }
    }

    /// Force, N, at a position, m, under a normal force, N.
    fn step(&mut self, x_m: f64, normal_n: f64) -> f64 {
        let motion_m = (x_m - self.last_m) as f32;
        self.last_m = x_m;
        let friction = self.bristle.step(
            &mut self.state,
            Vector::of([motion_m, 0.0, 0.0]),
            Vector::of([0.0, 0.0, 1.0]),
            Quantity::of(normal_n as f32),
            Quantity::of(self.mu * normal_n as f32),
        );
        f64::from(friction.force().values()[0])
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Wherever a stroke ended and however hard the stylus is pressed, noise of ±1 count never
    /// reverses the force.
    #[test]
    fn noise_at_rest_never_turns_the_force_round(
        counts in prop::collection::vec(-1_i8..=1, 3000),
        stroke_m in -0.02_f64..0.02,
        normal_n in 0.02_f64..3.3,
        mu in 0.05_f32..1.5,
    ) {
        let mut axis = Axis::new(mu, 0);
        for n in 0..200 {
            axis.step(stroke_m * f64::from(n) / 200.0, normal_n);
        }
        for count in counts {
            let force = axis.step(stroke_m + f64::from(count) * COUNT_M, normal_n);
            prop_assert!(force * stroke_m <= 0.0, "{force} N after {stroke_m} m");
        }
    }

    /// In a ramp of any acceleration, from rest or from a steady speed, through zero or not,
    /// |ΔF_t|/F_n is at most 0.03 per 0.1 mm/s.
    #[test]
    fn a_ramp_of_any_acceleration_has_no_step(
        exponent in -4.0_f64..1.0,
        start_m_s in -0.012_f64..0.012,
        normal_n in 0.05_f64..3.3,
        mu in 0.05_f32..1.5,
    ) {
        let accel = 10_f64.powf(exponent);
        let mut axis = Axis::new(mu, 0);
        let (mut x, mut last) = (0.0, 0.0);
        for _ in 0..20_000 {
            x += start_m_s * TICK_S;
            last = axis.step(x, normal_n);
        }
        let ticks = (0.03 / (accel * TICK_S)).ceil().min(100_000.0) as usize;
        let window = ((1e-4 / (accel * TICK_S)) as usize).clamp(1, ticks);
        let mut force = vec![last];
        for n in 1..=ticks {
            x += (start_m_s + accel * TICK_S * n as f64) * TICK_S;
            force.push(axis.step(x, normal_n));
        }
        // If a tick changes the speed by more than 0.1 mm/s, the bound grows in proportion.
        let allowed = 0.03 * (accel * TICK_S * window as f64 / 1e-4).max(1.0);
        for pair in force.windows(window + 1) {
            let change = (pair[window] - pair[0]).abs() / normal_n;
            prop_assert!(change <= allowed, "{change} of {allowed} at {accel} m/s²");
        }
    }

    /// While the speed wanders about a steady one, the force stays correspondingly near to its
    /// steady value.
    #[test]
    fn the_force_stays_as_near_as_the_speed(
        steps in prop::collection::vec((-1.0_f64..1.0, 1_usize..300), 1..30),
        steady_m_s in 0.0_f64..0.05,
        within_m_s in 1e-4_f64..5e-3,
        normal_n in 0.05_f64..3.3,
        mu in 0.05_f32..1.5,
    ) {
        let mut axis = Axis::new(mu, 0);
        let (mut x, mut before) = (0.0, 0.0);
        for _ in 0..20_000 {
            x += steady_m_s * TICK_S;
            before = axis.step(x, normal_n);
        }
        for (share, ticks) in steps {
            for _ in 0..ticks {
                x += (steady_m_s + share * within_m_s) * TICK_S;
                let change = (axis.step(x, normal_n) - before).abs() / normal_n;
                prop_assert!(change <= 0.03 * within_m_s / 1e-4, "{change}");
            }
        }
    }

    /// No work is done on the hand over closed paths. Speeds are those of a hand, the force of a
    /// tick is held until the next, the device absorbs nothing, and the stylus is pressed
    /// differently on the way back.
    #[test]
    fn no_closed_path_gains_energy(
        amplitude_m in 1e-5_f64..0.02,
        frequency_hz in 0.2_f64..10.0,
        (press_n, phase) in (0.0_f64..0.9, 0.0_f64..1.0),
        mu in 0.05_f32..1.5,
    ) {
        prop_assume!(amplitude_m * TAU * frequency_hz < 0.65);
        let mut axis = Axis::new(mu, 0);
        let ticks = (3000.0 / frequency_hz) as i32;
        let (mut work_j, mut force, mut last) = (0.0, 0.0, 0.0);
        for n in 0..=ticks {
            let turn = TAU * f64::from(n) / f64::from(ticks) * 3.0;
            let x = amplitude_m * turn.sin();
            work_j += force * (x - last);
            force = axis.step(x, 1.0 + press_n * (turn + TAU * phase).cos());
            last = x;
        }
        prop_assert!(work_j < 1e-9, "{work_j} J");
    }
}

/// Steady friction grows from zero to μF_n, and stays there from a few mm/s on.
#[test]
fn steady_friction_is_mu_times_the_normal_force_above_some_millimetres_a_second() {
    for (normal_n, mu) in [(0.1, 0.2_f32), (0.5, 0.7), (1.0, 0.7), (3.0, 1.4)] {
        let config = Config::default().friction;
        let steady = |speed_m_s: f64| {
            let mut axis = Axis::new(mu, 0);
            let mut force = 0.0;
            for n in 1..=30_000 {
                force = axis.step(speed_m_s * TICK_S * f64::from(n), normal_n);
            }
            -force
        };
        let full_n = f64::from(mu) * normal_n;
        assert!((steady(0.02) - full_n).abs() < 1e-4 * full_n);
        // F_n·v/v_c − kh, plus the lead of one tick.
        let (k, h) = (
            f64::from(config.stiffness_n_m),
            f64::from(config.dead_zone_m),
        );
        let slow_m_s = 0.5 * f64::from(mu) * f64::from(config.leak_speed_m_s);
        let viscous_n = normal_n * slow_m_s / f64::from(config.leak_speed_m_s) - k * h;
        let expected_n = if viscous_n > 0.0 {
            viscous_n + (k * slow_m_s * TICK_S).min(0.5 * viscous_n)
        } else {
            0.0
        };
        assert!(
            (steady(slow_m_s) - expected_n).abs() < 2e-3 * full_n,
            "{normal_n} {mu}"
        );
        assert_eq!(steady(0.0), 0.0);
    }
}
