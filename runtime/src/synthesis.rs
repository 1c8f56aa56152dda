//! The AR or ARMA recursion.
//!
//! `y[n] = e[n] + Σ b_k e[n−k] − Σ a_k y[n−k]`, `e[n] = level·ε[n]` (the paper's y\[n\],
//! with a numerator where the texture has one). Direct form with past inputs and
//! outputs as state: both stay physical when the coefficients change.

use crate::arithmetic::{
    Arithmetic, Float, Number, Point, Zero as _,
    units::{Acceleration, Coefficient},
};
use asperity_formats::limits::MAX_ORDER;

/// |y| never exceeds this in floats, m/s²; a verified texture stays far below.
pub const VIB_LIMIT_M_S2: f32 = <Float as Arithmetic>::VIB_LIMIT_M_S2;
const LANES: usize = 4;
const BLOCKS: usize = MAX_ORDER / LANES;
/// As many as the lags, and room for three new numbers: all move on only with the fourth.
const WINDOW: usize = MAX_ORDER + LANES - 1;

/// Numbers of up to 24 lags, from lag 1 on, in blocks of four.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
pub struct Line<A: Arithmetic = Float, F: Point = Coefficient>(
    pub(crate) [[A::Scalar<F>; LANES]; BLOCKS],
);

impl<A: Arithmetic, F: Point> Line<A, F> {
    /// All zero.
    pub const ZERO: Self = Self([[A::Scalar::ZERO; LANES]; BLOCKS]);

    /// All of them.
    #[must_use]
    pub fn to_array(&self) -> [A::Scalar<F>; MAX_ORDER] {
        let mut all = [A::Scalar::ZERO; MAX_ORDER];
        all.copy_from_slice(self.0.as_flattened());
        all
    }
}

/// One model: what [`Texture::filter_at`](crate::Texture::filter_at) gives for a
/// speed and a force.
#[derive(Debug, Clone, PartialEq)]
pub struct Filter {
    /// a_1..a_24 of A(z) = 1 + Σ a_k z⁻ᵏ, zeros above the order.
    pub a: [f32; MAX_ORDER],
    /// b_1..b_24 of B(z) = 1 + Σ b_k z⁻ᵏ, zeros above the order.
    pub b: [f32; MAX_ORDER],
    /// gain·σ, m/s².
    pub level_m_s2: f32,
}

/// Past inputs and outputs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct History<A: Arithmetic> {
    e: Window<A>,
    y: Window<A>,
}

/// Numbers in order of age, the newest at `at` of the first four.
#[derive(Debug, Clone, PartialEq)]
struct Window<A: Arithmetic>([A::Scalar<Acceleration>; WINDOW]);

impl<A: Arithmetic> Window<A> {
    const ZERO: Self = Self([A::Scalar::ZERO; WINDOW]);

    /// All move on by a block, the last of them out.
    #[inline(always)]
    fn shift(&mut self, blocks: usize) {
        let kept = (blocks * LANES).min(WINDOW - LANES);
        if A::IN_REGISTERS {
            self.0.copy_within(..kept, LANES);
            return;
        }
        // Elsewhere a copy by itself is a call.
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
    fn inner_product(&self, blocks: usize, c: &Line<A>, at: usize) -> A::Sum {
        let past = &self.0[at % LANES..];
        A::inner_product(blocks, &c.0, past.as_chunks::<LANES>().0)
    }
}

/// Length and kind of a recursion: 0..=5 for one to six blocks of four lags, those of the longer
/// one of A(z) and B(z), 6..=9 for three to six where B(z) has more than its first lag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lags(u8);

/// Short recursions with an MA part are rare, and not worth code of their own.
const FEWEST_WITH_MA: usize = 3;

impl Lags {
    /// As many as the orders need; orders are at most 24.
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

/// A sample, m/s², and whether it had to be clamped.
type Sounded<A> = (Number<A, Acceleration>, bool);

impl<A: Arithmetic> History<A> {
    /// Silence.
    pub(crate) const SILENT: Self = Self {
        e: Window::ZERO,
        y: Window::ZERO,
    };

    /// The last output, m/s².
    pub(crate) fn last(&self, newest: u8) -> Number<A, Acceleration> {
        Number(self.y.0[usize::from(newest) % LANES])
    }

    /// One sample. `e` is the excitation with its level; `a` and `b` are coefficients of lags
    /// 1.., zero above the order. With `sounding` false the model is mute, and with `e` zero its
    /// history fades out within 24 samples. `newest` says where the newest of the history stand; 0
    /// to begin with. Returns y, m/s², and whether it had to be clamped.
    #[inline(always)]
    pub(crate) fn advance(
        &mut self,
        newest: &mut u8,
        a: &Line<A>,
        b: &Line<A>,
        lags: Lags,
        e: Number<A, Acceleration>,
        sounding: bool,
    ) -> Sounded<A> {
        let at = usize::from(*newest) % LANES;
        *newest = before(at) as u8;
        // Constant in each arm, so that no sum is a loop.
        match lags.0 {
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

    /// [`History::advance`] in loops, with a numerator that may be zero beyond its first lag: the
    /// same bits in a tenth of the code.
    #[inline(always)]
    pub(crate) fn advance_in_loops(
        &mut self,
        newest: &mut u8,
        a: &Line<A>,
        b: &Line<A>,
        lags: Lags,
        e: Number<A, Acceleration>,
        sounding: bool,
    ) -> Sounded<A> {
        let at = usize::from(*newest) % LANES;
        *newest = before(at) as u8;
        self.arma(lags.blocks(), a, b, at, e, sounding)
    }

    /// Both sums over `blocks` blocks of lags; the newest of the past stand at `at`.
    #[inline(always)]
    fn arma(
        &mut self,
        blocks: usize,
        a: &Line<A>,
        b: &Line<A>,
        at: usize,
        e: Number<A, Acceleration>,
        sounding: bool,
    ) -> Sounded<A> {
        let driven = A::sum_of(e.0) + self.e.inner_product(blocks, b, at);
        let (y, clamped) = self.recurse(blocks, a, at, driven, sounding);
        if at == 0 {
            self.e.shift(blocks);
            self.y.shift(blocks);
        }
        self.push(at, e, y);
        (y, clamped)
    }

    /// With a numerator of one lag.
    #[inline(always)]
    fn ar(
        &mut self,
        blocks: usize,
        a: &Line<A>,
        b: &Line<A>,
        at: usize,
        e: Number<A, Acceleration>,
        sounding: bool,
    ) -> Sounded<A> {
        let before = Number::<A, Acceleration>(self.e.0[at]);
        let first = Number::<A, Coefficient>(b.0[0][0]).times(before);
        let driven = A::sum_of((e + first).0);
        let (y, clamped) = self.recurse(blocks, a, at, driven, sounding);
        if at == 0 {
            self.y.shift(blocks);
        }
        self.push(at, e, y);
        (y, clamped)
    }

    /// The output from what the numerator gives.
    #[inline(always)]
    fn recurse(
        &self,
        blocks: usize,
        a: &Line<A>,
        at: usize,
        driven: A::Sum,
        sounding: bool,
    ) -> Sounded<A> {
        let (y, clamped) = A::sample_of(driven - self.y.inner_product(blocks, a, at));
        let y = if sounding { Number(y) } else { Number::ZERO };
        (y, clamped && sounding)
    }

    /// The newest enter before `at`, in a circle: at the start, all others have moved.
    #[inline(always)]
    fn push(&mut self, at: usize, e: Number<A, Acceleration>, y: Number<A, Acceleration>) {
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
