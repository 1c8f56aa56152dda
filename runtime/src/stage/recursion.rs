//! The AR or ARMA recursion.
//!
//! `y[n] = e[n] + Σ b_k e[n−k] − Σ a_k y[n−k]`, `e[n] = level·ε[n]` (the paper's y\[n\],
//! with a numerator where the texture has one). Direct form with past inputs and
//! outputs as state: both stay physical when the coefficients change. |y| never exceeds
//! [`VIB_LIMIT_M_S2`]; a verified texture stays far below.
//!
//! Past inputs and outputs stand in a window that moves on only every fourth sample, by a block of
//! four. Between these moves, the newest numbers are written in front of the others.

use crate::{
    arithmetic::{
        Arithmetic, Fixed, Float, Zero as _,
        fixed::{bits_of, narrow_within, wide},
    },
    lanes::F4,
    model::row::{BLOCKS, LANES, PaddedRow},
    quantity::{
        Quantity, Raw,
        unit::{Coefficient, Unit, VibrationAcceleration},
    },
};
use asperity_formats::limits::MAX_ORDER;
use core::ops::{Add, Sub};
use fixed::{FixedI32, types::extra::Unsigned as _};

/// |y| never exceeds this in floats, m/s².
pub const VIB_LIMIT_M_S2: f32 = <Float as InnerProduct>::VIB_LIMIT_M_S2;
/// Room for every lag and for three new numbers. The fourth new number moves all of them.
const WINDOW: usize = MAX_ORDER + LANES - 1;

/// Sums of products of coefficients and samples.
pub trait InnerProduct: Arithmetic {
    /// A sum under way.
    type Sum: Copy + Add<Output = Self::Sum> + Sub<Output = Self::Sum>;

    /// |y| never exceeds this, m/s²; a verified texture stays far below.
    const VIB_LIMIT_M_S2: f32;
    /// Anything smaller is silence, m/s², so that no denormal slows a tick.
    const SILENCE_M_S2: f32;

    /// A sum that begins with a sample.
    fn sum_of(first: Raw<Self, VibrationAcceleration>) -> Self::Sum;

    /// Σ c_k x_k over the first `blocks` blocks.
    fn inner_product(
        blocks: usize,
        c: &[[Raw<Self, Coefficient>; 4]],
        x: &[[Raw<Self, VibrationAcceleration>; 4]],
    ) -> Self::Sum;

    /// The sample of a sum, and whether it had to be clamped to
    /// [`InnerProduct::VIB_LIMIT_M_S2`].
    fn sample_of(sum: Self::Sum) -> (Raw<Self, VibrationAcceleration>, bool);
}

impl InnerProduct for Float {
    type Sum = F4;

    const VIB_LIMIT_M_S2: f32 = 1.0e4;
    const SILENCE_M_S2: f32 = 1.0e-12;

    #[inline(always)]
    fn sum_of(first: f32) -> F4 {
        F4::load(&[first, 0.0, 0.0, 0.0])
    }

    #[inline(always)]
    fn inner_product(blocks: usize, c: &[[f32; 4]], x: &[[f32; 4]]) -> F4 {
        let products = c.iter().zip(x).take(blocks);
        let mut products = products.map(|(c, x)| F4::load(c) * F4::load(x));
        let first = products.next().unwrap_or(F4::ZERO);
        products.fold(first, |partial, product| partial + product)
    }

    #[inline(always)]
    fn sample_of(sum: F4) -> (f32, bool) {
        let raw = sum.sum();
        if is_usual(raw) {
            (raw, false)
        } else {
            bound(raw)
        }
    }
}

/// Returns true if an output is neither negligible, nor too large, nor NaN. The bits of positive
/// floats are ordered as the floats.
#[inline(always)]
fn is_usual(raw: f32) -> bool {
    const LEAST: u32 = Float::SILENCE_M_S2.to_bits();
    const SPAN: u32 = Float::VIB_LIMIT_M_S2.to_bits() - LEAST;
    raw.abs().to_bits().wrapping_sub(LEAST) <= SPAN
}

/// Bounds an output that is too small to matter, too large, or NaN. NaN becomes silence.
fn bound(raw: f32) -> (f32, bool) {
    if raw.abs() < Float::SILENCE_M_S2 {
        (0.0, false)
    } else if raw > Float::VIB_LIMIT_M_S2 {
        (Float::VIB_LIMIT_M_S2, true)
    } else if raw < -Float::VIB_LIMIT_M_S2 {
        (-Float::VIB_LIMIT_M_S2, true)
    } else {
        (0.0, raw.is_nan())
    }
}

impl InnerProduct for Fixed {
    type Sum = i64;

    const VIB_LIMIT_M_S2: f32 = 2048.0;
    const SILENCE_M_S2: f32 = 0.0;

    #[inline(always)]
    fn sum_of(first: Raw<Self, VibrationAcceleration>) -> i64 {
        i64::from(first.to_bits()) << <Coefficient as Unit>::Point::I32
    }

    #[inline(always)]
    fn inner_product(
        blocks: usize,
        c: &[[Raw<Self, Coefficient>; 4]],
        x: &[[Raw<Self, VibrationAcceleration>; 4]],
    ) -> i64 {
        let products = c.iter().zip(x).take(blocks);
        let block = |(c, x): (&[Raw<Self, Coefficient>; 4], &[_; 4])| {
            wide(c[0], x[0]) + wide(c[1], x[1]) + wide(c[2], x[2]) + wide(c[3], x[3])
        };
        products.map(block).sum()
    }

    #[inline(always)]
    fn sample_of(sum: i64) -> (Raw<Self, VibrationAcceleration>, bool) {
        let limit = bits_of::<<VibrationAcceleration as Unit>::Point>(Self::VIB_LIMIT_M_S2);
        let y: FixedI32<_> = narrow_within(sum, <Coefficient as Unit>::Point::I32, limit);
        (y, y.to_bits().unsigned_abs() == limit.unsigned_abs())
    }
}

/// Past inputs and outputs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct History<A: Arithmetic> {
    e: Window<A>,
    y: Window<A>,
}

/// Numbers in order of age. The newest stands among the first four, at index `at`.
#[derive(Debug, Clone, PartialEq)]
struct Window<A: Arithmetic>([Raw<A, VibrationAcceleration>; WINDOW]);

impl<A: InnerProduct> Window<A> {
    const ZERO: Self = Self([A::Scalar::ZERO; WINDOW]);

    /// Moves all numbers on by a block. The last ones fall out.
    #[inline(always)]
    fn shift(&mut self, blocks: usize) {
        let kept = (blocks * LANES).min(WINDOW - LANES);
        if A::IN_REGISTERS {
            self.0.copy_within(..kept, LANES);
            return;
        }
        // Elsewhere such a copy would be a call of a function.
        for block in (0..blocks.min(BLOCKS)).rev() {
            let Some((before, after)) = self.0.split_at_mut_checked((block + 1) * LANES) else {
                continue;
            };
            let last = before.last_chunk::<LANES>().into_iter().flatten();
            for (place, x) in after.iter_mut().zip(last) {
                *place = *x;
            }
        }
    }

    /// Σ c_k x_k over the first `blocks` blocks from the newest number on, in four partial sums.
    #[inline(always)]
    fn inner_product(&self, blocks: usize, c: &PaddedRow<A>, at: usize) -> A::Sum {
        let past = &self.0[at % LANES..];
        A::inner_product(blocks, &c.0, past.as_chunks::<LANES>().0)
    }
}

/// Length and kind of a recursion. 0..=5 are one to six blocks of four lags, as many as the longer
/// one of A(z) and B(z) has. 6..=9 are three to six blocks where B(z) has more than its first lag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recursion(u8);

/// Short recursions with an MA part are rare, and not worth code of their own.
const FEWEST_WITH_MA: usize = 3;

impl Recursion {
    /// The shortest recursion for these orders, which are at most 24.
    #[must_use]
    pub const fn new(ar_order: usize, ma_order: usize) -> Self {
        let longer = if ar_order > ma_order {
            ar_order
        } else {
            ma_order
        };
        let blocks = longer.div_ceil(LANES);
        Self(if ma_order > 0 {
            (BLOCKS + blocks.saturating_sub(FEWEST_WITH_MA)) as u8
        } else {
            blocks.saturating_sub(1) as u8
        })
    }

    /// Blocks of four.
    #[inline(always)]
    const fn blocks(self) -> usize {
        let kind = self.0 as usize;
        if kind < BLOCKS {
            kind + 1
        } else {
            kind - BLOCKS + FEWEST_WITH_MA
        }
    }
}

/// A sample of the vibration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VibrationSample<A: Arithmetic> {
    /// y\[n\], m/s².
    pub y: Quantity<A, VibrationAcceleration>,
    /// True if y was clamped.
    pub clamped: bool,
}

impl<A: InnerProduct> History<A> {
    /// Silence.
    pub(crate) const SILENT: Self = Self {
        e: Window::ZERO,
        y: Window::ZERO,
    };

    /// The last output, m/s².
    pub(crate) fn last(&self, newest: u8) -> Quantity<A, VibrationAcceleration> {
        Quantity(self.y.0[usize::from(newest) % LANES])
    }

    /// Computes a sample: y, m/s², and whether it was clamped. `e` is the excitation with its
    /// level; `a` and `b` are coefficients of lags 1.., zero above the order. With `sounding` false
    /// the model is mute, and with `e` zero its history fades out within 24 samples. `newest` is
    /// the index of the newest numbers in the history, initially 0.
    #[inline(always)]
    pub(crate) fn step(
        &mut self,
        newest: &mut u8,
        a: &PaddedRow<A>,
        b: &PaddedRow<A>,
        recursion: Recursion,
        e: Quantity<A, VibrationAcceleration>,
        sounding: bool,
    ) -> VibrationSample<A> {
        let at = usize::from(*newest) % LANES;
        *newest = before(at) as u8;
        // The length is a constant in each arm, so that no sum is a loop.
        match recursion.0 {
            0 => self.ar(1, a, b, at, e, sounding),
            1 => self.ar(2, a, b, at, e, sounding),
            2 => self.ar(3, a, b, at, e, sounding),
            3 => self.ar(4, a, b, at, e, sounding),
            4 => self.ar(5, a, b, at, e, sounding),
            5 => self.ar(6, a, b, at, e, sounding),
            6 => self.arma(3, a, b, at, e, sounding),
            7 => self.arma(4, a, b, at, e, sounding),
            8 => self.arma(5, a, b, at, e, sounding),
            _ => self.arma(6, a, b, at, e, sounding),
        }
    }

    /// [`History::step`] in loops, with a numerator that may be zero beyond its first lag. It gives
    /// the same bits and takes a tenth of the code.
    #[inline(always)]
    pub(crate) fn step_in_loops(
        &mut self,
        newest: &mut u8,
        a: &PaddedRow<A>,
        b: &PaddedRow<A>,
        recursion: Recursion,
        e: Quantity<A, VibrationAcceleration>,
        sounding: bool,
    ) -> VibrationSample<A> {
        let at = usize::from(*newest) % LANES;
        *newest = before(at) as u8;
        self.arma(recursion.blocks(), a, b, at, e, sounding)
    }

    /// The recursion with a full numerator: both sums run over `blocks` blocks of lags. The newest
    /// past numbers stand at `at`.
    #[inline(always)]
    fn arma(
        &mut self,
        blocks: usize,
        a: &PaddedRow<A>,
        b: &PaddedRow<A>,
        at: usize,
        e: Quantity<A, VibrationAcceleration>,
        sounding: bool,
    ) -> VibrationSample<A> {
        let driven = A::sum_of(e.0) + self.e.inner_product(blocks, b, at);
        let sounded = self.recurse(blocks, a, at, driven, sounding);
        if at == 0 {
            self.e.shift(blocks);
            self.y.shift(blocks);
        }
        self.push(at, e, sounded.y);
        sounded
    }

    /// The recursion with a numerator of one lag.
    #[inline(always)]
    fn ar(
        &mut self,
        blocks: usize,
        a: &PaddedRow<A>,
        b: &PaddedRow<A>,
        at: usize,
        e: Quantity<A, VibrationAcceleration>,
        sounding: bool,
    ) -> VibrationSample<A> {
        let before = Quantity::<A, VibrationAcceleration>(self.e.0[at]);
        let first = Quantity::<A, Coefficient>(b.0[0][0]) * before;
        let driven = A::sum_of((e + first).0);
        let sounded = self.recurse(blocks, a, at, driven, sounding);
        if at == 0 {
            self.y.shift(blocks);
        }
        self.push(at, e, sounded.y);
        sounded
    }

    /// The output, from the sum of the numerator.
    #[inline(always)]
    fn recurse(
        &self,
        blocks: usize,
        a: &PaddedRow<A>,
        at: usize,
        driven: A::Sum,
        sounding: bool,
    ) -> VibrationSample<A> {
        let (y, clamped) = A::sample_of(driven - self.y.inner_product(blocks, a, at));
        let y = Quantity(y);
        let y = if sounding { y } else { Quantity::ZERO };
        VibrationSample {
            y,
            clamped: clamped && sounding,
        }
    }

    /// Writes the newest numbers before `at`, in a circle. At 0 all others have moved on to make
    /// room.
    #[inline(always)]
    fn push(
        &mut self,
        at: usize,
        e: Quantity<A, VibrationAcceleration>,
        y: Quantity<A, VibrationAcceleration>,
    ) {
        let at = before(at);
        self.e.0[at] = e.0;
        self.y.0[at] = y.0;
    }
}

/// The place before one of the first four, in a circle.
#[inline(always)]
const fn before(at: usize) -> usize {
    (at + LANES - 1) % LANES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recursion_has_as_many_blocks_as_its_longer_part_needs() {
        for (ar, ma) in (0..=24).flat_map(|ar| (0..=24).map(move |ma| (ar, ma))) {
            let (longer, fewest) = (if ar > ma { ar } else { ma }, if ma > 0 { 3 } else { 1 });
            let blocks = Recursion::new(ar, ma).blocks();
            let needed = longer.div_ceil(LANES);
            assert_eq!(blocks, if needed > fewest { needed } else { fewest });
            assert!(Recursion::new(ar, ma).0 <= 9);
        }
    }
}
