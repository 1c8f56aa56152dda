//! Channels that are not what they are said to be: one value throughout, the values of another channel, a
//! clock, or a unit that the column's own name contradicts.

use super::verdict::{Finding, FindingKind, Severity};
use crate::{
    channel::Channel,
    description::{self, Column, Meaning, Quantity, Unit, meaning},
    reader::Recording,
};

/// Shortest end of a channel at one value that is a sensor that died, s and as a part of the channel.
const LEAST_END: (f64, f64) = (0.5, 0.04);
/// Least ratio of that end to the longest other run of the channel.
const LONGER: u64 = 5;
/// Part of the recording at whose end a hand may rest.
const REST: f64 = 0.25;
/// Fewest samples that tell a counter.
const LEAST_COUNTED: usize = 100;
/// Tolerance of a counter's straight line, as a fraction of its range: packets have steps.
const STRAIGHT: f64 = 0.02;
/// Relative tolerance between the slope of a counter and that of a clock in one of its units.
const SLOPE: f64 = 0.01;

/// Finds the dead channels, which hold one value throughout, and the faults in labels.
pub(super) fn check(recording: &Recording) -> (Vec<bool>, Vec<Finding>) {
    let dead: Vec<bool> = recording.channels.iter().map(is_dead).collect();
    let mut findings = Vec::new();
    for (index, channel) in recording.channels.iter().enumerate() {
        let of = |kind, severity, what: String, remedy: &str| {
            Finding::of_channel(&channel.file, &channel.label, kind, severity, what, remedy)
        };
        if dead[index] {
            let what = format!(
                "dead: it holds one value, {} {}, in all {} rows",
                channel.numbers.max,
                Unit::si(channel.quantity),
                channel.numbers.count
            );
            let severity = severity(recording, &dead, channel);
            let remedy = if severity == Severity::Note {
                "nothing, if it has no part in this recording"
            } else {
                "look for a loose cable or a sensor that was not started, and check `column`"
            };
            findings.push(of(FindingKind::Dead, severity, what, remedy));
            continue;
        }
        if let Some(severity) = died(recording, &dead, channel)
            && let Some(run) = channel.numbers.last_run
        {
            let what = format!(
                "drop-outs: it stands still from {:.3} s to its end, at {} {}",
                channel.clock.time_s(run.start as f64),
                run.value,
                Unit::si(channel.quantity)
            );
            let remedy = "look for a loose cable or a sensor that stopped; the stretch is left out";
            findings.push(of(FindingKind::DropOut, severity, what, remedy));
        }
        let copied = recording.channels[..index]
            .iter()
            .find(|known| is_copy(known, channel));
        if let Some(original) = copied {
            let what = format!(
                "mislabelled: it holds the values of {}, row by row",
                original.label
            );
            let remedy = "check `column` and the program that wrote the file";
            findings.push(of(FindingKind::Mislabelled, Severity::Fault, what, remedy));
        }
    }
    let described = recording
        .description
        .files
        .iter()
        .flat_map(|file| &file.channels);
    for (channel, described) in recording.channels.iter().zip(described) {
        let of = |kind, severity, what: String, remedy: &str| {
            Finding::of_channel(&channel.file, &channel.label, kind, severity, what, remedy)
        };
        if let Some(counted) = counter(channel, described) {
            let what = format!(
                "mislabelled: it counts {counted}, which no {} does",
                channel.quantity
            );
            let remedy =
                "remove the channel from recording.toml; name it under `clock` if it is the time";
            findings.push(of(FindingKind::Mislabelled, Severity::Fault, what, remedy));
        }
        findings.extend(contradiction(described).map(|(kind, what)| {
            of(
                kind,
                Severity::Warning,
                what,
                "correct it in recording.toml, or rename the column",
            )
        }));
    }
    (dead, findings)
}

fn is_dead(channel: &Channel) -> bool {
    let numbers = &channel.numbers;
    numbers.count > numbers.missing + 1 && numbers.min == numbers.max
}

fn is_motion(channel: &Channel) -> bool {
    matches!(channel.quantity, Quantity::Position | Quantity::Speed)
}

/// A motion may leave an axis out; a torque is not used.
fn severity(recording: &Recording, dead: &[bool], channel: &Channel) -> Severity {
    let moves = || {
        let mut all = recording.channels.iter().zip(dead);
        all.any(|(other, dead)| is_motion(other) && !dead)
    };
    if channel.quantity == Quantity::Torque || is_motion(channel) && moves() {
        Severity::Note
    } else {
        Severity::Fault
    }
}

/// Severity of a channel that holds one value from some time to its end; `None` if it does not.
fn died(recording: &Recording, dead: &[bool], channel: &Channel) -> Option<Severity> {
    let long = |channel: &Channel| {
        let numbers = &channel.numbers;
        let (least_s, least_part) = LEAST_END;
        let run = numbers.last_run?;
        let part = run.length as f64 / numbers.count as f64;
        let is_long = run.length as f64 >= least_s * channel.clock.rate_hz
            && part >= least_part
            && run.length >= LONGER * numbers.longest_before;
        is_long.then_some(part)
    };
    let part = long(channel)?;
    match channel.quantity {
        Quantity::Acceleration => Some(Severity::Fault),
        // A hand may rest, and then all of its axes do.
        Quantity::Position | Quantity::Speed => {
            let mut moving = recording.channels.iter().zip(dead);
            let rests =
                moving.all(|(other, dead)| !is_motion(other) || *dead || long(other).is_some());
            (part >= REST && rests).then_some(Severity::Warning)
        }
        Quantity::Force | Quantity::Torque => Some(Severity::Warning),
    }
}

fn is_copy(known: &Channel, channel: &Channel) -> bool {
    known.quantity == channel.quantity
        && known.samples.len() > LEAST_COUNTED
        && !is_dead(known)
        && known.samples == channel.samples
}

/// Unit of a channel that counts like a clock, or `rows` for a row counter.
fn counter(channel: &Channel, described: &description::Channel) -> Option<&'static str> {
    let samples = &channel.samples;
    let (first, last) = (f64::from(*samples.first()?), f64::from(*samples.last()?));
    let range = last - first;
    if samples.len() < LEAST_COUNTED || range == 0.0 {
        return None;
    }
    let a_row = range / (samples.len() - 1) as f64;
    let is_straight = samples
        .iter()
        .enumerate()
        .all(|(n, x)| (f64::from(*x) - first - a_row * n as f64).abs() < STRAIGHT * range.abs());
    let raw = a_row / described.factor();
    let raw_a_s = raw * channel.clock.rate_hz;
    let is_near = |slope: f64, of: f64| (slope / of - 1.0).abs() < SLOPE;
    let units = [
        (1.0, "seconds"),
        (1e3, "milliseconds"),
        (1e6, "microseconds"),
        (1e9, "nanoseconds"),
    ];
    if !is_straight {
        None
    } else if is_near(raw, 1.0) {
        Some("rows")
    } else {
        units
            .into_iter()
            .find(|(of, _)| is_near(raw_a_s, *of))
            .map(|(_, unit)| unit)
    }
}

/// Finds a contradiction between the name of a column and its description.
fn contradiction(described: &description::Channel) -> Option<(FindingKind, String)> {
    let Column::Name(name) = &described.column else {
        return None;
    };
    let Meaning::Channel { quantity, unit, .. } = meaning(name) else {
        return None;
    };
    if quantity != described.quantity {
        let what = format!(
            "mislabelled: its column {name:?} says {quantity}, recording.toml says {}",
            described.quantity
        );
        return Some((FindingKind::Mislabelled, what));
    }
    let unit = unit.filter(|unit| described.scale == 1.0 && unit.to_si != described.unit.to_si)?;
    let what = format!(
        "wrong unit: its column {name:?} says {}, recording.toml says {}",
        unit.name, described.unit.name
    );
    Some((FindingKind::Unit, what))
}

#[cfg(test)]
#[path = "label_tests.rs"]
mod laws;
