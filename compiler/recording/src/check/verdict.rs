//! Results of a check.

use serde::Serialize;
use std::fmt;

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// As it should be.
    Good,
    /// Worth knowing.
    Note,
    /// The texture may suffer.
    Warning,
    /// Something is broken.
    Fault,
}

/// Subject of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FindingKind {
    /// Values beyond what the sensor can give.
    Clipping,
    /// Missing or held values.
    DropOut,
    /// Values that nothing on a desk has.
    Impossible,
    /// A clock that runs fast or slow.
    Drift,
    /// A file that comes late.
    Delay,
    /// Gravity and bias of an accelerometer at rest.
    Gravity,
    /// Touching or not.
    Contact,
    /// Mains hum.
    Hum,
    /// A unit that cannot be right.
    Unit,
    /// Less data than wanted.
    Short,
    /// A file that is cut, or that does not say how long it is.
    File,
    /// A constant value throughout.
    Dead,
    /// A channel that holds what another one does, or a clock.
    Mislabelled,
}

/// A finding of a check.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// File, empty where it is about all.
    pub file: String,
    /// Channel, empty where it is about the file.
    pub channel: String,
    /// Its subject.
    pub kind: FindingKind,
    /// Its severity.
    pub severity: Severity,
    /// Description of the finding.
    pub what: String,
    /// Step for the user.
    pub remedy: String,
}

impl Finding {
    pub(crate) fn of_channel(
        file: &str,
        channel: &str,
        kind: FindingKind,
        severity: Severity,
        what: String,
        remedy: &str,
    ) -> Self {
        Self {
            file: file.to_owned(),
            channel: channel.to_owned(),
            kind,
            severity,
            what,
            remedy: remedy.to_owned(),
        }
    }

    pub(crate) fn of_file(
        file: &str,
        kind: FindingKind,
        severity: Severity,
        what: String,
        remedy: &str,
    ) -> Self {
        Self::of_channel(file, "", kind, severity, what, remedy)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mark = match self.severity {
            Severity::Good => "good",
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Fault => "FAULT",
        };
        let place = [&self.file, &self.channel];
        let place: Vec<&str> = place
            .into_iter()
            .map(String::as_str)
            .filter(|s| !s.is_empty())
            .collect();
        write!(f, "{mark:<8} {}: {}", place.join(", "), self.what)?;
        if self.severity > Severity::Good {
            write!(f, "\n         → {}", self.remedy)?;
        }
        Ok(())
    }
}

/// All that a check found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Checked {
    /// The findings, the worst first.
    pub findings: Vec<Finding>,
    /// By how much each file comes late, s; it was corrected.
    pub late_s: Vec<(String, f64)>,
    /// All channels: file and label.
    pub channels: Vec<(String, String)>,
    /// Time in which all channels are good, s.
    pub good_s: f64,
    /// Time in contact, s.
    pub contact_s: f64,
    /// Time that all files cover, s.
    pub duration_s: f64,
}

impl Checked {
    /// The worst finding.
    #[must_use]
    pub fn worst(&self) -> Severity {
        self.findings
            .iter()
            .map(|finding| finding.severity)
            .max()
            .unwrap_or(Severity::Good)
    }

    /// Findings that are at least this bad.
    pub fn at_least(&self, severity: Severity) -> impl Iterator<Item = &Finding> {
        self.findings
            .iter()
            .filter(move |finding| finding.severity >= severity)
    }
}

impl fmt::Display for Checked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:.1} s shared by all files, {:.1} s in contact, {:.1} s good",
            self.duration_s, self.contact_s, self.good_s
        )?;
        for (file, channel) in &self.channels {
            let of = self.findings.iter().filter(|x| {
                x.severity > Severity::Note
                    && x.file == *file
                    && (x.channel == *channel || x.channel.is_empty())
            });
            let is_dead = self
                .findings
                .iter()
                .any(|x| x.kind == FindingKind::Dead && x.file == *file && x.channel == *channel);
            let verdict = match of.map(|x| x.severity).max() {
                None if is_dead => "does not move",
                None => "good",
                Some(Severity::Warning) => "usable with care",
                Some(_) => "faulty",
            };
            writeln!(f, "  {file} {channel:<15} {verdict}")?;
        }
        for finding in &self.findings {
            writeln!(f, "{finding}")?;
        }
        Ok(())
    }
}

impl Checked {
    /// Faults that no step can mend: an import with them would give a wrong texture. Bad stretches are
    /// left out, and delays are corrected.
    pub fn stopping(&self) -> impl Iterator<Item = &Finding> {
        self.at_least(Severity::Fault).filter(|finding| {
            matches!(
                finding.kind,
                FindingKind::Unit
                    | FindingKind::Contact
                    | FindingKind::Impossible
                    | FindingKind::Dead
                    | FindingKind::Mislabelled
            )
        })
    }

    /// By how much a file came late, s.
    #[must_use]
    pub fn late_of(&self, file: &str) -> f64 {
        self.late_s
            .iter()
            .find(|(known, _)| known == file)
            .map_or(0.0, |(_, late_s)| *late_s)
    }
}

#[cfg(test)]
#[path = "verdict_tests.rs"]
mod tests;
