//! The paths that a hand's intention follows.

/// Time a stroke takes to reach its speed and to stop, s.
const STROKE_RAMP_S: f64 = 0.06;

/// Minimum-jerk blend from 0 to 1 over `s` in 0..=1: `10 s³ − 15 s⁴ + 6 s⁵`.
#[must_use]
pub fn min_jerk(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (6.0 * s - 15.0))
}

/// The way along a stroke: constant acceleration, constant speed, constant deceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokePath {
    distance_m: f64,
    speed_m_s: f64,
    ramp_s: f64,
}

impl StrokePath {
    /// A stroke of `distance_m`. One that is too short to reach `speed_m_s` consists of its two
    /// ramps alone, at the same acceleration.
    #[must_use]
    pub fn new(distance_m: f64, speed_m_s: f64) -> Self {
        let accel_m_s2 = speed_m_s / STROKE_RAMP_S;
        let ramp_s = STROKE_RAMP_S.min((distance_m / accel_m_s2).sqrt());
        Self {
            distance_m,
            speed_m_s: accel_m_s2 * ramp_s,
            ramp_s,
        }
    }

    /// Returns the duration, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        if self.speed_m_s > 0.0 {
            self.distance_m / self.speed_m_s + self.ramp_s
        } else {
            0.0
        }
    }

    /// The beginning and the end of its full speed, s after its start.
    #[must_use]
    pub fn steady_s(&self) -> (f64, f64) {
        (self.ramp_s, self.duration_s() - self.ramp_s)
    }

    /// Fraction of the distance covered after `t_s`, 0..=1.
    #[must_use]
    pub fn fraction(&self, t_s: f64) -> f64 {
        if self.distance_m <= 0.0 {
            return 1.0;
        }
        let end_s = self.duration_s();
        let t_s = t_s.clamp(0.0, end_s);
        let ramped = |tau_s: f64| 0.5 * self.speed_m_s / self.ramp_s * tau_s * tau_s;
        let covered_m = if t_s < self.ramp_s {
            ramped(t_s)
        } else if t_s > end_s - self.ramp_s {
            self.distance_m - ramped(end_s - t_s)
        } else {
            self.speed_m_s * (t_s - 0.5 * self.ramp_s)
        };
        covered_m / self.distance_m
    }
}

/// Displacement of a scrub after `t_s`, m: a sine that grows over its first half cycle and
/// decays over its last.
#[must_use]
pub fn scrub_m(t_s: f64, amplitude_m: f64, frequency_hz: f64, cycles: f64) -> f64 {
    let turns = t_s * frequency_hz;
    let envelope = min_jerk(2.0 * turns) * min_jerk(2.0 * (cycles - turns));
    amplitude_m * envelope * (std::f64::consts::TAU * turns).sin()
}

/// The vertical path of a tap.
///
/// It rises to a starting height, falls, meets the surface at exactly the wanted speed, goes on
/// to a depth where the grip's spring gives a stated force, and rises again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TapPath {
    start_m: f64,
    height_m: f64,
    speed_m_s: f64,
    sink_s: f64,
}

/// Time that a tap takes to reach its starting height and to come back up, s.
const TAP_TRAVEL_S: f64 = 0.18;
/// Longest time that the hand goes on below the surface, s.
const TAP_SINK_S: f64 = 0.04;
/// Time for which a tap keeps its speed below the surface, s.
const TAP_COAST_S: f64 = 0.002;
/// Time at the bottom of a tap, s.
const TAP_DWELL_S: f64 = 0.03;
/// Lowest starting height of a tap, m.
const TAP_MIN_HEIGHT_M: f64 = 0.005;

impl TapPath {
    /// A tap from `start_m` above the surface with an intended depth of at most `depth_m`.
    #[must_use]
    pub fn new(start_m: f64, speed_m_s: f64, depth_m: f64) -> Self {
        Self {
            start_m,
            height_m: TAP_MIN_HEIGHT_M.max(0.06 * speed_m_s),
            speed_m_s,
            sink_s: (2.0 * (depth_m / speed_m_s - TAP_COAST_S)).clamp(TAP_COAST_S, TAP_SINK_S),
        }
    }

    /// When the surface is met, s after the start.
    #[must_use]
    pub fn impact_s(&self) -> f64 {
        TAP_TRAVEL_S + 2.0 * self.height_m / self.speed_m_s
    }

    /// Returns the duration, s.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.impact_s() + TAP_COAST_S + self.sink_s + TAP_DWELL_S + TAP_TRAVEL_S
    }

    /// Height after `t_s`, m.
    #[must_use]
    pub fn height_m(&self, t_s: f64) -> f64 {
        let bottom_m = -self.speed_m_s * (TAP_COAST_S + 0.5 * self.sink_s);
        if t_s < TAP_TRAVEL_S {
            return self.start_m + (self.height_m - self.start_m) * min_jerk(t_s / TAP_TRAVEL_S);
        }
        let falling_s = t_s - TAP_TRAVEL_S;
        let fall_s = 2.0 * self.height_m / self.speed_m_s;
        if falling_s < fall_s {
            // Speed grows as (1 − cos)/2 and is exactly `speed_m_s` at the surface.
            let turn = std::f64::consts::PI / fall_s;
            let fallen_m = 0.5 * self.speed_m_s * (falling_s - (turn * falling_s).sin() / turn);
            return self.height_m - fallen_m;
        }
        let sinking_s = falling_s - fall_s - TAP_COAST_S;
        if sinking_s < self.sink_s {
            let slowing_s = sinking_s.max(0.0);
            let coasted_m = self.speed_m_s * (TAP_COAST_S + sinking_s);
            return 0.5 * self.speed_m_s * slowing_s * slowing_s / self.sink_s - coasted_m;
        }
        let rising_s = sinking_s - self.sink_s - TAP_DWELL_S;
        bottom_m + (self.height_m - bottom_m) * min_jerk(rising_s / TAP_TRAVEL_S)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn speed(path: impl Fn(f64) -> f64, t_s: f64) -> f64 {
        (path(t_s + 1e-6) - path(t_s - 1e-6)) / 2e-6
    }

    #[test]
    fn a_stroke_covers_its_distance_at_its_speed() {
        for (distance_m, speed_m_s) in [(0.11, 0.08), (0.11, 0.22), (0.001, 0.2), (0.0, 0.1)] {
            let stroke = StrokePath::new(distance_m, speed_m_s);
            assert_eq!(stroke.fraction(stroke.duration_s()), 1.0);
            let middle_s = 0.5 * stroke.duration_s();
            let covered = |t_s| distance_m * stroke.fraction(t_s);
            assert!(speed(covered, middle_s.max(1e-5)) <= speed_m_s * 1.000_001);
            if distance_m > 0.1 {
                assert!((speed(covered, middle_s) - speed_m_s).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn a_tap_meets_the_surface_at_its_speed_and_the_path_has_no_jumps() {
        for speed_m_s in [0.02, 0.05, 0.1, 0.3, 0.6] {
            let tap = TapPath::new(0.012, speed_m_s, 0.004);
            let path = |t_s| tap.height_m(t_s);
            let impact_s = tap.impact_s();
            assert!(path(impact_s).abs() < 1e-12);
            assert!((speed(path, impact_s - 2e-6) + speed_m_s).abs() < 1e-4 * speed_m_s);
            let mut t_s = 0.0;
            while t_s < tap.duration_s() {
                let jump_m = (path(t_s + 1e-4) - path(t_s)).abs();
                assert!(jump_m <= 1e-4 * speed_m_s.max(0.5), "{t_s}: {jump_m}");
                assert!(path(t_s) >= -0.004 - 1e-12);
                t_s += 1e-4;
            }
        }
    }

    #[test]
    fn a_scrub_stays_within_its_amplitude_and_starts_and_ends_still() {
        let at = |t_s| scrub_m(t_s, 0.025, 1.5, 3.0);
        assert!((0..2000).all(|n| at(f64::from(n) * 1e-3).abs() <= 0.025));
        assert_eq!(at(0.0), 0.0);
        assert!(at(2.0).abs() < 1e-12 && speed(at, 2.0).abs() < 1e-3);
    }
}
