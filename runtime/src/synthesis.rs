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

/// Past inputs and outputs, the newest first, as far back as the orders in use reach.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    e: Line,
    y: Line,
}

/// Lags of a recursion, in blocks of four.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lags {
    /// Of A(z), 0..=6.
    pub ar: u8,
    /// Of B(z), 0..=6; 0 stands for the first lag alone.
    pub ma: u8,
}

impl Lags {
    /// As many as the orders need; orders are at most 24.
    #[must_use]
    pub const fn new(ar_order: usize, ma_order: usize) -> Self {
        Self {
            ar: ar_order.div_ceil(LANES) as u8,
            ma: ma_order.div_ceil(LANES) as u8,
        }
    }
}

/// Σ c_k x_k over the first `N` blocks in four partial sums, in the same order on every
/// platform.
#[inline(always)]
fn inner_product<const N: usize>(c: &Line, x: &Line) -> F4 {
    let mut partial = F4::load(&c.0[0]) * F4::load(&x.0[0]);
    for block in 1..N {
        partial = partial + F4::load(&c.0[block]) * F4::load(&x.0[block]);
    }
    partial
}

/// The newest enters, all others move one lag on.
#[inline(always)]
fn push<const N: usize>(line: &mut Line, newest: f32) {
    let flat = line.0.as_flattened_mut();
    // From the last block on, so that nothing is overwritten before it is read.
    for block in (1..N).rev() {
        let at = LANES * block;
        let moved = F4::load(&[flat[at - 1], flat[at], flat[at + 1], flat[at + 2]]).to_array();
        flat[at..at + LANES].copy_from_slice(&moved);
    }
    let first = [newest, flat[0], flat[1], flat[2]];
    flat[..LANES].copy_from_slice(&first);
}

/// Calls a function generic over a number of blocks.
macro_rules! by_blocks {
    ($blocks:expr, $f:ident($($argument:expr),*)) => {
        match $blocks {
            0 => $f::<0>($($argument),*),
            1 => $f::<1>($($argument),*),
            2 => $f::<2>($($argument),*),
            3 => $f::<3>($($argument),*),
            4 => $f::<4>($($argument),*),
            5 => $f::<5>($($argument),*),
            _ => $f::<6>($($argument),*),
        }
    };
}

/// The recursive half for `N` blocks of lags: the output from what the numerator gives.
#[inline(always)]
fn recurse<const N: usize>(a: &Line, past: &mut Line, driven: F4, sounding: bool) -> (f32, bool) {
    let raw = (driven - inner_product::<N>(a, past)).sum();
    let size = raw.abs();
    let (bounded, clamped) = if size > SILENCE_M_S2 && size <= VIB_LIMIT_M_S2 {
        (raw, false)
    } else {
        bound(raw)
    };
    let y = if sounding { bounded } else { 0.0 };
    push::<N>(past, y);
    (y, clamped && sounding)
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

/// In four partial sums, the numerator for `N` blocks of lags, none of them standing for the first lag alone.
#[inline(always)]
fn drive<const N: usize>(b: &Line, past: &mut Line, e: f32) -> F4 {
    let driven = if N == 0 {
        F4::load(&[e + b.0[0][0] * past.0[0][0], 0.0, 0.0, 0.0])
    } else {
        F4::load(&[e, 0.0, 0.0, 0.0]) + inner_product::<N>(b, past)
    };
    push::<N>(past, e);
    driven
}

impl History {
    /// Silence.
    pub const SILENT: Self = Self {
        e: Line::ZERO,
        y: Line::ZERO,
    };

    /// The last output, m/s².
    pub(crate) const fn last(&self) -> f32 {
        self.y.0[0][0]
    }

    /// One sample. `e` is the excitation with its level; `a` and `b` are coefficients of lags
    /// 1.., zero above the order. With `sounding` false the model is mute and its history
    /// fades out within 24 samples. Returns y, m/s², and whether it had to be clamped.
    #[inline]
    pub fn step(&mut self, a: &Line, b: &Line, lags: Lags, e: f32, sounding: bool) -> (f32, bool) {
        let e = if sounding { e } else { 0.0 };
        let driven = by_blocks!(lags.ma, drive(b, &mut self.e, e));
        by_blocks!(lags.ar, recurse(a, &mut self.y, driven, sounding))
    }
}
