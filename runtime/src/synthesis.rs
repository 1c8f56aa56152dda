//! The AR or ARMA recursion.
//!
//! `y[n] = e[n] + Σ b_k e[n−k] − Σ a_k y[n−k]`, `e[n] = level·ε[n]` (the paper's y\[n\],
//! with a numerator where the texture has one). Direct form with past inputs and
//! outputs as state: both stay physical when the coefficients change.

use crate::lanes::F4;
use asperity_formats::limits::MAX_ORDER;

/// |y| never exceeds this, m/s²; a verified texture stays far below.
pub const VIB_LIMIT_M_S2: f32 = 1.0e4;
/// Below this a decaying output is set to zero, so that no denormal slows a tick.
const SILENCE_M_S2: f32 = 1.0e-20;
const LANES: usize = 4;
const BLOCKS: usize = MAX_ORDER / LANES;
/// One block more than the lags: all move on only when four new numbers fill it.
const WINDOW: usize = BLOCKS + 1;

/// Numbers of up to 24 lags, from lag 1 on, in blocks of four.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub struct Line(pub(crate) [[f32; LANES]; BLOCKS]);

impl Line {
    /// All zero.
    pub const ZERO: Self = Self([[0.0; LANES]; BLOCKS]);

    /// All of them.
    #[must_use]
    pub fn to_array(&self) -> [f32; MAX_ORDER] {
        let mut all = [0.0; MAX_ORDER];
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
pub struct History {
    e: Window,
    y: Window,
    /// Where the newest stand, 0..=3.
    at: u8,
}

/// Numbers in order of age, the newest at `at` of the first block.
#[derive(Debug, Clone, PartialEq)]
struct Window([[f32; LANES]; WINDOW]);

impl Window {
    const ZERO: Self = Self([[0.0; LANES]; WINDOW]);

    /// All move on by a block, the last of them out.
    #[inline(always)]
    fn shift<const N: usize>(&mut self) {
        for block in (0..N).rev() {
            self.0[block + 1] = F4::load(&self.0[block]).to_array();
        }
    }

    /// Σ c_k x_k over the first `N` blocks from the newest number on, in four partial sums.
    #[inline(always)]
    #[expect(
        clippy::needless_range_loop,
        reason = "of constant length, it is unrolled"
    )]
    fn inner_product<const N: usize>(&self, c: &Line, at: usize) -> F4 {
        let past = &self.0.as_flattened()[at % LANES..];
        let past = past.as_chunks::<LANES>().0;
        let mut partial = F4::load(&c.0[0]) * F4::load(&past[0]);
        for block in 1..N {
            partial = partial + F4::load(&c.0[block]) * F4::load(&past[block]);
        }
        partial
    }
}

/// Length and kind of a recursion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lags {
    /// Lags in blocks of four, of the longer one of A(z) and B(z), 1..=6.
    blocks: u8,
    /// Whether B(z) has more than its first lag.
    numerator: bool,
}

impl Lags {
    /// As many as the orders need; orders are at most 24.
    #[must_use]
    pub const fn new(ar_order: usize, ma_order: usize) -> Self {
        let longer = if ar_order > ma_order {
            ar_order
        } else {
            ma_order
        };
        Self {
            blocks: longer.div_ceil(LANES) as u8,
            numerator: ma_order > 0,
        }
    }
}

/// Calls a method generic over a number of blocks.
macro_rules! by_blocks {
    ($blocks:expr, $history:ident.$f:ident($($argument:expr),*)) => {
        match $blocks {
            0 | 1 => $history.$f::<1>($($argument),*),
            2 => $history.$f::<2>($($argument),*),
            3 => $history.$f::<3>($($argument),*),
            4 => $history.$f::<4>($($argument),*),
            5 => $history.$f::<5>($($argument),*),
            _ => $history.$f::<6>($($argument),*),
        }
    };
}

impl History {
    /// Silence.
    pub const SILENT: Self = Self {
        e: Window::ZERO,
        y: Window::ZERO,
        at: 0,
    };

    /// The last output, m/s².
    pub(crate) fn last(&self) -> f32 {
        self.y.0[0][usize::from(self.at) % LANES]
    }

    /// One sample. `e` is the excitation with its level; `a` and `b` are coefficients of lags
    /// 1.., zero above the order. With `sounding` false the model is mute, and with `e` zero its
    /// history fades out within 24 samples. Returns y, m/s², and whether it had to be clamped.
    #[inline]
    pub fn step(&mut self, a: &Line, b: &Line, lags: Lags, e: f32, sounding: bool) -> (f32, bool) {
        let at = usize::from(self.at) % LANES;
        if lags.numerator {
            by_blocks!(lags.blocks, self.arma(a, b, at, e, sounding))
        } else {
            by_blocks!(lags.blocks, self.ar(a, b, at, e, sounding))
        }
    }

    /// Both sums over `N` blocks of lags; the newest of the past stand at `at`.
    #[inline(always)]
    fn arma<const N: usize>(
        &mut self,
        a: &Line,
        b: &Line,
        at: usize,
        e: f32,
        sounding: bool,
    ) -> (f32, bool) {
        let driven = F4::load(&[e, 0.0, 0.0, 0.0]) + self.e.inner_product::<N>(b, at);
        let (y, clamped) = self.recurse::<N>(a, at, driven, sounding);
        if at == 0 {
            self.e.shift::<N>();
            self.y.shift::<N>();
        }
        self.push(at, e, y);
        (y, clamped)
    }

    /// With a numerator of one lag.
    #[inline(always)]
    fn ar<const N: usize>(
        &mut self,
        a: &Line,
        b: &Line,
        at: usize,
        e: f32,
        sounding: bool,
    ) -> (f32, bool) {
        let driven = F4::load(&[e + b.0[0][0] * self.e.0[0][at], 0.0, 0.0, 0.0]);
        let (y, clamped) = self.recurse::<N>(a, at, driven, sounding);
        if at == 0 {
            self.y.shift::<N>();
        }
        self.push(at, e, y);
        (y, clamped)
    }

    /// The output from what the numerator gives.
    #[inline(always)]
    fn recurse<const N: usize>(
        &self,
        a: &Line,
        at: usize,
        driven: F4,
        sounding: bool,
    ) -> (f32, bool) {
        let raw = (driven - self.y.inner_product::<N>(a, at)).sum();
        let (bounded, clamped) = if is_usual(raw) {
            (raw, false)
        } else {
            bound(raw)
        };
        (if sounding { bounded } else { 0.0 }, clamped && sounding)
    }

    /// The newest enter before `at`, in a circle: at the start, all others have moved.
    #[inline(always)]
    fn push(&mut self, at: usize, e: f32, y: f32) {
        let at = (at + LANES - 1) % LANES;
        self.at = at as u8;
        self.e.0[0][at] = e;
        self.y.0[0][at] = y;
    }
}

/// Whether an output is neither too small to matter, nor too large, nor NaN. Bits of positive
/// numbers are in their order.
#[inline(always)]
fn is_usual(raw: f32) -> bool {
    const LEAST: u32 = SILENCE_M_S2.to_bits();
    const SPAN: u32 = VIB_LIMIT_M_S2.to_bits() - LEAST;
    raw.abs().to_bits().wrapping_sub(LEAST) <= SPAN
}

/// An output too small to matter, too large, or NaN, which becomes silence.
fn bound(raw: f32) -> (f32, bool) {
    if raw > VIB_LIMIT_M_S2 {
        (VIB_LIMIT_M_S2, true)
    } else if raw < -VIB_LIMIT_M_S2 {
        (-VIB_LIMIT_M_S2, true)
    } else {
        (0.0, raw.is_nan())
    }
}
