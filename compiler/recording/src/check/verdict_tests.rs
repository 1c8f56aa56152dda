//! Wording of findings, and those that count for a channel.

use super::*;

fn finding(file: &str, channel: &str, kind: FindingKind, severity: Severity) -> Finding {
    Finding::of_channel(file, channel, kind, severity, "it is so".into(), "do this")
}

fn checked(findings: Vec<Finding>) -> Checked {
    Checked {
        findings,
        late_s: vec![("a".into(), 0.01), ("b".into(), -0.02)],
        channels: [("a", "x"), ("a", "y"), ("b", "x")]
            .map(|(f, c)| (f.into(), c.into()))
            .to_vec(),
        good_s: 1.0,
        contact_s: 2.0,
        duration_s: 3.0,
    }
}

/// Verdicts on the channels a x, a y and b x.
fn verdicts(findings: Vec<Finding>) -> Vec<String> {
    let text = checked(findings).to_string();
    let lines = text.lines().skip(1).take(3);
    lines
        .map(|line| line[4..].trim_start_matches(['x', 'y']).trim().to_owned())
        .collect()
}

#[test]
fn a_channel_is_as_bad_as_the_worst_of_its_own_and_of_its_files_findings() {
    use Severity::{Fault, Good, Note, Warning};
    let of = |file, channel, severity| finding(file, channel, FindingKind::Hum, severity);
    assert_eq!(verdicts(vec![]), ["good"; 3]);
    assert_eq!(
        verdicts(vec![of("a", "x", Note), of("b", "x", Good)]),
        ["good"; 3]
    );
    assert_eq!(
        verdicts(vec![of("a", "x", Warning)]),
        ["usable with care", "good", "good"]
    );
    assert_eq!(
        verdicts(vec![of("a", "", Warning), of("a", "y", Fault)]),
        ["usable with care", "faulty", "good"]
    );
    let dead = finding("a", "y", FindingKind::Dead, Note);
    assert_eq!(verdicts(vec![dead]), ["good", "does not move", "good"]);
    assert_eq!(verdicts(vec![of("a", "y", Note)]), ["good"; 3]);
}

#[test]
fn a_finding_names_its_place_and_a_remedy_unless_all_is_good() {
    let text =
        |file, channel, severity| finding(file, channel, FindingKind::Hum, severity).to_string();
    assert_eq!(text("a", "x", Severity::Good), "good     a, x: it is so");
    assert_eq!(
        text("", "x", Severity::Note),
        "note     x: it is so\n         → do this"
    );
    assert_eq!(
        text("a", "", Severity::Warning),
        "warning  a: it is so\n         → do this"
    );
    assert!(text("a", "x", Severity::Fault).starts_with("FAULT    a, x"));
}

#[test]
fn the_worst_the_stopping_and_the_late_are_picked() {
    assert_eq!(checked(vec![]).worst(), Severity::Good);
    let kinds = [
        (FindingKind::Unit, true),
        (FindingKind::Contact, true),
        (FindingKind::Impossible, true),
        (FindingKind::Dead, true),
        (FindingKind::Mislabelled, true),
        (FindingKind::Clipping, false),
        (FindingKind::DropOut, false),
        (FindingKind::Delay, false),
    ];
    for (kind, stops) in kinds {
        let fault = checked(vec![finding("a", "x", kind, Severity::Fault)]);
        assert_eq!(fault.stopping().count() == 1, stops, "{kind:?}");
        let warning = checked(vec![
            finding("a", "x", kind, Severity::Warning),
            finding("a", "x", kind, Severity::Note),
        ]);
        assert_eq!(warning.stopping().count(), 0);
        assert_eq!(warning.worst(), Severity::Warning);
        assert_eq!(warning.at_least(Severity::Warning).count(), 1);
        assert_eq!(warning.at_least(Severity::Note).count(), 2);
    }
    let late = checked(vec![]);
    assert_eq!(
        ["a", "b", "c"].map(|file| late.late_of(file)),
        [0.01, -0.02, 0.0]
    );
}
