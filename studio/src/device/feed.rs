//! The last second of a loop, and what was said in it.

use super::tick::LiveTick;
use serde::Serialize;
use std::collections::VecDeque;

/// Texts that are kept.
const MOST_TEXTS: usize = 32;

/// Status of a loop as a whole.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct LiveStatus {
    /// Name of the texture that plays.
    pub playing: String,
    /// Periods that were missed since the loop began.
    pub missed: u64,
    /// Wake-up latency since the loop began, µs.
    pub wakeup_us: Percentiles,
    /// Compute time of the runtime's tick since the loop began, µs.
    pub compute_us: Percentiles,
}

/// A distribution in short.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Percentiles {
    /// The median.
    pub p50: f64,
    /// The 99th percentile.
    pub p99: f64,
    /// The 99.9th percentile.
    pub p99_9: f64,
    /// The largest.
    pub max: f64,
}

/// News for the page.
#[derive(Serialize)]
struct News<'a> {
    /// Number to pass as `after` in the next request.
    next: u64,
    /// Ticks that are not kept any more.
    lost: u64,
    ended: bool,
    #[serde(flatten)]
    status: &'a LiveStatus,
    /// Texts since the loop began, the last ones: each with its number.
    said: &'a VecDeque<(u64, String)>,
    ticks: Columns,
}

/// Ticks one behind the other, as the page's plots take them. A gap in their numbers ends a run.
#[derive(Serialize, Default)]
struct Columns {
    runs: Vec<Run>,
}

#[derive(Serialize, Default)]
struct Run {
    first: u64,
    positions_mm: Vec<f32>,
    columns: Vec<f32>,
    flags: Vec<u32>,
    wakeup_us: Vec<f32>,
}

/// The last ticks of a loop.
#[derive(Debug)]
pub(crate) struct Feed {
    most: usize,
    ticks: VecDeque<LiveTick>,
    /// Ticks that were published, hence the number of the next one.
    published: u64,
    status: LiveStatus,
    said: VecDeque<(u64, String)>,
    texts: u64,
    ended: bool,
}

impl Feed {
    pub(crate) fn of_a_second(rate_hz: u32) -> Self {
        let most = rate_hz as usize;
        Self {
            most,
            ticks: VecDeque::with_capacity(most),
            published: 0,
            status: LiveStatus::default(),
            said: VecDeque::new(),
            texts: 0,
            ended: false,
        }
    }

    pub(crate) fn publish(&mut self, ticks: &[LiveTick], status: &LiveStatus) {
        self.published += ticks.len() as u64;
        let kept = &ticks[ticks.len().saturating_sub(self.most)..];
        let over = (self.ticks.len() + kept.len()).saturating_sub(self.most);
        self.ticks.drain(..over);
        self.ticks.extend(kept);
        self.status.clone_from(status);
    }

    pub(crate) fn say(&mut self, text: &str) {
        if self.said.len() == MOST_TEXTS {
            self.said.pop_front();
        }
        self.said.push_back((self.texts, text.to_owned()));
        self.texts += 1;
    }

    pub(crate) fn end(&mut self) {
        self.ended = true;
    }

    /// Returns true if there is news for a client that has the ticks before `after`.
    pub(crate) fn has_news(&self, after: Option<u64>) -> bool {
        self.ended || after.is_none_or(|after| after != self.published)
    }

    /// Returns the ticks published from number `after` on, JSON.
    pub(crate) fn after(&self, after: Option<u64>) -> String {
        let oldest = self.published - self.ticks.len() as u64;
        // A number of another loop, before the server was started again, is none of this one.
        let after = after
            .filter(|after| *after <= self.published)
            .unwrap_or(oldest);
        let from = after.max(oldest);
        let mut columns = Columns::default();
        let mut expected = None;
        for tick in self.ticks.range((from - oldest) as usize..) {
            if expected != Some(tick.tick) {
                columns.runs.push(Run {
                    first: tick.tick,
                    ..Run::default()
                });
            }
            expected = Some(tick.tick + 1);
            if let Some(run) = columns.runs.last_mut() {
                run.positions_mm.extend(tick.position());
                run.columns.extend(tick.columns());
                run.flags.push(tick.flags);
                run.wakeup_us.push(tick.wakeup());
            }
        }
        let news = News {
            next: self.published,
            lost: from - after,
            ended: self.ended,
            status: &self.status,
            said: &self.said,
            ticks: columns,
        };
        // Plain structures of numbers and strings always serialise.
        serde_json::to_string(&news).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    fn ticks(numbers: std::ops::Range<u64>) -> Vec<LiveTick> {
        let tick = |tick| LiveTick {
            tick,
            vib_m_s2: f32::NAN,
            depth_mm: tick as f32,
            ..LiveTick::default()
        };
        numbers.map(tick).collect()
    }

    fn firsts_and_lengths(news: &Value) -> Vec<(u64, usize)> {
        let runs = news["ticks"]["runs"].as_array().unwrap();
        let of = |run: &Value| {
            let flags = run["flags"].as_array().unwrap().len();
            assert_eq!(run["columns"].as_array().unwrap().len(), 9 * flags);
            assert_eq!(run["positions_mm"].as_array().unwrap().len(), 3 * flags);
            (run["first"].as_u64().unwrap(), flags)
        };
        runs.iter().map(of).collect()
    }

    #[test]
    fn a_page_gets_each_tick_once_and_a_slow_one_is_told_what_it_lost() {
        let mut feed = Feed::of_a_second(100);
        let status = LiveStatus::default();
        let read = |feed: &Feed, after| -> Value {
            serde_json::from_str(&feed.after(after)).expect("JSON")
        };
        feed.publish(&ticks(0..30), &status);
        let first = read(&feed, None);
        assert_eq!(firsts_and_lengths(&first), [(0, 30)]);
        assert_eq!(first["ticks"]["runs"][0]["columns"][3], 0.0, "NaN");
        let next = first["next"].as_u64();
        assert!(!feed.has_news(next));
        // A record that the loop could not hand over leaves a gap.
        feed.publish(&ticks(30..40), &status);
        feed.publish(&ticks(45..50), &status);
        let second = read(&feed, next);
        assert_eq!(firsts_and_lengths(&second), [(30, 10), (45, 5)]);
        assert_eq!(second["lost"], 0);
        // More than is kept, in one and in several pieces.
        feed.publish(&ticks(50..350), &status);
        let third = read(&feed, second["next"].as_u64());
        assert_eq!(firsts_and_lengths(&third), [(250, 100)]);
        assert_eq!(third["lost"], 200);
        // A number that this loop has not reached is of another one.
        assert_eq!(
            firsts_and_lengths(&read(&feed, Some(1 << 40))),
            [(250, 100)]
        );
        feed.end();
        assert!(feed.has_news(third["next"].as_u64()));
    }

    #[test]
    fn the_last_texts_are_kept_with_their_numbers() {
        let mut feed = Feed::of_a_second(100);
        (0..40).for_each(|n| feed.say(&format!("text {n}")));
        let news: Value = serde_json::from_str(&feed.after(None)).expect("JSON");
        let said = news["said"].as_array().expect("texts");
        assert_eq!(said.len(), MOST_TEXTS);
        assert_eq!(said[0], serde_json::json!([8, "text 8"]));
    }
}
