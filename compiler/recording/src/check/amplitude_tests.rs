//! Just inside and just outside of what is clipped, held, far or impossible.
#![allow(
    clippy::single_range_in_vec_init,
    reason = "a list of spans may have one"
)]

use super::*;
use crate::{description::Axis, signal::noise::white, test_recordings};

fn of(quantity: Quantity, values: &[f64]) -> Channel {
    test_recordings::channel(quantity, Axis::Z, 1000.0, values)
}

/// A saw of steps that never repeat one value, between −0.8 and 0.8.
fn moving(count: usize) -> Vec<f64> {
    white(9, count, 1).iter().map(|x| 1.6 * x).collect()
}

#[test]
fn values_beyond_any_desk_are_impossible_and_those_at_its_edge_are_not() {
    for (quantity, limit) in [
        (Quantity::Acceleration, 20_000.0),
        (Quantity::Force, 500.0),
        (Quantity::Torque, 50.0),
        (Quantity::Position, 10.0),
        (Quantity::Speed, 10.0),
    ] {
        for sign in [1.0, -1.0] {
            // A ramp has no spikes.
            let up_to = |top: f64| -> Vec<f64> {
                (0..=500)
                    .map(|n| sign * top * f64::from(n) / 500.0)
                    .collect()
            };
            let kinds = |top: f64| -> Vec<FindingKind> {
                check(&of(quantity, &up_to(top)))
                    .0
                    .iter()
                    .map(|f| f.kind)
                    .collect()
            };
            assert_eq!(kinds(limit), [], "{quantity}");
            assert_eq!(kinds(1.01 * limit), [FindingKind::Impossible], "{quantity}");
        }
    }
}

#[test]
fn missing_values_are_told_with_their_line_and_left_out() {
    let mut values = moving(100);
    values[40..43].fill(f64::NAN);
    values[70] = f64::NAN;
    let (found, bad) = check(&of(Quantity::Acceleration, &values));
    assert_eq!(found.len(), 1);
    assert_eq!(
        (found[0].kind, found[0].severity),
        (FindingKind::DropOut, Severity::Fault)
    );
    assert!(
        found[0]
            .what
            .contains("4 values are missing, the first in line 42, at most 3 in a row"),
        "{}",
        found[0].what
    );
    assert_eq!(bad, [40..43, 70..71]);
    assert_eq!(
        check(&of(Quantity::Acceleration, &moving(100))),
        (vec![], vec![])
    );
}

#[test]
fn a_motion_jumps_if_it_leaves_both_neighbours_by_six_large_steps() {
    // Steps of 1/128 mm, in turn up and up and down: their 99 % quantile is 2⁻⁷·(1 to 2^⅛).
    let step = 1.0 / 128.0;
    let signal = |jump: f64, back: f64| -> Vec<f64> {
        let mut values: Vec<f64> = (0..1000)
            .map(|n| step * [0.0, 1.0, 2.0, 1.0][n % 4])
            .collect();
        values[500] += jump;
        values[501] += jump - back;
        values
    };
    let found = |quantity, jump, back| spikes(&of(quantity, &signal(jump, back)));
    for quantity in [Quantity::Position, Quantity::Speed] {
        assert_eq!(found(quantity, 9.0 * step, 9.0 * step), [500]);
        assert_eq!(found(quantity, -9.0 * step, -9.0 * step), [500]);
        assert!(found(quantity, 4.5 * step, 4.5 * step).is_empty());
        // A step that stays, and one that comes back only in part.
        assert!(found(quantity, 9.0 * step, 0.0).is_empty());
        assert!(found(quantity, 20.0 * step, 4.0 * step).is_empty());
    }
    assert!(found(Quantity::Acceleration, 1.0, 1.0).is_empty());
    // A motion that jumps on has no spike.
    let stairs: Vec<f64> = (0..300).map(|n| if n < 150 { 0.0 } else { 1.0 }).collect();
    assert!(spikes(&of(Quantity::Position, &stairs)).is_empty());
    let (told, bad) = check(&of(Quantity::Position, &signal(9.0 * step, 9.0 * step)));
    assert!(
        told[0].what.contains("1 values far from both neighbours"),
        "{}",
        told[0].what
    );
    assert!(told[0].what.contains("at 0.500 s"), "{}", told[0].what);
    assert_eq!(
        (told[0].kind, bad),
        (FindingKind::Impossible, vec![500..501])
    );
}

#[test]
fn a_force_jumps_if_it_leaves_what_is_quiet_by_five_newtons() {
    let with = |change: &dyn Fn(&mut [f64])| {
        let mut values: Vec<f64> = (0..2000)
            .map(|n| 0.01 * [0.0, 1.0, 3.0, 2.0][n % 4])
            .collect();
        change(&mut values);
        force_spikes(&of(Quantity::Force, &values))
    };
    assert!(with(&|_| ()).is_empty());
    assert_eq!(with(&|x| x[800] = 5.1), [800]);
    assert_eq!(with(&|x| x[800] = -5.1), [800]);
    assert!(with(&|x| x[800] = 4.9).is_empty());
    assert!(with(&|x| x[800] = -4.9).is_empty());
    // Two at once ring, and so does what is not quiet within four samples.
    assert!(with(&|x| x[800..802].fill(9.0)).is_empty());
    assert!(
        with(&|x| {
            x[800] = 9.0;
            x[804] += 1.0;
        })
        .is_empty()
    );
    assert!(
        with(&|x| {
            x[800] = 9.0;
            x[796] += 1.0;
        })
        .is_empty()
    );
    assert_eq!(
        with(&|x| {
            x[800] = 9.0;
            x[805] += 1.0;
        }),
        [800]
    );
    assert_eq!(
        with(&|x| {
            x[800] = 9.0;
            x[795] += 1.0;
        }),
        [800]
    );
    // The first and the last samples have no four neighbours.
    assert_eq!(
        with(&|x| {
            x[4] = 9.0;
            x[1995] = 9.0;
        }),
        [4, 1995]
    );
    assert!(
        with(&|x| {
            x[3] = 9.0;
            x[1996] = 9.0;
        })
        .is_empty()
    );
}

#[test]
fn a_force_that_is_never_quiet_must_jump_by_thirty_large_steps() {
    // Steps of 0.5 N: 30 of them, rounded up to an eighth of an octave, are 15 to 16.4 N.
    let with = |top: f64| {
        let mut values: Vec<f64> = (0..2000).map(|n| 0.5 * f64::from(n as u32 % 2)).collect();
        values[800] = top;
        force_spikes(&of(Quantity::Force, &values))
    };
    assert_eq!(with(17.5), [800]);
    assert!(with(14.9).is_empty());
}

#[test]
fn stretches_at_a_value_are_told_with_both_ends() {
    let at = |samples: &[f32]| visits(samples, 1.0);
    assert_eq!(at(&[1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0]), [0..2, 3..4, 5..7]);
    assert!(at(&[0.0, 2.0]).is_empty());
}

/// Noise over many steps, and so many visits to an extreme of so many samples each.
fn cut(top: f64, visits: usize, samples: usize) -> Vec<f64> {
    let mut values = moving(4000);
    for visit in 0..visits {
        let start = 100 + 200 * visit;
        values[start..start + samples].fill(top);
    }
    values
}

#[test]
fn two_visits_of_three_samples_or_one_plateau_of_eight_are_clipping() {
    let found = |visits, samples| clipped(&of(Quantity::Force, &cut(1.0, visits, samples)));
    assert!(found(1, 7).is_empty());
    assert_eq!(found(1, 8), [100..108]);
    assert!(found(2, 1).is_empty());
    assert_eq!(found(2, 2), [100..102, 300..302]);
    assert_eq!(found(3, 1), [100..101, 300..301, 500..501]);
    assert_eq!(
        clipped(&of(Quantity::Acceleration, &cut(-1.0, 2, 2))).len(),
        2
    );
    for quantity in [Quantity::Position, Quantity::Speed, Quantity::Torque] {
        assert!(clipped(&of(quantity, &cut(1.0, 3, 9))).is_empty());
    }
    let (told, bad) = check(&of(Quantity::Force, &cut(1.0, 2, 3)));
    assert_eq!(
        (told[0].kind, bad),
        (FindingKind::Clipping, vec![100..103, 300..303])
    );
    assert!(
        told[0].what.contains("6 samples stand at") && told[0].what.contains("first at 0.100 s")
    );
}

#[test]
fn at_the_stated_range_three_samples_in_a_row_are_clipping() {
    let found = |top: f64, samples: usize, range: [f64; 2]| {
        let mut channel = of(Quantity::Force, &cut(top, 1, samples));
        channel.range = Some(range);
        clipped(&channel).len()
    };
    assert_eq!(found(1.0, 3, [-1.0, 1.0]), 1);
    assert_eq!(found(1.0, 2, [-1.0, 1.0]), 0);
    assert_eq!(found(-1.0, 3, [-1.0, 1.0]), 1);
    // Two thousandths below it is still there.
    assert_eq!(found(0.9985, 3, [-2.0, 1.0]), 1);
    assert_eq!(found(0.9975, 3, [-2.0, 1.0]), 0);
    assert_eq!(found(-0.9985, 3, [-1.0, 2.0]), 1);
    assert_eq!(found(1.0, 3, [-1.0, 2.0]), 0);
}

#[test]
fn an_extreme_near_zero_is_rest() {
    // Never below −0.29 of the top, where it often is; or a little further.
    let rests = |low: f64| {
        let mut values: Vec<f64> = moving(4000).iter().map(|x| x.abs() + 0.1).collect();
        values[50] = 1.0;
        for start in (100..3900).step_by(200) {
            values[start..start + 9].fill(low);
        }
        clipped(&of(Quantity::Force, &values)).len()
    };
    assert_eq!(rests(-0.29), 0);
    assert_eq!(rests(-0.31), 19);
}

#[test]
fn a_run_is_held_from_eight_samples_or_four_milliseconds_on() {
    let held_at = |rate_hz: f64, samples: usize| {
        let mut values = white(5, 20_000, 12);
        for start in [3000, 9000, 15_000] {
            let value = values[start];
            values[start..start + samples].fill(value);
        }
        held(&test_recordings::channel(
            Quantity::Force,
            Axis::Z,
            rate_hz,
            &values,
        ))
    };
    assert!(held_at(1000.0, 7).is_empty());
    assert_eq!(held_at(1000.0, 8), [3000..3008, 9000..9008, 15_000..15_008]);
    assert!(held_at(5000.0, 19).is_empty());
    assert_eq!(held_at(5000.0, 20).len(), 3);
}

#[test]
fn a_motion_is_held_if_it_then_jumps_further_than_it_ever_does() {
    // A slow way in steps of 0.01, halted for 50 samples.
    let with = |jump_before: f64, jump_after: f64, start: usize| {
        let mut values: Vec<f64> = Vec::new();
        let mut x = 0.0;
        for n in 0..4000 {
            x += if n == start {
                jump_before
            } else if n == start + 50 {
                jump_after
            } else if (start..start + 50).contains(&n) {
                0.0
            } else if n % 20 < 10 {
                0.01
            } else {
                -0.01
            };
            values.push(x);
        }
        held(&of(Quantity::Position, &values))
    };
    assert_eq!(with(0.01, 0.05, 1000), [1000..1050]);
    assert_eq!(with(0.05, -0.05, 1000), [1000..1050]);
    assert!(with(0.01, 0.035, 1000).is_empty());
    assert!(with(0.05, 0.035, 1000).is_empty());
    // Where it begins it may rest until it is moved.
    assert!(with(0.0, 0.5, 0).is_empty());
}

#[test]
fn the_more_a_sensor_repeats_itself_the_longer_a_run_chance_makes() {
    // In turn: so many pairs of equal values of a hundred around the run.
    let chance = |percent: usize, length: usize| {
        let mut values = Vec::new();
        let mut x = 0.0;
        for n in 0..1000 {
            if n % 100 >= percent {
                x += 1.0;
            }
            values.push(x);
        }
        let channel = of(Quantity::Force, &values);
        let run = Run {
            start: 500,
            length: length as u64,
            value: 0.0,
            jump_before: 1.0,
            jump_after: 1.0,
        };
        is_chance(&channel, &run)
    };
    // 1000·share^(length − 1) > 0.01: of one half up to 16 samples, of none (1/500) up to 2.
    assert!(chance(0, 2) && !chance(0, 3));
    assert!(chance(50, 16) && !chance(50, 17));
    assert!(chance(20, 7) && !chance(20, 8));
    assert!(chance(90, 100));
    let short = of(Quantity::Force, &[1.0, 2.0]);
    let run = Run {
        start: 0,
        length: 900,
        value: 1.0,
        jump_before: 0.0,
        jump_after: 0.0,
    };
    assert!(!is_chance(&short, &run));
}

#[test]
fn an_extreme_with_exactly_as_many_rivals_as_are_looked_at_is_judged() {
    let mut samples = vec![1.0_f32; 3];
    samples.extend((0..256_u16).map(|n| 0.6 + 0.001 * f32::from(n)));
    assert!(stands_out(&samples, 1.0));
}
