//! A table of straight lines, looked up in integers, so that both arithmetics find the same value.
//!
//! The work of a lookup is the same everywhere, and a value between two points is never outside them.

/// Points of a table.
pub(crate) const POINTS: usize = 8;
/// Bits of a place behind those of its code.
pub(crate) const FINE_BITS: u32 = 8;

/// Up to eight points, straight lines between them, constant before the first and behind the last
/// one. It takes 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Table {
    /// Codes of the places, ascending; the highest one behind the last point. All are 0 in no table.
    places: [u16; POINTS],
    /// Codes of the values; behind the last point that of the last.
    values: [u16; POINTS],
}

impl Table {
    /// No table.
    pub(crate) const NONE: Self = Self {
        places: [0; POINTS],
        values: [0; POINTS],
    };

    /// Takes points, (place, value), in ascending order of their places, in place; none for no table.
    #[inline(never)]
    pub(crate) fn load(&mut self, points: impl Iterator<Item = (u16, u16)>) {
        *self = Self::NONE;
        let mut points = points.peekable();
        if points.peek().is_none() {
            return;
        }
        let mut last = (0, 0);
        for (place, value) in self.places.iter_mut().zip(&mut self.values) {
            last = points.next().unwrap_or((u16::MAX, last.1));
            (*place, *value) = last;
        }
    }

    /// Returns true if there is a table. Its places ascend, so the last one is above 0.
    #[inline(always)]
    pub(crate) const fn is_some(&self) -> bool {
        self.places[POINTS - 1] != 0
    }

    /// The value, in 2⁻¹⁶ of its code, at a place in 2⁻⁸ of its code.
    pub(crate) fn at(&self, fine: u32) -> u32 {
        let fine_of = |code: u16| u32::from(code) << FINE_BITS;
        // Eight places are halved three times; the last comparison tells seven from eight.
        let mut passed = 0;
        for step in [4, 2, 1, 1] {
            let reached = fine_of(self.places[(passed + step - 1) % POINTS]) <= fine;
            passed += if reached { step } else { 0 };
        }
        let (low, high) = (passed.saturating_sub(1), passed.min(POINTS - 1));
        let point = |index: usize| {
            let index = index % POINTS;
            (self.places[index], u32::from(self.values[index]))
        };
        let ((from, below), (to, above)) = (point(low), point(high));
        // Outside the points both places are one, and the division by 0 gives none.
        let beyond = fine.saturating_sub(fine_of(from)) << FINE_BITS;
        let part = beyond
            .checked_div(u32::from(to.saturating_sub(from)))
            .unwrap_or(0);
        // The part is below 1 << 16, so the sum stays below 1 << 32.
        below * ((1 << 16) - part) + above * part
    }
}
