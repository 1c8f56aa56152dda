//! The upsampler, from samples of the models to ticks: an elliptic low-pass of order 7 as a
//! cascade of sections.

use std::f64::consts::PI;

/// Positions of the zeros on the imaginary axis, and of the poles with Im ≥ 0, in rad per
/// rad/s of pass edge: `scipy.signal.ellipap(7, 0.03, 48)`.
const ZEROS: [f64; 3] = [1.242_595_184_375, 1.430_694_308_584, 2.307_542_882_671];
const POLES: [(f64, f64); 3] = [
    (-0.050_934_151_459, 1.045_041_208_448),
    (-0.199_106_642_957, 0.958_225_748_917),
    (-0.459_981_775_780, 0.664_057_594_997),
];
const REAL_POLE: f64 = -0.650_048_816_500;
/// Pass edge as a fraction of the rate of the models.
const EDGE: f64 = 0.45;

/// A section (b0 + b1 z⁻¹ + b2 z⁻²)/(1 + a1 z⁻¹ + a2 z⁻²) and its state.
#[derive(Debug, Clone)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
    x: [f64; 2],
    y: [f64; 2],
}

impl Section {
    /// With these coefficients in z⁻¹ and unit gain at DC.
    fn new(b: [f64; 3], a: [f64; 2]) -> Self {
        let gain = (1.0 + a[0] + a[1]) / (b[0] + b[1] + b[2]);
        Self {
            b: b.map(|b| gain * b),
            a,
            x: [0.0; 2],
            y: [0.0; 2],
        }
    }

    fn step(&mut self, x: f64) -> f64 {
        let y = self.b[0] * x + self.b[1] * self.x[0] + self.b[2] * self.x[1]
            - self.a[0] * self.y[0]
            - self.a[1] * self.y[1];
        (self.x, self.y) = ([x, self.x[0]], [y, self.y[0]]);
        y
    }
}

/// 1 − 2 Re(q) z⁻¹ + |q|² z⁻² of q = (c + s)/(c − s), s = re + j·im.
fn pair(c: f64, (re, im): (f64, f64)) -> [f64; 2] {
    let square = |re: f64| re * re + im * im;
    let below = square(c - re);
    [
        -2.0 * (c * c - re * re - im * im) / below,
        square(c + re) / below,
    ]
}

/// The low-pass at a servo rate of `ticks` times the rate of the models.
#[derive(Debug, Clone)]
pub struct Interpolator {
    ticks: usize,
    sections: Vec<Section>,
}

impl Interpolator {
    /// At rest; the bilinear transform keeps the pass edge.
    #[must_use]
    pub fn new(ticks: usize) -> Self {
        let c = 1.0 / (PI * EDGE / ticks as f64).tan();
        let q = (c + REAL_POLE) / (c - REAL_POLE);
        let mut sections = vec![Section::new([1.0, 1.0, 0.0], [-q, 0.0])];
        for (zero, pole) in ZEROS.into_iter().zip(POLES) {
            let [b1, b2] = pair(c, (0.0, zero));
            sections.push(Section::new([1.0, b1, b2], pair(c, pole)));
        }
        Self { ticks, sections }
    }

    /// Back to rest.
    pub fn reset(&mut self) {
        for section in &mut self.sections {
            (section.x, section.y) = ([0.0; 2], [0.0; 2]);
        }
    }

    /// The output of a tick in which the sample `y` enters, or 0. Its level in band is that of the
    /// models.
    pub fn step(&mut self, y: f64) -> f64 {
        let driven = y * self.ticks as f64;
        self.sections.iter_mut().fold(driven, |x, s| s.step(x))
    }
}
