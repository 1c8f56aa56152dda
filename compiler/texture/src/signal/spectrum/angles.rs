//! Polynomials on the unit circle, at many frequencies side by side.
//!
//! Lanes never mix, so wider registers give the same bits.

use multiversion::multiversion;

/// Number of frequencies in a block: enough independent sums to keep the multipliers of a processor busy.
const LANES: usize = 16;

/// A value per frequency of a block.
type Lanes = [f64; LANES];

/// Frequencies at which polynomials are evaluated side by side.
#[derive(Debug, Clone)]
pub struct Angles {
    blocks: Vec<Block>,
    count: usize,
}

/// Frequencies by cosine and sine.
#[derive(Debug, Clone)]
struct Block {
    cosines: Lanes,
    sines: Lanes,
}

impl Angles {
    /// Prepares frequencies, rad.
    #[must_use]
    pub fn new(omegas: impl Iterator<Item = f64>) -> Self {
        let mut blocks = Vec::new();
        let mut count = 0;
        for omega in omegas {
            if count % LANES == 0 {
                blocks.push(Block {
                    cosines: [1.0; LANES],
                    sines: [0.0; LANES],
                });
            }
            if let Some(block) = blocks.last_mut() {
                let (sin, cos) = libm::sincos(omega);
                block.cosines[count % LANES] = cos;
                block.sines[count % LANES] = sin;
            }
            count += 1;
        }
        Self { blocks, count }
    }

    /// [`squared_magnitude`] at every frequency, to the bit.
    #[must_use]
    pub fn squared_magnitudes(&self, coefficients: &[f64]) -> Vec<f64> {
        let used = coefficients
            .iter()
            .rposition(|&c| c != 0.0)
            .map_or(0, |last| last + 1);
        self.evaluated(|blocks, out| by_horner(blocks, &coefficients[..used], out))
    }

    /// |A|² at every frequency, of the polynomial whose LSFs have these cosines.
    ///
    /// The sum and the difference polynomial are in quadrature on the unit circle and known by
    /// their roots, so |A|² = (|Q|² + |P|²)/4 needs no coefficients.
    #[must_use]
    pub fn squared_magnitudes_of_lsf(&self, lsf_cosines: &[f64]) -> Vec<f64> {
        self.evaluated(|blocks, out| by_roots(blocks, lsf_cosines, out))
    }

    fn evaluated(&self, evaluate: impl Fn(&[Block], &mut [Lanes])) -> Vec<f64> {
        let mut all = vec![0.0; self.blocks.len() * LANES];
        evaluate(&self.blocks, all.as_chunks_mut().0);
        all.truncate(self.count);
        all
    }
}

#[multiversion(targets("x86_64+avx2"))]
fn by_horner(blocks: &[Block], coefficients: &[f64], out: &mut [Lanes]) {
    for (Block { cosines, sines }, out) in blocks.iter().zip(out) {
        let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
        for &c in coefficients.iter().rev() {
            for lane in 0..LANES {
                let next = re[lane] * cosines[lane] + im[lane] * sines[lane] + c;
                im[lane] = im[lane] * cosines[lane] - re[lane] * sines[lane];
                re[lane] = next;
            }
        }
        for lane in 0..LANES {
            out[lane] = re[lane] * re[lane] + im[lane] * im[lane];
        }
    }
}

#[multiversion(targets("x86_64+avx2"))]
fn by_roots(blocks: &[Block], lsf_cosines: &[f64], out: &mut [Lanes]) {
    let (pairs, last) = lsf_cosines.as_chunks::<2>();
    // The factors of 2 of 2(cos ω − c), all at once: exact.
    let scale = |factors: usize| libm::ldexp(1.0, 2 * factors as i32);
    let (sum_scale, difference_scale) = (scale(lsf_cosines.len().div_ceil(2)), scale(pairs.len()));
    for (Block { cosines: x, .. }, out) in blocks.iter().zip(out) {
        let (mut sum, mut difference) = ([1.0; LANES], [1.0; LANES]);
        for [q, p] in pairs {
            for lane in 0..LANES {
                sum[lane] *= x[lane] - q;
                difference[lane] *= x[lane] - p;
            }
        }
        for q in last {
            for lane in 0..LANES {
                sum[lane] *= x[lane] - q;
            }
        }
        for lane in 0..LANES {
            let x = x[lane];
            let q = sum[lane] * sum[lane] * sum_scale;
            let p = difference[lane] * difference[lane] * difference_scale;
            out[lane] = if last.is_empty() {
                0.5 * ((1.0 + x) * q + (1.0 - x) * p)
            } else {
                0.25 * q + (1.0 - x) * (1.0 + x) * p
            };
        }
    }
}

/// `|1 + Σ c_k e^{−jkω}|²` by Horner's rule.
#[must_use]
pub fn squared_magnitude(coefficients: &[f64], omega: f64) -> f64 {
    let (sin, cos) = libm::sincos(omega);
    let (mut re, mut im) = (0.0, 0.0);
    for &c in coefficients.iter().rev() {
        // (re + j·im)·e^{−jω} + c
        (re, im) = (re * cos + im * sin + c, im * cos - re * sin);
    }
    re * re + im * im
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::lsf;

    #[test]
    fn side_by_side_is_one_by_one_to_the_bit() {
        let coefficients = [1.0, -1.3, 0.7, 0.0, 0.2, 0.0, 0.0];
        let omegas: Vec<f64> = (0..21).map(|n| 0.15 * f64::from(n)).collect();
        let together = Angles::new(omegas.iter().copied()).squared_magnitudes(&coefficients);
        assert_eq!(together.len(), omegas.len());
        for (found, omega) in together.iter().zip(&omegas) {
            assert_eq!(
                found.to_bits(),
                squared_magnitude(&coefficients, *omega).to_bits()
            );
        }
    }

    #[test]
    fn a_polynomial_is_known_by_its_lsf() {
        let omegas = (0..40).map(|n| 0.08 * f64::from(n));
        let angles = Angles::new(omegas);
        for lsf_rad in [
            vec![0.4],
            vec![0.3, 0.9],
            vec![0.2, 0.5, 1.9],
            vec![0.1, 0.4, 1.0, 2.2],
        ] {
            let cosines: Vec<f64> = lsf_rad.iter().map(|w: &f64| w.cos()).collect();
            let by_roots = angles.squared_magnitudes_of_lsf(&cosines);
            let by_horner = angles.squared_magnitudes(&lsf::to_polynomial(&lsf_rad));
            assert_eq!(by_roots.len(), 40);
            for (x, y) in by_roots.iter().zip(&by_horner) {
                assert!((x / y - 1.0).abs() < 1e-9, "{lsf_rad:?}: {x} for {y}");
            }
        }
    }
}
