//! Matrices in 16 bits, as two of 8.

use asperity_nn::Tensor;

/// Largest code.
const FULL_SCALE: f32 = 127.0;
/// A low code is worth so much less than a high one: it spans one step of it.
const STEPS: f32 = 254.0;

/// `W ≈ scale·(high + low/254)`, a scale for each column.
pub(super) struct Halves {
    high: Vec<i8>,
    low: Vec<i8>,
    scales: Vec<f32>,
}

impl Halves {
    /// Quantises a row-major matrix of so many columns.
    pub(super) fn of(values: &[f32], columns: usize) -> Self {
        let mut scales = vec![f32::MIN_POSITIVE; columns];
        for row in values.chunks(columns.max(1)) {
            for (scale, x) in scales.iter_mut().zip(row) {
                *scale = scale.max(x.abs() / FULL_SCALE);
            }
        }
        let (mut high, mut low) = (
            Vec::with_capacity(values.len()),
            Vec::with_capacity(values.len()),
        );
        for (x, scale) in values.iter().zip(scales.iter().cycle()) {
            let steps = x / scale;
            let whole = libm::roundf(steps).clamp(-FULL_SCALE, FULL_SCALE);
            let rest = libm::roundf((steps - whole) * STEPS);
            high.push(whole as i8);
            low.push(rest.clamp(-FULL_SCALE, FULL_SCALE) as i8);
        }
        Self { high, low, scales }
    }

    /// Codes and scales of the high part, and of the low one.
    pub(super) fn constants(self, columns: usize) -> ((Tensor, Tensor), (Tensor, Tensor)) {
        let rows = self.high.len() / columns.max(1);
        let codes = |codes: Vec<i8>| Tensor::I8 {
            shape: vec![rows, columns],
            data: codes
                .into_iter()
                .map(i8::cast_unsigned)
                .collect::<Vec<u8>>()
                .into(),
        };
        let low = self.scales.iter().map(|scale| scale / STEPS).collect();
        let scales = |scales: Vec<f32>| Tensor::f32(&[columns], scales);
        (
            (codes(self.high), scales(self.scales)),
            (codes(self.low), scales(low)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_halves_together_are_within_a_60_000th_of_the_largest_weight() {
        let values: Vec<f32> = (0..999)
            .map(|n| (n as f32 * 0.7).sin() * (1 + n % 3) as f32)
            .collect();
        let halves = Halves::of(&values, 3);
        for (n, x) in values.iter().enumerate() {
            let found = f32::from(halves.high[n]) + f32::from(halves.low[n]) / STEPS;
            let column = n % 3;
            let largest = (1 + column) as f32;
            let error = (found * halves.scales[column] - x).abs() / largest;
            assert!(error < 1.0 / 60_000.0, "{n}: {error}");
        }
    }

    #[test]
    fn a_column_of_zeros_stays_zero() {
        let halves = Halves::of(&[0.0, 1.0, 0.0, -1.0], 2);
        assert_eq!((halves.high[0], halves.low[0]), (0, 0));
        assert_eq!((halves.high[1], halves.high[3]), (127, -127));
    }
}
