//! Files of other tools, whose latencies are known.

use super::{ForeignError, Unit, read_foreign};
use asperity_host::latency::{Counts, Run, percentile_distribution};
use asperity_host::servo::Stage;
use asperity_io::diagnostic::Diagnostic as _;

/// Claim: the latencies of a file are those that its writer counted, whatever its format and unit.
#[test]
fn the_files_of_other_tools_hold_what_they_counted() {
    let counted = vec![(12_000, 900), (40_000, 90), (700_000, 9), (2_500_000, 1)];
    let histogram = Run::of_stage(Stage::WakeUp, Counts(counted.clone())).raw(Stage::WakeUp);
    let hgrm = percentile_distribution(&histogram);
    let cyclictest = r#"{"thread": {"0": {"cycles": 1000, "max": 2500,
        "histogram": {"12": 900, "40": 90, "700": 9}}}}"#;
    let with_n = r#"{"resolution_in_ns": 1, "thread": {"0": {"cycles": 1000, "max": 2500000,
        "histogram": {"12000": 900, "40000": 90, "700000": 9}}}}"#;
    let printed = "# /dev/cpu_dma_latency set to 0us\n# Histogram\n000012 000500\t000400\t000900\n\
        000040 000090\t000000\t000090\n000700 000000\t000009\t000009\n# Total: 000000590 000000409\n\
        # Max Latencies: 00040 02500 02500\n# Histogram Overflows: 00000 00001 00001\n# Thread 0:\n";
    let rtla = "# RTLA timerlat histogram\n# Time unit is microseconds (us)\nIndex   IRQ-000   Thr-000   Thr-001\n\
        12 1000 500 400\n40 0 90 -\n700 0 9 0\nover: 0 0 1\ncount: 1000 599 401\nmin: 12 12 12\n\
        max: 12 700 2500\nALL: IRQ Thr\ncount: 1000 1000\n";
    let hgrm_csv = "\"Value\",\"Percentile\",\"TotalCount\",\"1/(1-Percentile)\"\n12,0.9,900,10\n40,0.99,990,100\n\
        700,0.999,999,1000\n2500,1,1000,Infinity\n";
    let wrk2 = format!(
        "Running 30s test @ http://x\n  Thread Stats   Avg\n  Detailed Percentile spectrum:\n{}#[Mean = 1]\n---\n  \
         Detailed Percentile spectrum:\n       Value   Percentile\n 9 0.5 9 9\n",
        hgrm_csv
            .replace("12,", "0.012,")
            .replace("40,", "0.04,")
            .replace("\n700,", "\n0.7,")
            .replace("2500,", "2.5,")
    );
    let weighted = "latency_us,count\n12,900\n40,90\n700,9\n2500,1\n";
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
        (
            &format!("{hgrm}[Info] #[Mean = 1, x = 2]\n"),
            None,
            Unit::Us,
        ),
        (hgrm_csv, None, Unit::Us),
        (&wrk2, None, Unit::S),
        (cyclictest, None, Unit::Ns),
        (with_n, None, Unit::Us),
        (printed, None, Unit::Us),
        (rtla, None, Unit::Ms),
        (weighted, Some("latency"), Unit::Ms),
        (&column(1.0), None, Unit::Ns),
        (&column(1e-3), None, Unit::Us),
        (&column(1e-6), None, Unit::Ms),
        (&format!("latency (µs)\n{}", column(1e-3)), None, Unit::Ms),
        (&column(1e-9), None, Unit::S),
        (
            &format!("# a log\n\"Latency (MS)\"\n{}", column(1e-6)),
            None,
            Unit::S,
        ),
        (
            &format!("\u{feff}latency_Seconds\r\n{}", column(1e-9)),
            None,
            Unit::Us,
        ),
        (&table("period,wakeup_ns,read_ns", 1.0), None, Unit::Us),
        (
            &table("\"period\",\"wakeup_ns\",\"read_ns\"", 1.0),
            None,
            Unit::Us,
        ),
        (&table("period,Wakeup [msec],read", 1e-6), None, Unit::Us),
        (&table("count,wakeup_us,read_us", 1e-3), None, Unit::Ns),
        (&table("n,latencyNs,other", 1.0), Some("latency"), Unit::Us),
        (
            &table("n;delay;other", 1e-3).replace(',', ";"),
            Some("delay"),
            Unit::Us,
        ),
        (
            &table("n;delay_ms;other", 1e-6)
                .replace(',', ";")
                .replace('.', ","),
            Some("delay_ms"),
            Unit::Us,
        ),
        (
            &table("n;wakeup;other\n-;[ms];-", 1e-6).replace(',', ";"),
            None,
            Unit::Us,
        ),
        (
            &table("Logger 3\nat: desk\n\nn,wakeup us,other", 1e-3),
            None,
            Unit::Ns,
        ),
        (
            &table("n wakeup_us other", 1e-3).replace(',', "  "),
            None,
            Unit::Ns,
        ),
        (
            &table("n,wakeup,other", 1e-6).replace(",7", " ms,7"),
            None,
            Unit::Ns,
        ),
        (
            &table("n\tdelay_ms\tother", 1e-6).replace(',', "\t"),
            Some("delay_ms"),
            Unit::Us,
        ),
        (&table("n,delay_ms,other", 1e-6), Some("delay_ms"), Unit::Us),
        (&table("n,delay,other", 1e-3), Some("delay"), Unit::Us),
    ] {
        let read = read_foreign(text, Stage::WakeUp, column, Some(unit));
        let read = read.unwrap_or_else(|error| panic!("{error}: {:.60}", text));
        let own = read.run.raw(Stage::WakeUp);
        assert_eq!(own.len(), 1000, "{text:.60}");
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
    let refused = |text: &str| {
        let read = read_foreign(text, Stage::WakeUp, None, None);
        read.expect_err(text)
    };
    for (text, words) in [
        ("", "no latencies"),
        ("wakeup_ns\n", "no latencies"),
        ("{\"ticks\": 3}", "cyclictest --json"),
        ("{\"longest_gap_ns\": 3}", "run.json"),
        ("a,b\n1,2\n", "not clear among: a, b"),
        ("wakeup_ns\n12\nlate\n", "line 3: \"late\""),
        ("wakeup_ns\n-1\n", "line 2: \"-1\""),
        ("wakeup_ns\n1\ninf\n", "line 3: \"inf\""),
        ("wakeup_s\n1e300\n", "line 2: "),
        (
            "wakeup_ns\n1,5\n",
            "line 2 begins with numbers that commas separate",
        ),
        ("wakeup_us\n\"26,441\"\n", "line 2: \"26,441\""),
        ("wakeup_cycles\n1\n", "`cycles`"),
        ("wakeup [100ns]\n1\n", "`100ns`"),
        ("wakeup (100 ns)\n1\n", "`100 ns`"),
        ("wakeup_ns\n0.2\n0.3\n", "below 1 ns"),
        (
            "stage,kind,percentile,value_ns\nwakeup,raw,50,9\n",
            "percentiles",
        ),
        ("percentile,wakeup_us\n50,23\n99,31\n", "percentiles"),
        ("p99_us\n50\n", "percentiles"),
        (
            "Value Percentile TotalCount\n\n1.0 0.5 10\n2.0 1.0 9\n",
            "line 4",
        ),
        (
            "Value Percentile TotalCount\n\n2.0 0.5 10\n1.0 1.0 19\n",
            "line 4",
        ),
        (
            "Value Percentile TotalCount\n1.0 1.0 99999999999999999\n",
            "counts more",
        ),
        (
            "#[Histogram log format version 1.3]\n0,1,2,HISTFAAA\n",
            "another HdrHistogram",
        ),
        (
            "# /dev/cpu_dma_latency set to 0us\nT: 0 ( 9) P:80 I:1000\n",
            "without a histogram",
        ),
        ("# RTLA osnoise histogram\nIndex CPU-000\n0 1\n", "rtla"),
        (
            "# Histogram\n000001 000001\n# Max Latencies: 00090\n# Histogram Overflows: 00001\n",
            "1 of 2",
        ),
        ("# Histogram\n000001 x\n", "line 2"),
        (
            r#"{"thread":{"0":{"histogram":{},"cycles":2,"max":3}}}"#,
            "no histogram",
        ),
        (
            r#"{"thread":{"0":{"histogram":{"1":1},"cycles":9,"max":3}}}"#,
            "8 of 9",
        ),
        (
            r#"{"thread":{"0":{"histogram":{"18446744073709551615":1},"cycles":1,"max":3}}}"#,
            "too large",
        ),
    ] {
        let error = refused(text);
        assert!(error.to_string().contains(words), "{text:?}: {error}");
        assert!(!error.remedy().is_empty());
    }
    assert!(matches!(refused(""), ForeignError::Empty));
    let table = "stage,kind,percentile,value_ns\nwakeup,raw,50,9\n";
    let named = read_foreign(table, Stage::WakeUp, Some("value_ns"), None);
    assert!(
        matches!(named, Err(ForeignError::NotRead { .. })),
        "{named:?}"
    );
}

#[test]
fn a_count_beside_latencies_weighs_a_histogram_alone() {
    let total = |text: &str| {
        let read = read_foreign(text, Stage::WakeUp, Some("wakeup"), None).expect(text);
        read.run.raw(Stage::WakeUp).len()
    };
    assert_eq!(total("wakeup_us,count\n10,5\n20,9\n30,1\n"), 15);
    // A line's number, and a count of something else: the latencies come as they were measured.
    assert_eq!(total("wakeup_us,count\n10,1\n20,2\n30,3\n"), 3);
    assert_eq!(total("wakeup_us,count\n10,7\n30,7\n20,7\n"), 3);
}

#[test]
fn what_a_reader_must_know_is_noted() {
    let notes = |text: &str, unit| {
        read_foreign(text, Stage::WakeUp, None, unit)
            .expect(text)
            .notes
    };
    assert!(notes("1\n2\n", None)[0].contains("no unit"));
    assert_eq!(notes("1\n2\n", Some(Unit::Ms)), [""; 0]);
    assert_eq!(notes("wakeup_ns\n1\n2\n", None), [""; 0]);
    let beyond = r#"{"thread":{"0":{"histogram":{"9":999},"cycles":1000,"max":30}}}"#;
    assert!(notes(beyond, None)[0].starts_with("1 of 1000"));
}
