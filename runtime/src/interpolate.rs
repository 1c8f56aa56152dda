//! Samples of the models to ticks of a faster servo loop.
//!
//! A model keeps its clock whatever the servo rate: in one of `ticks` ticks a sample y\[n\]
//! enters, in the others nothing, and a low-pass keeps the band of the model and takes out its
//! images. It is an elliptic one of order 7: flat within 0.02 dB up to 0.45 of the models' rate
//! (450 Hz at 1 kHz), where the first images are those from 0.55 upwards: at least 43 dB down,
//! as is all above 0.535. In between, 500 Hz is 11 dB down. Its group delay at models of 1 kHz
//! is 1.1 ms up to 100 Hz, 1.5 ms at 250 Hz and 3.1 ms at 400 Hz; a linear phase would take
//! 8 ms everywhere.
//!
//! It runs as parallel sections, a pole each, which are mapped to the servo rate in closed form
//! (bilinear transform, exact at 0.45 of the models' rate): `r/(s − p)` becomes
//! `g·(1 + z⁻¹)/(1 − q·z⁻¹)` with q = (c + p)/(c − p), g = r/(c − p), c = 1/tan(0.45π/ticks).

use crate::{
    complex::Complex4,
    lanes::F4,
    math::{cos_pi, max, min, sin_pi},
    synthesis::VIB_LIMIT_M_S2,
};

/// Ticks that a sample of the models may last, at most.
pub(crate) const MAX_TICKS: u8 = 20;

/// Edge of the pass band, in rates of the models.
const EDGE: f32 = 0.45;
/// Less than this is silence, m/s².
const SILENCE_M_S2: f32 = 1.0e-20;

/// Poles with Im ≥ 0 (rad per rad/s of pass edge) and residues of the prototype with unit gain
/// at DC: `scipy.signal.ellipap(7, 0.02, 43)`, `scipy.signal.residue`. A residue with Im ≠ 0 is
/// twice its own: it stands for its conjugate, too.
const POLES: Complex4 = Complex4 {
    re: F4::load(&[-0.048_502_054, -0.197_750_58, -0.491_077_98, -0.728_127_55]),
    im: F4::load(&[1.048_766, 0.978_942_35, 0.707_800_72, 0.0]),
};
const RESIDUES: Complex4 = Complex4 {
    re: F4::load(&[0.091_007_843, 0.057_201_658, -1.170_167_9, 1.066_427]),
    im: F4::load(&[-0.066_205_716, 0.484_946_72, -0.741_624_73, 0.0]),
};

/// Ticks of the servo loop a sample of the models: a whole number, up to [`MAX_TICKS`]. The
/// product has one rounding, so that 1000 Hz is three times the `f32` next to 1000/3 Hz.
pub(crate) fn ticks_per_sample(model_hz: f32, servo_hz: f32) -> Option<u8> {
    (1..=MAX_TICKS).find(|&ticks| model_hz * f32::from(ticks) == servo_hz)
}

/// The low-pass at the servo rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interpolator {
    poles: Complex4,
    residues: Complex4,
    /// What a sample gives at once.
    direct: f32,
    ticks: u8,
}

impl Interpolator {
    /// For models that run at the servo rate.
    pub(crate) const NONE: Self = Self {
        poles: Complex4::ZERO,
        residues: Complex4::ZERO,
        direct: 1.0,
        ticks: 1,
    };

    /// For models a sample of which lasts 2 to [`MAX_TICKS`] ticks.
    pub(crate) fn new(ticks: u8) -> Self {
        if ticks < 2 {
            return Self::NONE;
        }
        let angle = EDGE / f32::from(ticks);
        let c = cos_pi(angle) / sin_pi(angle);
        let mut filter = Self {
            direct: 0.0,
            ticks,
            ..Self::NONE
        };
        let (mut poles, mut residues) = ([[0.0; 4]; 2], [[0.0; 4]; 2]);
        for lane in 0..4 {
            let [p, r] = [POLES, RESIDUES].map(|x| [x.re.lane(lane), x.im.lane(lane)]);
            let per_difference = reciprocal([c - p[0], -p[1]]);
            let q = product([c + p[0], p[1]], per_difference);
            // Nothing enters in the other ticks: the gain makes up for them.
            let g = product(r, per_difference).map(|x| x * f32::from(ticks));
            // (1 + z⁻¹)/(1 − q·z⁻¹) = 1 + (1 + q)·z⁻¹/(1 − q·z⁻¹).
            let late = product(g, [1.0 + q[0], q[1]]);
            filter.direct += g[0];
            for part in 0..2 {
                (poles[part][lane], residues[part][lane]) = (q[part], late[part]);
            }
        }
        let lanes = |[re, im]: [[f32; 4]; 2]| Complex4 {
            re: F4::load(&re),
            im: F4::load(&im),
        };
        (filter.poles, filter.residues) = (lanes(poles), lanes(residues));
        filter
    }

    /// Ticks a sample of the models.
    #[inline(always)]
    pub(crate) const fn ticks(&self) -> u8 {
        self.ticks
    }

    /// The output of a tick, m/s², in which `y` enters: a sample of the model, or 0.
    #[inline(always)]
    pub(crate) fn step(&self, held: &mut Held, y: f32) -> f32 {
        let state = held.state();
        let out = self.direct * y + state.response(&self.residues);
        let next = state.times(self.poles);
        *held = Held([(next.re + F4::splat(y)).to_array(), next.im.to_array()]);
        // A verified texture comes nowhere near.
        max(min(out, VIB_LIMIT_M_S2), -VIB_LIMIT_M_S2)
    }
}

/// What a low-pass holds: a complex number a pole, m/s².
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Held([[f32; 4]; 2]);

impl Held {
    pub(crate) const SILENT: Self = Self([[0.0; 4]; 2]);

    #[inline(always)]
    fn state(&self) -> Complex4 {
        let [re, im] = &self.0;
        Complex4 {
            re: F4::load(re),
            im: F4::load(im),
        }
    }

    /// Ends what no one feels, so that no denormal slows a tick.
    #[inline(always)]
    pub(crate) fn settle(&mut self) {
        let Complex4 { re, im } = self.state();
        if re.is_within(SILENCE_M_S2) & im.is_within(SILENCE_M_S2) {
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
