//! Latencies whose distribution is known: percentiles, verdicts, and the files of other tools.

use asperity_host::latency::{
    Counts, DistributionError, Interval, Limits, Punctuality, Run, Unit, Verdict,
    percentile_distribution, read_distribution,
};
use asperity_host::servo::Stage;

/// A run of a millisecond's period whose stages have these latencies, ns.
fn run_of(stages: &[(Stage, Vec<(u64, u64)>)], missed: u64) -> Run {
    let mut run = read_distribution("1\n", Stage::WakeUp, None, Unit::Us).expect("a latency");
    let mut counts: [Counts; Stage::ALL.len()] = Default::default();
    for (stage, own) in stages {
        counts[*stage as usize] = Counts(own.clone());
    }
    run.facts.ticks = stages[0].1.iter().map(|(_, count)| count).sum();
    run.facts.missed = missed;
    run.facts.period_ns = 1_000_000;
    run.intervals = vec![Interval {
        start_s: 0.0,
        length_s: 1.0,
        stages: counts,
    }];
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

/// Claim: the latencies of a file are those that its writer counted, whatever its format and unit.
#[test]
fn the_files_of_other_tools_hold_what_they_counted() {
    let counted = vec![(12_000, 900), (40_000, 90), (700_000, 9), (2_500_000, 1)];
    let run = run_of(&[(Stage::WakeUp, counted.clone())], 0);
    let histogram = run.raw(Stage::WakeUp);
    let hgrm = percentile_distribution(&histogram);
    let cyclictest = r#"{"thread": {"0": {"cycles": 1000, "max": 2500,
        "histogram": {"12": 900, "40": 90, "700": 9}}}}"#;
    let column = |scale: f64| -> String {
        let each = counted.iter().flat_map(|&(ns, count)| {
            let cell = format!("{}\n", ns as f64 * scale);
            std::iter::repeat_n(cell, count as usize)
        });
        each.collect()
    };
    let table = |heading: &str, scale: f64| {
        let rows = column(scale);
        let rows = rows.lines().enumerate();
        let rows: String = rows.map(|(n, cell)| format!("{n},{cell},7\n")).collect();
        format!("{heading}\n{rows}")
    };
    for (text, column, unit) in [
        (hgrm.as_str(), None, Unit::Us),
        (cyclictest, None, Unit::Ns),
        (&column(1.0), None, Unit::Ns),
        (&column(1e-3), None, Unit::Us),
        (&column(1e-6), None, Unit::Ms),
        (&format!("latency (µs)\n{}", column(1e-3)), None, Unit::Ms),
        (&table("period,wakeup_ns,read_ns", 1.0), None, Unit::Us),
        (&table("n,delay_ms,other", 1e-6), Some("delay_ms"), Unit::Us),
        (&table("n,delay,other", 1e-3), Some("delay"), Unit::Us),
    ] {
        let read = read_distribution(text, Stage::WakeUp, column, unit);
        let read = read.unwrap_or_else(|error| panic!("{error}: {:.60}", text));
        let own = read.raw(Stage::WakeUp);
        assert_eq!(own.len(), 1000);
        for quantile in [0.5, 0.9, 0.99, 0.999, 1.0] {
            let [a, b] = [&own, &histogram].map(|h| h.value_at_quantile(quantile) as f64);
            assert!(
                (a / b - 1.0).abs() < 2e-3,
                "{quantile}: {a} {b} in {:.40}",
                text
            );
        }
    }
}

#[test]
fn what_holds_no_latencies_is_refused_by_line_and_column() {
    let refused = |text: &str| read_distribution(text, Stage::WakeUp, None, Unit::Us);
    for (text, words) in [
        ("", "no latencies"),
        ("wakeup_ns\n", "no latencies"),
        ("{\"ticks\": 3}", "cyclictest --json"),
        ("a,b\n1,2\n", "not clear among: a, b"),
        ("wakeup_ns\n12\nlate\n", "line 3: \"late\""),
        ("wakeup_ns\n-1\n", "line 2: \"-1\""),
        (
            "Value Percentile TotalCount\n\n1.0 0.5 10\n2.0 1.0 9\n",
            "line 4",
        ),
    ] {
        let error = refused(text).expect_err(text);
        assert!(error.to_string().contains(words), "{text:?}: {error}");
    }
    assert!(matches!(refused(""), Err(DistributionError::Empty)));
}
