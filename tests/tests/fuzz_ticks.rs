//! A short run of the fuzzed ticks. `.ci/full` has a longer one, and the command `fuzz-ticks` runs
//! any number.

use asperity_runtime::{Fixed, Float, RenderArithmetic};
use asperity_tests::fuzz_ticks::{Summary, fuzz_ticks};

#[test]
fn fuzzed_ticks_keep_the_law_and_reach_what_they_are_for() {
    fuzz::<Float>();
}

/// Under debug assertions a number out of range panics.
#[test]
fn fuzzed_ticks_in_fixed_point_do_so_without_overflow() {
    fuzz::<Fixed>();
}

fn fuzz<A: RenderArithmetic>() {
    let summary = fuzz_ticks::<A>(1, 300_000);
    let Summary {
        ticks,
        swaps,
        contacts,
        taps,
        faults,
        limited,
        hash,
    } = summary;
    assert_eq!(ticks, 300_000);
    // The run reaches everything that the fuzzer looks for.
    assert!(swaps > 500 && contacts > ticks / 20, "{summary:?}");
    assert!(
        taps > 50 && faults > 1000 && limited > 10_000,
        "{summary:?}"
    );
    assert_eq!(
        fuzz_ticks::<A>(1, 300_000).hash,
        hash,
        "the same ticks again"
    );
    assert_ne!(fuzz_ticks::<A>(2, 300_000).hash, hash, "other ticks");
}
