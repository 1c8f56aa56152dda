//! The vibration that a texture's models promise: power over frequency, at a speed and a force.
//!
//! The density is (gain·σ)²·|B|²/|A|², whose mean over all frequencies is the variance. |A|² is the cosine series
//! r₀ + 2 Σ rₖ cos kω of the autocorrelation of A's coefficients, and |B|² that of B's.

use asperity_runtime::{Filter, math::cos_pi};

/// Lower end of the band that a hand feels as vibration, Hz: `rough_db` of an asset begins here too.
pub const FLOOR_HZ: f64 = 40.0;
/// Terms of a series: one more than the highest order.
const TERMS: usize = 25;
/// Frequencies side by side, none of which waits for another.
const LANES: usize = 8;

/// r₀, 2r₁, 2r₂, …, and how many of them there are.
type Series = ([f64; TERMS], usize);

/// Spectrum of one model.
#[derive(Debug, Clone, Copy)]
pub struct Spectrum {
    rate_hz: f64,
    variance_m2_s4: f64,
    numerator: Series,
    denominator: Series,
}

impl Spectrum {
    /// No vibration.
    pub const SILENT: Self = Self {
        rate_hz: 1.0,
        variance_m2_s4: 0.0,
        numerator: ([0.0; TERMS], 1),
        denominator: ([1.0; TERMS], 1),
    };

    /// The spectrum of a filter at its rate, Hz.
    #[must_use]
    pub fn new(filter: &Filter, rate_hz: f32) -> Self {
        let level_m_s2 = f64::from(filter.level_m_s2);
        Self {
            rate_hz: rate_hz.into(),
            variance_m2_s4: level_m_s2 * level_m_s2,
            numerator: autocorrelation(&filter.b),
            denominator: autocorrelation(&filter.a),
        }
    }

    /// Power density on one side at a frequency up to half the rate, (m/s²)²/Hz.
    #[must_use]
    pub fn density(&self, freq_hz: f64) -> f64 {
        self.densities([freq_hz; LANES])[0]
    }

    /// Power above [`FLOOR_HZ`] as the sum over at least so many frequencies, (m/s²)².
    #[must_use]
    pub fn power(&self, points: u32) -> f64 {
        if self.variance_m2_s4 == 0.0 {
            return 0.0;
        }
        let steps = points.div_ceil(LANES as u32);
        let lane_hz = (0.5 * self.rate_hz - FLOOR_HZ).max(0.0) / f64::from(steps) / LANES as f64;
        let step = |n| {
            let first_hz = FLOOR_HZ + f64::from(n) * LANES as f64 * lane_hz;
            let freqs_hz = core::array::from_fn(|lane| first_hz + (lane as f64 + 0.5) * lane_hz);
            self.densities(freqs_hz).iter().sum::<f64>()
        };
        (0..steps).map(step).sum::<f64>() * lane_hz
    }

    fn densities(&self, freqs_hz: [f64; LANES]) -> [f64; LANES] {
        let cosines = freqs_hz.map(|f| cos_pi((2.0 * f / self.rate_hz) as f32).into());
        let [above, below] = [&self.numerator, &self.denominator].map(|s| sum(s, &cosines));
        let scale = 2.0 / self.rate_hz * self.variance_m2_s4;
        core::array::from_fn(|lane| scale * above[lane] / below[lane])
    }
}

/// The series of 1 + Σ cₖ z⁻ᵏ.
fn autocorrelation(coefficients: &[f32; TERMS - 1]) -> Series {
    let mut monic = [1.0; TERMS];
    for (to, &from) in monic[1..].iter_mut().zip(coefficients) {
        *to = f64::from(from);
    }
    let series = core::array::from_fn(|lag| {
        let products = monic[lag..].iter().zip(&monic).map(|(a, b)| a * b);
        products.sum::<f64>() * if lag == 0 { 1.0 } else { 2.0 }
    });
    let order = coefficients.iter().rposition(|&c| c != 0.0);
    (series, order.map_or(1, |last| last + 2))
}

/// Σ sₖ cos kω by Clenshaw's recurrence; a square is not negative, whatever rounding says.
fn sum((series, terms): &Series, cosines: &[f64; LANES]) -> [f64; LANES] {
    let (mut next, mut after) = ([0.0; LANES], [0.0; LANES]);
    for term in series[1..*terms].iter().rev() {
        for lane in 0..LANES {
            let now = term + 2.0 * cosines[lane] * next[lane] - after[lane];
            (next[lane], after[lane]) = (now, next[lane]);
        }
    }
    core::array::from_fn(|lane| (series[0] + cosines[lane] * next[lane] - after[lane]).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    const RATE_HZ: f32 = 1000.0;

    fn filter(a: &[f32], b: &[f32], level_m_s2: f32) -> Filter {
        let padded = |from: &[f32]| core::array::from_fn(|k| from.get(k).copied().unwrap_or(0.0));
        Filter {
            a: padded(a),
            b: padded(b),
            level_m_s2,
        }
    }

    #[test]
    fn the_density_is_that_of_the_transfer_function() {
        let filter = filter(&[-1.1, 0.9, -0.2], &[0.4, 0.3], 2.0);
        let spectrum = Spectrum::new(&filter, RATE_HZ);
        for step in 0..=100 {
            let freq_hz = f64::from(step) * 5.0;
            let squared = |coefficients: &[f32]| {
                let part = |turn: fn(f64) -> f64| {
                    let terms = coefficients.iter().zip(1_u32..);
                    let angle = |k| TAU * freq_hz / f64::from(RATE_HZ) * f64::from(k);
                    turn(0.0)
                        + terms
                            .map(|(&c, k)| f64::from(c) * turn(angle(k)))
                            .sum::<f64>()
                };
                part(f64::cos).powi(2) + part(f64::sin).powi(2)
            };
            let wanted = 2.0 / f64::from(RATE_HZ) * 4.0 * squared(&filter.b) / squared(&filter.a);
            let found = spectrum.density(freq_hz);
            assert!((found / wanted - 1.0).abs() < 1e-5, "{freq_hz} Hz: {found}");
        }
    }

    #[test]
    fn the_power_of_white_noise_is_its_share_of_the_variance() {
        let power = Spectrum::new(&filter(&[], &[], 3.0), RATE_HZ).power(7);
        assert!(
            (power - 9.0 * (1.0 - FLOOR_HZ / 500.0)).abs() < 1e-12,
            "{power}"
        );
        assert_eq!(Spectrum::SILENT.power(7), 0.0);
    }
}
