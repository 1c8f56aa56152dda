//! The AR or ARMA recursion.
//!
//! `y[n] = e[n] + Σ b_k e[n−k] − Σ a_k y[n−k]`, `e[n] = level·ε[n]` (the paper's y\[n\],
//! with a numerator where the texture has one). Direct form with past inputs and
//! outputs as state: both stay physical when the coefficients change.

use asperity_formats::limits::MAX_ORDER;

/// |y| never exceeds this, m/s²; a verified texture stays far below.
pub const VIB_LIMIT_M_S2: f32 = 1.0e4;
/// Below this a decaying output is set to zero, so that no denormal slows a tick.
const SILENCE_M_S2: f32 = 1.0e-20;
const LANES: usize = 4;

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

/// Past inputs and outputs, the newest first.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    e: [f32; MAX_ORDER],
    y: [f32; MAX_ORDER],
}

impl History {
    /// Silence.
    pub const SILENT: Self = Self {
        e: [0.0; MAX_ORDER],
        y: [0.0; MAX_ORDER],
    };
}

/// Σ c_k x_k in four partial sums, in the same order on every platform.
#[inline]
fn inner_product(c: &[f32; MAX_ORDER], x: &[f32; MAX_ORDER]) -> f32 {
    let mut partial = [0.0; LANES];
    for (c, x) in c.chunks_exact(LANES).zip(x.chunks_exact(LANES)) {
        for lane in 0..LANES {
            partial[lane] += c[lane] * x[lane];
        }
    }
    (partial[0] + partial[1]) + (partial[2] + partial[3])
}

#[inline]
fn push(line: &mut [f32; MAX_ORDER], newest: f32) {
    line.copy_within(..MAX_ORDER - 1, 1);
    line[0] = newest;
}

impl Filter {
    /// One sample. `epsilon` is the excitation; with `sounding` false the model is
    /// mute and its history fades out within 24 samples. Returns y, m/s², and whether
    /// it had to be clamped.
    #[inline]
    pub fn step(&self, history: &mut History, epsilon: f32, sounding: bool) -> (f32, bool) {
        let e = self.level_m_s2 * epsilon;
        let raw = (e + inner_product(&self.b, &history.e)) - inner_product(&self.a, &history.y);
        let clamped = raw.is_nan() || raw.abs() > VIB_LIMIT_M_S2;
        // A NaN fails both comparisons and becomes silence.
        let bounded = if raw > VIB_LIMIT_M_S2 {
            VIB_LIMIT_M_S2
        } else if raw < -VIB_LIMIT_M_S2 {
            -VIB_LIMIT_M_S2
        } else if raw.abs() > SILENCE_M_S2 {
            raw
        } else {
            0.0
        };
        let y = if sounding { bounded } else { 0.0 };
        push(&mut history.e, if sounding { e } else { 0.0 });
        push(&mut history.y, y);
        (y, clamped && sounding)
    }
}
