//! A hand that strokes and taps the plane z = 0, in virtual time.

use super::Stroke;
use asperity_formats::Coupling;
use asperity_runtime::{HostTexture, Renderer, Sample, State};
use asperity_texture::model::ContactLaw;
use std::f64::consts::PI;

/// Time in which a stroke comes to its speed, and to rest, s.
const RAMP_S: f64 = 0.12;
/// Height from which a tap falls, m, and how deep it goes.
const FALL_M: f64 = 0.006;
const DEPTH_M: f64 = 0.001;
/// Time that the stylus stays in the surface after a tap, s.
const HELD_S: f32 = 0.3;
/// Ticks that a tap falls at least: the runtime takes the impact speed from eight distances.
const FALL_TICKS: f64 = 16.0;

/// A texture in a servo loop.
pub(super) struct Hand<'a> {
    pub(super) renderer: &'a Renderer,
    pub(super) texture: &'a HostTexture,
    pub(super) coupling: Coupling,
    pub(super) contact: Option<ContactLaw>,
    pub(super) rate_hz: f32,
    pub(super) seed: u64,
}

impl Hand<'_> {
    fn ticks(&self, time_s: f32) -> usize {
        (time_s * self.rate_hz).round() as usize
    }

    /// The depth at which the surface bears a force once it has yielded, m.
    fn depth_m(&self, force_n: f64) -> f64 {
        let wall = self.renderer.wall(&self.coupling);
        let stiffness_n_m = f64::from(wall.stiffness.0).max(1.0);
        let Some(law) = &self.contact else {
            return force_n / stiffness_n_m;
        };
        let asked_n_m = f64::from(self.coupling.stiffness_n_m);
        law.pressed_mm(force_n * asked_n_m / stiffness_n_m, asked_n_m) / 1000.0
    }

    /// The vibration of a stroke, m/s² before device gain. Each stroke, by its number, has an
    /// excitation of its own.
    pub(super) fn stroke(&self, stroke: &Stroke, number: u64) -> Vec<f64> {
        // Already in contact: a stroke begins without a tap.
        let z_m = -self.depth_m(f64::from(stroke.force_n));
        let ticks = self.ticks(stroke.time_s);
        let period_s = 1.0 / f64::from(self.rate_hz);
        let length_s = ticks as f64 * period_s;
        let mut state = State::new(self.seed.wrapping_add(number));
        let mut x_m = 0.0;
        (0..ticks)
            .map(|n| {
                let t_s = n as f64 * period_s;
                let from_end_s = t_s.min(length_s - t_s).min(RAMP_S);
                let share = 0.5 - 0.5 * libm::cos(PI * from_end_s / RAMP_S);
                x_m += share * f64::from(stroke.speed_mm_s) / 1000.0 * period_s;
                let sample = Sample::at([x_m as f32, 0.0, z_m as f32]);
                let out = self.renderer.tick(self.texture, &mut state, &sample);
                f64::from(out.vib_m_s2)
            })
            .collect()
    }

    /// The transient of an impact, m/s².
    pub(super) fn tap(&self, speed_m_s: f32) -> Vec<f64> {
        let mass_kg = f64::from(self.coupling.effective_mass_kg).max(1e-9);
        let step_m = f64::from(speed_m_s) / f64::from(self.rate_hz);
        let height_m = FALL_M.max(FALL_TICKS * step_m);
        let falling = (height_m / step_m).ceil() as usize;
        let mut state = State::new(self.seed);
        (0..falling + self.ticks(HELD_S))
            .map(|n| {
                let z_m = (height_m - n as f64 * step_m).max(-DEPTH_M);
                let sample = Sample::at([0.0, 0.0, z_m as f32]);
                let out = self.renderer.tick(self.texture, &mut state, &sample);
                f64::from(out.tap_n) / mass_kg
            })
            // The fall is silent, and slow taps would fall for long.
            .skip(falling.saturating_sub(4))
            .collect()
    }
}
