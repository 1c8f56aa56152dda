//! Clocks whose rates, gaps and delays are known.

use super::*;
use crate::test_recordings::near;

/// Fit of the clock to these stamps.
pub(super) fn seen(stamps: impl IntoIterator<Item = f64>) -> Result<ClockFit, String> {
    let mut follower = Follower::default();
    for (line, at_s) in (2..).zip(stamps) {
        follower
            .take(line, at_s)
            .map_err(|fault| fault.to_string())?;
        if follower.steps.is_none() && follower.has_enough() {
            follower.set_steps();
        }
        follower.judge(false).map_err(|fault| fault.to_string())?;
    }
    follower.finish().map_err(|fault| fault.to_string())
}

#[test]
fn a_regression_goes_through_a_line_and_tells_the_rms_distance_from_it() {
    let fitted = |points: &[(u64, f64)]| {
        let mut fit = Fit::default();
        points.iter().for_each(|(row, at_s)| fit.take(*row, *at_s));
        fit.fitted(0.5)
    };
    let (clock, rest) = fitted(&[(10, 101.0), (12, 101.5), (20, 103.5), (30, 106.0)]);
    near(clock.rate_hz, 4.0, 1e-9);
    near(clock.start_s, 98.5, 1e-9);
    near(rest, 0.0, 1e-6);
    // 0, 1, 2, 3 at 0, 1.1, 1.9, 3: slope 0.98, start 0.03; residuals ∓0.03, ±0.09.
    let (clock, rest) = fitted(&[(0, 5.0), (1, 6.1), (2, 6.9), (3, 8.0)]);
    near(1.0 / clock.rate_hz, 0.98, 1e-9);
    near(clock.start_s, 5.03, 1e-9);
    near(rest, ((2.0 * 0.0009 + 2.0 * 0.0081) / 4.0_f64).sqrt(), 1e-9);
    // A single stamp has the period that is known.
    let (clock, rest) = fitted(&[(4, 7.0)]);
    assert_eq!((clock.rate_hz, clock.start_s, rest), (2.0, 5.0, 0.0));
}

#[test]
fn a_steady_clock_has_its_rate_its_start_and_no_jitter() {
    for (rate_hz, count) in [(250.0, 3), (1000.0, 500), (1000.0, 9000)] {
        let found = seen((0..count).map(|n| 70.0 + f64::from(n) / rate_hz)).expect("a clock");
        near(found.clock.rate_hz, rate_hz, 1e-6 * rate_hz);
        near(found.clock.start_s, 70.0, 1e-7);
        near(found.jitter_s, 0.0, 1e-6);
        assert_eq!(found.gaps, []);
    }
}

/// Rows at 1 kHz, of which some are missing before a row.
fn with_gap(count: u32, at: u32, missing: u32) -> Vec<f64> {
    (0..count)
        .map(|n| f64::from(if n < at { n } else { n + missing }) / 1000.0)
        .collect()
}

#[test]
fn a_gap_is_told_with_its_row_its_line_its_length_and_its_step() {
    for (count, at, missing) in [(500, 200, 30), (9000, 7000, 30), (9000, 100, 400)] {
        let found = seen(with_gap(count, at, missing)).expect("a clock");
        let gap = Gap {
            row: u64::from(at),
            line: u64::from(at) + 2,
            missing: u64::from(missing),
            step_s: f64::from(missing + 1) / 1000.0,
        };
        assert_eq!(found.gaps.len(), 1);
        near(found.gaps[0].step_s, gap.step_s, 1e-6);
        assert_eq!(
            found.gaps,
            [Gap {
                step_s: found.gaps[0].step_s,
                ..gap
            }]
        );
        near(found.clock.rate_hz, 1000.0, 1e-3);
        near(found.jitter_s, 0.0, 1e-6);
    }
}

#[test]
fn less_than_five_milliseconds_is_no_gap_and_more_than_a_second_is_an_end() {
    let gaps = |missing| {
        seen(with_gap(9000, 6000, missing))
            .expect("a clock")
            .gaps
            .len()
    };
    assert_eq!((gaps(3), gaps(5), gaps(999)), (0, 1, 1));
    let error = seen(with_gap(9000, 6000, 1002)).expect_err("too long");
    assert!(error.contains("jumps by 1.003 s"), "{error}");
    // Of a slow clock three periods.
    let slow = |missing: u32| {
        let stamps = with_gap(300, 200, missing)
            .into_iter()
            .map(|at_s| 20.0 * at_s);
        seen(stamps).expect("a clock").gaps.len()
    };
    assert_eq!((slow(1), slow(3)), (0, 1));
}

#[test]
fn rows_that_catch_up_by_half_are_late_and_others_are_missing() {
    // From row 5000 on late by 40 ms, and by so much still 45 rows later.
    let with = |still: f64| {
        let stamps = (0..9000).map(|n| {
            let late = match n {
                5000..5010 => 0.04,
                5010.. => still,
                _ => 0.0,
            };
            f64::from(n) / 1000.0 + late
        });
        let mut last = 0.0_f64;
        let stamps: Vec<f64> = stamps
            .map(|at_s| {
                last = last.max(at_s);
                last
            })
            .collect();
        seen(stamps).expect("a clock").gaps
    };
    assert_eq!(with(0.019), []);
    let gaps = with(0.022);
    assert_eq!((gaps.len(), gaps[0].row, gaps[0].missing), (1, 5000, 22));
}

#[test]
fn steps_are_the_median_of_stretches_and_a_coarse_clock_begins_with_its_second_stamp() {
    let groups = |rows: &[u64], stamps: &[f64]| -> VecDeque<Group> {
        rows.iter()
            .zip(stamps)
            .map(|(row, at_s)| Group {
                row: *row,
                line: row + 2,
                at_s: *at_s,
            })
            .collect()
    };
    let fine = Steps::of(&groups(&[0, 1, 2, 3, 4], &[0.0, 0.25, 0.5, 0.75, 1.0])).expect("moves");
    assert_eq!((fine.period, fine.begin, fine.least_gap), (0.25, 0, 0.75));
    // Begun within a packet of four: its first stamp is that of no first row.
    let coarse =
        Steps::of(&groups(&[0, 1, 5, 9, 13], &[0.0, 0.25, 0.5, 0.75, 1.0])).expect("moves");
    assert_eq!((coarse.period, coarse.begin), (0.0625, 1));
    // Quicker than 600 Hz a gap has 5 ms; an uneven clock six of its median steps off.
    let rows: Vec<u64> = (0..40).collect();
    let quick: Vec<f64> = (0..40).map(|n| f64::from(n) / 1024.0).collect();
    assert_eq!(
        Steps::of(&groups(&rows, &quick)).expect("moves").least_gap,
        0.005
    );
    let uneven: Vec<f64> = (0..40)
        .map(|n| f64::from(n) / 1024.0 + f64::from(n as u32 % 2) / 512.0)
        .collect();
    let steps = Steps::with(&groups(&rows, &uneven), 1.0 / 1024.0, 0);
    near(steps.least_gap, 6.0 / 512.0, 1e-12);
    assert!(Steps::of(&groups(&[0], &[0.0])).is_none());
    assert!(Steps::of(&groups(&[], &[])).is_none());
}

#[test]
fn a_row_without_a_time_and_too_few_rows_are_refused() {
    assert!(
        seen([0.0, f64::NAN])
            .expect_err("none")
            .contains("without a time")
    );
    assert!(seen([0.0]).expect_err("one").contains("fewer than two"));
    assert!(seen([]).expect_err("none").contains("fewer than two"));
    assert!(seen([0.0, 0.01]).is_ok());
}

#[test]
fn a_file_tells_the_period_of_a_clock_and_none_of_what_goes_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.csv");
    let write = |stamp: &dyn Fn(u32) -> f64| {
        let mut table = String::from("t,x\n");
        for n in 0..300 {
            table += &format!("{:.4},{}\n", stamp(n), n % 7);
        }
        std::fs::write(&path, table).expect("written");
    };
    write(&|n| 5.0 * f64::from(n));
    near(period(&path, 0).expect("a clock"), 5.0, 1e-9);
    let found = follow(&path, 0, 1e-3).expect("a clock");
    near(found.clock.rate_hz, 200.0, 1e-6);
    write(&|n| f64::from(if n == 200 { 0 } else { n }));
    assert_eq!(period(&path, 0), None);
    assert_eq!(period(&path, 1), None);
    let error = follow(&path, 0, 1.0).expect_err("goes back");
    assert_eq!(error.line, Some(202));
    write(&|_| 5.0);
    assert_eq!(period(&path, 0), None);
}
