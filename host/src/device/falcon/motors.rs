//! From a force at the grip to the counts of three motors, and back.
//!
//! Virtual work: the force F does at the grip what the torques τ do at the thighs, F·dx = τ·dθ.
//! With dθ = J·dx that is F = Jᵀ·τ. A positive torque opens the thigh, which takes a negative
//! command.

use super::frame::MOTOR_LIMIT;
use super::geometry::COUNTS_PER_NM;
use super::kinematics::{Jacobian, norm, solve};

/// Counts that make the grip push with `force_n`. Where a motor would need more than it has, all
/// are lowered in proportion, so that the direction stays. `None` where the legs are singular.
#[must_use]
pub fn counts(force_n: [f64; 3], jacobian: &Jacobian) -> Option<[i16; 3]> {
    let transposed = std::array::from_fn(|n| jacobian.map(|row| row[n]));
    let torque_nm = solve(&transposed, force_n)?;
    let exact = torque_nm.map(|torque| -torque * COUNTS_PER_NM);
    let largest = exact
        .iter()
        .fold(0.0_f64, |l, c| if c.abs() > l { c.abs() } else { l });
    let limit = f64::from(MOTOR_LIMIT);
    let scale = if largest > limit {
        limit / largest
    } else {
        1.0
    };
    // Towards zero, so that rounding never adds force.
    Some(exact.map(|count| (count * scale) as i16))
}

/// Force at the grip that counts make, N.
#[must_use]
pub fn force_n(counts: [i16; 3], jacobian: &Jacobian) -> [f64; 3] {
    let torque_nm = counts.map(|count| -f64::from(count) / COUNTS_PER_NM);
    std::array::from_fn(|n| (0..3).map(|leg| jacobian[leg][n] * torque_nm[leg]).sum())
}

/// A force of at most `peak_n`, in the same direction; zero for what is no number.
#[must_use]
pub fn limited(force_n: [f32; 3], peak_n: f32) -> [f64; 3] {
    let force = force_n.map(f64::from);
    let (size, peak) = (norm(force), f64::from(peak_n));
    if !size.is_finite() {
        return [0.0; 3];
    }
    if size > peak {
        force.map(|f| f * peak / size)
    } else {
        force
    }
}

/// Goes from the counts that a motor has to those that are wanted, by at most `step` a motor. All
/// three go the same share of their way.
#[must_use]
pub fn approach(has: [i16; 3], wanted: [i16; 3], step: i16) -> [i16; 3] {
    let way: [i32; 3] = std::array::from_fn(|n| i32::from(wanted[n]) - i32::from(has[n]));
    let longest = way.iter().fold(0, |longest, w| longest.max(w.abs()));
    let step = i32::from(step.max(1));
    if longest <= step {
        return wanted;
    }
    // Division cuts towards zero: no motor goes further than its share.
    std::array::from_fn(|n| (i32::from(has[n]) + way[n] * step / longest) as i16)
}

#[cfg(test)]
mod tests {
    use super::super::geometry::CENTRE_M;
    use super::super::kinematics::{dot, inverse, jacobian};
    use super::*;

    fn places() -> impl Iterator<Item = ([f64; 3], Jacobian)> {
        (0..500_u32).map(|n| {
            let unit = |k: u32| f64::from(n.wrapping_mul(k) % 1000) / 1000.0 - 0.5;
            let offset = [unit(617), unit(383), unit(757)];
            let position = std::array::from_fn(|axis| CENTRE_M[axis] + 0.05 * offset[axis]);
            let rows = jacobian(position, inverse(position).expect("reachable"));
            (position, rows.expect("regular"))
        })
    }

    #[test]
    fn torques_do_the_work_that_the_force_does() {
        for (n, (position, rows)) in places().enumerate() {
            let force = [1.0, -0.5 + 0.002 * n as f64, 0.7];
            let torque = counts(force, &rows).expect("regular");
            let torque = torque.map(|c| -f64::from(c) / COUNTS_PER_NM);
            let moved = [3e-7, -2e-7, 4e-7];
            let there = std::array::from_fn(|axis| position[axis] + moved[axis]);
            let (before, after) = (inverse(position), inverse(there));
            let (before, after) = (before.expect("here"), after.expect("there"));
            let turned = std::array::from_fn(|leg| after[leg] - before[leg]);
            // Counts are cut by less than one each: 10⁻⁴ N·m.
            let slack = 1e-4 * turned.iter().map(|t: &f64| t.abs()).sum::<f64>() + 1e-12;
            let error = dot(force, moved) - dot(torque, turned);
            assert!(
                error.abs() <= slack,
                "{position:?}: {error:e} J of {slack:e}"
            );
        }
    }

    #[test]
    fn counts_give_the_force_back_within_their_step() {
        for (position, rows) in places() {
            for force in [[2.0, 0.0, 0.0], [0.0, -1.5, 1.0], [0.3, 0.2, -2.5]] {
                let back = force_n(counts(force, &rows).expect("regular"), &rows);
                let error: [f64; 3] = std::array::from_fn(|n| back[n] - force[n]);
                assert!(norm(error) < 0.01, "{position:?}: {force:?} gives {back:?}");
            }
        }
    }

    #[test]
    fn a_force_beyond_the_motors_keeps_its_direction() {
        for (_, rows) in places() {
            let force = [60.0, -80.0, 40.0];
            let counts = counts(force, &rows).expect("regular");
            assert!(counts.iter().all(|c| c.abs() <= MOTOR_LIMIT));
            assert!(counts.iter().any(|c| c.abs() >= MOTOR_LIMIT - 1));
            let back = force_n(counts, &rows);
            let cosine = dot(force, back) / (norm(force) * norm(back));
            assert!(cosine > 0.9999, "{cosine}");
        }
    }

    #[test]
    fn limits_hold_for_every_number() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(limited([bad, 1.0, 0.0], 8.9), [0.0; 3]);
        }
        assert!((norm(limited([f32::MAX, -30.0, 2.0], 8.9)) - 8.9).abs() < 1e-5);
        let few = limited([1.0, 2.0, -2.0], 8.9);
        assert_eq!(few, [1.0, 2.0, -2.0]);
    }

    #[test]
    fn an_approach_is_straight_and_arrives() {
        let wanted = [4096, -4096, 100];
        let mut has = [0; 3];
        for frame in 0..20 {
            let next = approach(has, wanted, 512);
            for n in 0..3 {
                assert!((next[n] - has[n]).abs() <= 512);
                let straight = f64::from(wanted[n]) * f64::from(frame + 1) / 8.0;
                assert!(frame >= 8 || (f64::from(next[n]) - straight).abs() < 16.0);
            }
            has = next;
        }
        assert_eq!(has, wanted);
        assert_eq!(approach([i16::MIN; 3], [i16::MAX; 3], i16::MAX)[0], -1);
    }
}
