//! Latencies whose distribution is known: percentiles and verdicts.

use asperity_host::latency::{Counts, Limits, Punctuality, Run, Verdict};
use asperity_host::servo::Stage;

/// A run of a millisecond's period whose stages have these latencies, ns.
fn run_of(stages: &[(Stage, Vec<(u64, u64)>)], missed: u64) -> Run {
    let mut run = Run::of_stage(Stage::WakeUp, Counts::default());
    for (stage, own) in stages {
        run.intervals[0].stages[*stage as usize] = Counts(own.clone());
    }
    run.facts.ticks = stages[0].1.iter().map(|(_, count)| count).sum();
    run.facts.missed = missed;
    run.facts.period_ns = 1_000_000;
    run.intervals[0].length_s = 1.0;
    run
}

/// Claim: of a known distribution every percentile is the known one, within three digits, and none
/// is stated that fewer values than one lie beyond.
#[test]
fn percentiles_are_those_of_the_distribution_and_none_that_the_count_does_not_carry() {
    for (count, carried) in [(999, 3), (1000, 4), (9726, 4), (10_000, 5), (100_000, 6)] {
        // 1 to `count` µs, once each.
        let values = (1..=count).map(|us| (1000 * us, 1)).collect();
        let run = run_of(&[(Stage::WakeUp, values)], 0);
        let percentiles = run.percentiles(Stage::WakeUp);
        let stated = percentiles.values();
        assert_eq!(stated.iter().flatten().count(), carried, "{count} ticks");
        let shares = [0.5, 0.9, 0.99, 0.999, 0.9999, 0.99999];
        for (share, ns) in shares.into_iter().zip(stated.into_iter().flatten()) {
            let expected = 1000.0 * (share * count as f64).ceil();
            let error = (ns as f64 - expected) / expected;
            assert!(error.abs() < 2e-3, "{count} ticks, {share}: {ns} ns");
        }
        assert_eq!(percentiles.p99_999.is_some(), count >= 100_000);
    }
}

/// Claim: a verdict is by the latest wake-up against a tenth of the period, by missed periods, and
/// by nothing that no limit states; a limit is exceeded by more than itself, not by itself.
#[test]
fn verdicts_are_those_of_the_rule_and_of_the_limits() {
    let none = Limits::default();
    for (latest_us, missed, expected) in [
        (99, 0, Punctuality::Punctual),
        (100, 0, Punctuality::Punctual),
        (101, 0, Punctuality::Late),
        (50, 1, Punctuality::Missed),
        (5000, 277, Punctuality::Missed),
    ] {
        let wakeups = vec![(20_000, 9726), (1000 * latest_us, 1)];
        let totals = vec![(30_000, 9726), (1000 * (latest_us + 8), 1)];
        let run = run_of(&[(Stage::WakeUp, wakeups), (Stage::Total, totals)], missed);
        let verdict = Verdict::on(&run, &none);
        assert_eq!(
            verdict.punctuality, expected,
            "{latest_us} µs, {missed} missed"
        );
        assert_eq!((verdict.missed, verdict.periods), (missed, 9727 + missed));
        assert!(verdict.exceeded.is_empty());
        let total_us = 1e-3 * verdict.longest_total_ns as f64;
        assert!((total_us / (latest_us + 8).max(30) as f64 - 1.0).abs() < 2e-3);
        let limits = |max_us, max_missed| Limits {
            max_us: Some(max_us),
            max_missed: Some(max_missed),
        };
        assert!(
            Verdict::on(&run, &limits(total_us, missed))
                .exceeded
                .is_empty()
        );
        let late = Verdict::on(&run, &limits(total_us - 0.1, missed)).exceeded;
        assert!(late.len() == 1 && late[0].contains("--max-us"), "{late:?}");
        if missed > 0 {
            let many = Verdict::on(&run, &limits(total_us, missed - 1)).exceeded;
            assert!(
                many.len() == 1 && many[0].contains("--max-missed"),
                "{many:?}"
            );
        }
    }
}
