//! Exact tables of blocks, and laws that made data follow to the last digit.

use super::*;
use crate::test_recordings::{near, timeline};

/// Timeline of blocks, each of speed (mm/s), load (N) and μ.
fn of(blocks: &[(f64, f64, f64)]) -> Timeline {
    let mut made = timeline(blocks.len() * BLOCK);
    let drag = made.drag_n.as_mut().expect("a drag");
    for (n, (speed_mm_s, load_n, mu)) in blocks.iter().enumerate() {
        let span = n * BLOCK..(n + 1) * BLOCK;
        made.speed_mm_s[span.clone()].fill(*speed_mm_s);
        made.load_n[span.clone()].fill(*load_n);
        drag[span].fill(mu * load_n);
    }
    made
}

#[test]
fn median_spread_speeds_and_load_are_the_order_statistics_of_the_blocks() {
    // μ from 0.30 to 0.80 in an order that is no order, speeds from 40 to 90, loads from 1 to 1.5.
    let blocks: Vec<(f64, f64, f64)> = (0..51)
        .map(|n| {
            let (a, b, c) = ((n * 7) % 51, (n * 11) % 51, (n * 5) % 51);
            (
                40.0 + f64::from(b),
                1.0 + 0.01 * f64::from(c),
                0.3 + 0.01 * f64::from(a),
            )
        })
        .collect();
    let found = friction(&of(&blocks)).expect("enough");
    assert_eq!(found.blocks, 51);
    near(found.mu, 0.55, 1e-9);
    // Places 42 and 8 of 0..=50.
    near(found.spread, 0.5 * (0.72 - 0.38), 1e-9);
    near(found.speeds_mm_s[0], 41.0, 1e-9);
    near(found.speeds_mm_s[1], 89.0, 1e-9);
    near(found.load_n, 1.25, 1e-9);
    assert_eq!(found.stick_slip, 0.0);
}

#[test]
fn ten_blocks_are_enough_and_nine_are_not() {
    assert!(friction(&of(&[(50.0, 1.0, 0.4); 9])).is_none());
    let found = friction(&of(&[(50.0, 1.0, 0.4); 10])).expect("enough");
    assert_eq!((found.blocks, found.law), (10, Law::Coulomb));
    near(found.mu, 0.4, 1e-12);
    let mut without = of(&[(50.0, 1.0, 0.4); 20]);
    without.drag_n = None;
    assert!(friction(&without).is_none());
}

#[test]
fn a_block_counts_if_all_of_it_touches_is_good_slides_and_presses() {
    let count = |spoil: &dyn Fn(&mut Timeline)| {
        let mut made = of(&[(50.0, 1.0, 0.4); 14]);
        spoil(&mut made);
        friction(&made).expect("enough").blocks
    };
    assert_eq!(count(&|_| ()), 14);
    assert_eq!(count(&|t| t.contact[300] = false), 13);
    assert_eq!(count(&|t| t.good[399..=400].fill(false)), 12);
    assert_eq!(count(&|t| t.load_n[300..400].fill(0.19)), 13);
    assert_eq!(count(&|t| t.load_n[300..400].fill(0.21)), 14);
    assert_eq!(count(&|t| t.speed_mm_s[300..400].fill(19.9)), 13);
    assert_eq!(count(&|t| t.speed_mm_s[300..400].fill(20.0)), 14);
    // Sliding, and for a moment too slow to be sure of it.
    assert_eq!(count(&|t| t.speed_mm_s[350] = 10.0), 13);
    assert_eq!(count(&|t| t.speed_mm_s[350] = 10.1), 14);
}

#[test]
fn a_block_counts_if_the_tool_came_its_way_for_two_millimetres() {
    let count = |spoil: &dyn Fn(&mut Timeline)| {
        let mut made = of(&[(50.0, 1.0, 0.4); 14]);
        spoil(&mut made);
        friction(&made).expect("enough").blocks
    };
    let degrees = |angle: f64| [libm::cos(angle.to_radians()), libm::sin(angle.to_radians())];
    // At 50 mm/s, 2 mm take 40 samples.
    let turn_at = |sample: usize, angle: f64| {
        count(&|t| {
            t.heading[sample..]
                .iter_mut()
                .for_each(|heading| *heading = degrees(angle))
        })
    };
    assert_eq!(turn_at(300, 180.0), 13);
    assert_eq!(turn_at(350, 180.0), 13);
    assert_eq!(turn_at(261, 180.0), 12);
    assert_eq!(
        turn_at(260, 180.0),
        13,
        "the way is behind it when the block begins"
    );
    assert_eq!(turn_at(300, 61.0), 13);
    assert_eq!(turn_at(300, 59.0), 14);
    // So far it goes in touch, too.
    assert_eq!(count(&|t| t.contact[399] = false), 12);
    // Circles of 10 mm turn by 11.5° over the way, those of 1.5 mm by 76°.
    let circle = |radius_mm: f64| {
        let mut made = of(&[(50.0, 1.0, 0.4); 14]);
        for (n, heading) in made.heading.iter_mut().enumerate() {
            *heading = degrees((0.05 * n as f64 / radius_mm).to_degrees());
        }
        friction(&made).map(|friction| friction.blocks)
    };
    assert_eq!(circle(10.0), Some(14));
    assert_eq!(circle(1.5), None);
}

#[test]
fn a_block_sticks_and_slips_if_it_nearly_stands_and_then_runs_away() {
    let part = |slowest: f64, fastest: f64| {
        let mut made = of(&[(50.0, 1.0, 0.4); 20]);
        for block in 0..5 {
            made.speed_mm_s[block * BLOCK] = slowest;
            made.speed_mm_s[block * BLOCK + 1] = fastest;
            // The mean stays 50.
            made.speed_mm_s[block * BLOCK + 2] = 150.0 - slowest - fastest;
        }
        friction(&made).expect("enough").stick_slip
    };
    near(part(4.9, 101.0), 0.25, 1e-12);
    near(part(4.9, 96.0), 0.0, 1e-12);
    near(part(5.1, 101.0), 0.0, 1e-12);
    let mut slow = of(&[(50.0, 1.0, 0.4); 20]);
    slow.speed_mm_s[..500].fill(19.0);
    slow.speed_mm_s[500] = 1.0;
    slow.speed_mm_s[501] = 110.0;
    near(
        friction(&slow).expect("enough").stick_slip,
        1.0 / 15.0,
        1e-12,
    );
}

/// Speeds of 25 to 244 mm/s, loads of 0.4 to 2.9 N.
fn blocks(mu: impl Fn(f64, f64) -> f64) -> Vec<Block> {
    let block = |n: u32| {
        let (speed_mm_s, load_n) = (
            25.0 + 1.1 * f64::from(n),
            0.4 + 2.5 * (f64::from(n) * 0.618).fract(),
        );
        Block {
            speed_mm_s,
            load_n,
            mu: mu(speed_mm_s, load_n),
        }
    };
    (0..200).map(block).collect()
}

#[test]
fn a_power_law_comes_back_to_the_last_digit() {
    for (c, v, f) in [(0.5, -0.2, -0.1), (0.3, 0.15, -0.3), (0.8, 0.0, 0.2)] {
        let exact = |speed: f64, load: f64| c * libm::pow(speed / 100.0, v) * libm::pow(load, f);
        let mut made = blocks(exact);
        let middle = median(made.iter().map(|b| b.mu));
        let Law::Power {
            mu,
            of_speed,
            of_load,
        } = law(&made, middle)
        else {
            panic!("{:?}", law(&made, middle));
        };
        near(mu, c, 1e-9);
        near(of_speed, v, 1e-9);
        near(of_load, f, 1e-9);
        let before = power_law(&made);
        // A block that is pushed has no logarithm.
        made[3].mu = -0.2;
        made[90].mu = 0.0;
        let (Some(Law::Power { mu: a, .. }), Some(Law::Power { mu: b, .. })) =
            (before, power_law(&made))
        else {
            panic!("no law");
        };
        near(a, b, 1e-9);
    }
}

#[test]
fn a_stribeck_law_of_each_speed_scale_of_the_row_comes_back() {
    for step in 2..12 {
        let scale = 5.0 * libm::pow(1.5, f64::from(step));
        let exact = |speed: f64, _: f64| 0.3 + 0.4 * libm::exp(-speed / scale);
        let Some(Law::Stribeck {
            sliding,
            rest,
            v_s_mm_s,
        }) = stribeck(&blocks(exact))
        else {
            panic!("no law");
        };
        near(v_s_mm_s, scale, 1e-6);
        near(sliding, 0.3, 1e-6);
        near(rest, 0.7, 1e-5);
    }
    let made = blocks(|speed, _| 0.3 + 0.4 * libm::exp(-speed / 56.953_125));
    assert!(
        matches!(law(&made, 0.35), Law::Stribeck { v_s_mm_s, .. } if v_s_mm_s > 56.0 && v_s_mm_s < 58.0)
    );
}

#[test]
fn friction_does_not_push_however_well_that_would_fit() {
    // Falls through zero between the recorded speeds: the best scales have a fast side below it.
    let falls = blocks(|speed, _| -0.05 + 0.6 * libm::exp(-speed / 86.0));
    if let Some(Law::Stribeck { sliding, rest, .. }) = stribeck(&falls) {
        assert!(sliding > 0.0 && rest >= 0.0);
    }
    let rises = blocks(|speed, _| 0.5 - 0.7 * libm::exp(-speed / 86.0));
    if let Some(Law::Stribeck { sliding, rest, .. }) = stribeck(&rises) {
        assert!(sliding > 0.0 && rest >= 0.0, "{sliding} {rest}");
    }
}

#[test]
fn a_law_that_changes_friction_by_less_than_a_twentieth_is_none() {
    // 5 % to 95 % of the speeds: 36 to 233 mm/s, a factor of 6.47; of the loads 0.53 to 2.77 N.
    let of_load = |exponent: f64| law(&blocks(|_, load| 0.5 * libm::pow(load, exponent)), 0.5);
    assert_eq!(of_load(0.028), Law::Coulomb);
    assert_eq!(of_load(-0.028), Law::Coulomb);
    assert!(matches!(of_load(0.033), Law::Power { .. }));
    assert!(matches!(of_load(-0.033), Law::Power { .. }));
    let of_speed = |exponent: f64| {
        law(
            &blocks(|speed, _| 0.5 * libm::pow(speed / 100.0, exponent)),
            0.5,
        )
    };
    assert!(matches!(of_speed(0.029), Law::Power { .. }));
    assert!(matches!(of_speed(-0.029), Law::Power { .. }));
    assert!(!matches!(of_speed(0.025), Law::Power { .. }));
}

#[test]
fn a_law_must_gain_twelve_in_twice_the_log_likelihood() {
    // Noise in turn above and below hardly correlates with load: gain = 200·ln(1 + signal/noise).
    let exact = |load: f64| 0.1 * (libm::log(load) - 0.36);
    let signal = mean(
        &blocks(|_, load| exact(load))
            .iter()
            .map(|b| b.mu * b.mu)
            .collect::<Vec<_>>(),
    );
    let with = |gain: f64| {
        let noise = (signal / (libm::exp(gain / 200.0) - 1.0)).sqrt();
        let mut made = blocks(|_, load| libm::exp(exact(load)));
        for pair in made.chunks_mut(2) {
            pair[0].mu += noise;
            pair[1].mu -= noise;
        }
        law(&made, 1.0)
    };
    assert_eq!(with(8.0), Law::Coulomb);
    assert!(matches!(with(18.0), Law::Power { .. }), "{:?}", with(18.0));
}

#[test]
fn each_law_has_its_value_at_a_speed() {
    let with = |law| Friction {
        mu: 0.7,
        spread: 0.0,
        blocks: 10,
        law,
        speeds_mm_s: [50.0, 200.0],
        load_n: 4.0,
        stick_slip: 0.0,
    };
    let coulomb = with(Law::Coulomb);
    assert_eq!(coulomb.mu_at(50.0), 0.7);
    assert!(!coulomb.depends_on_speed());
    // 0.5·(400/100)^0.5·4^(−0.5) = 0.5·2/2, and a quarter of the speed halves it.
    let power = with(Law::Power {
        mu: 0.5,
        of_speed: 0.5,
        of_load: -0.5,
    });
    near(power.mu_at(400.0), 0.5, 1e-12);
    near(power.mu_at(100.0), 0.25, 1e-12);
    assert!(power.depends_on_speed());
    let stribeck = |rest| {
        with(Law::Stribeck {
            sliding: 0.3,
            rest,
            v_s_mm_s: 50.0,
        })
    };
    near(stribeck(0.8).mu_at(0.0), 0.8, 1e-12);
    near(
        stribeck(0.8).mu_at(50.0),
        0.3 + 0.5 / std::f64::consts::E,
        1e-12,
    );
    // e⁻¹ − e⁻⁴ = 0.3496: a tenth of that is just below a twentieth of 0.7, and 0.101 of it above.
    assert!(!stribeck(0.4).depends_on_speed());
    assert!(stribeck(0.401).depends_on_speed());
    assert!(stribeck(0.199).depends_on_speed());
}

fn kept(mus: &[f64]) -> Vec<usize> {
    let blocks: Vec<Block> = (0..)
        .zip(mus)
        .map(|(n, mu)| Block {
            speed_mm_s: 30.0 + f64::from(n),
            load_n: f64::from(n),
            mu: *mu,
        })
        .collect();
    // In whatever order they come, they are held against their neighbours in speed.
    let turned: Vec<Block> = blocks.iter().rev().copied().collect();
    let kept = typical(&turned);
    kept.iter().map(|block| block.load_n as usize).collect()
}

#[test]
fn a_block_far_from_the_fifteen_nearest_in_speed_is_not_typical() {
    for at in [0, 1, 20, 38, 39] {
        let mut mus = [0.5; 40];
        // Without any spread: 5 % of the median.
        mus[at] = 0.524;
        assert_eq!(kept(&mus).len(), 40, "{at}");
        mus[at] = 0.526;
        assert_eq!(kept(&mus), (0..40).filter(|n| *n != at).collect::<Vec<_>>());
        mus[at] = 0.474;
        assert_eq!(kept(&mus).len(), 39, "{at}");
        // Around 0.5 by 0.02: five times 1.4826·0.02 is 0.148.
        let mut mus: Vec<f64> = (0..40).map(|n| [0.48, 0.5, 0.52][n % 3]).collect();
        mus[at] = 0.645;
        assert_eq!(kept(&mus).len(), 40, "{at}");
        mus[at] = 0.655;
        assert_eq!(kept(&mus).len(), 39, "{at}");
    }
    assert_eq!(kept(&[0.5, 0.5, 0.5, 0.5, 0.9]), [0, 1, 2, 3]);
}

#[test]
fn a_step_between_two_speeds_is_typical_on_both_of_its_sides() {
    // Eight of fifteen are of the block's own side, at the step and nowhere less.
    let mus: Vec<f64> = (0..40).map(|n| if n < 20 { 0.3 } else { 0.6 }).collect();
    assert_eq!(kept(&mus).len(), 40);
}

#[test]
fn a_regression_through_exact_points_is_exact() {
    let rows = [[1.0, 2.0], [1.0, 3.0], [1.0, 7.0]].map(|row| (row, 4.0 - 0.5 * row[1]));
    let [level, slope] = regress(rows.into_iter()).expect("regular");
    near(level, 4.0, 1e-12);
    near(slope, -0.5, 1e-12);
    assert_eq!(regress([([1.0, 2.0], 1.0)].into_iter()), None);
}
