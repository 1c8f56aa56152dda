//! Energy, faults, missed periods, what a surface forgets, and changes of texture.

use super::*;
use asperity_formats::{Adhesion, Drag, Relaxation};
use asperity_runtime::{Exchange, Fixed, Flags, Float};
use asperity_tests::{draw::Draw, texture::random_contact};

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
