//! Units and ranges that cannot be right: gravity, inertia and motion are the same for everybody.

use super::{
    delay::{motion, vibration},
    verdict::{Finding, FindingKind, Severity},
};
use crate::{
    description::{Axis, GRAVITY_M_S2, Quantity, Unit},
    reader::Recording,
    signal::quantile::{mean, quantile},
    timeline::{Aligned, Timeline},
};

/// Factors by which people get units wrong.
const FACTORS: [f64; 7] = [
    1.0,
    9.806_65,
    1.0 / 9.806_65,
    1000.0,
    1e-3,
    9806.65,
    1.0 / 9806.65,
];
/// Tolerances of the ratio to a factor, as factors.
const GRAVITY_TOLERANCE: f64 = 1.25;
const MOTION_TOLERANCE: f64 = 1.8;
const MASS_TOLERANCE: f64 = 2.6;
/// Tolerance of the ratio between two units: within it the unit is wrong, beyond it the range.
const UNIT_TOLERANCE: f64 = 1.08;
/// Least steady acceleration that is gravity, as a part of it: less is the bias of a sensor that shows none.
const LEAST_GRAVITY: f64 = 0.3;
/// Least correlation of two channels that measure the same.
const LEAST_CORRELATION: f64 = 0.3;
/// Speeds of strokes that a hand has, mm/s: least and most.
pub const SPEEDS_MM_S: (f64, f64) = (2.0, 3000.0);
/// Loads that a hand has, N: least and most.
pub const LOADS_N: (f64, f64) = (0.02, 100.0);

pub(super) fn check(
    recording: &Recording,
    aligned: &Aligned,
    timeline: &Timeline,
    dead: &[bool],
) -> Vec<Finding> {
    let mut wrong: Vec<(Quantity, f64, &'static str)> = Vec::new();
    let any_dead = |quantity| {
        let mut all = recording.channels.iter().zip(dead);
        all.any(|(channel, dead)| channel.quantity == quantity && *dead)
    };
    // A dead axis may be the one that shows gravity.
    let gravity = (!any_dead(Quantity::Acceleration))
        .then(|| gravity_factor(recording, aligned))
        .flatten();
    let of_accel = gravity.unwrap_or(1.0);
    if of_accel != 1.0 {
        wrong.push((Quantity::Acceleration, of_accel, "gravity"));
    }
    // Both hold the acceleration against another channel.
    let of_motion = ratio(&motion(recording, aligned, dead))
        .and_then(|r| factor(r.map(|r| r / of_accel), MOTION_TOLERANCE));
    let of_mass = recording.description.tool.mass_kg.and_then(|mass_kg| {
        let of_force = ratio(&vibration(recording, aligned, dead))?;
        factor(of_force.map(|r| of_accel / (r * mass_kg)), MASS_TOLERANCE)
    });
    match (of_motion, of_mass) {
        (Some(motion), Some(mass))
            if gravity.is_none() && motion != 1.0 && (motion * mass - 1.0).abs() < 1e-3 =>
        {
            wrong.push((
                Quantity::Acceleration,
                motion,
                "the motion and the tool's mass",
            ));
        }
        (motion, mass) => {
            if let Some(motion) = motion.filter(|f| *f != 1.0) {
                wrong.push((
                    Quantity::Position,
                    1.0 / motion,
                    "the acceleration of the same motion",
                ));
            }
            if let Some(mass) = mass.filter(|f| *f != 1.0) {
                wrong.push((Quantity::Force, mass, "the tool's mass times its vibration"));
            }
        }
    }
    let moving = quantile(timeline.speed_mm_s.iter().copied(), 0.9);
    let motion_known =
        wrong.iter().any(|(q, ..)| *q == Quantity::Position) || of_motion == Some(1.0);
    let quantity = if has(recording, Quantity::Speed) {
        Quantity::Speed
    } else {
        Quantity::Position
    };
    let is_dead = |quantity, axis| {
        let found = aligned.find(recording, quantity, axis);
        found.is_some_and(|index| dead[index])
    };
    let mut all = recording.channels.iter().zip(dead);
    let moves = all.any(|(channel, dead)| channel.quantity == quantity && !dead);
    if !motion_known
        && moves
        && let Some(f) = beyond(moving, SPEEDS_MM_S)
    {
        wrong.push((quantity, f, "the speed of a hand"));
    }
    let loads = timeline
        .load_n
        .iter()
        .zip(&timeline.contact)
        .filter(|(_, touches)| **touches)
        .map(|(load, _)| *load);
    let pressed = quantile(loads, 0.9).max(quantile(timeline.load_n.iter().copied(), 0.98));
    let force_known = wrong.iter().any(|(q, ..)| *q == Quantity::Force);
    if !force_known
        && !is_dead(Quantity::Force, Axis::Z)
        && let Some(f) = beyond(pressed, LOADS_N)
    {
        wrong.push((Quantity::Force, f, "the load of a hand"));
    }
    let unchecked = gravity.is_none() && of_motion.is_none() && of_mass.is_none();
    let known = wrong.iter().any(|(q, ..)| *q == Quantity::Acceleration);
    let unchecked = (unchecked && !known).then(|| unchecked_scale(recording));
    wrong
        .into_iter()
        .map(|(quantity, factor, by)| finding(recording, quantity, factor, by))
        .chain(unchecked.flatten())
        .collect()
}

/// An acceleration that nothing tells the scale of.
fn unchecked_scale(recording: &Recording) -> Option<Finding> {
    let quantity = Quantity::Acceleration;
    let channel = recording.channels.iter().find(|c| c.quantity == quantity)?;
    Some(Finding::of_channel(
        &channel.file,
        &quantity.to_string(),
        FindingKind::Gravity,
        Severity::Note,
        "its scale cannot be checked: it shows no gravity, and no motion or force that another channel has".into(),
        "look up unit and range of the sensor, or record three axes that show gravity",
    ))
}

fn has(recording: &Recording, quantity: Quantity) -> bool {
    recording.channels.iter().any(|c| c.quantity == quantity)
}

fn finding(recording: &Recording, quantity: Quantity, factor: f64, by: &str) -> Finding {
    let file = recording
        .channels
        .iter()
        .find(|c| c.quantity == quantity)
        .map_or("", |c| &c.file);
    let words = if factor > 1.0 {
        format!("{factor:.4} times too large")
    } else {
        format!("{:.4} times too small", 1.0 / factor)
    };
    let (kind, remedy) = match fitting(recording, quantity, factor) {
        Some(Some(unit)) => (
            "unit",
            format!("correct `unit` of {quantity} in recording.toml: {unit:?} would fit"),
        ),
        Some(None) => (
            "unit",
            format!("correct `unit` of {quantity} in recording.toml"),
        ),
        None => (
            "range",
            format!(
                "write the range that the sensor was set to (±2 g read as ±4 g gives a factor of 2), or multiply \
                 `scale` of {quantity} in recording.toml by {:.4}",
                1.0 / factor
            ),
        ),
    };
    let what = format!("wrong {kind}: its values are {words}, by {by}");
    Finding::of_channel(
        file,
        &quantity.to_string(),
        FindingKind::Unit,
        Severity::Fault,
        what,
        &remedy,
    )
}

/// The unit that a factor stands for, if there is one that a description can name; `None` for a factor that lies
/// between no two units.
fn fitting(recording: &Recording, quantity: Quantity, factor: f64) -> Option<Option<&'static str>> {
    let near = |one: f64, other: f64| (one / other).max(other / one) < UNIT_TOLERANCE;
    let files = recording.description.files.iter();
    let mut channels = files.flat_map(|file| &file.channels);
    let unit = channels.find(|c| c.quantity == quantity).map(|c| c.unit);
    let fits =
        unit.and_then(|unit| Unit::worth(quantity, |to_si| near(to_si, unit.to_si / factor)));
    let is_known = FACTORS.iter().any(|known| near(*known, factor));
    (fits.is_some() || is_known).then_some(fits)
}

/// By which factor the acceleration at rest differs from gravity, 1 within a quarter; `None` for a sensor without a
/// steady part.
fn gravity_factor(recording: &Recording, aligned: &Aligned) -> Option<f64> {
    let axes: Vec<&Vec<f64>> = recording
        .channels
        .iter()
        .zip(&aligned.channels)
        .filter(|(channel, _)| channel.quantity == Quantity::Acceleration)
        .map(|(_, samples)| samples)
        .collect();
    let steady = axes
        .iter()
        .map(|axis| mean(axis))
        .map(|x| x * x)
        .sum::<f64>()
        .sqrt();
    let moving = axes
        .iter()
        .map(|axis| {
            let middle = mean(axis);
            quantile(axis.iter().map(|x| (x - middle).abs()), 0.5)
        })
        .fold(0.0, f64::max);
    if axes.len() < 3 || steady < moving {
        return None;
    }
    let found = steady / GRAVITY_M_S2;
    match factor([found; 2], GRAVITY_TOLERANCE) {
        Some(1.0) => Some(1.0),
        near if found < LEAST_GRAVITY => near,
        _ => factor([found; 2], UNIT_TOLERANCE).or(Some(found)),
    }
}

/// The first over the second of pairs that go together, as the noise of the second and of the first make it: the slopes
/// of both regressions, between which the truth lies.
fn ratio(pairs: &[(Vec<f64>, Vec<f64>)]) -> Option<[f64; 2]> {
    let power = |axis: &[f64]| axis.iter().map(|x| x * x).sum::<f64>();
    // One axis at a time: the largest is the surest.
    let mut best: Option<(f64, [f64; 2])> = None;
    let reach = 30;
    for (x, y) in pairs {
        let found = crate::signal::correlate::delay(&[(x, y)], reach)?;
        if found.correlation > LEAST_CORRELATION
            && best.is_none_or(|(known, _)| found.correlation > known)
        {
            let whole = (power(x) / power(y)).sqrt();
            let slopes = [found.correlation * whole, whole / found.correlation];
            best = Some((found.correlation, slopes));
        }
    }
    best.map(|(_, slopes)| slopes)
}

/// The factor that lies between the slopes or near to them: 1 if it does, else the one next to the first slope.
fn factor(slopes: [f64; 2], tolerance: f64) -> Option<f64> {
    let [first, second] = slopes;
    let (low, high) = (first.min(second) / tolerance, first.max(second) * tolerance);
    let possible = || {
        FACTORS
            .into_iter()
            .filter(|factor| low < *factor && *factor < high)
    };
    let off = |factor: &f64| libm::log(factor / first).abs();
    let next = || possible().min_by(|a, b| off(a).total_cmp(&off(b)));
    possible().find(|factor| *factor == 1.0).or_else(next)
}

/// The power of 1000 that brings a value into a range.
fn beyond(value: f64, (low, high): (f64, f64)) -> Option<f64> {
    if value > high {
        Some(1000.0)
    } else if value < low && value > 0.0 {
        Some(1e-3)
    } else {
        None
    }
}

#[cfg(test)]
#[path = "scale_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::white;

    #[test]
    fn only_the_factors_that_people_confuse_are_named() {
        assert_eq!(factor([1.1; 2], 1.25), Some(1.0));
        assert_eq!(factor([0.11; 2], 1.25), Some(1.0 / 9.806_65));
        assert_eq!(factor([970.0; 2], 1.25), Some(1000.0));
        assert_eq!(factor([3.0; 2], 1.25), None);
    }

    /// A quiet surface under a noisy force sensor: the slope on the noisy channel is too small by a factor of seven.
    #[test]
    fn noise_in_one_channel_is_no_wrong_unit() {
        let (tool, sensor) = (white(1, 4000, 1), white(2, 4000, 1));
        let noisy: Vec<f64> = tool.iter().zip(&sensor).map(|(a, n)| a + 2.5 * n).collect();
        for (x, y) in [(&tool, &noisy), (&noisy, &tool)] {
            let slopes = ratio(&[(x.clone(), y.clone())]).unwrap();
            let widest = slopes[1] / slopes[0];
            assert!(
                widest > 6.0 && slopes[0] < 1.1 && slopes[1] > 0.9,
                "{slopes:?}"
            );
            assert_eq!(factor(slopes, 1.8), Some(1.0));
            // A unit that is wrong by 1000 is found all the same.
            let grams = slopes.map(|slope| 1000.0 * slope);
            assert_eq!(factor(grams, 2.6), Some(1000.0));
        }
    }
}
