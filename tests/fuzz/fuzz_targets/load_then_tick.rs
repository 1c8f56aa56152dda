//! Any bytes as an asset, any numbers as samples:
//! `cargo +nightly fuzz run load_then_tick` in `tests/`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    asperity_tests::load_then_tick::load_then_tick(data);
});
