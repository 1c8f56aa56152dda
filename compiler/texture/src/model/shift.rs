//! Shifts: attributes of a texture move, and nothing else changes.
//!
//! Roughness moves by the level of every model, slipperiness by μ, hardness by the time in which
//! a tap passes: a tap that is over in half the time has twice the pitch, and the same impulse.
//!
//! ```
//! use asperity_texture::model::{
//!     attributes::Attributes,
//!     shift::{Shift, scales, to},
//! };
//!
//! let cork = Attributes { rough_db: Some(-3.0), sharp_hz: None, hard_hz: None, mu: 0.6 };
//! let wanted = scales(&Attributes { rough_db: Some(3.0), ..cork });
//! assert_eq!(to(&wanted, &cork), Shift { rough_db: 6.0, ..Shift::default() });
//! ```

use super::{
    Gains, ModelGrid, TapBank, TextureModel,
    attributes::{Attributes, Meter},
};
use serde::{Deserialize, Serialize};

/// Largest σ·gain of a model after a change, relative to before.
const LARGEST_CHANGE_DB: f64 = 20.0;
/// μ stays within these.
const MU: (f64, f64) = (0.03, 2.5);
/// A tap is at most so many times faster or slower.
const FASTEST: f64 = 4.0;
/// Samples over which the end of a slower tap is faded.
const FADE: usize = 15;
/// A tap's peak stays below this share of what the device's force allows.
const TAP_SHARE: f64 = 0.95;
/// Corrections of a tap's time, since a cut end moves the centroid.
const CORRECTIONS: usize = 6;

/// Changes of a texture's attributes after decoding; 0 leaves an attribute unchanged.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Shift {
    /// Level of the vibration, dB.
    #[serde(skip_serializing_if = "is_zero")]
    pub rough_db: f64,
    /// −ln μ.
    #[serde(skip_serializing_if = "is_zero")]
    pub slippery: f64,
    /// ln of the centroid of a tap.
    #[serde(skip_serializing_if = "is_zero")]
    pub hard: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl Shift {
    /// A shift of three numbers on the scales of [`scales`], `None` for 0.
    fn of([rough, slippery, hard]: [Option<f64>; 3]) -> Self {
        Self {
            rough_db: rough.unwrap_or(0.0),
            slippery: slippery.unwrap_or(0.0),
            hard: hard.unwrap_or(0.0),
        }
    }

    /// Returns true if no attribute changes.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self == &Self::default()
    }

    /// The shift between two, part by part: `(1 − t)·a + t·b`.
    #[must_use]
    pub fn between(a: &Self, b: &Self, t: f64) -> Self {
        let mix = |a: f64, b: f64| (1.0 - t) * a + t * b;
        Self {
            rough_db: mix(a.rough_db, b.rough_db),
            slippery: mix(a.slippery, b.slippery),
            hard: mix(a.hard, b.hard),
        }
    }
}

/// Attributes on the scales of [`Shift`]: dB, −ln μ, ln Hz; `None` for one that is not defined.
pub type Scales = [Option<f64>; 3];

/// Attributes on their scales.
#[must_use]
pub fn scales(attributes: &Attributes) -> Scales {
    [
        attributes.rough_db,
        Some(-libm::log(attributes.mu.max(f64::MIN_POSITIVE))),
        ln_hz(attributes.hard_hz),
    ]
}

fn ln_hz(hz: Option<f64>) -> Option<f64> {
    hz.filter(|hz| *hz > 0.0).map(libm::log)
}

/// The middle of two.
#[must_use]
pub fn middle(first: &Scales, second: &Scales) -> Scales {
    std::array::from_fn(|k| Some(0.5 * (first[k]? + second[k]?)))
}

/// Returns the shift from a texture's scales to the wanted ones; 0 for an attribute that the texture does not define,
/// or that has no wanted value.
#[must_use]
pub fn to(wanted: &Scales, now: &Attributes) -> Shift {
    let now = scales(now);
    Shift::of(std::array::from_fn(|k| Some(wanted[k]? - now[k]?)))
}

/// Moves a texture.
pub fn adjust(texture: &mut TextureModel, shift: &Shift) {
    adjust_level(&mut texture.grid, shift.rough_db);
    texture.friction.mu = adjusted_mu(texture.friction.mu, shift.slippery);
    adjust_taps(&mut texture.taps, &texture.gains, shift.hard);
}

/// Moves the level of every model, dB.
pub fn adjust_level(grid: &mut ModelGrid, rough_db: f64) {
    if rough_db == 0.0 {
        return;
    }
    let change_db = rough_db.clamp(-LARGEST_CHANGE_DB, LARGEST_CHANGE_DB);
    let factor = libm::exp10(change_db / 20.0);
    for vertex in &mut grid.vertices {
        vertex.sigma_m_s2 *= factor;
    }
}

/// A coefficient of friction that is moved, −ln μ.
#[must_use]
pub fn adjusted_mu(mu: f64, slippery: f64) -> f64 {
    if slippery == 0.0 {
        return mu;
    }
    (mu * libm::exp(-slippery)).clamp(MU.0, MU.1)
}

/// Moves the centroid of a bank's fastest trace, ln Hz, and with it the pace of all traces. Their peaks stay within
/// what a device of these gains can give.
pub fn adjust_taps(taps: &mut TapBank, gains: &Gains, hard: f64) {
    if hard == 0.0 {
        return;
    }
    let mut meter = Meter::default();
    let mut centroid = |taps: &TapBank| ln_hz(meter.hard_hz(taps));
    let Some(before) = centroid(taps) else { return };
    let wanted = before + hard;
    let original = taps.traces.clone();
    let limit = TAP_SHARE * gains.f_max_n / gains.effective_mass_kg;
    let mut pace = 0.0;
    for _ in 0..CORRECTIONS {
        let Some(now) = centroid(taps) else { return };
        let bound = libm::log(FASTEST);
        pace = f64::clamp(pace + wanted - now, -bound, bound);
        let pace = libm::exp(pace);
        let mut peak = 0.0_f64;
        for (trace, original) in taps.traces.iter_mut().zip(&original) {
            trace.accel_m_s2 = at_pace(&original.accel_m_s2, pace);
            peak = trace
                .accel_m_s2
                .iter()
                .fold(peak, |peak, a| peak.max(a.abs()));
        }
        if peak > limit {
            let samples = taps.traces.iter_mut().flat_map(|t| &mut t.accel_m_s2);
            samples.for_each(|a| *a *= limit / peak);
        }
    }
}

/// `pace·a(pace·t)`: the same impulse in another time, linear between samples.
fn at_pace(samples: &[f64], pace: f64) -> Vec<f64> {
    let count = samples.len();
    let sample = |at: f64| -> f64 {
        let index = at as usize;
        let here = samples.get(index).copied().unwrap_or(0.0);
        let next = samples.get(index + 1).copied().unwrap_or(0.0);
        here + (at - index as f64) * (next - here)
    };
    (0..count)
        .map(|n| {
            let left = (count - 1 - n) as f64 / FADE as f64;
            let fade = if pace < 1.0 { left.min(1.0) } else { 1.0 };
            fade * pace * sample(n as f64 * pace)
        })
        .collect()
}
