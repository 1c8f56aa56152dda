//! The check of a recording names what people do wrong, and says nothing of what they do right.

use asperity::builtin;
use asperity_sim::bench;

/// Faulty and clean recordings, and the seconds of each: short ones in a plain run.
fn size() -> (usize, f64) {
    if cfg!(debug_assertions) {
        (100, 8.0)
    } else {
        (100, 20.0)
    }
}

#[test]
fn every_seeded_fault_is_named_and_no_clean_recording_raises_an_alarm() {
    let (count, seconds) = size();
    let checks = bench::checks(&[builtin::texture()], count, seconds, 11, || {})
        .expect("the built-in texture can be rendered");
    assert_eq!(
        (checks.named, checks.false_alarms.len()),
        (count, 0),
        "{:#?}\n{:#?}",
        checks.missed,
        checks.false_alarms
    );
}
