//! The runtime's wall gives off no more energy than the device absorbs, whatever the device's
//! damping, delay, friction and counts. It is no softer than that requires.

use asperity_experiments::stability::wall::{
    Bench, DAMPINGS_N_S_M, REPORTED, ROUNDING_J, given_j, lowered_walls, ours_j,
};
use asperity_experiments::stability::{Material, contact, row::Verdict};
use asperity_runtime::{Float, Passivity, Wall};

fn silent() -> Material {
    Material::silent(REPORTED.0, REPORTED.1).expect("the built-in texture")
}

#[test]
fn our_wall_is_passive_over_the_sweep_and_the_one_as_given_is_not() {
    let material = silent();
    for delay in 0..=2 {
        let mut active = 0;
        for damping in DAMPINGS_N_S_M {
            let bench = Bench::viscous(damping, delay);
            let energy_j = ours_j(&bench, &material);
            assert!(energy_j <= ROUNDING_J, "{bench:?}: {energy_j} J");
            active += usize::from(given_j(&bench, &material) > ROUNDING_J);
        }
        // 500 N/m need 0.25 N·s/m without delay, 0.75 with 1 tick and 1.25 with 2 ticks.
        assert_eq!(active, [6, 8, 9][delay as usize], "{delay} ticks");
    }
}

#[test]
fn friction_pays_for_counts_and_for_the_hold() {
    let material = silent();
    for delay_ticks in 0..=2 {
        for damping_n_s_m in [0.005, 0.1, 0.5] {
            let bench = Bench {
                damping_n_s_m,
                coulomb_n: 0.26,
                position_step_m: 0.055e-3,
                delay_ticks,
            };
            let energy_j = ours_j(&bench, &material);
            assert!(energy_j <= ROUNDING_J, "{bench:?}: {energy_j} J");
        }
    }
}

#[test]
fn a_wall_is_as_reported_where_theory_allows_and_lowered_by_no_more_than_it_asks() {
    for (damping, delay, stiffness) in [(0.25, 0, 500.0), (0.75, 1, 500.0), (0.1, 2, 40.0)] {
        let bench = Bench::viscous(damping, delay);
        let wall =
            Passivity::<Float>::new(&bench.mechanics(), 3.3, 1000.0).bear(Wall::of(500.0, 0.1));
        assert!(
            (wall.stiffness.value() - stiffness).abs() < 1e-3,
            "{wall:?}"
        );
    }
    let (lowered, slack) = lowered_walls();
    assert!(lowered > 20, "{lowered}");
    assert_eq!(slack, 0, "walls that 5 % more stiffness leaves passive");
}

/// Seven contact laws on 27 devices, a million random strokes in all.
#[test]
#[ignore = "takes two minutes in a release build"]
fn a_million_strokes_get_no_more_out_of_a_law_than_out_of_a_wall() {
    for row in contact::rows_of(1, 5300).unwrap() {
        assert_eq!(row.verdict, Verdict::Pass, "{row}");
    }
}
