//! Flags of a tick, and counters of them since the state was created.

/// Events of a tick, as a bit set.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct Flags(u32);

impl Flags {
    /// The stylus is inside the surface.
    pub const CONTACT: Self = Self(1);
    /// A tap transient started.
    pub const TAP_STARTED: Self = Self(1 << 1);
    /// A tap transient is under way.
    pub const TAP_ACTIVE: Self = Self(1 << 2);
    /// Speed or force lie outside the grid; an edge model answers.
    pub const OUTSIDE_GRID: Self = Self(1 << 3);
    /// The force was cut to the device's peak.
    pub const PEAK_LIMITED: Self = Self(1 << 4);
    /// The force was held back by the slew limit.
    pub const SLEW_LIMITED: Self = Self(1 << 5);
    /// A bad sample; the last good one was held.
    pub const HELD_SAMPLE: Self = Self(1 << 6);
    /// The safe state: the force goes to zero.
    pub const SAFE_STATE: Self = Self(1 << 7);
    /// The force comes back after a fault.
    pub const RAMPING: Self = Self(1 << 8);
    /// The vibration reached its bound; a verified texture never does.
    pub const VIB_CLAMPED: Self = Self(1 << 9);

    // What the stages tell each other, above the bits that callers see.
    /// Motion starts anew.
    pub(crate) const RESTART: Self = Self(1 << 16);
    /// The sample was bad.
    pub(crate) const BAD_SAMPLE: Self = Self(1 << 17);
    /// The safe state was entered.
    pub(crate) const FAULT: Self = Self(1 << 18);
    /// No flag.
    pub(crate) const NONE: Self = Self(0);
    /// The force is let through in part, or not at all.
    pub(crate) const LOWERED: Self = Self::SAFE_STATE.union(Self::RAMPING);
    /// Flags that [`Counters`] count.
    const COUNTED: Self = Self::RARE.union(Self::PEAK_LIMITED);
    /// The counted flags that seldom occur.
    const RARE: Self = Self::BAD_SAMPLE
        .union(Self::FAULT)
        .union(Self::TAP_STARTED)
        .union(Self::SLEW_LIMITED);

    /// Every flag with its name.
    pub const ALL: [(Self, &'static str); 10] = [
        (Self::CONTACT, "contact"),
        (Self::TAP_STARTED, "tap_started"),
        (Self::TAP_ACTIVE, "tap_active"),
        (Self::OUTSIDE_GRID, "outside_grid"),
        (Self::PEAK_LIMITED, "peak_limited"),
        (Self::SLEW_LIMITED, "slew_limited"),
        (Self::HELD_SAMPLE, "held_sample"),
        (Self::SAFE_STATE, "safe_state"),
        (Self::RAMPING, "ramping"),
        (Self::VIB_CLAMPED, "vib_clamped"),
    ];

    /// The bits, as `render` prints them.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.0 as u16
    }

    /// Returns true if every bit of `other` is set.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The bits of either.
    #[inline(always)]
    pub(crate) const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// These flags where `set`, else none.
    #[inline(always)]
    pub(crate) const fn when(self, set: bool) -> Self {
        Self(if set { self.0 } else { 0 })
    }

    /// The flags that callers see.
    #[inline(always)]
    pub(crate) const fn seen(self) -> Self {
        Self(self.0 & 0xffff)
    }

    /// The bits of both.
    #[inline(always)]
    pub(crate) const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Returns true if any bit of `other` is set.
    #[inline(always)]
    pub(crate) const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

/// Counts of what happened since the state was made. They saturate.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Ticks.
    pub ticks: u32,
    /// Bad samples: stale, not finite, out of reach.
    pub bad_samples: u32,
    /// Servo periods that the caller reported as missed.
    pub missed_ticks: u32,
    /// Times the safe state was entered.
    pub faults: u32,
    /// Taps.
    pub taps: u32,
    /// Ticks whose force was cut to the peak.
    pub peak_limited: u32,
    /// Ticks whose force was held back by the slew limit.
    pub slew_limited: u32,
}

impl Counters {
    /// Counts a tick.
    #[inline(always)]
    pub(crate) fn count(&mut self, flags: Flags, elapsed_ticks: u32) {
        if elapsed_ticks > 1 {
            self.missed_ticks = self.missed_ticks.saturating_add(elapsed_ticks - 1);
        }
        // The other counts never exceed the count of ticks, so all stop with it.
        if self.ticks == u32::MAX {
            return;
        }
        self.ticks += 1;
        if !flags.intersects(Flags::COUNTED) {
            return;
        }
        // The most frequent flag first.
        if flags.intersects(Flags::PEAK_LIMITED) {
            self.peak_limited = self.peak_limited.wrapping_add(1);
        }
        if !flags.intersects(Flags::RARE) {
            return;
        }
        if flags.intersects(Flags::SLEW_LIMITED) {
            self.slew_limited = self.slew_limited.wrapping_add(1);
        }
        if flags.intersects(Flags::BAD_SAMPLE) {
            self.bad_samples = self.bad_samples.wrapping_add(1);
        }
        if flags.intersects(Flags::FAULT) {
            self.faults = self.faults.wrapping_add(1);
        }
        if flags.intersects(Flags::TAP_STARTED) {
            self.taps = self.taps.wrapping_add(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_flags_obey_the_laws_of_sets() {
        let (a, b, c) = (Flags::CONTACT, Flags::RAMPING, Flags::FAULT);
        let ab = a.union(b);
        assert!(ab.contains(a) && ab.contains(b) && !ab.contains(c) && !a.contains(ab));
        assert!(ab.intersects(a) && ab.intersects(b.union(c)) && !ab.intersects(c));
        assert!(!ab.intersects(Flags::NONE) && !Flags::NONE.intersects(ab));
        assert_eq!(ab.union(a), ab);
        assert_eq!(ab.intersection(b.union(c)), b);
        assert_eq!(ab.intersection(c), Flags::NONE);
        assert_eq!(ab.when(true), ab);
        assert_eq!(ab.when(false), Flags::NONE);
        assert_eq!(Flags::LOWERED, Flags::SAFE_STATE.union(Flags::RAMPING));
    }

    #[test]
    fn what_stages_tell_each_other_is_not_seen() {
        for inner in [Flags::RESTART, Flags::BAD_SAMPLE, Flags::FAULT] {
            assert_eq!((inner.seen(), inner.bits()), (Flags::NONE, 0));
            for (seen, _) in Flags::ALL {
                assert_eq!(seen.union(inner).seen(), seen);
                assert!(!seen.intersects(inner));
            }
        }
    }

    /// Each flag by itself, and together.
    #[test]
    fn each_flag_counts_in_its_own_counter_alone() {
        let of = |flags: Flags, elapsed_ticks: u32| {
            let mut counters = Counters::default();
            counters.count(flags, elapsed_ticks);
            counters
        };
        let one = Counters {
            ticks: 1,
            ..Counters::default()
        };
        for (flag, counted) in [
            (Flags::NONE, one),
            (Flags::CONTACT.union(Flags::TAP_ACTIVE), one),
            (Flags::HELD_SAMPLE.union(Flags::SAFE_STATE), one),
            (
                Flags::BAD_SAMPLE,
                Counters {
                    bad_samples: 1,
                    ..one
                },
            ),
            (Flags::FAULT, Counters { faults: 1, ..one }),
            (Flags::TAP_STARTED, Counters { taps: 1, ..one }),
            (
                Flags::PEAK_LIMITED,
                Counters {
                    peak_limited: 1,
                    ..one
                },
            ),
            (
                Flags::SLEW_LIMITED,
                Counters {
                    slew_limited: 1,
                    ..one
                },
            ),
        ] {
            assert_eq!(of(flag, 1), counted, "{flag:?}");
            assert_eq!(of(flag, 0), counted, "{flag:?}");
        }
        let all = Flags::COUNTED.union(Flags::CONTACT);
        let counted = Counters {
            ticks: 1,
            bad_samples: 1,
            missed_ticks: 4,
            faults: 1,
            taps: 1,
            peak_limited: 1,
            slew_limited: 1,
        };
        assert_eq!(of(all, 5), counted);
    }

    #[test]
    fn full_counters_stay_full() {
        let mut counters = Counters {
            ticks: u32::MAX - 1,
            missed_ticks: u32::MAX - 1,
            faults: 7,
            ..Counters::default()
        };
        counters.count(Flags::FAULT, 9);
        assert_eq!(
            (counters.ticks, counters.missed_ticks, counters.faults),
            (u32::MAX, u32::MAX, 8)
        );
        let full = counters;
        counters.count(Flags::COUNTED, 9);
        assert_eq!(counters, full);
    }
}
