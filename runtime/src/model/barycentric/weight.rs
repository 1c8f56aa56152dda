//! The largest of the smallest barycentric weights: it belongs to the triangle that contains the
//! query.

use crate::{
    arithmetic::{Arithmetic, Fixed, Float, Point, Quad, Scalar},
    lanes::F4,
    math::max,
    quantity::{
        Four, Raw,
        unit::{Coordinate, Slope, Weight},
    },
};
use fixed::FixedI32;

/// A point lies in a triangle if its smallest weight is at least this, −2⁻²³, which rounding may
/// make of a zero. A wider margin would be felt beside slivers, whose mixtures change within a
/// hair. The last bits, where a weight has an index, are set, so that no index decides.
const NEARLY_INSIDE: f32 = f32::from_bits(0xb400_007f);
/// Added to the bits of a weight that has an index: the number is doubled, and a zero becomes a
/// normal number. A denormal would lose its index where the caller has switched denormals off.
const NORMAL: u32 = 1 << 23;
/// Added to every weight, 2⁻¹⁰⁰: smaller weights, denormals among them, all count as this.
const NOTHING: f32 = f32::from_bits((127 - 100) << 23);

/// Comparing weights of many triangles.
pub trait WeightSearch: Arithmetic {
    /// The largest of many weights, or of those in each lane, whose last bits hold an index.
    type Best: Copy + core::fmt::Debug + PartialEq;

    /// Less than every weight.
    const WORST: Self::Best;
    /// A coordinate beyond every grid.
    const FAR_OFF: Raw<Self, Coordinate>;
    /// A slope that makes a weight of [`WeightSearch::FAR_OFF`] smaller than every other weight.
    const STEEP: Raw<Self, Slope>;

    /// The best of `best` and of four more weights. The last bits of a weight, those of `bits`, are
    /// replaced by its index; the four are numbered from `index` on.
    fn better(best: Self::Best, four: Four<Self, Weight>, bits: u32, index: u32) -> Self::Best;

    /// Returns true if the best triangle contains the point: its weight is −2⁻²³ or more, within
    /// the bits of an index.
    fn is_inside(best: Self::Best) -> bool;

    /// Stores the best weights as bits. A single weight takes the first of them.
    fn keep(best: Self::Best, bits: &mut [u32; 4]);

    /// Loads the best weights from those bits.
    fn kept(bits: &[u32; 4]) -> Self::Best;

    /// The index of the best triangle.
    fn index(best: Self::Best, bits: u32) -> u32;

    /// The whole number nearest to `a`, which is from 0 to 32.
    fn nearest<F: Point>(a: Self::Scalar<F>) -> u32;
}

/// Weights that a search keeps.
const BEST: usize = if F4::IN_REGISTERS { 4 } else { 1 };

/// The best of all weights so far, or the best in each lane of a register.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Best([f32; BEST]);

impl Best {
    #[inline(always)]
    fn of(lanes: F4) -> Self {
        let mut best = [0.0; BEST];
        best.copy_from_slice(&lanes.to_array()[..BEST]);
        Self(best)
    }

    #[inline(always)]
    fn lanes(self) -> F4 {
        let mut lanes = [0.0; 4];
        lanes[..BEST].copy_from_slice(&self.0);
        F4::load(&lanes)
    }
}

impl WeightSearch for Float {
    type Best = Best;

    const WORST: Best = Best([-1.0e30; BEST]);
    const FAR_OFF: f32 = 1.0e6;
    const STEEP: f32 = 1.0e3;

    #[inline(always)]
    fn better(best: Best, four: Four<Self, Weight>, bits: u32, index: u32) -> Best {
        // Zeros lose their sign, which platforms compare differently.
        let four = four.0 + F4::splat(NOTHING);
        if F4::IN_REGISTERS {
            return Best::of(four.mark(bits, NORMAL | index).max(best.lanes()));
        }
        let marked = |x: f32, index: u32| f32::from_bits((x.to_bits() & !bits) + (NORMAL | index));
        let lanes = four.to_array().into_iter().zip(index..);
        let least = best.lanes().to_array()[0];
        Best([lanes.fold(least, |best, (x, index)| max(marked(x, index), best)); BEST])
    }

    #[inline(always)]
    fn is_inside(best: Best) -> bool {
        if F4::IN_REGISTERS {
            return best.lanes().reaches(2.0 * NEARLY_INSIDE);
        }
        best.0[0] >= 2.0 * NEARLY_INSIDE
    }

    #[inline(always)]
    fn keep(best: Best, bits: &mut [u32; 4]) {
        for (bits, lane) in bits.iter_mut().zip(best.0) {
            *bits = lane.to_bits();
        }
    }

    #[inline(always)]
    fn kept(bits: &[u32; 4]) -> Best {
        let mut best = [0.0; BEST];
        for (lane, bits) in best.iter_mut().zip(bits) {
            *lane = f32::from_bits(*bits);
        }
        Best(best)
    }

    #[inline(always)]
    fn index(best: Best, bits: u32) -> u32 {
        if !F4::IN_REGISTERS {
            return best.0[0].to_bits() & bits;
        }
        let lanes = best.lanes().to_array();
        let lane = |lane: usize| f32::from_bits(lanes[lane].to_bits() | lane as u32);
        max(max(lane(0), lane(1)), max(lane(2), lane(3))).to_bits() & bits
    }

    #[inline(always)]
    fn nearest<F: Point>(a: f32) -> u32 {
        /// From here on floats are whole numbers: a sum rounds to the nearest.
        const WHOLE: f32 = (1 << 23) as f32;
        (a + WHOLE).to_bits() % (1 << 23)
    }
}

impl WeightSearch for Fixed {
    type Best = Raw<Self, Weight>;

    const WORST: Raw<Self, Weight> = FixedI32::MIN;
    const FAR_OFF: Raw<Self, Coordinate> = FixedI32::const_from_int(1500);
    const STEEP: Raw<Self, Slope> = FixedI32::const_from_int(1000);

    #[inline(always)]
    fn better(
        best: Raw<Self, Weight>,
        Four(Quad(four)): Four<Self, Weight>,
        bits: u32,
        index: u32,
    ) -> Raw<Self, Weight> {
        let marked = |x: Raw<Self, Weight>, index: u32| {
            FixedI32::from_bits(x.to_bits() & !bits as i32 | index as i32)
        };
        let lanes = four.into_iter().zip(index..);
        lanes.fold(best, |best, (x, index)| marked(x, index).max(best))
    }

    #[inline(always)]
    fn is_inside(best: Raw<Self, Weight>) -> bool {
        best >= <Raw<Self, Weight> as Scalar>::of(NEARLY_INSIDE)
    }

    #[inline(always)]
    fn keep(best: Raw<Self, Weight>, bits: &mut [u32; 4]) {
        bits[0] = best.bits();
    }

    #[inline(always)]
    fn kept(bits: &[u32; 4]) -> Raw<Self, Weight> {
        Scalar::from_bits(bits[0])
    }

    #[inline(always)]
    fn index(best: Raw<Self, Weight>, bits: u32) -> u32 {
        best.to_bits() as u32 & bits
    }

    #[inline(always)]
    fn nearest<F: Point>(a: FixedI32<F>) -> u32 {
        ((a.to_bits() + (1 << (F::U32 - 1))) >> F::U32) as u32
    }
}
