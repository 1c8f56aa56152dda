//! Round numbers along an axis, and how they are written.

/// About `count` round values in a range, with their numbers.
pub(crate) fn linear_ticks(min: f64, max: f64, count: usize) -> Vec<(f64, String)> {
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
pub(crate) fn log_ticks(min: f64, max: f64) -> Vec<(f64, String)> {
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

/// How many decimals show every multiple of `step` exactly.
fn decimals_of(step: f64) -> usize {
    (0..12)
        .find(|&decimals| {
            let scaled = step * 10_f64.powi(decimals);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        })
        .map_or(12, |decimals| decimals as usize)
}

/// An exponent in superscript digits.
pub(crate) fn superscript(exponent: i32) -> String {
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
