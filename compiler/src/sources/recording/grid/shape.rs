//! The spectrum of a model as a function of the cosines of its line spectral frequencies.

use asperity_texture::{model::Numerator, signal::spectrum::squared_magnitude};

/// Frequencies at which spectra are looked at, and a numerator's part in them.
pub(super) struct Shape {
    /// cos ω.
    cosines: Vec<f64>,
    /// |B|².
    above: Vec<f64>,
}

impl Shape {
    /// At `omegas`, rad, under B = 1 + z⁻¹ or 1.
    pub(super) fn new(omegas: &[f64], numerator: Numerator) -> Self {
        let above = omegas.iter().map(|&omega| match numerator {
            Numerator::Nyquist => squared_magnitude(&[1.0, 1.0], omega),
            _ => 1.0,
        });
        Self {
            cosines: omegas.iter().map(|omega| libm::cos(*omega)).collect(),
            above: above.collect(),
        }
    }

    /// |B|²/|A|² at every frequency, and the derivative of its logarithm by every cosine, followed by
    /// that by the logarithm of the level.
    pub(super) fn spectrum_and_rows(&self, c: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let mut rows = Vec::with_capacity(self.cosines.len());
        let powers = self
            .cosines
            .iter()
            .zip(&self.above)
            .map(|(&x, &above)| {
                let (sum, difference, below) = self.halves(c, x);
                let mut row: Vec<f64> = c
                    .iter()
                    .enumerate()
                    .map(|(k, c)| {
                        let half = if k % 2 == 0 { sum } else { difference };
                        let away = x - c;
                        if away.abs() < 1e-12 {
                            0.0
                        } else {
                            2.0 * half / (away * below)
                        }
                    })
                    .collect();
                row.push(2.0);
                rows.push(row);
                above / below
            })
            .collect();
        (powers, rows)
    }

    pub(super) fn spectrum(&self, c: &[f64]) -> impl Iterator<Item = f64> {
        let points = self.cosines.iter().zip(&self.above);
        points.map(|(&x, &above)| above / self.halves(c, x).2)
    }

    /// Parts of |A|² by the sum and by the difference polynomial, whose roots the cosines are in turn,
    /// and their sum.
    fn halves(&self, c: &[f64], x: f64) -> (f64, f64, f64) {
        let (mut sum, mut difference) = (1.0, 1.0);
        for (k, c) in c.iter().enumerate() {
            let factor = 2.0 * (x - c);
            if k % 2 == 0 {
                sum *= factor;
            } else {
                difference *= factor;
            }
        }
        let (sum, difference) = if c.len().is_multiple_of(2) {
            (
                0.5 * (1.0 + x) * sum * sum,
                0.5 * (1.0 - x) * difference * difference,
            )
        } else {
            (
                0.25 * sum * sum,
                (1.0 - x) * (1.0 + x) * difference * difference,
            )
        };
        (sum, difference, (sum + difference).max(1e-300))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_texture::signal::lsf;

    #[test]
    fn it_is_the_spectrum_of_the_polynomial_and_its_slopes_are_those_of_small_steps() {
        for lsf_rad in [vec![0.4, 0.9, 1.7, 2.6], vec![0.4, 0.9, 1.7, 2.2, 2.9]] {
            let omegas = [0.1, 0.7, 1.3, 3.0];
            let shape = Shape::new(&omegas, Numerator::Nyquist);
            let c: Vec<f64> = lsf_rad.iter().map(|w| libm::cos(*w)).collect();
            let a = lsf::to_polynomial(&lsf_rad);
            let (powers, rows) = shape.spectrum_and_rows(&c);
            for ((power, omega), row) in powers.iter().zip(omegas).zip(&rows) {
                let expected = squared_magnitude(&[1.0, 1.0], omega) / squared_magnitude(&a, omega);
                assert!((power / expected - 1.0).abs() < 1e-9, "{power} {expected}");
                assert_eq!(row[c.len()], 2.0);
            }
            let step = 1e-6;
            for k in 0..c.len() {
                let mut moved = c.clone();
                moved[k] += step;
                let pairs = shape.spectrum(&moved).zip(&powers).zip(&rows);
                for ((after, before), row) in pairs {
                    let slope = libm::log(after / before) / step;
                    assert!((slope - row[k]).abs() < 1e-3 * (1.0 + row[k].abs()));
                }
            }
        }
    }
}
