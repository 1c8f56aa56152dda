//! The clock of a file: its rate, its jitter, and the rows that are missing.
//!
//! Rows that share a time stamp are one packet, or were stamped by a coarse clock: the stamp is that of the
//! first of them, and they come at the mean rate. A step that is too long means missing rows, unless the rows
//! behind it catch up: then they were only stamped late.

use super::rows;
use crate::{
    description::RATES_HZ,
    remedy,
    signal::{quantile::median, resample::Clock},
};
use asperity_io::diagnostic::Fault;
use std::{collections::VecDeque, path::Path};

/// Rows, and stamps, that tell the rate before gaps are looked for.
const FIRST: (u64, usize) = (4000, 64);
/// Stretches whose median rate is that of the clock.
const STRETCHES: usize = 16;
/// Longest gap that is bridged, s.
const MAX_GAP_S: f64 = 1.0;
/// Longest delay that rows may catch up with, s and in samples.
const MAX_LATE: (f64, f64) = (10.0, 100.0);
/// Shortest gap, s, and in samples. Anything less is jitter.
const LEAST_GAP: (f64, f64) = (0.005, 3.0);
/// Shortest gap as a multiple of the median irregularity of the steps.
const LEAST_SPREADS: f64 = 6.0;
/// Rows a stamp from which on a clock is coarse.
const COARSE: f64 = 1.5;
/// Rows beyond those that a step could hold back, within which they must catch up.
const SPARE_ROWS: f64 = 8.0;
/// Part of a delay that late rows catch up at least.
const CAUGHT_UP: f64 = 0.5;

/// Rows with one time stamp.
#[derive(Debug, Clone, Copy)]
struct Group {
    /// The first row, from 0.
    row: u64,
    /// Its line.
    line: u64,
    /// The stamp, s.
    at_s: f64,
}

/// Missing rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gap {
    /// The row before which they are missing, from 0.
    pub row: u64,
    /// Its line.
    pub line: u64,
    /// Number of missing rows.
    pub missing: u64,
    /// Time from the row before to this one, s.
    pub step_s: f64,
}

/// Fit of a clock to its stamps.
#[derive(Debug, Clone)]
pub(super) struct ClockFit {
    /// The steady clock that fits best, over rows and missing rows.
    pub clock: Clock,
    /// RMS distance from it, s.
    pub jitter_s: f64,
    /// Missing rows, in order.
    pub gaps: Vec<Gap>,
}

/// Follows the clock of a whole file.
pub(super) fn follow(path: &Path, column: usize, unit_s: f64) -> Result<ClockFit, Fault> {
    let mut follower = Follower::default();
    rows(path, &[column], &mut |line, row| {
        follower
            .take(line, row[column] * unit_s)
            .map_err(|fault| fault.at(path).line(line))?;
        if follower.steps.is_none() && follower.has_enough() {
            follower.set_steps();
        }
        follower.judge(false).map_err(|fault| fault.at(path))?;
        Ok(true)
    })?;
    follower.finish().map_err(|fault| fault.at(path))
}

/// The period of a column by its first rows, in the column's own unit; `None` where it is no clock.
pub(crate) fn period(path: &Path, column: usize) -> Option<f64> {
    let mut follower = Follower::default();
    let mut is_clock = true;
    rows(path, &[], &mut |line, row| {
        is_clock = follower.take(line, row[column]).is_ok();
        Ok(is_clock && !follower.has_enough())
    })
    .ok()?;
    let steps = follower.set_steps().filter(|_| is_clock)?;
    Some(steps.period)
}

/// Step statistics of a clock, s.
#[derive(Debug, Clone, Copy)]
struct Steps {
    /// Time from row to row.
    period: f64,
    /// Shortest step that may be a gap.
    least_gap: f64,
    /// The first stamp that is that of its first row: a recording may begin within a packet.
    begin: usize,
}

impl Steps {
    /// By stretches of groups, most of which have no gap; `None` for a clock that does not move.
    fn of(groups: &VecDeque<Group>) -> Option<Self> {
        let last = groups.len().checked_sub(1).filter(|last| *last > 0)?;
        let is_coarse = (groups[last].row - groups[0].row) as f64 > COARSE * last as f64;
        let begin = usize::from(is_coarse && last > 1);
        let ends = (begin..last)
            .step_by((last - begin).div_ceil(STRETCHES))
            .chain([last]);
        let ends: Vec<Group> = ends.map(|end| groups[end]).collect();
        let period =
            |pair: &[Group]| (pair[1].at_s - pair[0].at_s) / (pair[1].row - pair[0].row) as f64;
        Some(Self::with(
            groups,
            median(ends.windows(2).map(period)),
            begin,
        ))
    }

    fn with(groups: &VecDeque<Group>, period: f64, begin: usize) -> Self {
        let late = groups.iter().zip(groups.iter().skip(1)).skip(begin);
        let spread = median(late.map(|(before, group)| group.late_s(before, period).abs()));
        let (least_s, least_samples) = LEAST_GAP;
        Self {
            period,
            least_gap: least_s
                .max(least_samples * period)
                .max(LEAST_SPREADS * spread),
            begin,
        }
    }
}

impl Group {
    /// By how much it comes later after another one than its rows take.
    fn late_s(&self, before: &Self, period_s: f64) -> f64 {
        self.at_s - before.at_s - (self.row - before.row) as f64 * period_s
    }
}

#[derive(Default)]
struct Follower {
    /// Stamps of which the first is judged, and the others not yet.
    queue: VecDeque<Group>,
    rows: u64,
    last_s: Option<f64>,
    steps: Option<Steps>,
    missing: u64,
    gaps: Vec<Gap>,
    fit: Fit,
}

impl Follower {
    /// Takes the time of a row.
    fn take(&mut self, line: u64, at_s: f64) -> Result<(), Fault> {
        if !at_s.is_finite() {
            return Err(Fault::new(
                "has a row without a time",
                "remove the row, or leave `clock` out and give `rate_hz`",
            ));
        }
        if let Some(before_s) = self.last_s.filter(|before_s| at_s < *before_s) {
            return Err(Fault::new(
                format!("the clock goes from {before_s} s to {at_s} s"),
                "sort the rows by time, or leave `clock` out and give `rate_hz`",
            ));
        }
        if self.last_s != Some(at_s) {
            let row = self.rows;
            self.queue.push_back(Group { row, line, at_s });
            self.last_s = Some(at_s);
        }
        self.rows += 1;
        Ok(())
    }

    fn has_enough(&self) -> bool {
        let (rows, stamps) = FIRST;
        self.rows >= rows && self.queue.len() >= stamps
    }

    /// Sets what the steps are like: by stretches first, then without the gaps that are seen with that.
    fn set_steps(&mut self) -> Option<Steps> {
        let mut steps = Steps::of(&self.queue)?;
        if steps.begin > 0 {
            self.queue.pop_front();
        }
        let (first, last) = (self.queue[0], self.queue[self.queue.len() - 1]);
        for _ in 0..2 {
            let missing = (1..self.queue.len()).filter_map(|at| self.missing_s(at, &steps, true));
            let rest_s = last.at_s - first.at_s - missing.sum::<f64>();
            if rest_s > 0.0 {
                steps = Steps::with(&self.queue, rest_s / (last.row - first.row) as f64, 0);
            }
        }
        self.steps = Some(steps);
        self.fit.take(first.row, first.at_s);
        self.steps
    }

    /// Time that is missing before a place of the queue, s; `None` where later rows must tell and are not
    /// there, though it is not the `end`.
    fn missing_s(&self, at: usize, steps: &Steps, end: bool) -> Option<f64> {
        let (before, group) = (&self.queue[at - 1], &self.queue[at]);
        let late_s = group.late_s(before, steps.period);
        if late_s + steps.period <= steps.least_gap {
            return Some(0.0);
        }
        if late_s > MAX_LATE.0.max(MAX_LATE.1 * steps.period) {
            return Some(late_s);
        }
        let reach = group.row + (late_s / steps.period + SPARE_ROWS) as u64;
        let behind = self.queue.range(at..).take_while(|next| next.row <= reach);
        let least_s = behind
            .map(|next| next.late_s(before, steps.period))
            .fold(late_s, f64::min);
        if least_s <= CAUGHT_UP * late_s {
            return Some(0.0);
        }
        (end || self.rows > reach).then_some(least_s)
    }

    /// Judges the stamps behind which enough rows are there, or all of them at the end.
    fn judge(&mut self, end: bool) -> Result<(), Fault> {
        let Some(steps) = self.steps else {
            return Ok(());
        };
        while self.queue.len() > 1 {
            let Some(missing_s) = self.missing_s(1, &steps, end) else {
                break;
            };
            let (before, group) = (self.queue[0], self.queue[1]);
            let missing = (missing_s / steps.period).round() as u64;
            if missing > 0 {
                let step_s = group.late_s(&before, steps.period) + steps.period;
                // A clock as slow as this is one in another unit.
                if missing_s > MAX_GAP_S && steps.period * RATES_HZ.0 <= 1.0 {
                    let what = format!("the clock jumps by {step_s:.3} s");
                    let remedy = "split the recording at the gap into two folders";
                    return Err(Fault::new(what, remedy).line(group.line));
                }
                let (row, line) = (group.row, group.line);
                self.gaps.push(Gap {
                    row,
                    line,
                    missing,
                    step_s,
                });
                self.missing += missing;
            }
            self.fit.take(group.row + self.missing, group.at_s);
            self.queue.pop_front();
        }
        Ok(())
    }

    fn finish(mut self) -> Result<ClockFit, Fault> {
        if self.rows < 2 {
            return Err(Fault::new("has fewer than two rows", remedy::TOO_LITTLE));
        }
        let Some(steps) = self.steps.or_else(|| self.set_steps()) else {
            return Err(Fault::new(
                "has a clock that does not move: all rows have the same time",
                "write time stamps with more digits, or leave `clock` out and give `rate_hz`",
            ));
        };
        self.judge(true)?;
        let (clock, jitter_s) = self.fit.fitted(steps.period);
        Ok(ClockFit {
            clock,
            jitter_s,
            gaps: self.gaps,
        })
    }
}

/// A regression of time on row, about running means.
#[derive(Default)]
struct Fit {
    count: u64,
    first_s: f64,
    means: (f64, f64),
    sums: (f64, f64, f64),
}

impl Fit {
    fn take(&mut self, row: u64, at_s: f64) {
        if self.count == 0 {
            self.first_s = at_s;
        }
        self.count += 1;
        let (x, y) = (row as f64, at_s - self.first_s);
        let share = 1.0 / self.count as f64;
        let (dx, dy) = (x - self.means.0, y - self.means.1);
        self.means.0 += share * dx;
        self.means.1 += share * dy;
        self.sums.0 += dx * (x - self.means.0);
        self.sums.1 += dx * (y - self.means.1);
        self.sums.2 += dy * (y - self.means.1);
    }

    /// The steady clock that fits best, and the RMS distance from it, s.
    fn fitted(&self, period_s: f64) -> (Clock, f64) {
        let (xx, xy, yy) = self.sums;
        let period_s = if xx > 0.0 { xy / xx } else { period_s };
        let clock = Clock {
            start_s: self.first_s + self.means.1 - period_s * self.means.0,
            rate_hz: 1.0 / period_s,
        };
        let rest = (yy - xy * period_s).max(0.0) / self.count.max(1) as f64;
        (clock, rest.sqrt())
    }
}

#[cfg(test)]
#[path = "clock_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(stamps: &[f64]) -> Result<ClockFit, String> {
        super::laws::seen(stamps.iter().copied())
    }

    fn noise(n: usize) -> f64 {
        let mixed = (n as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        ((mixed ^ (mixed >> 29)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn is_steady(stamps: &[f64], rate_hz: f64) {
        let seen = seen(stamps).expect("a clock");
        assert!(
            (seen.clock.rate_hz / rate_hz - 1.0).abs() < 0.003,
            "{} {rate_hz}",
            seen.clock.rate_hz
        );
        assert_eq!(seen.gaps, [], "{rate_hz}");
        assert!(seen.jitter_s < 3.0 / rate_hz, "{} s", seen.jitter_s);
    }

    #[test]
    fn rounded_stamps_and_packets_have_the_mean_rate() {
        for rate_hz in [100.0, 800.0, 1000.0, 3200.0] {
            let exact = |n: usize| n as f64 / rate_hz;
            for step_s in [0.001, 0.01, 0.1, 1.0] {
                let rounded: Vec<f64> = (0..12_000)
                    .map(|n| (exact(n) / step_s).round() * step_s)
                    .collect();
                let cut: Vec<f64> = (0..12_000)
                    .map(|n| (exact(n) / step_s).floor() * step_s)
                    .collect();
                is_steady(&rounded, rate_hz);
                is_steady(&cut, rate_hz);
            }
            for length in [3, 20, 40, 333] {
                let packets: Vec<f64> = (0..12_000).map(|n| exact(n / length * length)).collect();
                is_steady(&packets, rate_hz);
            }
        }
    }

    #[test]
    fn missing_rows_are_found_between_single_stamps_rounded_ones_and_packets() {
        let exact = |n: usize| n as f64 / 1000.0;
        type Stamp = Box<dyn Fn(usize) -> f64>;
        let stamps: [(&str, Stamp); 4] = [
            ("single", Box::new(exact)),
            ("jitter", Box::new(move |n| exact(n) + 2e-4 * noise(n))),
            (
                "rounded",
                Box::new(move |n| (exact(n) * 100.0).floor() / 100.0),
            ),
            ("packets", Box::new(move |n| exact(n / 20 * 20))),
        ];
        for (name, stamp) in stamps {
            let there =
                (0..9000).filter(|n| !(3000..3080).contains(n) && !(6000..6200).contains(n));
            let seen = seen(&there.map(stamp).collect::<Vec<f64>>()).expect("a clock");
            let missing: Vec<u64> = seen.gaps.iter().map(|gap| gap.missing).collect();
            assert_eq!(missing.len(), 2, "{name}: {missing:?}");
            assert!(
                missing[0].abs_diff(80) < 3 && missing[1].abs_diff(200) < 3,
                "{name}: {missing:?}"
            );
            assert!((seen.clock.rate_hz - 1000.0).abs() < 2.0, "{name}");
        }
    }

    #[test]
    fn rows_that_are_stamped_late_are_not_missing() {
        // Each stamp is that of its arrival, and none comes before the one in front of it.
        let mut last: f64 = 0.0;
        let late: Vec<f64> = (0..8000)
            .map(|n| {
                let stall = if n % 700 < 40 {
                    (40 - n % 700) as f64 / 1000.0
                } else {
                    0.0
                };
                last = last.max(n as f64 / 1000.0 + stall + 0.001 * noise(n));
                last
            })
            .collect();
        let seen = seen(&late).expect("a clock");
        assert_eq!(seen.gaps, []);
        assert!(
            (seen.clock.rate_hz - 1000.0).abs() < 3.0,
            "{}",
            seen.clock.rate_hz
        );
    }

    #[test]
    fn what_is_no_clock_is_refused() {
        assert!(
            seen(&[5.0; 100])
                .expect_err("still")
                .contains("does not move")
        );
        assert!(
            seen(&[0.0, 1.0, 0.5])
                .expect_err("back")
                .contains("goes from 1 s to 0.5 s")
        );
        let jump: Vec<f64> = (0..8000)
            .map(|n| f64::from(n) / 1000.0 + if n < 5000 { 0.0 } else { 2.0 })
            .collect();
        assert!(
            seen(&jump)
                .expect_err("a jump")
                .contains("jumps by 2.001 s")
        );
    }
}
