//! The clock of the page in terms of the audio clock.
//!
//! A pointer event carries the page's time, which a worklet cannot read. Its message arrives later
//! by an unknown, varying time, and only between two blocks of audio. The smallest difference seen
//! between arrival and event is therefore the offset of the clocks plus the shortest way; any longer
//! way would shift single events and so distort their speed. The clocks drift apart by up to some
//! 100 ppm, so the offset also rises, by a small share of each larger difference.

/// Share of a larger difference by which the offset rises: at 60 messages a second and ways that
/// vary by 5 ms this follows a drift of 300 ppm.
const RISE: f64 = 1.0e-3;

/// Converts times of the page to times of the audio clock.
#[derive(Debug, Clone, Copy, Default)]
pub struct Clock {
    offset_s: Option<f64>,
}

impl Clock {
    /// A clock that has seen no event.
    #[must_use]
    pub const fn new() -> Self {
        Self { offset_s: None }
    }

    /// An event of the page's time `event_s` has arrived at the audio time `now_s`, both in s.
    pub const fn observe(&mut self, now_s: f64, event_s: f64) {
        let difference = now_s - event_s;
        self.offset_s = Some(match self.offset_s {
            Some(offset) if difference > offset => offset + RISE * (difference - offset),
            _ => difference,
        });
    }

    /// The audio time, s, of a time of the page, s; the same before any event.
    #[must_use]
    pub fn audio_s(&self, event_s: f64) -> f64 {
        event_s + self.offset_s.unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Events of each millisecond that arrive after 2 to 18 ms, as frames of a page bunch them.
    fn run(clock: &mut Clock, events: u32, drift: f64) -> f64 {
        (0..events).fold(0.0, |_, n| {
            let event_s = f64::from(n) * 1e-3;
            let way_s = 2e-3 + f64::from(n * 7 % 17) * 1e-3;
            let audio_s = (event_s + 100.0) * (1.0 + drift);
            clock.observe(audio_s + way_s, event_s);
            clock.audio_s(event_s) - audio_s - 2e-3
        })
    }

    #[test]
    fn the_shortest_way_is_the_offset_and_longer_ways_hardly_shift_it() {
        let mut clock = Clock::new();
        // An event can rise by a thousandth of 16 ms at most until the next shortest way.
        let error_s = run(&mut clock, 2000, 0.0);
        assert!((0.0..17.0 * 16e-6).contains(&error_s), "{error_s}");
    }

    #[test]
    fn drift_of_either_sign_is_followed_within_a_millisecond() {
        for drift in [1e-4, -1e-4] {
            let error_s = run(&mut Clock::new(), 60_000, drift);
            assert!(error_s.abs() < 1e-3, "{drift}: {error_s}");
        }
    }

    #[test]
    fn an_audio_clock_that_stood_still_is_taken_over_at_once() {
        let mut clock = Clock::new();
        clock.observe(5.0, 1.0);
        clock.observe(5.1, 3.0);
        assert!((clock.audio_s(3.0) - 5.1).abs() < 1e-12);
    }
}
