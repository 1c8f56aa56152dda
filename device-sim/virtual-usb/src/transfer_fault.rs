//! Faults of a bus, at a rate.

use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A kind of transfer fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferFault {
    /// The endpoint halts: this and later transfers stall until it is cleared.
    Stall,
    /// A part of the bytes is transferred; the rest is lost.
    Short,
    /// No response until the transfer is cancelled.
    TimeOut,
    /// The device is unplugged, and plugged in again a little later.
    Unplug,
}

/// All faults, in the order of [`Rates::of`] and [`FaultCounts::of`].
pub const ALL: [TransferFault; 4] = [
    TransferFault::Stall,
    TransferFault::Short,
    TransferFault::TimeOut,
    TransferFault::Unplug,
];

/// Probability of each fault for a bulk transfer.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rates {
    /// In the order of [`ALL`].
    pub of: [f64; 4],
    /// Time for which a device stays unplugged, s.
    pub away_s: f64,
}

impl Rates {
    /// A mixture: of a hundred faults 45 stalls, 40 short transfers, 13 time-outs and 2 times
    /// unplugged for 0.1 s.
    #[must_use]
    pub fn mixed(rate: f64) -> Self {
        Self {
            of: [0.45, 0.40, 0.13, 0.02].map(|share| share * rate),
            away_s: 0.1,
        }
    }
}

/// Counts of injected faults.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FaultCounts {
    /// In the order of [`ALL`].
    pub of: [u64; 4],
    /// Bulk transfers that were tried.
    pub transfers: u64,
}

/// Draws faults.
#[derive(Debug, Clone)]
pub(super) struct Faults {
    pub(super) rates: Rates,
    rng: Xoshiro256PlusPlus,
    pub(super) counts: FaultCounts,
}

impl Faults {
    pub(super) fn new(rates: Rates, seed: u64) -> Self {
        Self {
            rates,
            rng: Xoshiro256PlusPlus::seed_from_u64(seed),
            counts: FaultCounts::default(),
        }
    }

    /// The fault of the next transfer, if any.
    pub(super) fn draw(&mut self) -> Option<TransferFault> {
        self.counts.transfers += 1;
        let mut left = self.unit();
        for (n, rate) in self.rates.of.into_iter().enumerate() {
            if left < rate {
                self.counts.of[n] += 1;
                return Some(ALL[n]);
            }
            left -= rate;
        }
        None
    }

    /// Returns the length of a short transfer, less than `bytes`.
    pub(super) fn part(&mut self, bytes: usize) -> usize {
        (self.unit() * bytes as f64) as usize
    }

    /// A number in 0..1, with the 53 bits that a double holds.
    fn unit(&mut self) -> f64 {
        (self.rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}
