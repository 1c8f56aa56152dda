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
