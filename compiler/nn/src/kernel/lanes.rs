//! Sums in eight lanes: element i is added to lane i mod 8, and the lanes are added pairwise at
//! the end.

const LANES: usize = 8;

/// Σ x.
pub(crate) fn sum(values: &[f32]) -> f32 {
    total(values, |x| x)
}

/// Σ x².
pub(crate) fn sum_of_squares(values: &[f32]) -> f32 {
    total(values, |x| x * x)
}

#[inline(always)]
fn total(values: &[f32], of: impl Fn(f32) -> f32) -> f32 {
    let (blocks, rest) = values.as_chunks::<LANES>();
    let mut lanes = [0.0_f32; LANES];
    for block in blocks {
        for (lane, &x) in lanes.iter_mut().zip(block) {
            *lane += of(x);
        }
    }
    for (lane, &x) in lanes.iter_mut().zip(rest) {
        *lane += of(x);
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_counts_once() {
        for count in 0..40_u16 {
            let values: Vec<f32> = (1..=count).map(f32::from).collect();
            let n = f32::from(count);
            assert_eq!(sum(&values), n * (n + 1.0) / 2.0);
            assert_eq!(
                sum_of_squares(&values),
                n * (n + 1.0) * (2.0 * n + 1.0) / 6.0
            );
        }
    }
}
