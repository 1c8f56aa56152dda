//! Axes: from values to positions.

use crate::range::{extent, widened};

/// Mapping of values to positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Proportional.
    Linear,
    /// Proportional to the logarithm; both ends are positive.
    Log,
    /// Percentiles, proportional to the logarithm of how rarely they are exceeded: as far from
    /// 90 to 99 as from 99 to 99.9. Below 100.
    Percentile,
}

/// An axis: its label with unit, and its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Label with unit, e.g. `Speed (mm/s)`; may be empty.
    pub label: String,
    /// Value at the left or lower end.
    pub min: f64,
    /// Value at the right or upper end; above `min`.
    pub max: f64,
    /// Mapping of values to positions.
    pub scale: Scale,
    /// About how many ticks to draw.
    pub tick_count: usize,
    /// True if ticks carry numbers; of panels that share an axis only one needs them.
    pub numbered: bool,
}

impl Axis {
    /// A linear axis; an empty range is widened.
    #[must_use]
    pub fn new(label: impl Into<String>, min: f64, max: f64) -> Self {
        let (min, max) = widened(min, max);
        Self {
            label: label.into(),
            min,
            max,
            scale: Scale::Linear,
            tick_count: 6,
            numbered: true,
        }
    }

    /// A linear axis over all finite values, with 5 % of space at both ends.
    #[must_use]
    pub fn covering(label: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Self {
        let (min, max) = extent(values).unwrap_or((0.0, 1.0));
        let (min, max) = widened(min, max);
        let space = 0.05 * (max - min);
        Self::new(label, min - space, max + space)
    }

    /// A logarithmic axis. An empty range, or one that is not positive, becomes 1 to 10.
    #[must_use]
    pub fn log(label: impl Into<String>, min: f64, max: f64) -> Self {
        let (min, max) = if min > 0.0 && max > min && max.is_finite() {
            (min, max)
        } else {
            (1.0, 10.0)
        };
        Self {
            scale: Scale::Log,
            ..Self::new(label, min, max)
        }
    }

    /// An axis of the percentiles of `count` values, from 0 to the last one that has a value
    /// beyond it.
    #[must_use]
    pub fn percentiles(label: impl Into<String>, count: u64) -> Self {
        Self {
            scale: Scale::Percentile,
            ..Self::new(label, 0.0, 100.0 * (1.0 - 1.0 / count.max(2) as f64))
        }
    }

    /// The same axis with about `count` ticks.
    #[must_use]
    pub fn ticks_about(self, count: usize) -> Self {
        Self {
            tick_count: count,
            ..self
        }
    }

    /// The same axis without numbers at its ticks.
    #[must_use]
    pub fn unnumbered(self) -> Self {
        Self {
            numbered: false,
            ..self
        }
    }

    /// Position of a value: 0 at `min`, 1 at `max`. Values outside the range lie outside 0..=1.
    #[must_use]
    pub fn fraction(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.min) / (self.max - self.min),
            Scale::Log => (value / self.min).ln() / (self.max / self.min).ln(),
            Scale::Percentile => {
                let rarity = |percentile: f64| -(1.0 - percentile / 100.0).ln();
                (rarity(value) - rarity(self.min)) / (rarity(self.max) - rarity(self.min))
            }
        }
    }

    /// The value at a position: the inverse of [`Axis::fraction`].
    #[must_use]
    pub fn value(&self, fraction: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.min + fraction * (self.max - self.min),
            Scale::Log => self.min * (self.max / self.min).powf(fraction),
            Scale::Percentile => {
                let (low, high) = (100.0 - self.min, 100.0 - self.max);
                100.0 - low * (high / low).powf(fraction)
            }
        }
    }

    /// Ticks inside the range with their numbers, ascending.
    ///
    /// Very small and very large numbers are divided by a power of ten, which
    /// [`Axis::full_label`] states.
    #[must_use]
    pub fn ticks(&self) -> Vec<(f64, String)> {
        match self.scale {
            Scale::Linear => {
                let unit = 10_f64.powi(self.exponent());
                linear_ticks(self.min / unit, self.max / unit, self.tick_count)
                    .into_iter()
                    .map(|(value, text)| (value * unit, text))
                    .collect()
            }
            Scale::Log => log_ticks(self.min, self.max),
            Scale::Percentile => percentile_ticks(self.min, self.max),
        }
    }

    /// The label, with the power of ten that the numbers at the ticks are divided by.
    #[must_use]
    pub fn full_label(&self) -> String {
        match self.exponent() {
            0 => self.label.clone(),
            exponent => format!("{} × 10{}", self.label, superscript(exponent)),
        }
    }

    /// The exponent of ten that the numbers at the ticks are divided by; 0 for ranges that need
    /// no scaling.
    fn exponent(&self) -> i32 {
        let largest = self.min.abs().max(self.max.abs());
        let exponent = largest.log10().floor() as i32;
        if self.scale == Scale::Linear && !(-2..5).contains(&exponent) {
            exponent
        } else {
            0
        }
    }
}

// Round numbers along an axis, and how they are written.

/// About `count` round values in a range, with their numbers.
fn linear_ticks(min: f64, max: f64, count: usize) -> Vec<(f64, String)> {
    let rough = (max - min) / count.max(1) as f64;
    let decade = 10_f64.powi(rough.log10().floor() as i32);
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|mantissa| mantissa * decade)
        .find(|&step| step >= rough * 0.999)
        .unwrap_or(10.0 * decade);
    let first = (min / step - 1e-6).ceil() as i64;
    let last = (max / step + 1e-6).floor() as i64;
    let decimals = decimals_of(step);
    (first..=last.min(first + 100))
        .map(|index| {
            let value = index as f64 * step;
            (value, number(value, decimals))
        })
        .collect()
}

/// Powers of ten in a range, with 2 and 5 between them where there are few.
fn log_ticks(min: f64, max: f64) -> Vec<(f64, String)> {
    let decades = (max / min).log10();
    let mantissas: &[f64] = if decades <= 3.0 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let mut ticks = Vec::new();
    for exponent in (min.log10().floor() as i32)..=(max.log10().ceil() as i32) {
        for mantissa in mantissas {
            let value = mantissa * 10_f64.powi(exponent);
            if value >= min * 0.999_999 && value <= max * 1.000_001 {
                ticks.push((
                    value,
                    number(value, usize::try_from(-exponent).unwrap_or(0)),
                ));
            }
        }
    }
    ticks
}

/// 0, 50, and as many nines as the range has.
fn percentile_ticks(min: f64, max: f64) -> Vec<(f64, String)> {
    let nines = (1..=12).map(|nines| {
        let value = 100.0 * (1.0 - 10_f64.powi(-nines));
        let decimals = usize::try_from(nines - 2).unwrap_or(0);
        (value, format!("{value:.decimals$}"))
    });
    [(0.0, "0".to_owned()), (50.0, "50".to_owned())]
        .into_iter()
        .chain(nines)
        .filter(|(value, _)| (min..=max * (1.0 + 1e-12)).contains(value))
        .collect()
}

/// Returns the decimals that show every multiple of `step` exactly.
fn decimals_of(step: f64) -> usize {
    (0..12)
        .find(|&decimals| {
            let scaled = step * 10_f64.powi(decimals);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        })
        .map_or(12, |decimals| decimals as usize)
}

/// An exponent in superscript digits.
fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent
        .to_string()
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]))
        .collect()
}

/// A number with a true minus sign; one that would be long is in scientific notation.
fn number(value: f64, decimals: usize) -> String {
    let text = if decimals > 4 || value.abs() >= 1e6 {
        format!("{value:.1e}")
    } else {
        format!("{value:.decimals$}")
    };
    if value == 0.0 {
        "0".to_owned()
    } else {
        text.replace('-', "\u{2212}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(min: f64, max: f64) -> Vec<String> {
        let axis = Axis::new("", min, max);
        axis.ticks().into_iter().map(|tick| tick.1).collect()
    }

    /// Claim: ticks are round, inside the range, and labelled without rounding.
    #[test]
    fn ticks_are_round_and_exactly_labelled() {
        assert_eq!(labels(0.0, 500.0), ["0", "100", "200", "300", "400", "500"]);
        assert_eq!(
            labels(-1.0, 0.25),
            ["−1.00", "−0.75", "−0.50", "−0.25", "0", "0.25"]
        );
        for (min, max) in [(0.013, 0.0131), (-7e5, 3e6), (1e-9, 2e-9), (0.0, 1e-12)] {
            let axis = Axis::new("", min, max);
            let ticks = axis.ticks();
            assert!((3..=12).contains(&ticks.len()), "{min}..{max}: {ticks:?}");
            for (value, _) in &ticks {
                assert!((-1e-6..=1.0 + 1e-6).contains(&axis.fraction(*value)));
            }
        }
    }

    /// Claim: the number at a tick times the power of ten in the label is the value.
    #[test]
    fn powers_of_ten_move_into_the_label() {
        let faint = Axis::new("Level (m/s²)", 0.0, 1.2e-4);
        assert_eq!(faint.full_label(), "Level (m/s²) × 10⁻⁴");
        let (value, text) = faint.ticks().pop().expect("it has ticks");
        assert_eq!(text, "1.2");
        assert!((value - 1.2e-4).abs() < 1e-16);
        assert_eq!(Axis::new("x", -3e6, 0.0).full_label(), "x × 10⁶");
        assert_eq!(Axis::new("x", 0.0, 0.02).full_label(), "x");
    }

    /// Claim: percentiles have a tick for each nine that the count can carry, equally far apart.
    #[test]
    fn percentiles_are_marked_by_nines() {
        let axis = Axis::percentiles("", 10_000);
        let ticks = axis.ticks();
        let labels: Vec<&str> = ticks.iter().map(|tick| tick.1.as_str()).collect();
        assert_eq!(labels, ["0", "50", "90", "99", "99.9", "99.99"]);
        for (tick, place) in ticks.iter().skip(2).zip([0.25, 0.5, 0.75, 1.0]) {
            assert!((axis.fraction(tick.0) - place).abs() < 1e-9);
        }
        assert_eq!(Axis::percentiles("", 9999).ticks().len(), 5);
        assert!(Axis::percentiles("", 0).fraction(0.0).abs() < 1e-12);
    }

    /// Claim: a position's value has that position.
    #[test]
    fn a_value_is_where_it_is_said_to_be() {
        let axes = [
            Axis::new("", -3.0, 7.0),
            Axis::log("", 0.01, 40.0),
            Axis::percentiles("", 5000),
        ];
        for axis in axes {
            for fraction in [0.0, 0.2, 0.5, 0.9, 1.0] {
                assert!((axis.fraction(axis.value(fraction)) - fraction).abs() < 1e-9);
            }
        }
    }

    /// Claim: no range, however degenerate, gives an axis that maps to NaN.
    #[test]
    fn degenerate_ranges_are_widened() {
        for (min, max) in [
            (0.0, 0.0),
            (3.0, 3.0),
            (-2.0, -2.0),
            (5.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            let axis = Axis::new("", min, max);
            assert!(axis.min < axis.max, "{min}..{max}");
            assert!(axis.fraction(1.0).is_finite());
            assert!(!axis.ticks().is_empty());
            assert!(!Axis::log("", min, max).ticks().is_empty());
        }
        assert_eq!(Axis::covering("", []).min, -0.05);
    }
}
