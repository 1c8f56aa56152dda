//! Runs the target of the fuzzer on a number of seeded cases: damaged assets whose checksums are
//! recomputed, so that the checks behind them are reached, and samples of any bits.
//! `ASPERITY_FUZZ_CASES` sets the number.

use asperity_formats::Numerator;
use asperity_tests::{
    draw::Draw,
    load_then_tick::{Outcome, load_then_tick},
    size::sized_or,
    texture::{TextureKind, random},
};

/// A small asset of a random kind, patched in a few places.
fn case(seed: u64) -> Vec<u8> {
    let mut draw = Draw::new(seed);
    let kind = TextureKind {
        ar_order: 1 + draw.below(24),
        ma_order: 1 + draw.below(24),
        numerator: [Numerator::None, Numerator::Nyquist, Numerator::Lsf][draw.below(3)],
        lattice: (2 + draw.below(4), 2 + draw.below(4)),
    };
    let mut texture = random(seed, kind);
    texture.traces.truncate(draw.below(4));
    let mut bytes = vec![1];
    bytes.extend(texture.encode());
    let interesting = [
        0.0_f32,
        -0.0,
        1e-45,
        1e-38,
        1e-20,
        1e-6,
        1.0,
        1e3,
        1e4,
        1e5,
        1e6,
        1e38,
        f32::NAN,
        f32::INFINITY,
        -1.0,
    ];
    for _ in 0..draw.below(5) {
        let at = 1 + draw.below(bytes.len() - 1);
        match draw.below(4) {
            0 => bytes[at] = draw.bits() as u8,
            1 => bytes[at] ^= 1 << draw.below(8),
            2 => bytes[at] = [0, 1, 2, 127, 128, 254, 255][draw.below(7)],
            _ => {
                let value = interesting[draw.below(interesting.len())].to_le_bytes();
                let at = at.min(bytes.len() - 4);
                bytes[at..at + 4].copy_from_slice(&value);
            }
        }
    }
    if draw.below(20) == 0 {
        bytes.truncate(draw.below(bytes.len()));
    }
    bytes
}

#[test]
fn load_then_tick_survives_seeded_damage() {
    let (mut refused, mut rendered) = (0_u64, 0_u64);
    let cases = sized_or("ASPERITY_FUZZ_CASES", "cases", 4000, 40_000) as u64;
    for seed in 0..cases {
        match load_then_tick(&case(seed)) {
            Outcome::Refused => refused += 1,
            Outcome::Rendered(_) => rendered += 1,
        }
    }
    println!("{cases} cases: {rendered} rendered, {refused} refused");
    // Some assets are refused and some are loaded.
    assert!(refused > cases / 10 && rendered > cases / 10);
}

#[test]
fn load_then_tick_survives_plain_noise() {
    for seed in 0..2000 {
        let mut draw = Draw::new(seed);
        let mut bytes: Vec<u8> = (0..draw.below(400)).map(|_| draw.bits() as u8).collect();
        if let Some(front) = bytes.get_mut(1..7) {
            front.copy_from_slice(b"ASPT\x01\0");
        }
        load_then_tick(&bytes);
    }
}
