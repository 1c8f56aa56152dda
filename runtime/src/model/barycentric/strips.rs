//! Which blocks of triangles a query may lie in: each axis of the grid is cut into strips.

use super::weight::WeightSearch;
use crate::{
    arithmetic::Arithmetic,
    math::min,
    quantity::{
        Quantity,
        unit::{Coordinate, Slope, Unit, Weight},
    },
};

/// Strips of an axis.
pub(super) const STRIPS: usize = 32;
/// A block also meets strips this far beyond it, in strips. That is far more than rounding, and
/// more than triangles too thin to weigh leave to their neighbours.
const MARGIN: f32 = 0.1;

/// The blocks that each strip of an axis meets, one bit a block. Strip i reaches half a strip
/// to either side of i.
#[derive(Debug, Clone)]
pub(crate) struct Strips<A: Arithmetic> {
    per_unit: Quantity<A, Slope>,
    pub(super) blocks: [u32; STRIPS],
}

impl<A: WeightSearch> Strips<A> {
    pub(super) const EMPTY: Self = Self {
        per_unit: Quantity::ZERO,
        blocks: [0; STRIPS],
    };

    /// The strips of an axis from 0 to `longest`.
    pub(super) fn new(longest: f32) -> Self {
        let per_unit = if longest > 0.0 {
            (STRIPS - 1) as f32 / longest
        } else {
            0.0
        };
        Self {
            per_unit: Quantity::of(per_unit),
            ..Self::EMPTY
        }
    }

    /// The strip of a number from 0 to the longest.
    #[inline(always)]
    pub(super) fn strip(&self, x: Quantity<A, Coordinate>) -> usize {
        A::nearest::<<Weight as Unit>::Point>((x * self.per_unit).0) as usize % STRIPS
    }

    #[inline(always)]
    pub(super) fn at(&self, x: Quantity<A, Coordinate>) -> u32 {
        self.blocks[self.strip(x)]
    }

    /// Notes that block `block` reaches from `low` to `high`. Before [`Strips::turn`] there is a
    /// word for each block, with a bit for each strip.
    pub(super) fn meets(&mut self, block: usize, low: f32, high: f32) {
        let [low, high] = [low, high].map(|x| x * self.per_unit.value());
        // The first strip at or above, and the last one at or below. A cast to a byte rounds down
        // and ends at 0, and costs less than a cast to a word.
        let [first, last] =
            [low - (0.5 + MARGIN), high + (0.5 + MARGIN)].map(|x| min(x, (STRIPS - 1) as f32));
        let from = u32::MAX << (first as u8 + u8::from(first > f32::from(first as u8)));
        let to = u32::MAX >> (STRIPS as u8 - 1 - last as u8);
        if let Some(strips) = self.blocks.get_mut(block) {
            *strips |= from & to;
        }
    }

    /// Transposes the bits: a word for each block becomes a word for each strip. Halves of halves
    /// change places (after Warren's "Hacker's Delight", 7-3).
    pub(super) fn turn(&mut self) {
        let bits = &mut self.blocks;
        let (mut apart, mut low) = (STRIPS / 2, u32::MAX >> (STRIPS / 2));
        while apart > 0 {
            for pair in bits.chunks_exact_mut(2 * apart) {
                let (above, below) = pair.split_at_mut(apart);
                for (above, below) in above.iter_mut().zip(below) {
                    let exchanged = ((*above >> apart) ^ *below) & low;
                    *below ^= exchanged;
                    *above ^= exchanged << apart;
                }
            }
            apart /= 2;
            low ^= low << apart;
        }
    }
}

/// The numbers that differ from the one before, and how many there are.
pub(super) fn distinct(numbers: &[u32; STRIPS]) -> ([u32; STRIPS], usize) {
    let (mut found, mut count) = ([0; STRIPS], 0);
    let mut before = !numbers[0];
    for &number in numbers {
        found[count % STRIPS] = number;
        count += usize::from(number != before);
        before = number;
    }
    (found, count.min(STRIPS))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::Float;
    use asperity_formats::limits::MAX_TRIANGLES;

    #[test]
    fn each_strip_knows_the_blocks_that_meet_it() {
        let mut strips = Strips::<Float>::new((STRIPS - 1) as f32);
        let span = |block: usize| {
            let low = (block * 7 % 29) as f32 + 0.3;
            (low, low + (block % 5) as f32)
        };
        for block in 0..MAX_TRIANGLES / 4 {
            let (low, high) = span(block);
            strips.meets(block, low, high);
            strips.meets(block, high, high + 0.5);
        }
        strips.turn();
        for (strip, blocks) in strips.blocks.iter().enumerate() {
            for block in 0..MAX_TRIANGLES / 4 {
                let (low, high) = span(block);
                let reach = 0.5 + MARGIN;
                let met = low - reach <= strip as f32 && strip as f32 <= high + 0.5 + reach;
                assert_eq!(
                    blocks >> block & 1 == 1,
                    met,
                    "strip {strip}, block {block}"
                );
            }
        }
        let (found, count) = distinct(&strips.blocks);
        assert!(count > 1 && found[..count].windows(2).all(|two| two[0] != two[1]));
    }
}
