//! A scenario of the table: the figure of each method, and the verdict.

use std::fmt;

use serde::Serialize;

/// The figure of another method in the same scenario.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Other {
    /// Name of the method.
    pub method: &'static str,
    /// Its figure in the row's unit; infinite where it gives no usable answer.
    pub figure: f64,
}

/// The verdict on a row.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Our figure is within the limit.
    Pass,
    /// Our figure is above the limit.
    Fail,
    /// The row could not run, and why.
    Skipped(String),
}

/// A scenario in which methods fail. Smaller figures are better.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScenarioResult {
    /// Which part of the tick it tries.
    pub theme: &'static str,
    /// The scenario.
    pub scenario: String,
    /// Measured quantity, with its unit.
    pub quantity: &'static str,
    /// Our figure.
    pub ours: f64,
    /// Largest figure that passes.
    pub limit: f64,
    /// The figures of other methods.
    pub others: Vec<Other>,
    /// The failure of the other methods, and its cause.
    pub fails: &'static str,
    /// Our alternative.
    pub instead: &'static str,
    /// The verdict.
    pub verdict: Verdict,
}

/// The words of a row, which several rows share.
#[derive(Debug, Clone, Copy)]
pub struct Words {
    /// Which part of the tick it tries.
    pub theme: &'static str,
    /// Measured quantity, with its unit.
    pub quantity: &'static str,
    /// The failure of the other methods, and its cause.
    pub fails: &'static str,
    /// Our alternative.
    pub instead: &'static str,
}

impl Words {
    /// A row that was measured. It passes if `ours` is at most `limit` and not NaN.
    #[must_use]
    pub fn row(
        self,
        scenario: impl Into<String>,
        ours: f64,
        limit: f64,
        others: &[(&'static str, f64)],
    ) -> ScenarioResult {
        let others = others
            .iter()
            .map(|&(method, figure)| Other { method, figure })
            .collect();
        ScenarioResult {
            theme: self.theme,
            scenario: scenario.into(),
            quantity: self.quantity,
            ours,
            limit,
            others,
            fails: self.fails,
            instead: self.instead,
            verdict: if ours <= limit {
                Verdict::Pass
            } else {
                Verdict::Fail
            },
        }
    }

    /// A row that could not run.
    #[must_use]
    pub fn skipped(self, scenario: impl Into<String>, reason: impl Into<String>) -> ScenarioResult {
        ScenarioResult {
            verdict: Verdict::Skipped(reason.into()),
            ..self.row(scenario, f64::NAN, f64::NAN, &[])
        }
    }
}

impl fmt::Display for ScenarioResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = match &self.verdict {
            Verdict::Pass => "pass",
            Verdict::Fail => "FAIL",
            Verdict::Skipped(_) => "skip",
        };
        writeln!(f, "{verdict}  {}: {}", self.theme, self.scenario)?;
        if let Verdict::Skipped(reason) = &self.verdict {
            return writeln!(f, "      skipped: {reason}");
        }
        write!(
            f,
            "      {}: ours {} (at most {})",
            self.quantity,
            Figure(self.ours),
            Figure(self.limit)
        )?;
        for other in &self.others {
            write!(f, ", {} {}", other.method, Figure(other.figure))?;
        }
        writeln!(f, "\n      fails:   {}", self.fails)?;
        writeln!(f, "      instead: {}", self.instead)
    }
}

/// A number with three digits.
#[derive(Debug, Clone, Copy)]
pub struct Figure(pub f64);

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if self.0 == 0.0 {
            write!(f, "0")
        } else if self.0.is_infinite() {
            write!(f, "∞")
        } else if !(1e-3..1e5).contains(&size) {
            write!(f, "{:.1e}", self.0)
        } else {
            let decimals = (2.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
            write!(f, "{:.decimals$}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: Words = Words {
        theme: "wall",
        quantity: "energy (mJ)",
        fails: "it bounces",
        instead: "it does not",
    };

    #[test]
    fn a_row_passes_up_to_its_limit_and_a_nan_never_does() {
        assert_eq!(WORDS.row("a", 1.0, 1.0, &[]).verdict, Verdict::Pass);
        assert_eq!(WORDS.row("a", 1.1, 1.0, &[]).verdict, Verdict::Fail);
        assert_eq!(WORDS.row("a", f64::NAN, 1.0, &[]).verdict, Verdict::Fail);
        let skipped = WORDS.skipped("a", "no data").to_string();
        assert!(skipped.starts_with("skip") && skipped.contains("no data"));
    }

    #[test]
    fn figures_have_three_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.2345, "1.23"),
            (-123.4, "-123"),
            (0.012_345, "0.0123"),
            (1e-7, "1.0e-7"),
            (f64::INFINITY, "∞"),
        ] {
            assert_eq!(Figure(value).to_string(), text);
        }
    }
}
