//! FNV-1a over the bits of outputs.

use asperity_runtime::{Counters, Output, RenderArithmetic, arithmetic::Scalar};

/// A 64-bit FNV-1a hash under way, taken a word at a time.
#[derive(Debug, Clone, Copy)]
pub struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        Self::new()
    }
}

impl Hash {
    /// Returns the hash of no outputs.
    #[must_use]
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// The hash so far.
    #[must_use]
    pub const fn value(&self) -> u64 {
        self.0
    }

    fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
    }

    /// Takes in every bit of an output.
    pub fn output<A: RenderArithmetic>(&mut self, output: &Output<A>) {
        let Output {
            force_n: [x, y, z],
            depth_m,
            speed_mm_s,
            normal_force_n,
            vib_m_s2,
            tap_n,
            friction_n,
            flags,
        } = *output;
        for force in [x, y, z, normal_force_n, tap_n, friction_n] {
            self.word(force.bits());
        }
        for bits in [depth_m.bits(), speed_mm_s.bits(), vib_m_s2.bits()] {
            self.word(bits);
        }
        self.word(u32::from(flags.bits()));
    }

    /// Takes in every counter.
    pub fn counters(&mut self, counters: &Counters) {
        let Counters {
            ticks,
            bad_samples,
            missed_ticks,
            faults,
            taps,
            peak_limited,
            slew_limited,
        } = *counters;
        for count in [
            ticks,
            bad_samples,
            missed_ticks,
            faults,
            taps,
            peak_limited,
            slew_limited,
        ] {
            self.word(count);
        }
    }
}
