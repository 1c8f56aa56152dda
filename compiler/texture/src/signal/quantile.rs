//! Order statistics.
//!
//! ```
//! use asperity_texture::signal::quantile::{mean, median};
//!
//! assert_eq!(median([3.0, 1.0, f64::NAN, 2.0]), 2.0); // what is not finite does not count
//! assert_eq!(mean(&[1.0, 2.0, 6.0]), 3.0);
//! ```

/// RMS of Gaussian noise over the median of its size.
pub const RMS_OF_MEDIAN: f64 = 1.4826;

/// The value below which this fraction of the values lies; 0 of none.
#[must_use]
pub fn quantile(values: impl IntoIterator<Item = f64>, fraction: f64) -> f64 {
    let mut sorted: Vec<f64> = values.into_iter().filter(|x| x.is_finite()).collect();
    if sorted.is_empty() {
        return 0.0;
    }
    let index = ((sorted.len() - 1) as f64 * fraction).round() as usize;
    *sorted.select_nth_unstable_by(index, f64::total_cmp).1
}

/// The middle value; 0 of none.
#[must_use]
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    quantile(values, 0.5)
}

/// The mean; 0 of none.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    if values.is_empty() {
        0.0
    } else {
        values.iter().sum::<f64>() / values.len() as f64
    }
}

/// Spearman's ρ: the correlation of ranks, of which equal values share the mean. `None` where one side does not vary.
#[must_use]
pub fn rank_correlation(x: &[f64], y: &[f64]) -> Option<f64> {
    let (x, y) = (ranks(x), ranks(y));
    let (x_mean, y_mean) = (mean(&x), mean(&y));
    let sum = |a: &[f64], a_mean: f64, b: &[f64], b_mean: f64| -> f64 {
        let products = a.iter().zip(b).map(|(a, b)| (a - a_mean) * (b - b_mean));
        products.sum()
    };
    let scale = sum(&x, x_mean, &x, x_mean) * sum(&y, y_mean, &y, y_mean);
    (scale > 0.0).then(|| sum(&x, x_mean, &y, y_mean) / scale.sqrt())
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut below = 0;
    for tied in order.chunk_by(|&a, &b| values[a] == values[b]) {
        let rank = below as f64 + 0.5 * (tied.len() as f64 - 1.0);
        tied.iter().for_each(|&index| ranks[index] = rank);
        below += tied.len();
    }
    ranks
}

/// Counts of magnitudes in eighths of an octave: quantiles of a stream in bounded memory.
#[derive(Debug, Clone)]
pub struct Magnitudes {
    counts: Vec<u64>,
    zeros: u64,
}

/// Exponent of the least magnitude that is resolved; smaller ones share the first class.
const LEAST: i32 = -80;
/// Classes of an octave.
const CLASSES: i32 = 8;

impl Default for Magnitudes {
    fn default() -> Self {
        Self {
            counts: vec![0; (160 * CLASSES) as usize],
            zeros: 0,
        }
    }
}

impl Magnitudes {
    /// Counts a value by its magnitude.
    pub fn add(&mut self, value: f64) {
        let magnitude = value.abs();
        if magnitude == 0.0 || magnitude.is_nan() {
            self.zeros += 1;
            return;
        }
        let class = ((libm::log2(magnitude) - f64::from(LEAST)) * f64::from(CLASSES)) as isize;
        let last = self.counts.len() as isize - 1;
        self.counts[class.clamp(0, last) as usize] += 1;
    }

    /// The magnitude below which this fraction lies, within an eighth of an octave.
    #[must_use]
    pub fn quantile(&self, fraction: f64) -> f64 {
        let total = self.zeros + self.counts.iter().sum::<u64>();
        let wanted = (fraction * total as f64) as u64;
        let mut seen = self.zeros;
        if seen > wanted {
            return 0.0;
        }
        for (class, count) in self.counts.iter().enumerate() {
            seen += count;
            if seen > wanted {
                let exponent = f64::from(LEAST) + (class as f64 + 1.0) / f64::from(CLASSES);
                return libm::exp2(exponent);
            }
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_rising_law_has_the_rank_correlation_one() {
        let x: [f64; 5] = [3.0, 1.0, 4.0, 1.5, 9.0];
        let of = |y: &[f64]| rank_correlation(&x, y);
        assert!((of(&x.map(|x| x * x * x)).unwrap() - 1.0).abs() < 1e-12);
        assert!((of(&x.map(|x| -x)).unwrap() + 1.0).abs() < 1e-12);
        assert_eq!(of(&[2.0; 5]), None);
        // Ties share their mean rank.
        let tied = rank_correlation(&[1.0, 2.0, 3.0], &[1.0, 2.0, 2.0]).unwrap();
        assert!((tied - 0.75_f64.sqrt()).abs() < 1e-12, "{tied}");
    }

    #[test]
    fn a_stream_has_the_quantiles_of_its_values() {
        let values: Vec<f64> = (1..=10_000).map(f64::from).collect();
        let mut stream = Magnitudes::default();
        values.iter().for_each(|&x| stream.add(x));
        for fraction in [0.1, 0.5, 0.99] {
            let exact = quantile(values.iter().copied(), fraction);
            assert!(
                (stream.quantile(fraction) / exact - 1.0).abs() < 0.1,
                "{fraction}"
            );
        }
        assert_eq!(median([3.0, 1.0, f64::NAN, 2.0]), 2.0);
    }
}
