//! The folders of `tests/cases` that are recordings: each does what its README says.

use asperity_recording::{
    check::{self, Severity},
    description::propose,
    reader,
};
use std::{
    fs,
    path::{Path, PathBuf},
};

fn case(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases");
    let path = path.join(name);
    assert!(path.exists(), "{} is missing", path.display());
    path
}

/// Every finding that is at least of this severity, or the refusal.
fn said(folder: &Path, least: Severity) -> Vec<String> {
    match reader::load(folder).and_then(|recording| check::check(&recording)) {
        Ok((checked, _)) => checked.at_least(least).map(ToString::to_string).collect(),
        Err(error) => vec![format!("{error} → {}", error.remedy())],
    }
}

fn proposed(folder: &str) -> String {
    propose(&case(folder)).unwrap().expect("a proposal")
}

#[test]
fn stamps_that_many_rows_share_are_a_clock_that_moves() {
    for folder in ["packets", "two_decimals"] {
        let said = said(&case("clock-coarse").join(folder), Severity::Fault);
        assert!(said.is_empty(), "{folder}: {said:?}");
    }
}

#[test]
fn dialects_of_csv_are_read_like_the_plain_one_and_a_column_twice_is_refused() {
    let folder = case("csv-dialects");
    let plain = said(&folder.join("plain"), Severity::Warning);
    for dialect in ["label", "comment", "hash_header"] {
        assert_eq!(
            said(&folder.join(dialect), Severity::Warning),
            plain,
            "{dialect}"
        );
    }
    let twice = said(&folder.join("dup"), Severity::Warning);
    assert!(
        twice.iter().any(|one| one.contains("\"x\" 2 times")),
        "{twice:?}"
    );
}

#[test]
fn a_channel_of_one_value_is_a_fault_by_its_name() {
    for (folder, file) in [("zero", "accel"), ("force", "force"), ("still", "position")] {
        let said = said(&case("dead-channel").join(folder), Severity::Fault);
        assert!(
            said.iter().any(|one| one.contains(file)),
            "{folder}: {said:?}"
        );
        for word in ["delay", "unit"] {
            assert!(
                !said.iter().any(|one| one.contains(word)),
                "{folder}: {said:?}"
            );
        }
    }
}

#[test]
fn a_proposal_takes_units_and_clocks_from_the_header_and_makes_no_position_up() {
    for (folder, clock, unit) in [
        ("brackets", "time [s]", "\"g\""),
        ("ms", "Time(ms)", "\"g\""),
        ("parentheses", "Time (s)", "m/s"),
        ("suffix", "time_ms", "mg"),
    ] {
        let proposal = proposed(&format!("proposal-units/{folder}"));
        let clock = format!("clock = \"{clock}\"");
        assert!(proposal.contains(&clock), "{folder}: {proposal}");
        assert!(proposal.contains(unit), "{folder}: {proposal}");
        let stated = |line: &&str| line.trim_start().starts_with("rate_hz");
        assert_eq!(proposal.lines().find(stated), None, "{folder}");
    }
    let proposal = proposed("proposal-halves-time/folder");
    assert!(proposal.contains("clock = \"Time (s)\""), "{proposal}");
}

/// Who states another rate beside the clock gets the factor.
#[test]
fn a_rate_that_disagrees_with_the_clock_is_refused_by_its_factor() {
    let folder = tempfile::tempdir().unwrap();
    let from = case("proposal-halves-time");
    fs::copy(from.join("folder/log.csv"), folder.path().join("log.csv")).unwrap();
    fs::copy(
        from.join("fixed.toml"),
        folder.path().join("recording.toml"),
    )
    .unwrap();
    let said = said(folder.path(), Severity::Fault);
    assert!(
        said.iter()
            .any(|one| one.contains("1000 Hz") && one.contains("factor of 2.0")),
        "{said:?}"
    );
}

#[test]
fn a_wav_of_64_bit_floats_is_read() {
    let said = said(&case("wav-float64").join("folder"), Severity::Fault);
    assert!(said.is_empty(), "{said:?}");
}
