//! Values of a field: a number, a time, a labelled number.

/// A number; NaN for a value that is missing (an empty field, `nan`, `NA`). With `decimal_comma`, a comma stands for
/// the point, and a point is refused: it would group thousands.
#[must_use]
pub fn number(text: &str, decimal_comma: bool) -> Option<f64> {
    if text.is_empty() || text.eq_ignore_ascii_case("nan") || text.eq_ignore_ascii_case("na") {
        return Some(f64::NAN);
    }
    if !decimal_comma {
        return text.parse().ok();
    }
    let part = text.split_once(',').map_or("0", |(_, part)| part);
    let is_one = !text.contains('.') && part.starts_with(|c: char| c.is_ascii_digit());
    is_one
        .then(|| text.replacen(',', ".", 1).parse().ok())
        .flatten()
}

/// Returns true if a text is a number with a decimal comma; `surely` requires a comma that cannot group thousands.
pub(super) fn has_decimal_comma(text: &str, surely: bool) -> bool {
    let Some((whole, part)) = text.split_once(',') else {
        return false;
    };
    let whole = whole.trim_start_matches(['-', '+']);
    number(text, true).is_some() && (!surely || part.len() != 3 || matches!(whole, "" | "0"))
}

/// A time that is written as text, s: ISO 8601 or `YYYY-MM-DD hh:mm:ss` since 1970, `hh:mm:ss.sss` since midnight, a
/// number with a unit of time behind it.
#[must_use]
pub fn seconds(text: &str) -> Option<f64> {
    let text = text.trim().trim_matches('"');
    if let Some((value, unit)) = text.split_once(' ')
        && let Some((_, factor)) = time_unit(unit)
    {
        return Some(number(value, false)? * factor);
    }
    let (date, clock) = match text.split_once(['T', ' ']) {
        Some((date, clock)) => (Some(date), clock),
        None => (None, text),
    };
    let (clock, offset_s) = zone(clock)?;
    let of_day = hours(clock)? - offset_s;
    let days = date.map_or(Some(0), days)?;
    Some(86_400.0 * days as f64 + of_day)
}

/// A unit of time: its symbol, and the seconds in one.
#[must_use]
pub fn time_unit(text: &str) -> Option<(&'static str, f64)> {
    Some(match text {
        "s" | "sec" | "secs" | "second" | "seconds" => ("s", 1.0),
        "ms" | "msec" | "msecs" | "milli" | "millis" | "millisecond" | "milliseconds" => {
            ("ms", 1e-3)
        }
        "us" | "µs" | "μs" | "usec" | "micro" | "micros" | "microsecond" | "microseconds" => {
            ("us", 1e-6)
        }
        "ns" | "nsec" | "nanos" | "nanosecond" | "nanoseconds" => ("ns", 1e-9),
        _ => return None,
    })
}

/// A time of day without its zone, and the zone's offset, s.
fn zone(clock: &str) -> Option<(&str, f64)> {
    if let Some(clock) = clock.strip_suffix('Z') {
        return Some((clock, 0.0));
    }
    let Some(at) = clock.rfind(['+', '-']) else {
        return Some((clock, 0.0));
    };
    let (clock, offset) = clock.split_at(at);
    let (sign, offset) = offset.split_at(1);
    let (hours, minutes) = match offset.split_once(':') {
        Some(parts) => parts,
        None => offset.split_at_checked(2)?,
    };
    let minutes = if minutes.is_empty() { "0" } else { minutes };
    let size = 3600 * hours.parse::<u32>().ok()? + 60 * minutes.parse::<u32>().ok()?;
    let size = f64::from(size);
    Some((clock, if sign == "-" { -size } else { size }))
}

/// `hh:mm:ss.sss`, s.
fn hours(clock: &str) -> Option<f64> {
    let (hours, rest) = clock.split_once(':')?;
    let (minutes, seconds) = rest.split_once(':')?;
    let two = |text: &str, below: u32| {
        let digits = matches!(text.len(), 1 | 2) && text.bytes().all(|b| b.is_ascii_digit());
        let value: u32 = digits.then(|| text.parse().ok()).flatten()?;
        (value < below).then_some(value)
    };
    let seconds = seconds.replacen(',', ".", 1);
    let whole = seconds.split('.').next()?;
    two(whole, 61)?;
    let seconds: f64 = seconds.parse().ok()?;
    Some(f64::from(3600 * two(hours, 24)? + 60 * two(minutes, 60)?) + seconds)
}

/// Days since 1970 of `YYYY-MM-DD` or `YYYY/MM/DD`, by the calendar of Gregory.
fn days(date: &str) -> Option<i64> {
    let mut parts = date.split(['-', '/']);
    let mut part = |low: i64, high: i64| {
        let value = parts.next()?.parse().ok()?;
        (low..=high).contains(&value).then_some(value)
    };
    let (year, month, day) = (part(1900, 9999)?, part(1, 12)?, part(1, 31)?);
    if parts.next().is_some() {
        return None;
    }
    // Years that begin in March, so that the day which some years have more comes last.
    let (year, month) = if month > 2 {
        (year, month - 3)
    } else {
        (year - 1, month + 9)
    };
    let leaps = year / 4 - year / 100 + year / 400;
    Some(365 * year + leaps + (153 * month + 2) / 5 + day - 1 - 719_468)
}

/// The parts of `name:value`, where the value is a number.
pub(super) fn label(text: &str) -> Option<(&str, &str)> {
    let (name, value) = text.split_once(':')?;
    let (name, value) = (name.trim(), value.trim());
    let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
    (is_name && number(value, false).is_some()).then_some((name, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comma_is_a_decimal_comma_or_refused() {
        assert_eq!(number("0,5", true), Some(0.5));
        assert_eq!(number("-1,25e-3", true), Some(-0.001_25));
        assert_eq!(number("7", true), Some(7.0));
        for grouped in ["1.234", "1.234,5", "1,2,3", "1,"] {
            assert_eq!(number(grouped, true), None, "{grouped}");
        }
        assert_eq!(number("0,5", false), None);
        assert!(number("", true).is_some_and(f64::is_nan));
        // 1,234 may be a thousand; 0,234 and 1,23 may not.
        assert!(has_decimal_comma("0,234", true) && has_decimal_comma("1,23", true));
        assert!(!has_decimal_comma("1,234", true) && has_decimal_comma("1,234", false));
    }

    #[test]
    fn times_as_text_are_seconds() {
        for (text, expected) in [
            ("1970-01-01T00:00:00Z", 0.0),
            ("2024-09-29T08:53:20.001Z", 1_727_600_000.001),
            ("2024-09-29 10:53:20+02:00", 1_727_600_000.0),
            ("2024/09/29 08:53:20", 1_727_600_000.0),
            ("2000-02-29T00:00:00Z", 951_782_400.0),
            ("2000-03-01T00:00:00-0100", 951_872_400.0),
            ("08:53:20.001", 32_000.001),
            ("8:53:20,5", 32_000.5),
            ("0.001 sec", 0.001),
            ("5 ms", 0.005),
        ] {
            let found = seconds(text).expect(text);
            assert!((found - expected).abs() < 1e-6, "{text}: {found}");
        }
        for none in [
            "",
            "12",
            "stroke",
            "08:53",
            "25:00:00",
            "08:61:00",
            "1 N",
            "a:b:c",
            "2024-13-01T00:00:00",
            "08:00:-1",
            "08:00:1e1",
        ] {
            assert_eq!(seconds(none), None, "{none}");
        }
    }

    #[test]
    fn a_label_names_a_number() {
        assert_eq!(label("ax: -0.5"), Some(("ax", "-0.5")));
        for none in ["ax", "ax:b", "08:53", ":1", "8:1"] {
            assert_eq!(label(none), None, "{none}");
        }
    }
}
