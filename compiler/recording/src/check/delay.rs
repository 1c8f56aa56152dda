//! Delays between files: what one of them shows early, another shows late.

use super::{
    hum::without_hum,
    verdict::{Finding, FindingKind, Severity},
};
use crate::{
    description::{Axis, Quantity},
    reader::Recording,
    signal::{
        correlate,
        filter::{band_pass, derivative},
    },
    timeline::{Aligned, RATE_HZ, velocity},
};

/// Largest delay that is looked for, s.
const REACH_S: f64 = 0.08;
/// Delay that is warned of although it is corrected, s: a stroke changes its speed meanwhile.
const WARNED_S: f64 = 0.008;
/// Least correlation that tells a delay.
const LEAST_CORRELATION: f64 = 0.25;
/// A peak must stand above its rivals.
const LEAST_LEAD: f64 = 0.02;
/// Vibration that accelerometer and force sensor share, Hz.
const VIBRATION_HZ: (f64, f64) = (30.0, 250.0);
/// Motion that accelerometer and position share, Hz.
const MOTION_HZ: (f64, f64) = (2.0, 7.0);
/// Turns of strokes, which friction and velocity share, Hz.
const FRICTION_HZ: (f64, f64) = (0.5, 20.0);
/// Standard deviations that a delay beyond `WARNED_S` must exceed to be reported.
const SURE: f64 = 3.0;
/// Half lengths of the filters, samples.
const HALF: (usize, usize) = (60, 300);
/// Least rate of a force sensor that shows vibration, Hz.
const FAST_HZ: f64 = 600.0;

/// By how much a file comes after that of the acceleration.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FileDelay {
    pub file: String,
    pub late_s: f64,
}

type Pairs = Vec<(Vec<f64>, Vec<f64>)>;

/// The delay of every file, and what is to be said about it.
pub(super) fn check(
    recording: &Recording,
    aligned: &Aligned,
    dead: &[bool],
) -> (Vec<FileDelay>, Vec<Finding>) {
    let (mut delays, mut findings) = (Vec::new(), Vec::new());
    // A quantity whose channels all are dead has no delay.
    let file_of = |quantity| {
        recording
            .channels
            .iter()
            .zip(dead)
            .find(|(c, dead)| c.quantity == quantity && !**dead)
            .map(|(c, _)| c.file.clone())
    };
    let Some(reference) = file_of(Quantity::Acceleration) else {
        return (delays, findings);
    };
    for (quantity, how) in [
        (Quantity::Position, "motion"),
        (Quantity::Force, "vibration"),
    ] {
        let Some(file) = file_of(quantity).filter(|file| *file != reference) else {
            continue;
        };
        if delays.iter().any(|known: &FileDelay| known.file == file) {
            continue;
        }
        let of_position = file_of(Quantity::Position).and_then(|position| {
            let known = delays.iter().find(|known| known.file == position);
            let same = (position == reference).then_some(0.0);
            known.map(|known| known.late_s).or(same)
        });
        let found = match quantity {
            Quantity::Position => lag(&motion(recording, aligned, dead), MOTION_HZ),
            // Friction turns with the stroke, which the position shows.
            _ => lag(&vibration(recording, aligned, dead), VIBRATION_HZ).or_else(|| {
                Some(of_position? + lag(&friction(recording, aligned, dead), FRICTION_HZ)?)
            }),
        };
        let told = findings.iter().position(|finding| finding.file == file);
        let Some(late_s) = found else {
            if told.is_some() {
                continue;
            }
            let what =
                format!("its delay cannot be told: it shares no {how} with the accelerometer");
            findings.push(Finding::of_file(
                &file,
                FindingKind::Delay,
                Severity::Note,
                what,
                "tap the surface a few times at start and end",
            ));
            continue;
        };
        // What the motion cannot tell, the vibration may.
        told.map(|note| findings.remove(note));
        let what = format!(
            "misaligned: it comes {:.1} ms after the accelerometer; corrected",
            1e3 * late_s
        );
        let severity = if late_s.abs() > WARNED_S {
            Severity::Warning
        } else {
            Severity::Good
        };
        findings.push(Finding::of_file(
            &file,
            FindingKind::Delay,
            severity,
            what,
            "start all devices by one trigger, or give `start_s`",
        ));
        delays.push(FileDelay { file, late_s });
    }
    (delays, findings)
}

/// The delay by which pairs of signals are alike, in a band of so many Hz around a middle. What is not known
/// well enough to tell whether it deserves a warning is not told.
fn lag(pairs: &Pairs, (low_hz, high_hz): (f64, f64)) -> Option<f64> {
    let pairs: Vec<(&[f64], &[f64])> = pairs.iter().map(|(x, y)| (&x[..], &y[..])).collect();
    let found = correlate::delay(&pairs, (REACH_S * RATE_HZ) as usize)?;
    // The standard deviation of a delay between signals that share a part of their power.
    let seconds = pairs.first().map_or(0.0, |(x, _)| x.len() as f64 / RATE_HZ);
    let noise = 1.0 / (found.correlation * found.correlation).min(1.0) - 1.0;
    let turns = std::f64::consts::PI * (low_hz + high_hz);
    let sigma_s = (noise / (2.0 * (high_hz - low_hz) * seconds)).sqrt() / turns;
    let late_s = found.samples / RATE_HZ;
    let is_sure = late_s.abs() <= WARNED_S || late_s.abs() > SURE * sigma_s;
    let clear = is_sure
        && found.correlation > LEAST_CORRELATION
        && found.correlation > found.rival + LEAST_LEAD;
    clear.then_some(late_s)
}

/// The channels of two quantities along the same axis, without dead ones.
fn both(
    recording: &Recording,
    aligned: &Aligned,
    dead: &[bool],
    of: [Quantity; 2],
    prepare: impl Fn(Quantity, &[f64]) -> Vec<f64>,
) -> Pairs {
    let alive = |quantity, axis| {
        let index = aligned
            .find(recording, quantity, axis)
            .filter(|index| !dead[*index]);
        index.map(|index| &aligned.channels[index][..])
    };
    let pairs = [Axis::X, Axis::Y, Axis::Z].map(|axis| of.map(|quantity| alive(quantity, axis)));
    pairs
        .into_iter()
        .filter_map(|[x, y]| Some((prepare(of[0], x?), prepare(of[1], y?))))
        .collect()
}

/// Acceleration, and what the position says of it.
pub(super) fn motion(recording: &Recording, aligned: &Aligned, dead: &[bool]) -> Pairs {
    let band = (MOTION_HZ.0 / RATE_HZ, MOTION_HZ.1 / RATE_HZ);
    both(
        recording,
        aligned,
        dead,
        [Quantity::Acceleration, Quantity::Position],
        |quantity, axis| {
            let slow = band_pass(axis, band, HALF.1);
            if quantity == Quantity::Position {
                derivative(&derivative(&slow))
                    .into_iter()
                    .map(|x| x * RATE_HZ * RATE_HZ)
                    .collect()
            } else {
                slow
            }
        },
    )
}

/// Acceleration and force of a tool that vibrates.
pub(super) fn vibration(recording: &Recording, aligned: &Aligned, dead: &[bool]) -> Pairs {
    let is_fast =
        |c: &crate::channel::Channel| c.quantity != Quantity::Force || c.clock.rate_hz >= FAST_HZ;
    if !recording.channels.iter().all(is_fast) {
        return Vec::new();
    }
    let band = (VIBRATION_HZ.0 / RATE_HZ, VIBRATION_HZ.1 / RATE_HZ);
    both(
        recording,
        aligned,
        dead,
        [Quantity::Acceleration, Quantity::Force],
        |_, axis| band_pass(&without_hum(axis), band, HALF.0),
    )
}

/// The direction of motion, and the force against it.
fn friction(recording: &Recording, aligned: &Aligned, dead: &[bool]) -> Pairs {
    let Some([vx, vy]) = velocity(recording, aligned) else {
        return Vec::new();
    };
    let alive = |axis| {
        let index = aligned.find(recording, Quantity::Force, axis);
        index
            .filter(|index| !dead[*index])
            .map(|index| &aligned.channels[index])
    };
    let (fx, fy) = (alive(Axis::X), alive(Axis::Y));
    let speed: Vec<f64> = vx
        .iter()
        .zip(&vy)
        .map(|(x, y)| libm::hypot(*x, *y).max(0.01))
        .collect();
    let unit = |v: &[f64]| v.iter().zip(&speed).map(|(v, speed)| v / speed).collect();
    let against = |f: &Vec<f64>| f.iter().map(|x| -x).collect();
    [(vx, fx), (vy, fy)]
        .into_iter()
        .filter_map(|(v, f)| Some((unit(&v), against(f?))))
        .collect()
}

#[cfg(test)]
#[path = "delay_tests.rs"]
mod laws;
