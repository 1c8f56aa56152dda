//! The check of a recording names what people do wrong, and says nothing of what they do right.

use asperity::builtin;
use asperity_experiments::import_accuracy;
use asperity_tests::size::sized;

#[test]
fn every_seeded_fault_is_named_and_no_clean_recording_raises_an_alarm() {
    let count = sized("faulty and clean recordings", 25, 100);
    let seconds = sized("seconds of each", 8.0, 20.0);
    let checks = import_accuracy::checks(&[builtin::texture()], count, seconds, 11, || {})
        .expect("the built-in texture can be rendered");
    assert_eq!(
        (checks.named, checks.false_alarms.len()),
        (count, 0),
        "{:#?}\n{:#?}",
        checks.missed,
        checks.false_alarms
    );
}
