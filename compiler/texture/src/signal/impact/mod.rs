//! The transient of an impact: a contact that closes and opens, a hand behind it, a surface that
//! rings.
//!
//! 1. `pulse`: Hertz's contact. Its time falls as v^(−1/5) with the impact speed v, and its force
//!    grows as v^(6/5). Losses that rise with speed (Hunt and Crossley, 1975) lean it forward, and a
//!    soft material keeps a dent, so the contact opens sooner than it closed.
//! 2. `resonator`: the hand, which holds a part of the stylus at the contact resonance, and the
//!    first modes of the surface, which the pulse excites.
//!
//! [`Impact::of_material`] has the constants. What no measurement decides is marked *chosen*. The
//! modes follow measured ones (`training/corpora/measured`); `docs/taps.md` compares them.
//!
//! ```
//! use asperity_texture::signal::impact::{Impact, SAMPLE_RATE_HZ};
//!
//! let (foam, steel) = (Impact::of_material(0.05, 0.3), Impact::of_material(1e5, 0.02));
//! assert!(steel.contact_time_s(0.1) < foam.contact_time_s(0.1));
//! let impulse: f64 = steel.unit_trace(0.1).iter().sum::<f64>() / SAMPLE_RATE_HZ;
//! assert!((impulse - 1.0).abs() < 1e-9);
//! ```

mod resonator;

use self::resonator::Resonator;
use std::f64::consts::PI;

/// Impact speeds of a bank.
pub const SPEEDS: usize = 13;
/// Samples of a trace.
pub const SAMPLES: usize = 100;
/// Rate of a trace, Hz: 100 samples last 10 ms.
pub const SAMPLE_RATE_HZ: f64 = 10_000.0;
/// Step of impact speed, m/s: a bank reaches from 0.025 to 0.325 m/s.
pub const SPEED_STEP_M_S: f64 = 0.025;
/// Speed at which [`Impact::contact_s`] holds, m/s.
pub const REFERENCE_SPEED_M_S: f64 = 0.1625;
/// Exponent of the contact time in the impact speed (Hertz).
pub const TIME_EXPONENT: f64 = -0.2;
/// Modes of a surface.
pub const MODES: usize = 3;

/// *Chosen.* Contact time at 0.01 MPa, s: the slowest tap of the softest material still ends within
/// a trace.
const SOFTEST_S: f64 = 5.5e-3;
const SOFTEST_MPA: f64 = 0.01;
/// *Chosen.* Exponent of the contact time in the modulus. Hertz has −2/5, which spreads seven decades
/// of modulus over three of time. A trace and a servo loop at 1 kHz have room for one. A real tip,
/// its holder and what lies under a soft layer compress the range, too.
const STIFFNESS_EXPONENT: f64 = -1.0 / 7.0;
const CONTACT_RANGE_S: (f64, f64) = (0.5e-3, 5.8e-3);

/// *Chosen.* Loss of the coefficient of restitution, 1 − e, per impact speed, s/m, of a lossless
/// material, and what the loss factor adds.
const LOSS_S_M: f64 = 0.5;
const LOSS_S_M_PER_LOSS: f64 = 2.5;
/// *Chosen.* Dents: the part of the opening that a lossy and soft thing lacks at most, the loss
/// factors at which that begins and is reached, and the modulus that halves it, MPa.
const LARGEST_SET: f64 = 0.2;
const SET_LOSS: (f64, f64) = (0.15, 0.5);
const SET_MPA: f64 = 3.0;

/// *Chosen.* Resonance of stylus and hand on a contact of 10 MPa at 1 N, Hz, its exponent in the modulus,
/// and its damping ratio. Those of the sliding stylus are calibrated on strokes (`generator.toml` of the
/// reference corpus), of which no measured tap tells whether they hold for an impact.
const HAND_HZ: f64 = 122.0;
const HAND_EXPONENT: f64 = 0.09;
const HAND_DAMPING: f64 = 0.42;
const MATERIAL_DAMPING: f64 = 0.5;
/// *Chosen.* Part of the stylus that the hand holds.
const HELD: f64 = 0.35;

/// Frequency of the first mode at 1 MPa, Hz, and its exponent in the modulus, over ten measured
/// materials.
const MODE_HZ: f64 = 253.0;
const MODE_EXPONENT: f64 = 0.143;
/// Time in which a mode of loss factor 1 falls by 60 dB, s, and its exponent in the loss factor,
/// over the same.
const MODE_DECAY_S: f64 = 0.0236;
const MODE_DECAY_EXPONENT: f64 = -0.358;
/// Frequency and amplitude of the modes relative to the first: medians over the same.
const MODE_LADDER: [(f64, f64); MODES] = [(1.0, 1.0), (1.78, 1.11), (2.86, 0.84)];
/// *Chosen.* Mass of the stylus over that of the first mode, and the modulus that halves it, MPa: a
/// soft body gives way before it rings.
const MODE_SHARE: f64 = 0.15;
const MODE_SHARE_MPA: f64 = 3.0;
/// Modes above this frequency, Hz, do not fit a trace.
const MODE_LIMIT_HZ: f64 = 4500.0;

/// Samples over which the end of a trace is faded to zero.
const FADE_SAMPLES: usize = 20;

/// Parameters of a surface's transients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Hertzian contact time at [`REFERENCE_SPEED_M_S`], s.
    pub contact_s: f64,
    /// 1 − e per impact speed, s/m, with e the coefficient of restitution.
    pub loss_s_m: f64,
    /// The part of the opening that a dent takes away, 0–1.
    pub set: f64,
    /// Resonance of stylus and hand, Hz.
    pub hand_hz: f64,
    /// Damping ratio of that resonance.
    pub hand_damping: f64,
    /// Modes of the surface, by frequency.
    pub modes: [Mode; MODES],
}

/// A mode of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Frequency, Hz.
    pub freq_hz: f64,
    /// Time in which it falls by 60 dB, s.
    pub decay_s: f64,
    /// Mass of the stylus over the mode's.
    pub share: f64,
}

impl Impact {
    /// The impact on a material of an effective modulus, MPa, and a loss factor, both positive.
    #[must_use]
    pub fn of_material(modulus_mpa: f64, loss_factor: f64) -> Self {
        let (shortest, longest) = CONTACT_RANGE_S;
        let contact_s = SOFTEST_S * libm::pow(modulus_mpa / SOFTEST_MPA, STIFFNESS_EXPONENT);
        let (begins, reached) = SET_LOSS;
        let lossy = ((loss_factor - begins) / (reached - begins)).clamp(0.0, 1.0);
        let lossy = lossy * lossy * (3.0 - 2.0 * lossy);
        let share = MODE_SHARE * modulus_mpa / (modulus_mpa + MODE_SHARE_MPA);
        let first_hz = MODE_HZ * libm::pow(modulus_mpa, MODE_EXPONENT);
        let decay_s = MODE_DECAY_S * libm::pow(loss_factor, MODE_DECAY_EXPONENT);
        Self {
            contact_s: contact_s.clamp(shortest, longest),
            loss_s_m: LOSS_S_M + LOSS_S_M_PER_LOSS * loss_factor,
            set: LARGEST_SET * lossy * SET_MPA / (modulus_mpa + SET_MPA),
            hand_hz: HAND_HZ * libm::pow(modulus_mpa / 10.0, HAND_EXPONENT),
            hand_damping: HAND_DAMPING + MATERIAL_DAMPING * loss_factor,
            modes: MODE_LADDER.map(|(ratio, level)| Mode {
                freq_hz: (first_hz * ratio).min(MODE_LIMIT_HZ),
                decay_s,
                share: share * level,
            }),
        }
    }

    /// The modulus, MPa, whose contact time at [`REFERENCE_SPEED_M_S`] is given.
    #[must_use]
    pub fn modulus_mpa(contact_s: f64) -> f64 {
        let (shortest, longest) = CONTACT_RANGE_S;
        let ratio = contact_s.clamp(shortest, longest) / SOFTEST_S;
        SOFTEST_MPA * libm::pow(ratio, 1.0 / STIFFNESS_EXPONENT)
    }

    /// Hertz's contact time at an impact speed, s: T·(v/v₀)^(−1/5).
    #[must_use]
    pub fn contact_time_s(&self, speed_m_s: f64) -> f64 {
        self.contact_s * libm::pow(speed_m_s / REFERENCE_SPEED_M_S, TIME_EXPONENT)
    }

    /// Coefficient of restitution at an impact speed, not below 0.2: e = 1 − αv.
    #[must_use]
    pub fn restitution(&self, speed_m_s: f64) -> f64 {
        (1.0 - self.loss_s_m * speed_m_s).max(0.2)
    }

    /// Acceleration at an impact speed, away from the surface, at [`SAMPLE_RATE_HZ`] from the touch
    /// on. Its unit is such that ∫a dt = 1 after truncation; the peak then goes as v^(1/5).
    #[must_use]
    pub fn unit_trace(&self, speed_m_s: f64) -> [f64; SAMPLES] {
        let pulse = Pulse {
            time_s: self.contact_time_s(speed_m_s),
            restitution: self.restitution(speed_m_s),
            set: self.set,
        };
        let force: [f64; SAMPLES] = std::array::from_fn(|n| pulse.at(n as f64 / SAMPLE_RATE_HZ));
        let mut trace = force;
        let mut add = |share: f64, resonator: Resonator| {
            for (a, x) in trace.iter_mut().zip(resonator.response(&force)) {
                *a += share * x;
            }
        };
        let hand = Resonator::new(self.hand_hz, self.hand_damping, SAMPLE_RATE_HZ);
        add(-HELD, hand);
        for mode in &self.modes {
            let damping = resonator::damping_of_decay(mode.freq_hz, mode.decay_s);
            let resonator = Resonator::new(mode.freq_hz, damping, SAMPLE_RATE_HZ);
            add(mode.share, resonator);
        }
        for (n, a) in trace.iter_mut().enumerate() {
            *a *= fade(n);
        }
        let impulse = trace.iter().sum::<f64>() / SAMPLE_RATE_HZ;
        trace.map(|a| a / impulse)
    }
}

/// The impact speeds of a bank, m/s.
#[must_use]
pub fn speeds_m_s() -> [f64; SPEEDS] {
    std::array::from_fn(|n| SPEED_STEP_M_S * (n + 1) as f64)
}

/// A bank with an impulse ∫a dt of `impulse_per_speed`·v, or less where its strongest sample would
/// exceed `peak_m_s2`; all traces then shrink alike. m/s².
#[must_use]
pub fn bank(impact: &Impact, impulse_per_speed: f64, peak_m_s2: f64) -> [[f64; SAMPLES]; SPEEDS] {
    let mut traces = speeds_m_s().map(|speed_m_s| {
        let scale = impulse_per_speed * speed_m_s;
        impact.unit_trace(speed_m_s).map(|a| scale * a)
    });
    let samples = traces.iter().flatten();
    let peak = samples.fold(0.0_f64, |peak, a| peak.max(a.abs()));
    let scale = (peak_m_s2 / peak).min(1.0);
    for a in traces.iter_mut().flatten() {
        *a *= scale;
    }
    traces
}

fn fade(sample: usize) -> f64 {
    let left = (SAMPLES - sample) as f64 / FADE_SAMPLES as f64;
    if left < 1.0 {
        0.5 - 0.5 * libm::cos(PI * left)
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests;

// The force of a contact over time.

/// Fraction of its half of the contact time by which the closing shortens at e = 0: losses lean the pulse forward.
const LEAN: f64 = 0.3;

/// A Hertzian pulse, `sin^(3/2)` of a phase that runs from 0 to π. The force of a Hertzian contact
/// is the 3/2 power of an indentation that is nearly a half sine.
#[derive(Debug, Clone, Copy)]
struct Pulse {
    /// Contact time without losses, s.
    time_s: f64,
    /// Coefficient of restitution.
    restitution: f64,
    /// The part of the opening that a dent takes away.
    set: f64,
}

impl Pulse {
    /// Force at a time after the touch, relative to its peak.
    fn at(&self, t_s: f64) -> f64 {
        let closing_s = 0.5 * self.time_s * (1.0 - LEAN * (1.0 - self.restitution));
        let opening_s = (self.time_s - closing_s) * (1.0 - self.set);
        let phase = if t_s < closing_s {
            0.5 * t_s / closing_s
        } else {
            0.5 + 0.5 * (t_s - closing_s) / opening_s
        };
        if phase < 1.0 {
            let indentation = libm::sin(PI * phase).max(0.0);
            indentation * indentation.sqrt()
        } else {
            0.0
        }
    }
}
