//! Velocity: the backward difference of positions, through a Butterworth low-pass of second
//! order.

/// `H(s) = 1/(1 + √2 s + s²)` by the bilinear transform with its cut-off kept, as the
/// direct form of the difference equation.
#[derive(Debug, Clone)]
pub struct Butterworth2 {
    gain: f64,
    a1: f64,
    a2: f64,
    x: [f64; 2],
    y: [f64; 2],
}

impl Butterworth2 {
    /// At rest.
    #[must_use]
    pub fn new(cutoff_hz: f64, rate_hz: f64) -> Self {
        // s = (1 − z⁻¹) / (K (1 + z⁻¹)), K = tan(π f_c / f_s).
        let c = 1.0 / (std::f64::consts::PI * cutoff_hz / rate_hz).tan();
        let whole = 1.0 + std::f64::consts::SQRT_2 * c + c * c;
        Self {
            gain: 1.0 / whole,
            a1: 2.0 * (1.0 - c * c) / whole,
            a2: (1.0 - std::f64::consts::SQRT_2 * c + c * c) / whole,
            x: [0.0; 2],
            y: [0.0; 2],
        }
    }

    /// Back to rest.
    pub fn reset(&mut self) {
        (self.x, self.y) = ([0.0; 2], [0.0; 2]);
    }

    /// Filters a sample.
    pub fn step(&mut self, x: f64) -> f64 {
        let y = self.gain * (x + 2.0 * self.x[0] + self.x[1])
            - self.a1 * self.y[0]
            - self.a2 * self.y[1];
        self.x = [x, self.x[0]];
        self.y = [y, self.y[0]];
        y
    }
}
