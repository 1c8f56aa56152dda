//! How long a cycle lasts: from one query of speed and force to the next.
//!
//! A query takes effect in the last of the samples that its work takes, and the next one follows as
//! late as lets no change be heard after more than [`LAG_SAMPLES`]. A small texture takes effect
//! sooner and works less often.

/// A change of speed or force is heard after at most so many samples of the models.
pub const LAG_SAMPLES: usize = 10;
const LAG: u8 = LAG_SAMPLES as u8;

/// The cycle of a texture, in samples of the models: ticks, where they run at the servo rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cycle {
    /// From the query's sample to that in which it takes effect, both included.
    working: u8,
}

impl Cycle {
    /// Every cycle, shortest way first.
    pub(crate) const ALL: [Self; 3] = [Self::of(4), Self::of(5), Self::SLOWEST];
    /// That of the largest textures: its last tick puts to work what the first asked for.
    pub(crate) const SLOWEST: Self = Self::of(LAG / 2 + 1);

    /// Kinds are told apart by a number below this.
    pub(crate) const KINDS: usize = 4;
    /// A cycle is over; above every count of working samples.
    pub(crate) const OVER: u8 = LAG + 2;

    const fn of(working: u8) -> Self {
        Self { working }
    }

    /// Samples that work, that of the query included; the last of them ends with a new model.
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

    /// What a count of samples is set to when the work is done, to be [`Cycle::OVER`] when the next
    /// query is due.
    #[inline(always)]
    pub(crate) const fn rest(self) -> u8 {
        Self::OVER - (self.samples() - self.working)
    }

    /// What it is among [`Cycle::KINDS`].
    #[inline(always)]
    pub(crate) const fn kind(self) -> usize {
        self.working as usize % Self::KINDS
    }
}
