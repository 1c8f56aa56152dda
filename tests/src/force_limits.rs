//! The law that holds for every tick: the force is finite, and within peak and slew.

use asperity_runtime::{Config, Output, RenderArithmetic, arithmetic::Scalar as _};

/// The limits of a configuration, and the force of the previous tick.
#[derive(Debug, Clone)]
pub struct ForceLimits {
    peak_n: f64,
    step_n: f64,
    last_n: [f32; 3],
}

/// Euclidean norm.
#[must_use]
pub fn size(v: [f32; 3]) -> f64 {
    v.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt()
}

impl ForceLimits {
    /// Before the first tick, without force.
    #[must_use]
    pub fn new(config: &Config) -> Self {
        let peak_n = f64::from(config.limits.peak_n);
        let exact = f64::from(config.limits.slew_n_s) / f64::from(config.servo_rate_hz);
        Self {
            peak_n,
            // The exact slew, plus the rounding of both forces.
            step_n: exact + 2.0 * peak_n * f64::from(f32::EPSILON),
            last_n: [0.0; 3],
        }
    }

    /// The force of the previous tick, N.
    #[must_use]
    pub fn last_n(&self) -> [f32; 3] {
        self.last_n
    }

    /// Checks the next tick.
    ///
    /// # Panics
    /// If a number is not finite, or the force leaves the limits.
    pub fn check<A: RenderArithmetic>(&mut self, output: &Output<A>) {
        let force_n = output.force_n.map(|x| x.value());
        assert!(size(force_n) <= self.peak_n, "peak: {output:?}");
        let change = std::array::from_fn(|i| force_n[i] - self.last_n[i]);
        assert!(
            size(change) <= self.step_n,
            "slew: {output:?} after {:?}",
            self.last_n
        );
        let numbers = [
            output.depth_m.value(),
            output.speed_mm_s.value(),
            output.normal_force_n.value(),
            output.vib_m_s2.value(),
            output.tap_n.value(),
            output.friction_n.value(),
        ];
        assert!(numbers.iter().all(|x| x.is_finite()), "{output:?}");
        self.last_n = force_n;
    }
}
