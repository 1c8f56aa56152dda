//! Upsampling: samples of the models to ticks of a faster servo loop.
//!
//! A model keeps its clock whatever the servo rate: in one of `ticks` ticks a sample y\[n\] enters,
//! in the others zero. A low-pass keeps the band of the model and takes out its images. It is an
//! elliptic one of order 7: flat within 0.03 dB up to 0.45 of the models' rate (450 Hz at 1 kHz),
//! whose images begin at 0.55. Each image is at least 47 dB down; those of white noise are 40 dB
//! down together. Halfway, at 500 Hz, it is 10 dB down or more. Its group delay at models of 1 kHz
//! is 1.2 ms up to 100 Hz, 1.6 ms at 250 Hz and 3.2 ms at 400 Hz; a linear phase would take 8 ms
//! everywhere.
//!
//! It runs as parallel sections, a pole each, which are mapped to the servo rate in closed form
//! (bilinear transform, exact at 0.45 of the models' rate): `r/(s − p)` becomes
//! `g·(1 + z⁻¹)/(1 − q·z⁻¹)` with q = (c + p)/(c − p), g = r/(c − p), c = 1/tan(0.45π/ticks).

use super::recursion::InnerProduct;
use crate::{
    arithmetic::{Arithmetic, Cut, Zero as _},
    complex::Complex4,
    lanes::F4,
    math::{cos_pi, sin_pi},
    quantity::{
        Four, Quantity, Raw,
        unit::{Fraction, Residue, VibrationAcceleration},
    },
};

/// State and output of the low-pass stay within this, m/s², where numbers have a range.
const LOUDEST_M_S2: f32 = 16_000.0;

/// Ticks that a sample of the models may last, at most.
pub(crate) const MAX_TICKS: u8 = 20;

/// Edge of the pass band, in rates of the models.
const EDGE: f32 = 0.45;

/// Poles with Im ≥ 0 (rad per rad/s of pass edge) and residues of the prototype with unit gain at
/// DC: `scipy.signal.ellipap(7, 0.03, 48)`, `scipy.signal.residue`. A residue with Im ≠ 0 is
/// doubled, because it stands for its conjugate, too.
const POLES: Complex4 = Complex4 {
    re: F4::load(&[-0.050_934_15, -0.199_106_64, -0.459_981_78, -0.650_048_8]),
    im: F4::load(&[1.045_041_2, 0.958_225_7, 0.664_057_6, 0.0]),
};
const RESIDUES: Complex4 = Complex4 {
    re: F4::load(&[0.080_823_96, 0.098_144_5, -1.102_655_8, 0.950_117_6]),
    im: F4::load(&[-0.086_019_13, 0.481_816_93, -0.679_401_8, 0.0]),
};

/// Ticks that a sample of models at `model_hz` lasts in a servo loop at `servo_hz`: a whole
/// number from 1 to 20, or `None` where their textures cannot be loaded for that loop. The
/// product has one rounding, so that 1000 Hz is three times the `f32` next to 1000/3 Hz.
#[must_use]
pub fn ticks_per_sample(model_hz: f32, servo_hz: f32) -> Option<u8> {
    (1..=MAX_TICKS).find(|&ticks| model_hz * f32::from(ticks) == servo_hz)
}

/// The low-pass at the servo rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Upsampler<A: Arithmetic> {
    /// Real and imaginary parts.
    poles: [Four<A, Fraction>; 2],
    residues: [Four<A, Residue>; 2],
    /// The gain from a sample to the output of its own tick.
    direct: Quantity<A, Residue>,
    /// Rate of the ticks, Hz; 0 for none yet. Here it takes no room: four lanes are aligned.
    servo_rate_hz: f32,
    ticks: u8,
}

impl<A: InnerProduct> Upsampler<A> {
    /// No low-pass, for models that run at the servo rate.
    pub(crate) const NONE: Self = Self {
        poles: [Four::ZERO; 2],
        residues: [Four::ZERO; 2],
        direct: Quantity::ZERO,
        servo_rate_hz: 0.0,
        ticks: 1,
    };

    /// The low-pass for models whose samples last 2 to [`MAX_TICKS`] ticks of a rate; none for 1.
    pub(crate) fn new(ticks: u8, servo_rate_hz: f32) -> Self {
        if ticks < 2 {
            return Self {
                servo_rate_hz,
                ..Self::NONE
            };
        }
        let angle = EDGE / f32::from(ticks);
        let c = cos_pi(angle) / sin_pi(angle);
        let mut direct = 0.0;
        let (mut poles, mut residues) = ([[0.0; 4]; 2], [[0.0; 4]; 2]);
        for lane in 0..4 {
            let [p, r] = [POLES, RESIDUES].map(|x| [x.re.to_array()[lane], x.im.to_array()[lane]]);
            let per_difference = reciprocal([c - p[0], -p[1]]);
            let q = product([c + p[0], p[1]], per_difference);
            // Nothing enters in the other ticks: the gain makes up for them.
            let g = product(r, per_difference).map(|x| x * f32::from(ticks));
            // (1 + z⁻¹)/(1 − q·z⁻¹) = 1 + (1 + q)·z⁻¹/(1 − q·z⁻¹).
            let late = product(g, [1.0 + q[0], q[1]]);
            direct += g[0];
            for part in 0..2 {
                (poles[part][lane], residues[part][lane]) = (q[part], late[part]);
            }
        }
        Self {
            poles: poles.map(Four::of),
            residues: residues.map(Four::of),
            direct: Quantity::of(direct),
            servo_rate_hz,
            ticks,
        }
    }

    /// Rate of the ticks, Hz; 0 for none yet.
    #[inline(always)]
    pub(crate) const fn servo_rate_hz(&self) -> f32 {
        self.servo_rate_hz
    }

    /// Ticks that a sample of the models lasts.
    #[inline(always)]
    pub(crate) const fn ticks(&self) -> u8 {
        self.ticks
    }

    /// The output of a tick, m/s², in which `y` enters: a sample of the model, or 0.
    #[inline(always)]
    pub(crate) fn step(
        &self,
        held: &mut Held<A>,
        y: Quantity<A, VibrationAcceleration>,
    ) -> Quantity<A, VibrationAcceleration> {
        let [re, im] = held.lanes();
        let against = Four::ZERO - im;
        let [pole, pole_im] = self.poles;
        let [residue, residue_im] = self.residues;
        let late = Four::<A, VibrationAcceleration>::sum_of_products(
            [(re, residue), (against, residue_im)],
            Cut::At(LOUDEST_M_S2 / 4.0),
        );
        let next = Four::<A, VibrationAcceleration>::sum_of_products(
            [(re, pole), (against, pole_im)],
            Cut::At(LOUDEST_M_S2 / 2.0),
        );
        let turned = Four::sum_of_products([(im, pole), (re, pole_im)], Cut::At(LOUDEST_M_S2));
        *held = Held::of(next + Four::splat(y), turned);
        let now = Quantity::sum_of_products([(y, self.direct)], Cut::At(LOUDEST_M_S2 / 2.0));
        // A verified texture comes nowhere near.
        let limit = Quantity::of(A::VIB_LIMIT_M_S2);
        let out = now + late.sum();
        out.min(limit).max(-limit)
    }
}

/// State of a low-pass: one complex number for each pole, m/s².
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Held<A: Arithmetic> {
    re: [Raw<A, VibrationAcceleration>; 4],
    /// The last pole is real, so its imaginary part is zero.
    im: [Raw<A, VibrationAcceleration>; 3],
}

impl<A: InnerProduct> Held<A> {
    pub(crate) const SILENT: Self = Self {
        re: [A::Scalar::ZERO; 4],
        im: [A::Scalar::ZERO; 3],
    };

    #[inline(always)]
    fn of(re: Four<A, VibrationAcceleration>, im: Four<A, VibrationAcceleration>) -> Self {
        Self {
            re: re.to_array(),
            im: im.vector().to_array(),
        }
    }

    #[inline(always)]
    fn lanes(&self) -> [Four<A, VibrationAcceleration>; 2] {
        let [a, b, c] = self.im;
        let im = Four::load(&[a, b, c, A::Scalar::ZERO]);
        [Four::load(&self.re), im]
    }

    /// Clears a state that nobody feels, so that no denormal slows a tick.
    #[inline(always)]
    pub(crate) fn settle(&mut self) {
        let [re, im] = self.lanes();
        let silence = Quantity::of(A::SILENCE_M_S2);
        if re.is_within(silence) & im.is_within(silence) {
            *self = Self::SILENT;
        }
    }
}

fn product(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn reciprocal([re, im]: [f32; 2]) -> [f32; 2] {
    let square = re * re + im * im;
    [re / square, -im / square]
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::arithmetic::Float;

    /// Gain of a low-pass, and its delay in samples of the models, at a frequency in their rate:
    /// from its own coefficients, H(z) = (direct + Re Σ R z⁻¹/(1 − q z⁻¹))/ticks.
    fn response(filter: &Upsampler<Float>, frequency: f64) -> (f64, f64) {
        let ticks = f64::from(filter.ticks);
        let at = |frequency: f64| {
            let w = core::f64::consts::TAU * frequency / ticks;
            let (mut re, mut im) = (f64::from(filter.direct.0), 0.0);
            for lane in 0..4 {
                let [a, b] = filter.residues.map(|x| f64::from(x.lane(lane).0));
                let [qa, qb] = filter.poles.map(|x| f64::from(x.lane(lane).0));
                // Half of R and q, half of their conjugates: real coefficients.
                for (b, qb) in [(b, qb), (-b, -qb)] {
                    let (da, db) = (w.cos() - qa, w.sin() - qb);
                    let square = 2.0 * (da * da + db * db);
                    re += (a * da + b * db) / square;
                    im += (b * da - a * db) / square;
                }
            }
            (re.hypot(im) / ticks, im.atan2(re))
        };
        let step = 1e-5;
        let turned = at(frequency - step).1 - at(frequency + step).1;
        let turned = turned.rem_euclid(core::f64::consts::TAU);
        let delay = turned / (2.0 * step * core::f64::consts::TAU);
        (at(frequency).0, delay)
    }

    fn db(gain: f64) -> f64 {
        20.0 * gain.log10()
    }

    #[test]
    fn the_band_is_kept_and_images_are_taken_out() {
        for ticks in 2..=MAX_TICKS {
            let filter = Upsampler::<Float>::new(ticks, 1000.0 * f32::from(ticks));
            let gains = |from: usize, to: usize| {
                let gain = |n: usize| db(response(&filter, n as f64 * 1e-3).0);
                (from..=to).map(gain)
            };
            let (low, high) = gains(1, 450).fold((0.0_f64, 0.0_f64), |(low, high), gain| {
                (low.min(gain), high.max(gain))
            });
            assert!(low > -0.032 && high < 0.002, "{ticks}: {low} {high} dB");
            let image = gains(550, 500 * usize::from(ticks)).fold(f64::MIN, f64::max);
            assert!(image < -46.9, "{ticks}: {image} dB");
        }
    }

    /// The table of `docs/rates.md`.
    #[test]
    fn the_delay_is_as_stated() {
        for (ticks, stated_ms) in [
            (2, [1.02, 1.06, 1.44, 3.51]),
            (5, [1.20, 1.23, 1.58, 3.21]),
            (10, [1.22, 1.25, 1.59, 3.16]),
        ] {
            let filter = Upsampler::<Float>::new(ticks, 1000.0 * f32::from(ticks));
            for (frequency, stated) in [0.05, 0.1, 0.25, 0.4].into_iter().zip(stated_ms) {
                let (_, delay) = response(&filter, frequency);
                assert!(
                    (delay - stated).abs() < 0.01,
                    "{ticks}, {frequency}: {delay}"
                );
            }
        }
    }

    /// The step has the frequency response of its coefficients: a tone fed at a sample a model
    /// period comes out with the gain at its frequency.
    #[test]
    fn a_tone_comes_out_at_its_level() {
        for ticks in [2, 5, 10] {
            let filter = Upsampler::<Float>::new(ticks, 1000.0 * f32::from(ticks));
            for frequency in [0.01, 0.1, 0.25, 0.44, 0.47] {
                let mut held = Held::SILENT;
                let (mut power, count) = (0.0, 4000);
                for n in 0..2 * count {
                    let tone = core::f64::consts::TAU * frequency * f64::from(n);
                    for tick in 0..ticks {
                        let y = if tick == 0 { tone.sin() as f32 } else { 0.0 };
                        let out = f64::from(filter.step(&mut held, Quantity(y)).0);
                        power += if n < count { 0.0 } else { out * out };
                    }
                }
                let level = (2.0 * power / f64::from(count * i32::from(ticks))).sqrt();
                // Its image counts, too.
                let (gain, image) = (
                    response(&filter, frequency).0,
                    response(&filter, 1.0 - frequency).0,
                );
                let wanted = gain.hypot(image);
                assert!(
                    (level / wanted - 1.0).abs() < 2e-3,
                    "{ticks}, {frequency}: {level} {wanted}"
                );
            }
        }
    }

    #[test]
    fn only_whole_multiples_are_rates() {
        for (model_hz, servo_hz, ticks) in [
            (1000.0, 1000.0, Some(1)),
            (1000.0, 10_000.0, Some(10)),
            (1000.0, 20_000.0, Some(20)),
            (1000.0 / 3.0, 1000.0, Some(3)),
            (441.0, 4410.0, Some(10)),
            (1000.0, 21_000.0, None),
            (1000.0, 1500.0, None),
            (1000.0, 999.999, None),
            (2000.0, 1000.0, None),
            (1000.0, f32::NAN, None),
            (1000.0, f32::INFINITY, None),
        ] {
            assert_eq!(ticks_per_sample(model_hz, servo_hz), ticks, "{servo_hz}");
        }
    }

    /// A single number above the silence threshold, in any place, keeps all of them.
    #[test]
    fn only_a_state_that_nobody_feels_is_cleared() {
        let silence = Float::SILENCE_M_S2;
        let quiet = Held::<Float> {
            re: [silence, -silence, 0.0, silence],
            im: [-silence, silence, 0.0],
        };
        let mut held = quiet.clone();
        held.settle();
        assert_eq!(held, Held::SILENT);
        for place in 0..7 {
            let mut heard = quiet.clone();
            if place < 4 {
                heard.re[place] = 2.0 * silence;
            } else {
                heard.im[place - 4] = -2.0 * silence;
            }
            let mut kept = heard.clone();
            kept.settle();
            assert_eq!(kept, heard);
        }
    }
}
