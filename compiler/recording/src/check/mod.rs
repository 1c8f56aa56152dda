//! Looks for what is wrong with a recording: a verdict for each channel, and what to do about it.

mod amplitude;
mod delay;
mod hum;
mod label;
mod scale;
mod verdict;

pub use scale::{LOADS_N, SPEEDS_MM_S};
pub use verdict::{Checked, Finding, FindingKind, Severity};

use crate::{
    description::{Axis, Meaning, Quantity, meaning},
    reader::Recording,
    signal::quantile::mean,
    timeline::{Aligned, Timeline},
};
use asperity_io::diagnostic::Fault;
use std::ops::Range;

/// Delay that is corrected, s. Less than this is the uncertainty of the correlation.
const LEAST_DELAY_S: f64 = 0.0003;
/// Drift of a clock that is worth a note, parts per million.
const NOTED_PPM: f64 = 500.0;
/// Jitter of a clock that is worth a note, as a fraction of its period.
const NOTED_JITTER: f64 = 3.0;

/// Checks a recording and aligns its channels, with the delays between files taken away.
///
/// # Errors
/// [`Fault`] where the files share no time, or a quantity is missing.
pub fn check(recording: &Recording) -> Result<(Checked, Timeline), Fault> {
    let mut findings = clocks(recording);
    let mut late_s = vec![0.0; recording.channels.len()];
    let mut aligned = Aligned::new(recording, &late_s)?;
    let mut bad: Vec<(usize, Range<u64>)> = Vec::new();
    let (dead, found) = label::check(recording);
    findings.extend(found);
    for (index, channel) in recording.channels.iter().enumerate() {
        if dead[index] {
            continue;
        }
        let (found, spans) = amplitude::check(channel);
        findings.extend(found);
        bad.extend(spans.into_iter().map(|span| (index, span)));
    }
    let (delays, found) = delay::check(recording, &aligned, &dead);
    findings.extend(found);
    if delays
        .iter()
        .any(|delay| delay.late_s.abs() > LEAST_DELAY_S)
    {
        for (late_s, channel) in late_s.iter_mut().zip(&recording.channels) {
            *late_s = delays
                .iter()
                .find(|d| d.file == channel.file)
                .map_or(0.0, |d| d.late_s);
        }
        aligned = Aligned::new(recording, &late_s)?;
    }
    let spans: Vec<Range<usize>> = bad
        .iter()
        .map(|(channel, span)| aligned.span(recording, *channel, span))
        .collect();
    let timeline = Timeline::new(recording, &aligned, &spans)?;
    findings.extend(scale::check(recording, &aligned, &timeline, &dead));
    findings.extend(hum::check(recording, &aligned, &timeline));
    let is_dead = |quantity, axis| {
        let found = aligned.find(recording, quantity, axis);
        found.is_some_and(|index| dead[index])
    };
    if !Axis::ALL
        .iter()
        .any(|axis| is_dead(Quantity::Acceleration, *axis))
    {
        findings.extend(gravity(recording, &aligned));
    }
    if !is_dead(Quantity::Force, Axis::Z) {
        findings.extend(contact(&timeline));
    }
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    let checked = Checked {
        findings,
        late_s: delays
            .into_iter()
            .map(|delay| (delay.file, delay.late_s))
            .collect(),
        channels: recording
            .channels
            .iter()
            .map(|c| (c.file.clone(), c.label.clone()))
            .collect(),
        good_s: timeline.good.iter().filter(|good| **good).count() as f64
            / crate::timeline::RATE_HZ,
        contact_s: timeline.contact_s(),
        duration_s: timeline.len() as f64 / crate::timeline::RATE_HZ,
    };
    Ok((checked, timeline))
}

fn clocks(recording: &Recording) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (clock, file) in recording.clocks.iter().zip(&recording.description.files) {
        let of = |kind, severity, what: String, remedy: &str| {
            Finding::of_file(&clock.file, kind, severity, what, remedy)
        };
        let name = file
            .clock
            .as_ref()
            .map(ToString::to_string)
            .unwrap_or_default();
        if let Meaning::Clock(Some(unit)) = meaning(&name)
            && unit != file.clock_unit
        {
            let what = format!(
                "its clock {name:?} says {unit}, recording.toml says {}",
                file.clock_unit
            );
            let remedy = "correct `clock_unit` in recording.toml, or rename the column";
            findings.push(of(FindingKind::Unit, Severity::Warning, what, remedy));
        }
        for remark in &clock.remarks {
            findings.push(of(
                FindingKind::File,
                Severity::Warning,
                remark.what.clone(),
                remark.remedy,
            ));
        }
        if clock.gaps > 0 {
            let line = clock.first_gap.unwrap_or(0);
            let what = format!(
                "drop-outs: the clock has {} gaps, {:.3} s in all, the first before line {line}",
                clock.gaps, clock.gap_s
            );
            findings.push(of(
                FindingKind::DropOut,
                Severity::Fault,
                what,
                "the stretches are left out; look for a full buffer or a loose cable",
            ));
        }
        if let Some(ppm) = clock.drift_ppm()
            && ppm.abs() > NOTED_PPM
        {
            let what = format!("its clock runs {ppm:+.0} ppm off the stated rate");
            findings.push(of(
                FindingKind::Drift,
                Severity::Note,
                what,
                "nothing: the clock is believed",
            ));
        }
        let period_s = clock.clock_hz.map_or(0.0, |rate_hz| 1.0 / rate_hz);
        if clock.jitter_s > NOTED_JITTER * period_s && period_s > 0.0 {
            let what = format!("its clock jitters by {:.1} ms RMS", 1e3 * clock.jitter_s);
            findings.push(of(
                FindingKind::Drift,
                Severity::Warning,
                what,
                "stamp samples where they are taken, not where they arrive",
            ));
        }
        if clock.shortened {
            let what = "is longer than memory may hold; its end is checked, not used".to_owned();
            findings.push(of(
                FindingKind::Short,
                Severity::Note,
                what,
                "split the recording",
            ));
        }
    }
    findings
}

fn gravity(recording: &Recording, aligned: &Aligned) -> Option<Finding> {
    let steady: Vec<f64> = recording
        .channels
        .iter()
        .zip(&aligned.channels)
        .filter(|(channel, _)| channel.quantity == Quantity::Acceleration)
        .map(|(_, samples)| mean(samples))
        .collect();
    let size = steady.iter().map(|x| x * x).sum::<f64>().sqrt();
    (size > 0.5).then(|| {
        let what = format!("gravity and bias of {size:.2} m/s² are taken away");
        Finding::of_channel(
            "",
            "acceleration",
            FindingKind::Gravity,
            Severity::Good,
            what,
            "nothing",
        )
    })
}

fn contact(timeline: &Timeline) -> Option<Finding> {
    let (contact_s, all_s) = (
        timeline.contact_s(),
        timeline.len() as f64 / crate::timeline::RATE_HZ,
    );
    let finding = |severity, what: String, remedy: &str| {
        Some(Finding::of_channel(
            "",
            "force z",
            FindingKind::Contact,
            severity,
            what,
            remedy,
        ))
    };
    if contact_s < 0.05 * all_s {
        let what = format!("the tool touches the surface for {contact_s:.1} s of {all_s:.1} s");
        return finding(
            Severity::Fault,
            what,
            "check sign and unit of the normal force, and stroke longer",
        );
    }
    if contact_s > 0.995 * all_s {
        let what = "the tool is never lifted, so neither bias nor noise can be told".to_owned();
        return finding(
            Severity::Warning,
            what,
            "lift the tool for a second at the start",
        );
    }
    None
}

#[cfg(test)]
mod tests;
