//! Each part against its closed form in f64.

use super::*;
use asperity_formats::{Adhesion, Drag, Imprint, Relaxation};
use asperity_runtime::{Fixed, Float};
use asperity_tests::draw::Draw;

/// Straight lines through the points, at every depth, and on beyond the last one.
#[test]
fn a_spring_has_its_shape() {
    fn check<A: RenderArithmetic>() {
        let points = [
            (0.002, 0.000_5),
            (0.006, 0.000_9),
            (0.01, 0.003),
            (0.03, 0.02),
        ];
        let contact = Contact {
            spring: points.to_vec(),
            ..Contact::default()
        };
        let mut hand = Hand::<A>::new(&material(800.0, Some(contact)), &bench(1000.0));
        for step in 0..400 {
            let depth = 1e-4 * f64::from(step);
            let mut line = ((0.0, 0.0), points[0]);
            for pair in points.windows(2) {
                if depth >= pair[0].0 {
                    line = (pair[0], pair[1]);
                }
            }
            let ((from, low), (to, high)) = line;
            let exact = 800.0 * (low + (high - low) * (depth - from) / (to - from));
            let found = hand.press(depth);
            assert!(near(found, exact, 1e-4, 2e-4), "{depth}: {found} {exact}");
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// A ramp and a hold on a standard linear solid: F = kδ + k₁vτ(1 − e^(−t/τ)) while it moves, then
/// the branch decays.
#[test]
fn relaxation_is_exact_over_ten_seconds() {
    fn check<A: RenderArithmetic>() {
        for rate_hz in [500.0, 1000.0, 2000.0] {
            for time_s in [0.02, 0.5, 1.5, 8.0] {
                let contact = Contact {
                    relaxation: Relaxation {
                        stiffness_n_m: 300.0,
                        time_s,
                    },
                    ..Contact::default()
                };
                let texture = material(200.0, Some(contact));
                let mut hand = Hand::<A>::new(&texture, &bench(rate_hz));
                let (speed, ramp_s, tau) = (0.02, 0.25, f64::from(time_s));
                let rate = f64::from(rate_hz);
                hand.press(0.0);
                for n in 1..=(10.0 * rate) as u32 {
                    let t = f64::from(n) / rate;
                    let moved = t.min(ramp_s);
                    let depth = speed * moved;
                    let loaded = 300.0 * speed * tau * (1.0 - (-moved / tau).exp());
                    let branch = loaded * (-(t - moved) / tau).exp();
                    let exact = 200.0 * depth + branch;
                    let found = hand.press(depth);
                    let case = format!("{rate_hz} Hz, τ {time_s} s, at {t} s: {found} {exact}");
                    assert!(near(found, exact, 0.01, 1e-3), "{case}");
                }
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Damping has no jump at touch and no pull at release, and is λ·F_el·v for a steady motion.
#[test]
fn damping_grows_with_the_load() {
    fn check<A: RenderArithmetic>() {
        let contact = Contact {
            damping_s_m: 2.0,
            ..Contact::default()
        };
        let mut hand = Hand::<A>::new(&material(400.0, Some(contact)), &bench(1000.0));
        let speed_m_s = 0.05;
        for n in 0..300 {
            let depth = speed_m_s * (f64::from(n) - 100.0) / 1000.0;
            let output = hand.tick(Sample::at([0.0, 0.0, -depth as f32]));
            let force = f64::from(output.force_n[2].value());
            if n <= 100 {
                assert_eq!(force, 0.0);
            } else if n > 130 {
                let exact = 400.0 * depth * (1.0 + 2.0 * speed_m_s);
                assert!(near(force, exact, 0.01, 1e-4), "{n}: {force} {exact}");
            }
        }
        for n in 0..400 {
            let depth = 0.01 - 0.000_1 * f64::from(n);
            let output = hand.tick(Sample::at([0.0, 0.0, -depth as f32]));
            assert!(output.force_n[2].value() >= 0.0);
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Sand: beyond its yield a share of each millimetre stays; unloading is the spring's; sliding
/// brings fresh sand, and so does the open.
#[test]
fn what_yields_leaves_an_imprint() {
    fn check<A: RenderArithmetic>() {
        let contact = Contact {
            imprint: Imprint {
                yield_m: 5e-4,
                share: 0.8,
                heal: 0.15,
                recovery_s: 0.0,
            },
            ..Contact::default()
        };
        let texture = material(700.0, Some(contact));
        let mut hand = Hand::<A>::new(&texture, &bench(1000.0));
        let imprint = |deepest: f64| 0.8 * (deepest - 5e-4).max(0.0);
        let down = (0..=60).map(|n| 1e-4 * f64::from(n));
        let mut deepest = 0.0_f64;
        for depth in down.clone().chain(down.clone().rev()).chain(down.clone()) {
            deepest = deepest.max(depth);
            let exact = 700.0 * (depth - imprint(deepest)).max(0.0);
            let found = hand.press(depth);
            assert!(near(found, exact, 0.01, 2e-3), "{depth}: {found} {exact}");
        }
        // At rest nothing moves, whatever the noise of a count.
        let mut draw = Draw::new(3);
        let still = hand.press(6e-3);
        for _ in 0..2000 {
            let noise = draw.range(-2.7e-5, 2.7e-5) as f32;
            hand.tick(Sample::at([noise, 0.0, -6e-3]));
        }
        assert!(near(hand.press(6e-3), still, 1e-3, 1e-4));
        // A stroke at another place feels fresh sand, which yields as the first did.
        for n in 0..600 {
            hand.tick(Sample::at([1e-4 * n as f32, 0.0, -4e-3]));
        }
        let along = hand
            .tick(Sample::at([0.06, 0.0, -4e-3]))
            .normal_force_n
            .value();
        let fresh = 700.0 * (4e-3 - imprint(4e-3));
        assert!(near(along.into(), fresh, 0.03, 2e-3), "{along} {fresh}");
        // In the open, twelve millimetres away, nothing is left; on the spot all of it is.
        for moved_m in [0.0_f32, 0.03] {
            let mut hand = Hand::<A>::new(&texture, &bench(1000.0));
            for n in 0..=60 {
                hand.press(1e-4 * f64::from(n));
            }
            for n in 0..400 {
                hand.tick(Sample::at([moved_m * n as f32 / 400.0, 0.0, 1e-3]));
            }
            let mut load = 0.0;
            for n in 0..=30 {
                let z = -1e-4 * n as f32;
                load = hand
                    .tick(Sample::at([moved_m, 0.0, z]))
                    .normal_force_n
                    .value();
            }
            let old = if moved_m > 0.0 {
                imprint(3e-3)
            } else {
                imprint(6e-3)
            };
            let exact = 700.0 * (3e-3 - old).max(0.0);
            assert!(
                near(load.into(), exact, 0.01, 3e-3),
                "{moved_m}: {load} {exact}"
            );
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Honey drags more the faster, sand does not; steady friction is what the equation says.
#[test]
fn drag_raises_the_limit_of_friction() {
    fn check<A: RenderArithmetic>() {
        for (viscous, plough) in [(900.0, 0.0), (0.0, 60.0), (400.0, 30.0)] {
            let contact = Contact {
                drag: Drag {
                    viscous_n_s_m2: viscous,
                    plough_n_m: plough,
                },
                ..Contact::default()
            };
            let texture = material(50.0, Some(contact));
            for (speed_mm_s, depth_mm) in [(20.0, 3.0), (80.0, 3.0), (150.0, 6.0)] {
                let mut hand = Hand::<A>::new(&texture, &bench(1000.0));
                let (v, depth) = (speed_mm_s / 1000.0, depth_mm / 1000.0);
                let mut friction = 0.0;
                for n in 0..600 {
                    let x = v * f64::from(n) / 1000.0;
                    let output = hand.tick(Sample::at([x as f32, 0.0, -depth as f32]));
                    friction = output.friction_n.value();
                }
                let drag = (f64::from(viscous) * v + f64::from(plough)) * depth;
                let exact = 0.4 * 50.0 * depth + drag;
                assert!(
                    near(friction.into(), exact, 0.01, 1e-3),
                    "{friction} {exact}"
                );
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// The pull is against a motion outwards, bounded, and nothing where the surface ends.
#[test]
fn adhesion_pulls_at_release_alone() {
    fn check<A: RenderArithmetic>() {
        let contact = Contact {
            adhesion: Adhesion {
                pull_n: 0.3,
                stiffness_n_m: 150.0,
            },
            ..Contact::default()
        };
        let mut hand = Hand::<A>::new(&material(100.0, Some(contact)), &bench(1000.0));
        let mut force = |depth: f64| {
            let output = hand.tick(Sample::at([0.0, 0.0, -depth as f32]));
            f64::from(output.force_n[2].value())
        };
        for n in 0..=100 {
            let depth = 1e-4 * f64::from(n);
            let found = force(depth);
            assert!(near(found, 100.0 * depth, 1e-3, 1e-4), "{depth}: {found}");
        }
        for n in (0..100).rev() {
            let depth = 1e-4 * f64::from(n);
            let pull = (150.0 * (0.01 - depth)).min(0.3).min(150.0 * depth);
            let exact = 100.0 * depth - pull;
            assert!(near(force(depth), exact, 1e-3, 2e-3), "{depth}");
        }
        assert_eq!(force(-1e-5), 0.0);
        assert_eq!(force(0.0), 0.0);
        assert!(near(force(1e-3), 0.1, 1e-3, 1e-4));
    }
    check::<Float>();
    check::<Fixed>();
}
