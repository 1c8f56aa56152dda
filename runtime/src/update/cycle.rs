//! Duration of a cycle: from one query of speed and force to the next.
//!
//! A query takes effect in the last of the samples that its work takes. The next query follows as
//! late as possible while every change is still heard within [`LAG_SAMPLES`]. So a small texture
//! responds sooner and works less often.

/// A change of speed or force is heard after at most this many samples of the models.
pub const LAG_SAMPLES: usize = 10;
const LAG: u8 = LAG_SAMPLES as u8;

/// The cycle of a texture, in samples of the models. These are ticks where the models run at the
/// servo rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cycle {
    /// From the query's sample to the sample in which it takes effect, both included.
    working: u8,
}

impl Cycle {
    /// Every cycle, the one that answers soonest first.
    pub(crate) const ALL: [Self; 3] = [Self::of(4), Self::of(5), Self::SLOWEST];
    /// The cycle of the largest textures. The last tick of it puts the model to work that the first
    /// one asked for.
    pub(crate) const SLOWEST: Self = Self::of(LAG / 2 + 1);

    /// The number of a kind of cycle is below this.
    pub(crate) const KINDS: usize = 4;
    /// The count of a cycle that is over. It is above every count of working samples.
    pub(crate) const OVER: u8 = LAG + 2;

    const fn of(working: u8) -> Self {
        Self { working }
    }

    /// Samples in which work is done, the query's sample included. The last of them ends with a new
    /// model.
    #[inline(always)]
    pub(crate) const fn working(self) -> u8 {
        self.working
    }

    /// Samples from one query to the next.
    #[inline(always)]
    pub(crate) const fn samples(self) -> u8 {
        // What changes just after a query waits for the next one and its work.
        LAG + 2 - self.working
    }

    /// The count that is set when the work is done, so that it is [`Cycle::OVER`] when the next
    /// query is due.
    #[inline(always)]
    pub(crate) const fn rest(self) -> u8 {
        Self::OVER - (self.samples() - self.working)
    }

    /// The number of this kind of cycle, below [`Cycle::KINDS`].
    #[inline(always)]
    pub(crate) const fn kind(self) -> usize {
        self.working as usize % Self::KINDS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A change just after a query waits for the next query, and then for its work.
    #[test]
    fn every_change_is_heard_within_the_lag() {
        assert_eq!(Cycle::ALL.map(Cycle::working), [4, 5, 6]);
        assert_eq!(Cycle::ALL.map(Cycle::samples), [8, 7, 6]);
        for cycle in Cycle::ALL {
            let lag = usize::from(cycle.samples() + cycle.working() - 2);
            assert_eq!(lag, LAG_SAMPLES);
            // Counting on from the rest ends when the next query is due.
            let left = Cycle::OVER - cycle.rest();
            assert_eq!(left, cycle.samples() - cycle.working());
            assert!(cycle.rest() >= cycle.working() && cycle.kind() < Cycle::KINDS);
        }
        let kinds = Cycle::ALL.map(Cycle::kind);
        assert!(kinds[0] != kinds[1] && kinds[1] != kinds[2] && kinds[0] != kinds[2]);
        assert_eq!(Cycle::SLOWEST, Cycle::ALL[2]);
    }
}
