//! Crossing from one surface to another turns the step between them into neither motion nor impact.

use crate::scenes::{anywhere, level, on_scene};
use asperity_formats::SceneSurface;
use asperity_runtime::{Flags, Float, Output, Sample, SceneState, scene::HYSTERESIS_M};

/// Two planes a step apart, each on its side of x = 0.
fn step_at_zero(left_m: f32, right_m: f32) -> Vec<SceneSurface> {
    let mut surfaces = anywhere(&[level(left_m), level(right_m)]);
    surfaces[0].to_m[0] = 0.0;
    surfaces[1].from_m[0] = 0.0;
    for surface in &mut surfaces {
        surface.texture = 0;
    }
    surfaces
}

/// Ticks along x at 0.1 m/s from −30 mm on, at heights of the caller's.
fn along(surfaces: &[SceneSurface], height: impl Fn(f32) -> f32) -> Vec<(f32, Output)> {
    on_scene::<Float, _>(surfaces, |scene, renderer| {
        let mut state = SceneState::new(1);
        let tick = |n: usize| {
            let x_m = 1e-4 * n as f32 - 0.03;
            let sample = Sample::at([x_m, 0.0, height(x_m)]);
            (x_m, renderer.tick_scene(scene, &mut state, &sample))
        };
        (0..600).map(tick).collect()
    })
}

/// The stylus does not move towards either surface, so there is neither damping nor an impact.
#[test]
fn a_step_between_two_surfaces_is_no_motion() {
    let outputs = along(&step_at_zero(0.0, 5e-4), |_| -5e-4);
    for (x_m, output) in outputs {
        let depth_m = if x_m > 2.0 * HYSTERESIS_M { 1e-3 } else { 5e-4 };
        if (x_m.abs() > 2.0 * HYSTERESIS_M) && x_m > -0.02 {
            assert!((output.depth_m - depth_m).abs() < 1e-7, "{x_m}");
            // The vibration lies in the plane, and friction too: what is left is the spring.
            let wall_n = 200.0 * depth_m;
            assert!(
                (output.force_n[2] - wall_n).abs() < 1e-4,
                "{x_m}: {output:?}"
            );
        }
        assert!(!output.flags.contains(Flags::TAP_ACTIVE), "{x_m}");
    }
}

#[test]
fn a_surface_that_was_entered_from_the_side_is_no_impact() {
    let outputs = along(&step_at_zero(-0.01, 1e-3), |_| 5e-4);
    let entered = |o: &Output| o.flags.contains(Flags::CONTACT);
    assert!(outputs.iter().any(|(_, o)| entered(o)));
    assert!(
        outputs
            .iter()
            .all(|(_, o)| !o.flags.contains(Flags::TAP_STARTED))
    );
}

/// The speed of an impact goes on over the border: 0.1 m/s downwards, over steps up and down.
#[test]
fn a_descent_over_a_border_taps_with_its_own_speed() {
    let tap = |left_m: f32, right_m: f32| {
        let down = |x_m: f32| 2.5e-4 - x_m + right_m;
        let outputs = along(&step_at_zero(left_m, right_m), down);
        let taps = |o: &&(f32, Output)| o.1.flags.contains(Flags::TAP_STARTED);
        assert_eq!(outputs.iter().filter(taps).count(), 1);
        outputs
            .iter()
            .map(|(_, o)| o.tap_n.abs())
            .fold(0.0, f32::max)
    };
    let flat = tap(0.0, 0.0);
    assert!(flat > 0.01, "{flat}");
    for (left_m, right_m) in [(-2e-3, 0.0), (0.0, 1e-4), (-3e-3, 1e-3)] {
        let stepped = tap(left_m, right_m);
        assert!((stepped / flat - 1.0).abs() < 0.01, "{stepped} {flat}");
    }
}
