//! The delay between two signals, by their cross-correlation.

/// Where one signal lies in another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Delay {
    /// Samples by which the second signal comes after the first.
    pub samples: f64,
    /// Normalised correlation there, −1..1.
    pub correlation: f64,
    /// Largest correlation further than a period away, in the same measure.
    pub rival: f64,
}

/// The lag within ±`reach` samples at which the summed correlation of the pairs is largest.
///
/// Every pair is (first, second), all of one length. `None` for silent or short signals.
#[must_use]
pub fn delay(pairs: &[(&[f64], &[f64])], reach: usize) -> Option<Delay> {
    let length = pairs.iter().map(|(x, y)| x.len().min(y.len())).min()?;
    if length < 4 * reach + 4 {
        return None;
    }
    let inner = reach..length - reach;
    let energy = |signal: &[f64]| signal[inner.clone()].iter().map(|x| x * x).sum::<f64>();
    let norm: f64 = pairs.iter().map(|(x, _)| energy(x)).sum::<f64>().sqrt()
        * pairs.iter().map(|(_, y)| energy(y)).sum::<f64>().sqrt();
    if norm.is_nan() || norm <= 0.0 {
        return None;
    }
    let at = |lag: isize| -> f64 {
        let sum = |x: &[f64], y: &[f64]| -> f64 {
            let start = (reach as isize + lag) as usize;
            x[inner.clone()]
                .iter()
                .zip(&y[start..])
                .map(|(x, y)| x * y)
                .sum()
        };
        pairs.iter().map(|(x, y)| sum(x, y)).sum::<f64>() / norm
    };
    let lags: Vec<f64> = (-(reach as isize)..=reach as isize).map(at).collect();
    let best = (0..lags.len()).max_by(|&a, &b| lags[a].total_cmp(&lags[b]))?;
    let offset = if best > 0 && best + 1 < lags.len() {
        let (before, peak, after) = (lags[best - 1], lags[best], lags[best + 1]);
        let bend = before - 2.0 * peak + after;
        if bend < 0.0 {
            (0.5 * (before - after) / bend).clamp(-0.5, 0.5)
        } else {
            0.0
        }
    } else {
        0.0
    };
    // A rival is another peak, so the way to it leads through a valley.
    let rival = (1..lags.len() - 1)
        .filter(|&n| n.abs_diff(best) > 1 && lags[n] >= lags[n - 1] && lags[n] >= lags[n + 1])
        .map(|n| lags[n])
        .fold(0.0, f64::max);
    Some(Delay {
        samples: best as f64 - reach as f64 + offset,
        correlation: lags[best],
        rival,
    })
}

#[cfg(test)]
#[path = "correlate_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::white;

    #[test]
    fn a_shifted_signal_is_found_where_it_lies() {
        let noise = white(1, 2000, 1);
        let early = &noise[100..1900];
        let late = &noise[83..1883];
        let found = delay(&[(early, late)], 50).expect("long enough");
        assert!((found.samples - 17.0).abs() < 0.3, "{found:?}");
        assert!(found.correlation > 0.95 && found.rival < 0.3);
    }

    #[test]
    fn silence_has_no_delay() {
        assert_eq!(delay(&[(&[0.0; 400], &[0.0; 400])], 20), None);
    }
}
