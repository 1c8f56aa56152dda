//! Stages that see motion by themselves, in both arithmetics: contact, gate, direction, impact.

use asperity_formats::Asset;
use asperity_runtime::{
    Config, Fixed, Flags, Float, RenderArithmetic, SafetyConfig, Sample, Solid,
    quantity::{Quantity, StoredVector, Vector, unit::Metre},
    stage::{
        contact::DistanceField,
        sample_gate::{Gate, GateState},
        tap::{TapState, impact::Detector},
        velocity::{Velocity, VelocityEstimator, VelocityState},
    },
};
use asperity_tests::{
    draw::Draw,
    texture::{HostSlot, TextureKind, random},
};

fn solids() -> [Solid; 4] {
    [
        Solid::Plane {
            point_m: [0.01, -0.02, 0.03],
            normal: [0.3, -0.4, 2.0],
        },
        Solid::Plane {
            point_m: [-0.1, 0.2, 0.1],
            normal: [-1.0, 0.5, 0.25],
        },
        Solid::Sphere {
            center_m: [0.01, 0.02, -0.03],
            radius_m: 0.02,
        },
        Solid::Box {
            center_m: [-0.01, 0.02, 0.01],
            half_extents_m: [0.01, 0.02, 0.03],
        },
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Signed distance, f64.
fn distance(solid: &Solid, at: [f64; 3]) -> f64 {
    let from = |c: [f32; 3]| [0, 1, 2].map(|i| at[i] - f64::from(c[i]));
    match *solid {
        Solid::Plane { point_m, normal } => {
            let normal = normal.map(f64::from);
            dot(from(point_m), normal) / dot(normal, normal).sqrt()
        }
        Solid::Sphere { center_m, radius_m } => {
            let r = from(center_m);
            dot(r, r).sqrt() - f64::from(radius_m)
        }
        Solid::Box {
            center_m,
            half_extents_m,
        } => {
            let r = from(center_m);
            let q = [0, 1, 2].map(|i| r[i].abs() - f64::from(half_extents_m[i]));
            let out = q.map(|x| x.max(0.0));
            dot(out, out).sqrt() + q[0].max(q[1]).max(q[2]).min(0.0)
        }
    }
}

/// The normal is where the distance grows fastest, by as much as the motion.
#[test]
fn distances_are_exact_and_normals_are_their_slopes() {
    fn check<A: RenderArithmetic>() {
        let mut draw = Draw::new(1);
        for solid in solids() {
            let field = DistanceField::<A>::new(&solid);
            for _ in 0..2000 {
                let at = [0; 3].map(|_| draw.range(-0.06, 0.06) as f32);
                let contact = field.step(Vector::of(at));
                let wide = at.map(f64::from);
                let exact = distance(&solid, wide);
                let found = f64::from(contact.distance.value());
                assert!(
                    (found - exact).abs() < 6e-8,
                    "{solid:?} {at:?}: {found} {exact}"
                );
                let depth = f64::from(contact.depth().value());
                assert!((depth - (-exact).max(0.0)).abs() < 6e-8);
                let normal = contact.normal.values().map(f64::from);
                let step = 1e-6;
                let slope = [0, 1, 2].map(|axis| {
                    let (mut a, mut b) = (wide, wide);
                    a[axis] -= step;
                    b[axis] += step;
                    (distance(&solid, b) - distance(&solid, a)) / (2.0 * step)
                });
                // Between two faces that are equally near, the slope is of neither.
                let clear = dot(slope, slope) > 0.999;
                for (n, s) in normal.iter().zip(slope) {
                    assert!(
                        (n - s).abs() < 1e-3 || !clear,
                        "{solid:?} {at:?}: {normal:?}"
                    );
                }
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn of_equally_near_faces_the_first_axis_wins() {
    fn check<A: RenderArithmetic>() {
        let cube = Solid::Box {
            center_m: [0.0; 3],
            half_extents_m: [0.5; 3],
        };
        let field = DistanceField::<A>::new(&cube);
        for (at, normal) in [
            ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ([-0.25, 0.25, 0.25], [-1.0, 0.0, 0.0]),
            ([0.125, -0.25, 0.25], [0.0, -1.0, 0.0]),
            ([0.125, 0.125, -0.25], [0.0, 0.0, -1.0]),
            ([0.25, 0.125, 0.25], [1.0, 0.0, 0.0]),
            ([0.5, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ([0.0, -0.5, 0.25], [0.0, -1.0, 0.0]),
        ] {
            let contact = field.step(Vector::of(at));
            assert_eq!(contact.normal.values(), normal, "{at:?}");
        }
        let ball = Solid::Sphere {
            center_m: [0.25, 0.5, -0.25],
            radius_m: 0.125,
        };
        let centre = DistanceField::<A>::new(&ball).step(Vector::of([0.25, 0.5, -0.25]));
        assert_eq!(centre.normal.values(), [0.0, 0.0, 1.0]);
        assert_eq!(centre.distance.value(), -0.125);
    }
    check::<Float>();
    check::<Fixed>();
}

/// Every count of bad samples and of missed periods, with every number of held ones.
#[test]
fn a_gate_holds_exactly_as_many_bad_samples_as_it_is_told() {
    fn check<A: RenderArithmetic>() {
        let at = |x: f32| Sample::<A>::of(&Sample::at([x, 0.0, 0.0]));
        for hold_ticks in 0..=2 {
            let config = SafetyConfig {
                hold_ticks,
                ramp_s: 0.004,
                reach_m: 1.0,
            };
            let gate = Gate::<A>::new(&config, 1000.0);
            for bad in 0..6 {
                for missed in 0..6 {
                    let mut state = GateState::new();
                    gate.step(&mut state, &at(0.25));
                    let mut held = 0;
                    for n in 1..=bad {
                        let gated = gate.step(&mut state, &Sample::STALE);
                        let is_held = gated.flags.contains(Flags::HELD_SAMPLE);
                        held += u32::from(is_held);
                        assert_eq!(is_held, n <= hold_ticks);
                        assert_eq!(gated.flags.contains(Flags::SAFE_STATE), n > hold_ticks);
                        assert_eq!(gated.position.values(), [0.25, 0.0, 0.0]);
                        assert_eq!((gated.motion.values(), gated.elapsed_ticks), ([0.0; 3], 1));
                        assert_eq!(gated.gain.value(), if is_held { 1.0 } else { 0.0 });
                    }
                    let mut late = at(0.5);
                    late.elapsed_ticks = missed + 1;
                    let gated = gate.step(&mut state, &late);
                    assert_eq!(gated.position.values(), [0.5, 0.0, 0.0]);
                    let case = (hold_ticks, bad, missed);
                    let (restarts, faults) = (bad > hold_ticks, missed > hold_ticks);
                    let moved = if restarts || faults { 0.0 } else { 0.25 };
                    assert_eq!(gated.motion.values(), [moved, 0.0, 0.0], "{case:?}");
                    let elapsed = if moved > 0.0 { missed + 1 } else { 1 };
                    assert_eq!(gated.elapsed_ticks, elapsed, "{case:?}");
                    let safe = faults && !restarts;
                    assert_eq!(gated.flags.contains(Flags::SAFE_STATE), safe, "{case:?}");
                    let gain = match (restarts, safe) {
                        (true, _) => 0.25,
                        (_, true) => 0.0,
                        _ => 1.0,
                    };
                    assert_eq!(gated.gain.value(), gain, "{case:?}");
                    assert_eq!(held, bad.min(hold_ticks));
                }
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn a_ramp_shorter_than_a_tick_lets_all_of_the_force_through_at_once() {
    let config = SafetyConfig {
        hold_ticks: 0,
        ramp_s: 0.0,
        reach_m: 1.0,
    };
    let gate = Gate::<Float>::new(&config, 1000.0);
    let mut state = GateState::new();
    for sample in [Sample::at([0.0; 3]), Sample::STALE, Sample::at([0.0; 3])] {
        gate.step(&mut state, &sample);
    }
    let gated = gate.step(&mut state, &Sample::at([0.0; 3]));
    assert_eq!((gated.gain.value(), gated.flags), (1.0, Flags::default()));
}

#[test]
fn the_direction_of_motion_is_kept_below_a_tenth_of_a_millimetre_a_second() {
    fn check<A: RenderArithmetic>() {
        let normal = Vector::of([0.0, 0.0, 1.0]);
        let slide = |world: [f32; 3]| {
            let velocity = Velocity::<A> {
                world: Vector::of(world),
                outward: Quantity::ZERO,
            };
            let mut direction = StoredVector::from(Vector::of([1.0, 0.0, 0.0]));
            let speed = velocity.slide(normal, &mut direction).value();
            (speed, direction.get().values())
        };
        for (world, speed, direction) in [
            ([0.0, 0.9e-4, 5.0], 0.9e-4, [1.0, 0.0, 0.0]),
            ([0.0, 1.1e-4, 5.0], 1.1e-4, [0.0, 1.0, 0.0]),
            ([0.0, -0.25, 1.0], 0.25, [0.0, -1.0, 0.0]),
            ([-0.3, 0.4, -1.0], 0.5, [-0.6, 0.8, 0.0]),
            ([0.0, 0.0, 1.0], 0.0, [1.0, 0.0, 0.0]),
        ] {
            let (found_speed, found) = slide(world);
            assert!(
                (found_speed - speed).abs() < 1e-6,
                "{world:?}: {found_speed}"
            );
            for (found, wanted) in found.iter().zip(direction) {
                // Speeds have steps of 0.06 µm/s in fixed point.
                assert!((found - wanted).abs() < 2e-3, "{world:?}: {found} {wanted}");
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// An impact has a least speed; the detector arms a hair beyond the configured distance, and nowhere nearer.
#[test]
fn an_impact_is_as_fast_and_comes_from_as_far_as_the_configuration_says() {
    fn check<A: RenderArithmetic>() {
        let bytes = random(1, TextureKind::nyquist(4)).encode();
        let mut slot = Box::new(HostSlot::<A>::new());
        slot.load(&Asset::parse(&bytes).unwrap(), 1000.0).unwrap();
        let mut config = Config::default().tap;
        (config.min_speed_m_s, config.rearm_m) = (0.125, 1.0 / 1024.0);
        let detector = Detector::<A>::new(&config, 1000.0);
        // From a place above the surface down at a speed, until well inside.
        let taps = |speed_m_s: f32, from_m: f32, first_m: f32| {
            let mut state = TapState::<A>::IDLE;
            state.restart(Quantity::of(first_m));
            let mut taps = 0;
            for n in 0..40 {
                let at = from_m - speed_m_s * 1e-3 * n as f32;
                let at = if at < -0.01 { -0.01 } else { at };
                let tap = detector.step(&mut state, slot.taps(), Quantity::of(at));
                taps += u32::from(tap.flags.contains(Flags::TAP_STARTED));
                assert_eq!(
                    state.distance().value(),
                    Quantity::<A, Metre>::of(at).value()
                );
            }
            taps
        };
        assert_eq!(taps(0.13, 0.004, 0.004), 1);
        assert_eq!(taps(0.12, 0.004, 0.004), 0, "too slow");
        // Fast, but never beyond the distance that arms.
        let rearm_m = 1.0 / 1024.0;
        assert_eq!(taps(0.5, rearm_m, 0.004), 0, "not armed yet");
        assert_eq!(taps(0.5, rearm_m + 1e-6, 0.004), 1);
        assert_eq!(taps(0.5, -1e-3, -1e-3), 0, "inside from the start");
    }
    check::<Float>();
    check::<Fixed>();
}

/// Whole multiples of a power of two, so that no product of theirs is a denormal.
fn is_multiple(x: f32, of: f64) -> bool {
    (f64::from(x) / of).fract() == 0.0
}

#[test]
fn normals_and_slow_velocities_stand_on_a_grid() {
    let mut draw = Draw::new(8);
    for solid in solids() {
        let field = DistanceField::<Float>::new(&solid);
        for _ in 0..500 {
            let at = [0; 3].map(|_| draw.range(-0.06, 0.06) as f32);
            for n in field.step(Vector::of(at)).normal.values() {
                assert!(is_multiple(n, 2_f64.powi(-22)), "{n}");
            }
        }
    }
    let estimator = VelocityEstimator::<Float>::new(20.0, 20.0, 1000.0);
    let mut state = VelocityState::REST;
    for n in 0..3000 {
        let moves = if n < 100 { 1.234_567e-4 } else { 0.0 };
        let motion = Vector::of([moves, -0.3 * moves, 1e-7 * moves]);
        let velocity = estimator.step(&mut state, motion, Quantity::of(0.1 * moves), 1);
        let [x, y, z] = velocity.world.values();
        for v in [x, y, z, velocity.outward.value()] {
            assert!(
                v.abs() > 1e-5 || is_multiple(v, 2_f64.powi(-36)),
                "{n}: {v:e}"
            );
            assert!(n < 1000 || v.abs() < 2e-9, "{n}: {v:e}");
        }
    }
}

#[test]
fn a_position_next_to_nothing_is_nothing() {
    let gate = Gate::<Float>::new(&Config::default().safety, 1000.0);
    let mut state = GateState::new();
    for _ in 0..3 {
        let gated = gate.step(&mut state, &Sample::at([1e-30, -1e-40, 0.25]));
        assert_eq!(gated.position.values(), [0.0, 0.0, 0.25]);
    }
}
