//! Which clocks have the wrong unit, and where columns are.
#![allow(
    clippy::single_range_in_vec_init,
    reason = "a list of spans may have one"
)]

use super::*;
use crate::{
    description::{Axis, Quantity},
    test_recordings::{self, near},
};

/// Files with clocks of a rate and so many rows: which is refused, and by which factor.
fn refused(files: &[(f64, u64)]) -> Option<(String, f64)> {
    let channels = files.iter().enumerate().map(|(n, (rate_hz, _))| {
        let mut channel = test_recordings::channel(Quantity::Force, Axis::Z, *rate_hz, &[0.0, 1.0]);
        channel.file = format!("{n}.csv");
        channel
    });
    let mut recording = test_recordings::recording(channels.collect());
    let clocks = files
        .iter()
        .enumerate()
        .map(|(n, (rate_hz, rows))| FileClock {
            file: format!("{n}.csv"),
            stated_hz: None,
            clock_hz: Some(*rate_hz),
            jitter_s: 0.0,
            gaps: 0,
            first_gap: None,
            gap_s: 0.0,
            rows: *rows,
            shortened: false,
            remarks: Vec::new(),
        });
    recording.clocks = clocks.collect();
    let error = check_units(&recording, &recording.description.files).err()?;
    let file = error.file?.file_name()?.to_string_lossy().into_owned();
    let (slow, factor) = error.what.split_once(" by a factor of ")?;
    let factor: f64 = factor.parse().ok()?;
    let is_slow = slow.ends_with("too slow");
    Some((file, if is_slow { factor } else { 1.0 / factor }))
}

#[test]
fn one_file_has_the_wrong_unit_if_its_rate_is_that_of_no_sensor() {
    for right in [10.0, 100.0, 1000.0, 200_000.0] {
        assert_eq!(refused(&[(right, 5000)]), None, "{right}");
    }
    let of = |rate_hz: f64| refused(&[(rate_hz, 5000)]).map(|(_, factor)| factor);
    assert_eq!(of(9.9), Some(1e3));
    assert_eq!(of(1.0), Some(1e3));
    assert_eq!(of(0.001), Some(1e6));
    assert_eq!(of(1e6), Some(1e-3));
    assert_eq!(of(1e9), Some(1e-6));
    assert_eq!(of(1e12), Some(1e-9));
    assert_eq!(of(1e-6), Some(1e9));
    assert_eq!(of(201_000.0), Some(1e-3));
}

#[test]
fn of_two_files_the_one_with_the_stranger_rate_is_wrong_if_they_cover_other_times() {
    assert_eq!(refused(&[(1000.0, 10_000), (500.0, 5000)]), None);
    // Times that differ by less than three.
    assert_eq!(refused(&[(1000.0, 29_900), (1000.0, 10_000)]), None);
    assert_eq!(refused(&[(1000.0, 10_000), (1000.0, 29_900)]), None);
    let wrong = |name: &str, factor| Some((name.to_owned(), factor));
    assert_eq!(
        refused(&[(1.0, 10_000), (500.0, 5000)]),
        wrong("0.csv", 1e3)
    );
    assert_eq!(
        refused(&[(500.0, 5000), (1.0, 10_000)]),
        wrong("1.csv", 1e3)
    );
    assert_eq!(
        refused(&[(500.0, 5000), (1e6, 10_000)]),
        wrong("1.csv", 1e-3)
    );
    assert_eq!(
        refused(&[(500.0, 5000), (1000.0, 10_000), (1e9, 10_000)]),
        wrong("2.csv", 1e-6)
    );
    // Both cover the same time in a unit that no sensor has: that of both is right.
    assert_eq!(refused(&[(1.0, 100), (1.0, 100)]), None);
    // Other times, and rates that sensors have: nothing is known.
    assert_eq!(refused(&[(1000.0, 60_000), (1000.0, 10_000)]), None);
}

#[test]
fn drift_is_the_clock_over_the_stated_rate_in_parts_of_a_million() {
    let of = |clock_hz, stated_hz| {
        let clock = FileClock {
            file: String::new(),
            stated_hz,
            clock_hz,
            jitter_s: 0.0,
            gaps: 0,
            first_gap: None,
            gap_s: 0.0,
            rows: 0,
            shortened: false,
            remarks: Vec::new(),
        };
        clock.drift_ppm()
    };
    near(of(Some(1001.0), Some(1000.0)).expect("known"), 1000.0, 1e-6);
    near(of(Some(499.0), Some(500.0)).expect("known"), -2000.0, 1e-6);
    assert_eq!(of(None, Some(1.0)), None);
    assert_eq!(of(Some(1.0), None), None);
}

/// A recording of one file at 1 kHz by its header, with these keys and rows.
fn read(
    keys: &str,
    header: &str,
    rows: usize,
    row: impl Fn(usize) -> String,
    kept: usize,
) -> Result<Recording, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let toml = format!(
        "name = \"oak\"\n[[file]]\npath = \"a.csv\"\n{keys}\n[[file.channel]]\ncolumn = \"f\"\nquantity = \"force\"\naxis = \"z\"\nunit = \"mN\"\nscale = -2\nrange = [-500, 250]\n"
    );
    std::fs::write(folder.path().join("recording.toml"), toml).expect("written");
    let mut table = format!("{header}\n");
    for n in 0..rows {
        table += &row(n);
        table.push('\n');
    }
    std::fs::write(folder.path().join("a.csv"), table).expect("written");
    load_at_most(folder.path(), kept).map_err(|error| error.to_string())
}

#[test]
fn values_are_scaled_to_si_and_a_range_by_its_unit() {
    let found = read(
        "rate_hz = 1000\nstart_s = 2.5",
        "f,g",
        100,
        |n| format!("{n},7"),
        1000,
    )
    .expect("read");
    let channel = &found.channels[0];
    assert_eq!(channel.range, Some([-0.5, 0.25]));
    near(f64::from(channel.samples[30]), -0.06, 1e-6);
    assert_eq!(
        (channel.clock.start_s, channel.clock.rate_hz),
        (2.5, 1000.0)
    );
    let clock = &found.clocks[0];
    assert_eq!(
        (clock.rows, clock.shortened, clock.clock_hz),
        (100, false, None)
    );
    assert!(
        !read("rate_hz = 1000", "f,g", 100, |n| format!("{n},7"), 100)
            .expect("read")
            .clocks[0]
            .shortened
    );
    let short = read("rate_hz = 1000", "f,g", 101, |n| format!("{n},7"), 100).expect("read");
    assert!(short.clocks[0].shortened && short.channels[0].samples.len() == 100);
    let error = read("rate_hz = 1000", "f,g", 1, |_| "1,2".into(), 100).expect_err("short");
    assert!(error.contains("fewer than two rows"), "{error}");
    assert!(read("rate_hz = 1000", "f,g", 2, |_| "1,2".into(), 100).is_ok());
}

#[test]
fn a_stated_rate_may_differ_from_the_clock_by_two_percent() {
    let of = |percent: f64| {
        let period = 1.0 / (1000.0 * (1.0 + 0.01 * percent));
        read(
            "clock = \"t\"\nrate_hz = 1000",
            "t,f",
            500,
            |n| format!("{:.9},{n}", n as f64 * period),
            9999,
        )
    };
    assert!(of(1.9).is_ok() && of(-1.9).is_ok());
    for percent in [2.1, -2.1] {
        let error = of(percent).expect_err("off");
        assert!(error.contains("recording.toml:2"), "{error}");
    }
}

#[test]
fn a_clock_that_is_not_used_must_run_at_the_stated_rate_in_some_unit() {
    let of = |rate_hz: f64, unit: f64| {
        read(
            "rate_hz = 1000",
            "time,f",
            500,
            |n| format!("{:.6},{n}", n as f64 / rate_hz / unit),
            9999,
        )
    };
    for unit in [1.0, 1e-3, 1e-6] {
        assert!(of(1000.0, unit).is_ok());
        assert!(of(1019.0, unit).is_ok());
        let error = of(1030.0, unit).expect_err("another rate");
        assert!(error.contains("time") && error.contains("1030"), "{error}");
    }
    assert!(of(500.0, 1.0).is_err());
}

#[test]
fn rows_that_are_missing_are_held_and_counted() {
    let skip = |n: usize| if n < 200 { n } else { n + 50 };
    let row = |n: usize| format!("{:.3},{}", skip(n) as f64 / 1000.0, n % 10);
    let found = read("clock = \"t\"", "t,f", 500, row, 9999).expect("read");
    let channel = &found.channels[0];
    assert_eq!((channel.samples.len(), channel.numbers.count), (550, 550));
    assert_eq!(channel.numbers.missing_spans, [200..250]);
    assert!(
        channel.samples[199..250]
            .iter()
            .all(|x| *x == channel.samples[199])
    );
    near(f64::from(channel.samples[250]), 0.0, 1e-9);
    near(f64::from(channel.samples[251]), -0.002, 1e-9);
    let clock = &found.clocks[0];
    assert_eq!(
        (clock.gaps, clock.first_gap, clock.rows),
        (1, Some(202), 500)
    );
    near(clock.gap_s, 0.051, 1e-6);
    // Only as much is held as is kept.
    assert_eq!(
        read("clock = \"t\"", "t,f", 500, row, 220)
            .expect("read")
            .channels[0]
            .samples
            .len(),
        220
    );
}
