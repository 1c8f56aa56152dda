//! The terms of the loss.

use crate::network::{matrix, unit_rows};
use burn_tensor::{Device, Tensor, activation::log_softmax};

/// Added to the logit of a pair that is neither a match nor a mismatch.
const EXCLUDED: f32 = -1e9;

/// Huber's loss with its bend at 1: ½d² below, |d| − ½ above; mean over all elements.
pub(crate) fn smooth_l1(x: Tensor<2>, y: Tensor<2>) -> Tensor<1> {
    let distance = (x - y).abs();
    let near = distance.clone().clamp_max(1.0);
    (near.clone().square() * 0.5 + distance - near).mean()
}

/// Which rows of a batch belong together.
pub(crate) struct Pairing {
    /// [B, B], ones on the diagonal.
    matches: Tensor<2>,
    /// [B, B], `EXCLUDED` where two rows share a material.
    exclusion: Tensor<2>,
}

impl Pairing {
    /// Row i matches column i; others of its material count neither way.
    pub(crate) fn new(materials: &[usize], device: &Device) -> Self {
        let count = materials.len();
        let each = |value: &dyn Fn(usize, usize) -> f32| {
            let values = (0..count * count).map(|k| value(k / count, k % count));
            matrix(values.collect(), count, device)
        };
        Self {
            matches: each(&|i, j| f32::from(u8::from(i == j))),
            exclusion: each(&|i, j| {
                if i != j && materials[i] == materials[j] {
                    EXCLUDED
                } else {
                    0.0
                }
            }),
        }
    }
}

/// InfoNCE over cosines, both ways: `−log softmax(cos(x_i, y_j)/τ)_{ii}`.
pub(crate) fn info_nce(
    x: Tensor<2>,
    y: Tensor<2>,
    temperature: f64,
    pairing: &Pairing,
) -> Tensor<1> {
    let cosines = unit_rows(x).matmul(unit_rows(y).transpose());
    let logits = cosines / temperature + pairing.exclusion.clone();
    let rows = logits.dims()[0] as f64;
    let forward = log_softmax(logits.clone(), 1);
    let backward = log_softmax(logits, 0);
    ((forward + backward) * pairing.matches.clone()).sum() * (-0.5 / rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scalar(x: Tensor<1>) -> f32 {
        x.into_scalar()
    }

    #[test]
    fn smooth_l1_is_square_near_and_linear_far() {
        let device = Device::flex();
        let x = matrix(vec![0.5, -3.0], 2, &device);
        let y = matrix(vec![0.0, 0.0], 2, &device);
        let expected = 0.5 * (0.125 + 2.5);
        assert!((scalar(smooth_l1(x, y)) - expected).abs() < 1e-6);
    }

    #[test]
    fn captions_of_one_material_are_no_negatives() {
        let device = Device::flex();
        let x = matrix(vec![1.0, 0.0, 1.0, 0.0, 0.0, 1.0], 2, &device);
        let pairing = |materials: &[usize]| Pairing::new(materials, &device);
        let shared = scalar(info_nce(x.clone(), x.clone(), 0.1, &pairing(&[0, 0, 1])));
        let apart = scalar(info_nce(x.clone(), x, 0.1, &pairing(&[0, 1, 2])));
        assert!(shared < 1e-3);
        // Two of three rows see an equal rival: log 2 each.
        assert!((apart - 2.0 / 3.0 * 2.0_f32.ln()).abs() < 1e-3);
    }
}
