//! The hand: pointer events at 60 to 1000 Hz become a position at every tick.
//!
//! Events are played [`Hand::latency_s`] late. Between two of them the pointer moves along a line;
//! before a line of more than [`LONGEST_MOVE_S`] it rested, because a resting pointer sends no events.
//! The hand follows the pointer no faster than a hand can move, through two equal one-poles
//!
//! ```text
//! a[n] = a[n−1] + α(p[n] − a[n−1]),   b[n] = b[n−1] + α(a[n] − b[n−1]),   α = 1/81,
//! ```
//!
//! whose delay is 80 ticks each, 10 ms together, and which cannot overshoot. So, whatever events
//! come, are lost, or jump:
//!
//! - the speed is at most [`FASTEST_SLIDE_MM_S`] along the surface, [`FASTEST_PRESS_MM_S`] normal to it;
//! - the speed is continuous: from tick to tick it changes by at most 2α/e, a hundredth, of the fastest,
//!   since the impulse response α²(n + 1)(1 − α)ⁿ rises to α/e and falls again;
//! - a jump along the surface leads to a motion of at most [`LARGEST_LAG_MM`] beyond its speed, for
//!   on a plane without end only the way matters; a depth is always reached.

use asperity_runtime::math::norm;
use heapless::Deque;

/// Ticks a second.
pub const RATE_HZ: f32 = 16_000.0;
/// Fastest motion along the surface, mm/s: three times the fastest that a grid of the HaTT knows, 336 mm/s.
pub const FASTEST_SLIDE_MM_S: f64 = 1000.0;
/// Fastest motion along the normal, mm/s: the fastest tap of the corpus.
pub const FASTEST_PRESS_MM_S: f64 = 650.0;
/// The pointer's lead over the hand's target that is kept, mm; a longer one is cut.
pub const LARGEST_LAG_MM: f64 = 5.0;
/// Longest motion between two events, s: events of 60 Hz, of which none was lost, and a reserve.
pub const LONGEST_MOVE_S: f64 = 0.025;
/// Largest coordinate of an event, mm.
pub const LARGEST_MM: f64 = 10_000.0;
/// Events that can wait to be played.
pub const ROOM: usize = 256;

const SMOOTHING: f64 = 1.0 / 81.0;
/// Delay of the two one-poles, s.
pub const SMOOTHING_DELAY_S: f64 = 2.0 * (1.0 / SMOOTHING - 1.0) / RATE_HZ as f64;
const TICK_S: f64 = 1.0 / RATE_HZ as f64;
/// A remaining way that is taken at once, mm; else a decay would end in denormals.
const SETTLED_MM: f64 = 1.0e-9;
/// Height above the surface before the first event, mm.
const START_MM: f64 = 10.0;

/// A pointer event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pointer {
    /// Time, s.
    pub time_s: f64,
    /// Position, mm: x and y along the surface, z above it; below zero the hand presses.
    pub position_mm: [f64; 3],
    /// Number of the stroke. Where it changes the pointer was put down elsewhere, and x and y moved
    /// without the hand.
    pub stroke: f64,
}

impl Pointer {
    /// Returns true if every number is finite and the position is within [`LARGEST_MM`].
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.time_s.is_finite()
            && self.stroke.is_finite()
            && (self.position_mm.iter()).all(|x| x.abs() <= LARGEST_MM)
    }
}

/// A hand that follows a pointer.
#[derive(Debug, Clone)]
pub struct Hand {
    events: Deque<Pointer, ROOM>,
    /// The event that was played last; its x and y are the hand's.
    played: Option<Pointer>,
    /// From the pointer's x and y to the hand's, mm.
    shift_mm: [f64; 2],
    /// Where the hand goes: the pointer, no faster than a hand.
    target_mm: [f64; 3],
    /// The two one-poles.
    smoothed_mm: [[f64; 3]; 2],
    delay_s: f64,
}

impl Hand {
    /// A hand at rest above the surface, which plays events `delay_s` late, plus the delay of its
    /// smoothing. The delay should be an interval between events and the jitter of their arrival.
    #[must_use]
    pub const fn new(delay_s: f64) -> Self {
        let start_mm = [0.0, 0.0, START_MM];
        Self {
            events: Deque::new(),
            played: None,
            shift_mm: [0.0; 2],
            target_mm: start_mm,
            smoothed_mm: [start_mm; 2],
            delay_s,
        }
    }

    /// From an event to the hand's position, s.
    #[must_use]
    pub const fn latency_s(&self) -> f64 {
        self.delay_s + SMOOTHING_DELAY_S
    }

    /// Takes an event. One that is earlier than the event before counts as of the same time. Where
    /// [`ROOM`] events wait, the oldest is played at once.
    pub fn post(&mut self, event: Pointer) {
        let last = self.events.back().or(self.played.as_ref());
        let time_s = last.map_or(event.time_s, |last| last.time_s.max(event.time_s));
        if self.events.is_full()
            && let Some(oldest) = self.events.pop_front()
        {
            self.play(oldest);
        }
        // There is room now.
        let _ = self.events.push_back(Pointer { time_s, ..event });
    }

    /// The position in the tick at `now_s`, mm. Call it once a tick.
    pub fn step(&mut self, now_s: f64) -> [f32; 3] {
        let pointer_mm = self.pointer_mm(now_s - self.delay_s);
        self.approach(pointer_mm);
        let [first, second] = &mut self.smoothed_mm;
        for axis in 0..3 {
            first[axis] = smooth(first[axis], self.target_mm[axis]);
            second[axis] = smooth(second[axis], first[axis]);
        }
        second.map(|x| x as f32)
    }

    /// The pointer at a time, in the hand's coordinates, mm.
    fn pointer_mm(&mut self, time_s: f64) -> [f64; 3] {
        while let Some(&event) = self.events.front()
            && event.time_s <= time_s
        {
            self.events.pop_front();
            self.play(event);
        }
        let Some(from) = self.played else {
            return self.target_mm;
        };
        let Some(to) = self.events.front() else {
            return from.position_mm;
        };
        let start_s = from.time_s.max(to.time_s - LONGEST_MOVE_S);
        if time_s <= start_s || start_s >= to.time_s {
            return from.position_mm;
        }
        let share = (time_s - start_s) / (to.time_s - start_s);
        let to_mm = self.in_hand(to, &from);
        core::array::from_fn(|axis| {
            from.position_mm[axis] + share * (to_mm[axis] - from.position_mm[axis])
        })
    }

    /// Makes an event the last one played.
    fn play(&mut self, event: Pointer) {
        let [x, y, z] = self.target_mm;
        let before = self.played.unwrap_or(Pointer {
            position_mm: [x, y, z],
            stroke: f64::NAN,
            ..event
        });
        let position_mm = self.in_hand(&event, &before);
        self.shift_mm = [0, 1].map(|axis| position_mm[axis] - event.position_mm[axis]);
        self.played = Some(Pointer {
            position_mm,
            ..event
        });
    }

    /// The position of an event in the hand's coordinates, mm. A new stroke begins where the hand is.
    fn in_hand(&self, event: &Pointer, before: &Pointer) -> [f64; 3] {
        let [x, y, z] = event.position_mm;
        if event.stroke == before.stroke {
            [x + self.shift_mm[0], y + self.shift_mm[1], z]
        } else {
            [before.position_mm[0], before.position_mm[1], z]
        }
    }

    /// Moves the target towards the pointer, no faster than a hand, and cuts the way that it then
    /// lags behind along the surface.
    fn approach(&mut self, pointer_mm: [f64; 3]) {
        let step_mm = FASTEST_PRESS_MM_S * TICK_S;
        self.target_mm[2] += (pointer_mm[2] - self.target_mm[2]).clamp(-step_mm, step_mm);

        let way_mm = [0, 1].map(|axis| pointer_mm[axis] - self.target_mm[axis]);
        let length_mm = f64::from(norm([way_mm[0] as f32, way_mm[1] as f32, 0.0]));
        let step_mm = FASTEST_SLIDE_MM_S * TICK_S;
        if length_mm <= step_mm {
            self.target_mm[..2].copy_from_slice(&pointer_mm[..2]);
            return;
        }
        let excess_mm = (length_mm - step_mm - LARGEST_LAG_MM).max(0.0);
        for (axis, way_mm) in way_mm.into_iter().enumerate() {
            let direction = way_mm / length_mm;
            self.target_mm[axis] += direction * step_mm;
            self.shift_mm[axis] -= direction * excess_mm;
            if let Some(played) = &mut self.played {
                played.position_mm[axis] -= direction * excess_mm;
            }
        }
    }
}

/// Advances a one-pole low-pass by a step.
fn smooth(from_mm: f64, to_mm: f64) -> f64 {
    let next_mm = from_mm + SMOOTHING * (to_mm - from_mm);
    if (to_mm - next_mm).abs() < SETTLED_MM {
        to_mm
    } else {
        next_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DELAY_S: f64 = 0.02;

    fn event(time_s: f64, x: f64, z: f64, stroke: f64) -> Pointer {
        Pointer {
            time_s,
            position_mm: [x, 0.0, z],
            stroke,
        }
    }

    /// Steps the hand from tick `from` for `ticks`; each event is posted `way_s` after its time.
    fn run(
        hand: &mut Hand,
        events: &[Pointer],
        way_s: f64,
        from: usize,
        ticks: usize,
    ) -> Vec<[f64; 3]> {
        let mut events = events.iter().peekable();
        (from..from + ticks)
            .map(|n| {
                let now_s = n as f64 * TICK_S;
                while let Some(event) = events.next_if(|event| event.time_s + way_s <= now_s) {
                    hand.post(*event);
                }
                hand.step(now_s).map(f64::from)
            })
            .collect()
    }

    /// Positions have f32, so two of them differ by this much less or more, mm.
    const ROUNDING_MM: f64 = 1e-4;

    /// The claims of the module's head about every motion.
    fn assert_a_hand_can_do_this(path: &[[f64; 3]]) {
        // The impulse response at its maximum, n ≈ 1/α; (1 − α)^(1/α − 1) is 1 % above 1/e.
        let peak = 1.01 * SMOOTHING / core::f64::consts::E;
        let jerk_mm = |fastest_mm_s: f64| 2.0 * fastest_mm_s * TICK_S * peak + 2.0 * ROUNDING_MM;
        let step = |n: usize, axis: usize| path[n + 1][axis] - path[n][axis];
        for n in 0..path.len() - 1 {
            let slide_mm = step(n, 0).hypot(step(n, 1));
            assert!(
                slide_mm <= FASTEST_SLIDE_MM_S * TICK_S + ROUNDING_MM,
                "{n}: {slide_mm}"
            );
            assert!(
                step(n, 2).abs() <= FASTEST_PRESS_MM_S * TICK_S + ROUNDING_MM,
                "{n}"
            );
            if n > 0 {
                for (axis, fastest) in [FASTEST_SLIDE_MM_S, FASTEST_SLIDE_MM_S, FASTEST_PRESS_MM_S]
                    .into_iter()
                    .enumerate()
                {
                    let change_mm = (step(n, axis) - step(n - 1, axis)).abs();
                    assert!(change_mm <= jerk_mm(fastest), "{n}, {axis}: {change_mm} mm");
                }
            }
        }
    }

    #[test]
    fn a_steady_stroke_comes_out_steady_and_30_ms_late_at_every_rate_of_events() {
        for (event_hz, way_s) in [
            (60.0, 0.002),
            (125.0, 0.008),
            (240.0, 0.01),
            (1000.0, 0.018),
        ] {
            let events: Vec<_> = (0..event_hz as usize)
                .map(|n| n as f64 / event_hz)
                .map(|time_s| event(time_s, 100.0 * time_s, -1.0, 1.0))
                .collect();
            let mut hand = Hand::new(DELAY_S);
            assert!((hand.latency_s() - 0.03).abs() < 1e-12);
            let path = run(&mut hand, &events, way_s, 0, 15_000);
            assert_a_hand_can_do_this(&path);
            for (n, [x, _, z]) in path.iter().enumerate().skip(3000) {
                let wanted = 100.0 * (n as f64 * TICK_S - hand.latency_s());
                assert!(
                    (x - wanted).abs() < 1e-3,
                    "{event_hz} Hz, {n}: {x} not {wanted}"
                );
                assert_eq!(*z, -1.0);
            }
        }
    }

    #[test]
    fn what_no_hand_does_becomes_what_a_hand_can_do() {
        // A xorshift chooses jumps, gaps, bursts of late events and new strokes.
        let mut state = 0x9e37_79b9_u32;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            f64::from(state) / f64::from(u32::MAX)
        };
        let mut hand = Hand::new(DELAY_S);
        let (mut events, mut time_s, mut stroke) = (Vec::new(), 0.0, 0.0);
        while time_s < 8.0 {
            time_s += if random() < 0.1 { 0.3 } else { 0.02 } * random();
            stroke += f64::from(random() < 0.05);
            let [x, y, z] = [random(), random(), random()].map(|r| 2.0 * LARGEST_MM * (r - 0.5));
            // Some of them late, or out of their order.
            let late_s = if random() < 0.2 { 0.05 } else { 0.0 };
            events.push(Pointer {
                time_s: time_s - late_s,
                position_mm: [x, y, z * 1e-3],
                stroke,
            });
        }
        assert_a_hand_can_do_this(&run(&mut hand, &events, 0.01, 0, 130_000));
    }

    #[test]
    fn a_jump_moves_the_hand_by_the_lag_that_is_kept() {
        let events = [event(0.0, 0.0, -1.0, 1.0), event(0.1, 500.0, -1.0, 1.0)];
        let path = run(&mut Hand::new(DELAY_S), &events, 0.0, 0, 8000);
        // Plus what it goes at its fastest while the pointer's line lasts.
        let most = LARGEST_LAG_MM + FASTEST_SLIDE_MM_S * LONGEST_MOVE_S;
        let end = path[7999][0];
        assert!((LARGEST_LAG_MM..most + 0.1).contains(&end), "{end}");
    }

    #[test]
    fn a_new_stroke_elsewhere_is_no_motion_and_its_depth_is_reached() {
        let events = [
            event(0.0, 0.0, -1.0, 1.0),
            event(0.1, 0.0, 1.0, 1.0),
            event(0.2, 300.0, 1.0, 2.0),
            event(0.3, 300.0, -2.0, 2.0),
            event(0.35, 305.0, -2.0, 2.0),
        ];
        let path = run(&mut Hand::new(DELAY_S), &events, 0.001, 0, 9000);
        assert_a_hand_can_do_this(&path);
        for [x, y, _] in &path[..5200] {
            assert_eq!((*x, *y), (0.0, 0.0));
        }
        // At rest it is exactly there.
        assert_eq!(path[8500], [5.0, 0.0, -2.0]);
        assert_eq!(path[8999], path[8500]);
    }

    /// A pointer that rested for a second sends its next event when it has moved for a moment only.
    #[test]
    fn after_a_rest_the_hand_moves_when_the_pointer_does() {
        let events = [event(0.0, 0.0, -1.0, 1.0), event(1.0, 1.0, -1.0, 1.0)];
        let path = run(&mut Hand::new(DELAY_S), &events, 0.001, 0, 20_000);
        let (moved, _) = (path.iter().enumerate()).find(|(_, x)| x[0] > 0.0).unwrap();
        assert!((moved as f64 * TICK_S - 1.001).abs() < 2e-3, "{moved}");
    }

    #[test]
    fn more_events_than_there_is_room_for_lose_no_stroke() {
        let mut hand = Hand::new(DELAY_S);
        for n in 0..3 * ROOM {
            let time_s = n as f64 * 1e-5;
            hand.post(event(time_s, n as f64 * 0.1, -1.0, (n / ROOM) as f64));
        }
        // The last stroke began where the one before it ended, a way of 255 events each.
        let path = run(&mut hand, &[], 0.0, 1000, 4000);
        assert_a_hand_can_do_this(&path);
        assert_eq!(path[3999][2], -1.0);
    }

    #[test]
    fn numbers_that_are_none_are_found() {
        assert!(event(1.0, 1.0, -1.0, 0.0).is_valid());
        for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
            assert!(!event(bad, 1.0, 1.0, 0.0).is_valid());
            assert!(!event(1.0, bad, 1.0, 0.0).is_valid());
            assert!(!event(1.0, 1.0, bad, 0.0).is_valid());
            assert!(!event(1.0, 1.0, 1.0, bad).is_valid());
        }
        assert!(!event(0.0, LARGEST_MM * 1.001, 0.0, 0.0).is_valid());
    }
}
