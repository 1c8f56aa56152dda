//! The laws of materials that give way: closed forms in f64, energy, missed periods, changes of texture.

use asperity_formats::{Adhesion, Asset, Drag, Imprint, Relaxation};
use asperity_runtime::{
    Config, Exchange, Fixed, Flags, Float, Output, RenderArithmetic, Renderer, Sample, State,
    arithmetic::Scalar as _,
};
use asperity_tests::{
    draw::Draw,
    texture::{Contact, HostSlot, Texture, TextureKind, random, random_contact},
};

/// A silent texture of a stiffness without taps.
fn material(stiffness_n_m: f32, contact: Option<Contact>) -> Texture {
    let mut texture = random(1, TextureKind::nyquist(4));
    texture.traces.clear();
    for vertex in &mut texture.vertices {
        vertex.sigma_m_s2 = 0.0;
    }
    texture.mu = 0.4;
    texture.coupling.stiffness_n_m = stiffness_n_m;
    texture.coupling.damping_n_s_m = 0.0;
    texture.contact = contact;
    texture
}

/// A device that absorbs anything, so that nothing is lowered.
fn bench(rate_hz: f32) -> Config {
    let mut config = Config {
        servo_rate_hz: rate_hz,
        ..Config::default()
    };
    config.limits.peak_n = 100.0;
    config.limits.slew_n_s = 1e6;
    config.mechanics.damping_n_s_m = 1000.0;
    config.mechanics.coulomb_n = 100.0;
    config
}

/// A texture in the hand of a test.
struct Hand<A: RenderArithmetic> {
    renderer: Renderer<A>,
    slot: Box<HostSlot<A>>,
    state: State<A>,
}

impl<A: RenderArithmetic> Hand<A> {
    fn new(texture: &Texture, config: &Config) -> Self {
        let mut texture = texture.clone();
        texture.sample_rate_hz = config.servo_rate_hz;
        let mut slot = Box::new(HostSlot::new());
        let bytes = texture.encode();
        let asset = Asset::parse(&bytes).unwrap();
        slot.load(&asset, config.servo_rate_hz).unwrap();
        Self {
            renderer: Renderer::prepare(config).unwrap(),
            slot,
            state: State::new(1),
        }
    }

    fn tick(&mut self, sample: Sample) -> Output<A> {
        self.renderer
            .tick(&self.slot, &mut self.state, &Sample::of(&sample))
    }

    /// Presses to a depth, m, and returns the load, N.
    fn press(&mut self, depth_m: f64) -> f64 {
        let output = self.tick(Sample::at([0.0, 0.0, -depth_m as f32]));
        output.normal_force_n.value().into()
    }
}

fn near(found: f64, exact: f64, share: f64, least: f64) -> bool {
    (found - exact).abs() <= share * exact.abs() + least
}

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

/// Two missed periods equal two periods of the same motion.
#[test]
fn missed_periods_are_made_up_for() {
    fn check<A: RenderArithmetic>() {
        let mut draw = Draw::new(11);
        for _ in 0..20 {
            let mut contact = random_contact(&mut draw);
            contact.damping_s_m = 0.0;
            contact.drag = Drag::default();
            let texture = material(300.0, Some(contact));
            let (mut a, mut b) = (
                Hand::<A>::new(&texture, &bench(1000.0)),
                Hand::<A>::new(&texture, &bench(1000.0)),
            );
            let z = |step: u32| -0.004 * (f64::from(step) * 0.012).sin();
            for step in 0..500_u32 {
                let (from, to) = (z(step.saturating_sub(1)), z(step));
                let mut last = 0.0;
                for third in 1..=3 {
                    let at = from + (to - from) * f64::from(third) / 3.0;
                    last = f64::from(
                        a.tick(Sample::at([0.0, 0.0, at as f32]))
                            .normal_force_n
                            .value(),
                    );
                }
                let sample = Sample {
                    position_m: [0.0, 0.0, to as f32],
                    elapsed_ticks: if step == 0 { 1 } else { 3 },
                };
                let found = f64::from(b.tick(sample).normal_force_n.value());
                assert!(near(found, last, 1e-3, 1.5e-3), "{step}: {found} {last}");
            }
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// In the open, and after a fault, every number goes to zero, exactly: a later press is the first.
#[test]
fn a_surface_forgets() {
    fn check<A: RenderArithmetic>() {
        let mut draw = Draw::new(17);
        for _ in 0..20 {
            let mut contact = random_contact(&mut draw);
            contact.imprint.recovery_s = if contact.imprint.share > 0.0 {
                0.4
            } else {
                0.0
            };
            let texture = material(300.0, Some(contact));
            let mut hand = Hand::<A>::new(&texture, &bench(1000.0));
            let press = |hand: &mut Hand<A>| -> Vec<u32> {
                let depths = (0..200).map(|n| 5e-3 * (f64::from(n) * 0.0157).sin());
                depths
                    .map(|depth| hand.press(depth).to_bits() as u32)
                    .collect()
            };
            hand.press(-1e-3);
            let first = press(&mut hand);
            for _ in 0..20_000 {
                hand.press(-1e-3);
            }
            assert_eq!(press(&mut hand), first, "after twenty seconds");
            for _ in 0..50 {
                hand.tick(Sample::STALE);
            }
            for _ in 0..300 {
                hand.press(-1e-3);
            }
            assert_eq!(press(&mut hand), first, "after a fault");
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// From one material to another in contact, no step of the force is larger than the change of all
/// of it times the share of a tick.
#[test]
fn a_change_of_texture_mixes_the_forces() {
    let mut draw = Draw::new(23);
    for round in 0..30 {
        let mut laws = [(); 2].map(|()| {
            let mut contact = random_contact(&mut draw);
            contact.relaxation = Relaxation::default();
            material(draw.range(100.0, 500.0) as f32, Some(contact))
        });
        if round % 3 == 0 {
            laws[round / 3 % 2].contact = None;
        }
        let config = Config::default();
        let renderer = Renderer::new(&config).unwrap();
        let mut slots = [(); 2].map(|()| Box::new(HostSlot::<Float>::new()));
        let [first, second] = &mut slots;
        let bytes = laws[0].encode();
        first.load(&Asset::parse(&bytes).unwrap(), 1000.0).unwrap();
        let mut exchange = Exchange::new();
        let (mut preparer, mut player) = exchange.split(first, [second.as_mut()], 1);
        let depth_m = draw.range(1e-3, 4e-3) as f32;
        let rest = |player: &mut _, ticks: u32| {
            let mut forces = Vec::new();
            for _ in 0..ticks {
                let output = renderer.tick_player(player, &Sample::at([0.0, 0.0, -depth_m]));
                forces.push((output.force_n[2], output.normal_force_n));
            }
            forces
        };
        let before = *rest(&mut player, 400).last().unwrap();
        let bytes = laws[1].encode();
        preparer
            .prepare(&Asset::parse(&bytes).unwrap(), 1000.0)
            .unwrap();
        let way = rest(&mut player, 400);
        let after = *way.last().unwrap();
        let fraction = 1.0 - (-1.0_f32 / 5.0).exp();
        let mut last = before;
        for (tick, &now) in way.iter().enumerate() {
            for (was, is, from, to) in [
                (last.0, now.0, before.0, after.0),
                (last.1, now.1, before.1, after.1),
            ] {
                let most = 1.5 * fraction * (to - from).abs() + 2e-3;
                assert!(
                    (is - was).abs() <= most,
                    "{round}, {tick}: {was} {is}, {from} to {to}"
                );
                let (low, high) = (from.min(to) - 2e-3, from.max(to) + 2e-3);
                assert!(
                    (low..=high).contains(&is),
                    "{round}, {tick}: {is}, {from} to {to}"
                );
            }
            last = now;
        }
    }
}

/// What a hand gets out of a closed path, J, less than nothing but for what a sampled spring may give;
/// the device's own damping absorbs more than that.
#[test]
fn no_law_gives_off_energy() {
    let mut draw = Draw::new(31);
    let mut config = Config::default();
    // Without the lead of the limiter.
    config.limits.peak_n = 100.0;
    config.limits.slew_n_s = 1e6;
    for round in 0..200 {
        let texture = material(
            draw.range(50.0, 900.0) as f32,
            Some(random_contact(&mut draw)),
        );
        let mut hand = Hand::<Float>::new(&texture, &config);
        let wave = |draw: &mut Draw, amplitude: f64, high_hz: f64| {
            let (hz, phase) = (draw.range(0.3, high_hz), draw.range(0.0, 6.3));
            let offset = amplitude * phase.sin();
            move |t: f64| amplitude * (std::f64::consts::TAU * hz * t + phase).sin() - offset
        };
        let x = [wave(&mut draw, 0.01, 3.0), wave(&mut draw, 0.002, 8.0)];
        let z = [wave(&mut draw, 0.004, 2.0), wave(&mut draw, 0.001, 8.0)];
        let at = |t: f64| {
            // From rest in the open and back.
            let envelope = (std::f64::consts::PI * t / 4.0).sin().min(1.0);
            let height = 1e-3 + envelope * (z[0](t) + z[1](t) - 3e-3);
            [envelope * (x[0](t) + x[1](t)), height]
        };
        let (mut given, mut absorbed) = (0.0, 0.0);
        let mut force = [0.0_f64; 2];
        let mut last = at(0.0);
        for n in 1..=4000 {
            let now = at(f64::from(n) / 1000.0);
            let moved = [now[0] - last[0], now[1] - last[1]];
            // The force of a tick is held while the hand moves on.
            given += force[0] * moved[0] + force[1] * moved[1];
            let square = moved[0] * moved[0] + moved[1] * moved[1];
            let mechanics = &config.mechanics;
            absorbed += f64::from(mechanics.damping_n_s_m) * square * 1000.0
                + f64::from(mechanics.coulomb_n) * square.sqrt();
            let output = hand.tick(Sample::at([now[0] as f32, 0.0, now[1] as f32]));
            force = [output.force_n[0], output.force_n[2]].map(f64::from);
            last = now;
        }
        assert!(
            given < absorbed,
            "{round}: {given} J of {absorbed}: {:?}",
            texture.contact
        );
    }
}

/// The default Touch renders what it can bear, and lowers the rest in a fixed order.
#[test]
fn a_device_lowers_what_it_cannot_absorb() {
    let contact = Contact {
        damping_s_m: 3.0,
        relaxation: Relaxation {
            stiffness_n_m: 400.0,
            time_s: 0.5,
        },
        adhesion: Adhesion {
            pull_n: 0.3,
            stiffness_n_m: 400.0,
        },
        ..Contact::default()
    };
    let bytes = material(400.0, Some(contact)).encode();
    let asset = Asset::parse(&bytes).unwrap();
    let law = asset.contact().unwrap();
    let touch = Renderer::new(&Config::default()).unwrap();
    let lowered = touch.contact_law(asset.coupling(), law);
    assert_eq!(lowered.wall.stiffness.value(), 400.0);
    assert_eq!(lowered.relaxing.value(), 400.0);
    let left = 922.0 - 800.0;
    assert!((lowered.sticking.value() - left).abs() < 1.0, "{lowered:?}");
    assert!(lowered.damping.value() < 1e-3);
    let free = Renderer::new(&bench(1000.0)).unwrap();
    let whole = free.contact_law(asset.coupling(), law);
    assert_eq!(whole.sticking.value(), 400.0);
    assert_eq!(whole.damping.value(), 3.0);
}

/// NaN, gaps and jumps: finite, within the limits, and silent in the safe state.
#[test]
fn faults_are_handled_as_on_a_wall() {
    let mut draw = Draw::new(41);
    for _ in 0..40 {
        let texture = material(300.0, Some(random_contact(&mut draw)));
        let config = Config::default();
        let mut hand = Hand::<Float>::new(&texture, &config);
        let mut last = [0.0_f32; 3];
        for n in 0..3000 {
            let sample = match draw.below(12) {
                0 => Sample::STALE,
                1 => Sample::at([f32::NAN, 0.0, 0.0]),
                2 => Sample {
                    position_m: [0.0, 0.0, -draw.range(0.0, 0.9) as f32],
                    elapsed_ticks: draw.below(6) as u32,
                },
                _ => Sample::at([
                    (n as f32 * 0.01).sin() * 0.02,
                    0.0,
                    -draw.range(0.0, 0.01) as f32,
                ]),
            };
            let output = hand.tick(sample);
            let size = |v: [f32; 3]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
            assert!(size(output.force_n) <= config.limits.peak_n * 1.000_1);
            let change: [f32; 3] = std::array::from_fn(|axis| output.force_n[axis] - last[axis]);
            assert!(size(change) <= config.limits.slew_n_s / 1000.0 * 1.001);
            assert!(output.normal_force_n >= 0.0 && output.friction_n.is_finite());
            assert!(!output.flags.contains(Flags::VIB_CLAMPED));
            last = output.force_n;
        }
    }
}
