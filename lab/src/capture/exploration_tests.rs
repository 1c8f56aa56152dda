//! Scripted motions of a tool, 1 kHz, whose cells, taps and bias are known.

use super::*;

struct Tool {
    exploration: Exploration,
    t_s: f64,
    place_m: [f64; 3],
    bias_n: f64,
}

impl Tool {
    fn new(is_sensor: bool, bias_n: f64) -> Self {
        let plan = Plan {
            coverage: Coverage::new(&[20.0, 50.0, 100.0, 200.0], &[0.3, 1.0, 2.0], 1.0)
                .expect("a grid"),
            taps: 1,
            air_s: 2.0,
            is_sensor,
        };
        Self {
            exploration: Exploration::new(plan),
            t_s: 0.0,
            place_m: [0.0, 0.0, 0.02],
            bias_n,
        }
    }

    /// Moves for some seconds at some speeds, m/s, under a load.
    fn go(&mut self, seconds: f64, velocity_m_s: [f64; 3], load_n: impl Fn(f64) -> f64) {
        for n in 0..(seconds * 1000.0) as usize {
            self.t_s += 0.001;
            for (x, v) in self.place_m.iter_mut().zip(velocity_m_s) {
                *x += 0.001 * v;
            }
            let load_n = self.bias_n + load_n(n as f64 / 1000.0);
            self.exploration.take(self.t_s, self.place_m, load_n);
        }
    }

    fn tap(&mut self, speed_m_s: f64) {
        self.go(0.06, [0.0, 0.0, -speed_m_s], |_| 0.0);
        self.go(0.05, [0.0; 3], |_| 1.5);
        self.go(0.06, [0.0, 0.0, speed_m_s], |_| 0.0);
    }
}

#[test]
fn a_session_goes_from_air_over_taps_to_strokes_and_ends() {
    let mut tool = Tool::new(true, 0.37);
    assert_eq!(tool.exploration.next_step(), NextStep::Air);
    tool.go(2.2, [0.0; 3], |_| 0.0);
    assert_eq!(tool.exploration.next_step(), NextStep::Tap(0));
    for (band, speed_m_s) in [0.05, 0.1, 0.2, 0.3].into_iter().enumerate() {
        assert_eq!(tool.exploration.next_step(), NextStep::Tap(band));
        tool.tap(speed_m_s);
    }
    assert_eq!(tool.exploration.taps(), [1, 1, 1, 1]);
    let mut strokes = 0;
    while let NextStep::Stroke((speed, force)) = tool.exploration.next_step() {
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let coverage = tool.exploration.coverage();
        let speed_m_s = 1e-3 * middle(coverage.speed(speed));
        let force_n = middle(coverage.force(force));
        tool.go(1.4, [0.6 * speed_m_s, -0.8 * speed_m_s, 0.0], |_| force_n);
        strokes += 1;
        assert!(strokes < 10, "{:?}", tool.exploration.coverage());
    }
    assert_eq!(
        (strokes, tool.exploration.next_step()),
        (6, NextStep::Nothing)
    );
    let now = tool.exploration.now();
    assert!(
        (now.load_n - 1.5).abs() < 0.51 && now.touches == Some(true),
        "{now:?}"
    );
}

#[test]
fn what_is_not_steady_covers_nothing() {
    let mut tool = Tool::new(false, 0.0);
    // A load that goes from nothing to 2 N and back five times a second.
    tool.go(5.0, [0.07, 0.0, 0.0], |t_s| {
        1.0 + libm::sin(std::f64::consts::TAU * 5.0 * t_s)
    });
    let unsteady: f64 = tool.exploration.coverage().rows().concat().iter().sum();
    assert!(unsteady < 0.5, "{unsteady} s");
    // Nor does a tool in the air, or one that rests on the surface.
    tool.go(3.0, [0.07, 0.0, 0.0], |_| 0.0);
    tool.go(3.0, [0.0; 3], |_| 1.5);
    let after: f64 = tool.exploration.coverage().rows().concat().iter().sum();
    assert_eq!(after, unsteady);
}

#[test]
fn a_bias_is_taken_while_the_force_rests_and_not_while_it_moves() {
    let mut tool = Tool::new(true, -0.8);
    tool.go(6.0, [0.05, 0.0, 0.0], |t_s| 0.4 * libm::sin(3.0 * t_s));
    assert_eq!(
        (tool.exploration.next_step(), tool.exploration.now().touches),
        (NextStep::Air, None)
    );
    tool.go(2.5, [0.0; 3], |_| 0.0);
    assert_eq!(tool.exploration.now().touches, Some(false));
    assert!(tool.exploration.now().load_n.abs() < 0.02);
}

#[test]
fn a_bounce_is_no_second_tap_and_missing_values_are_left_out() {
    let mut tool = Tool::new(false, 0.0);
    tool.tap(0.1);
    tool.go(0.01, [0.0; 3], |_| 1.0);
    tool.go(0.02, [0.0; 3], |_| 0.0);
    tool.go(0.01, [0.0; 3], |_| 1.0);
    tool.go(0.5, [0.0; 3], |_| f64::NAN);
    assert_eq!(tool.exploration.taps().iter().sum::<u32>(), 1);
}
