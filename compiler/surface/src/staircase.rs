//! Smoothing of heights that are stored in coarse steps.

use crate::heights::HeightField;

/// Wave numbers over which the power is averaged, as a part of the largest.
const RINGS: usize = 256;

impl HeightField {
    /// The heights without the noise of rounding to steps of `step_um`, which is white with the variance step²/12: Wiener's
    /// filter for the power that is left in each ring of wave numbers.
    #[must_use]
    pub fn smoothed(&self, step_um: f64) -> Self {
        let (width, height) = (self.width(), self.height());
        let mut plane = self.plane();
        let per_mm = self.step_per_mm();
        let end = (0.5 * width as f64 * per_mm[0]).hypot(0.5 * height as f64 * per_mm[1]);
        let ring = |[x, y]: [f64; 2]| {
            let k_per_mm = libm::hypot(x * per_mm[0], y * per_mm[1]);
            ((k_per_mm / end * RINGS as f64) as usize).min(RINGS - 1)
        };
        let mut rings = [(0.0, 0.0); RINGS];
        for (periods, halves, wave) in plane.waves_mut() {
            let (power, count) = &mut rings[ring(periods)];
            *power += halves * wave.norm_sqr();
            *count += halves;
        }
        let noise = step_um * step_um / 12.0 * (width * height) as f64;
        for (periods, _, wave) in plane.waves_mut() {
            let (power, count) = rings[ring(periods)];
            *wave *= (1.0 - noise * count / power).max(0.0);
        }
        self.of_plane(plane)
    }
}
