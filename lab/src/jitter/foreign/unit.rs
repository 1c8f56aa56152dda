//! Units of time, and the heads of columns that state one.

use std::str::FromStr;

/// A unit of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Nanoseconds.
    Ns,
    /// Microseconds.
    Us,
    /// Milliseconds.
    Ms,
    /// Seconds.
    S,
}

impl Unit {
    /// Nanoseconds in it.
    #[must_use]
    pub const fn ns(self) -> f64 {
        match self {
            Self::Ns => 1.0,
            Self::Us => 1e3,
            Self::Ms => 1e6,
            Self::S => 1e9,
        }
    }

    /// Its symbol.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Ns => "ns",
            Self::Us => "µs",
            Self::Ms => "ms",
            Self::S => "s",
        }
    }
}

impl FromStr for Unit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.to_lowercase().as_str() {
            "ns" | "nsec" | "nsecs" | "nano" | "nanos" | "nanosecond" | "nanoseconds" => {
                Ok(Self::Ns)
            }
            // The micro sign and the Greek letter.
            "us" | "\u{b5}s" | "\u{3bc}s" | "usec" | "usecs" | "\u{b5}sec" | "\u{3bc}sec"
            | "micro" | "micros" | "microsecond" | "microseconds" => Ok(Self::Us),
            "ms" | "msec" | "msecs" | "milli" | "millis" | "millisecond" | "milliseconds" => {
                Ok(Self::Ms)
            }
            "s" | "sec" | "secs" | "second" | "seconds" => Ok(Self::S),
            _ => Err("must be ns, us, ms or s".into()),
        }
    }
}

/// Last words of heads that are units of something else than a latency.
const OTHER_UNITS: [&str; 16] = [
    "cycles",
    "ticks",
    "tsc",
    "clocks",
    "jiffies",
    "hz",
    "khz",
    "mhz",
    "ghz",
    "percent",
    "pct",
    "ps",
    "picoseconds",
    "minutes",
    "hours",
    "days",
];
/// Those that are units in brackets alone: `wakeup_min` is a minimum.
const OTHER_IN_BRACKETS: [&str; 4] = ["min", "h", "d", "%"];

/// The unit that a head states.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum StatedUnit {
    /// None.
    Nothing,
    /// A unit of time.
    Time(Unit),
    /// Another, in which no latency can be read.
    Other(String),
}

/// A column's head: its words in lower case without the unit, and the unit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Head {
    /// The words.
    pub(super) words: Vec<String>,
    /// The unit.
    pub(super) unit: StatedUnit,
}

impl Head {
    /// The parts of a head such as `wakeup_ns`, `Latency (MS)`, `delay [msec]`, `latencyUs`.
    pub(super) fn of(name: &str) -> Self {
        let mut words = words(name);
        let is_bracketed = name.trim_end().ends_with([')', ']', '}']);
        let last = words.last().map(String::as_str).unwrap_or_default();
        let is_other = OTHER_UNITS.contains(&last)
            || (is_bracketed && OTHER_IN_BRACKETS.contains(&last))
            // A multiple, as in `latency_100ns`.
            || (last.starts_with(|c: char| c.is_ascii_digit())
                && last.trim_start_matches(|c: char| c.is_ascii_digit()).parse::<Unit>().is_ok());
        // A multiple, too: `latency (100 ns)`.
        let multiple = name.rsplit_once(['(', '[', '{']).map(|(_, inside)| inside);
        let multiple = multiple.filter(|inside| {
            inside
                .trim_start()
                .starts_with(|c: char| c.is_ascii_digit())
        });
        let unit = if let Some(inside) = multiple.filter(|_| is_bracketed) {
            StatedUnit::Other(inside.trim_end_matches([')', ']', '}']).to_owned())
        } else if is_other {
            StatedUnit::Other(last.to_owned())
        } else if let Ok(unit) = last.parse() {
            words.pop();
            StatedUnit::Time(unit)
        } else {
            // As in `wakeup_ns_raw`; a single letter within a name is no unit.
            let within = |word: &String| (word.len() > 1).then(|| word.parse().ok()).flatten();
            let mut units = words
                .iter()
                .enumerate()
                .filter_map(|(n, word)| Some((n, within(word)?)));
            match (units.next(), units.next()) {
                (Some((n, unit)), None) => {
                    words.remove(n);
                    StatedUnit::Time(unit)
                }
                _ => StatedUnit::Nothing,
            }
        };
        Self { words, unit }
    }

    /// Returns true if the head names percentiles, which are not samples.
    pub(super) fn is_percentile(&self) -> bool {
        let is = |word: &String| {
            let digits = word.strip_prefix('p').unwrap_or_default();
            let is_rank = !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
            let names = [
                "percentile",
                "percentiles",
                "quantile",
                "quantiles",
                "median",
            ];
            is_rank || names.contains(&word.as_str())
        };
        self.words.iter().any(is)
    }

    /// Returns true if the rows below are percentiles.
    pub(super) fn is_list_of_percentiles(&self) -> bool {
        matches!(&self.words[..], [word] if word == "percentile" || word == "quantile")
    }

    /// Returns true for a column of counts.
    pub(super) fn is_count(&self) -> bool {
        let names = [
            "count",
            "counts",
            "frequency",
            "freq",
            "occurrences",
            "hits",
        ];
        matches!(&self.words[..], [word] if names.contains(&word.as_str()))
    }
}

/// The words of a name in lower case: between signs, and where a capital or a µ follows a small letter.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        let begins = (letter.is_uppercase() && before.is_lowercase())
            || (matches!(letter, '\u{b5}' | '\u{3bc}') && before.is_alphanumeric());
        let is_within = letter.is_alphanumeric() || matches!(letter, '\'' | '’' | '%');
        if !is_within || begins {
            words.push(String::new());
        }
        if let (true, Some(word)) = (is_within, words.last_mut()) {
            word.extend(letter.to_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_found_in_every_spelling_of_a_head() {
        for (unit, heads) in [
            (
                Unit::Ns,
                "wakeup_ns|latency_nsec|Latency (Nanoseconds)|latencyNanos|lat.ns|ns|wakeup_ns_raw",
            ),
            (
                Unit::Us,
                "latency_us|latency usec|Wakeup [µs]|delay (μs)|latencyUs|latencyµs|Latency / us|US|micros|us_wakeup",
            ),
            (
                Unit::Ms,
                "MS|Latency (MS)|latency_msec|response [ms]|latencyMillis|LatencyMS|delay-milliseconds|latency ms",
            ),
            (
                Unit::S,
                "latency_s|Latency [Seconds]|latency (sec)|S|elapsed seconds|latencySec",
            ),
        ] {
            for head in heads.split('|') {
                assert_eq!(Head::of(head).unit, StatedUnit::Time(unit), "{head}");
            }
        }
        for head in [
            "latency",
            "wakeup_min",
            "s_wakeup",
            "the thread's",
            "latency (raw)",
            "ns us wakeup",
            "",
            "x",
        ] {
            assert_eq!(Head::of(head).unit, StatedUnit::Nothing, "{head}");
        }
        for head in [
            "latency_cycles",
            "wakeup (TSC)",
            "latency_100ns",
            "delay [min]",
            "load (%)",
            "rate_Hz",
        ] {
            assert!(
                matches!(Head::of(head).unit, StatedUnit::Other(_)),
                "{head}"
            );
        }
        assert_eq!(Head::of("Wakeup Latency (MS)").words, ["wakeup", "latency"]);
    }

    #[test]
    fn percentiles_and_counts_are_told_from_latencies() {
        for head in [
            "percentile",
            "p99_us",
            "Quantile",
            "latency p50",
            "median_ns",
        ] {
            assert!(Head::of(head).is_percentile(), "{head}");
        }
        for head in ["period", "p_us", "wakeup_ns", "cpu0", "total"] {
            assert!(!Head::of(head).is_percentile(), "{head}");
        }
        assert!(Head::of("Count").is_count() && !Head::of("n").is_count());
    }
}
