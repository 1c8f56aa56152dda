//! Friction that depends on speed, through the whole tick: the μ(v) of the asset at steady strokes,
//! in both arithmetics alike; nothing at rest; no energy; little by little from law to law.

use asperity::{
    emit::lower::lower,
    model::{FrictionLaw, LawPoint},
    sources::builtin,
};
use asperity_formats::Asset;
use asperity_runtime::{
    Config, Exchange, Fixed, Float, HostCapacities, RenderArithmetic, Renderer, Sample, State,
    Texture, arithmetic::Scalar as _,
};
use asperity_tests::{draw::Draw, texture::HostSlot};

const RATE_HZ: f32 = 1000.0;
/// Servo period, s.
const TICK_S: f64 = 1e-3;
const DEPTH_M: f64 = 2e-3;
const MU: f64 = 0.4;
/// Position resolution (a count), m.
const COUNT_M: f64 = 0.055e-3;

/// μ(v) of the surfaces: falls as Stribeck says, falls and rises as powers.
fn stribeck(speed_mm_s: f64) -> f64 {
    0.3 + 0.5 * (-speed_mm_s / 40.0).exp()
}

fn falling(speed_mm_s: f64) -> f64 {
    0.4 * (speed_mm_s / 100.0).powf(-0.3)
}

fn rising(speed_mm_s: f64) -> f64 {
    0.4 * (speed_mm_s / 100.0).powf(0.25)
}

/// A silent texture with this friction, sampled as the importer samples it, from 10 to 300 mm/s.
fn texture(mu_at: Option<fn(f64) -> f64>) -> Vec<u8> {
    let mut texture = builtin::texture();
    for vertex in &mut texture.grid.vertices {
        vertex.sigma_m_s2 = 0.0;
    }
    texture.friction.mu = MU;
    texture.friction.law = mu_at.and_then(|mu_at| {
        let point = |step: i32| {
            let speed_mm_s = 10.0 * 30_f64.powf(f64::from(step) / 128.0);
            LawPoint {
                speed_mm_s,
                factor: mu_at(speed_mm_s) / MU,
            }
        };
        FrictionLaw::through((0..=128).map(point).collect())
    });
    lower(&texture, None).unwrap().bytes
}

fn loaded<A: RenderArithmetic>(bytes: &[u8]) -> Box<HostSlot<A>> {
    let mut slot = Box::new(Texture::new());
    slot.load(&Asset::parse(bytes).unwrap(), RATE_HZ).unwrap();
    slot
}

/// F_t/F_n at the end of a steady stroke.
fn rendered<A: RenderArithmetic>(bytes: &[u8], speed_mm_s: f64) -> f64 {
    let renderer = Renderer::<A>::prepare(&Config::default()).unwrap();
    let (texture, mut state) = (loaded(bytes), State::new(1));
    let mut ratio = 0.0;
    for n in 0..600 {
        let x_m = 1e-3 * speed_mm_s * TICK_S * f64::from(n);
        let sample = Sample::at([x_m as f32, 0.0, -DEPTH_M as f32]);
        let output = renderer.tick(&texture, &mut state, &Sample::of(&sample));
        ratio = f64::from(output.friction_n.value()) / f64::from(output.normal_force_n.value());
    }
    ratio
}

#[test]
fn steady_strokes_render_the_law_of_the_asset_within_one_per_cent() {
    let laws: [fn(f64) -> f64; 3] = [stribeck, falling, rising];
    for mu_at in laws {
        let bytes = texture(Some(mu_at));
        for speed_mm_s in [12.0, 20.0, 35.0, 50.0, 80.0, 120.0, 180.0, 250.0, 295.0] {
            let exact = mu_at(speed_mm_s);
            let float = rendered::<Float>(&bytes, speed_mm_s);
            let fixed = rendered::<Fixed>(&bytes, speed_mm_s);
            for found in [float, fixed] {
                assert!(
                    (found / exact - 1.0).abs() < 0.01,
                    "{speed_mm_s} mm/s: {found}, not {exact}"
                );
            }
            // Both arithmetics look into one table.
            assert!((fixed / float - 1.0).abs() < 1e-3, "{fixed} {float}");
        }
        // Constant beyond.
        let fast = rendered::<Float>(&bytes, 600.0);
        assert!((fast / mu_at(300.0) - 1.0).abs() < 0.01, "{fast}");
    }
}

#[test]
fn a_slot_tells_the_same_friction_as_the_tick() {
    let bytes = texture(Some(stribeck));
    let slot = loaded::<Float>(&bytes);
    assert!((f64::from(slot.mu()) - MU).abs() < 1e-6);
    for speed_mm_s in [0.0_f64, 15.0, 60.0, 400.0] {
        let within = speed_mm_s.clamp(10.0, 300.0);
        let mu = f64::from(slot.mu_at(speed_mm_s as f32));
        assert!((mu / stribeck(within) - 1.0).abs() < 0.01, "{mu}");
    }
}

/// With μ falling from 0.8 to 0.3, noise of a count at rest causes no sign change, and the force is no more restless
/// than with a constant μ of 0.8.
#[test]
fn a_law_that_falls_does_not_chatter_at_rest() {
    let restless = |bytes: &[u8]| {
        let renderer = Renderer::new(&Config::default()).unwrap();
        let (texture, mut state) = (loaded(bytes), State::new(1));
        let mut draw = Draw::new(5);
        let (mut turns, mut change_n, mut last) = (0, 0.0_f32, 0.0_f32);
        for n in 0..10_500 {
            let base_m = 1e-4 * f64::from(n.min(200));
            let count_m = (draw.below(3) as f64 - 1.0) * COUNT_M;
            let x_m = (base_m + count_m) as f32;
            let output = renderer.tick(&texture, &mut state, &Sample::at([x_m, 0.0, -0.002]));
            let force_n = output.force_n[0];
            if n >= 500 {
                turns += u32::from(force_n * last < 0.0);
                change_n = change_n.max((force_n - last).abs());
            }
            last = force_n;
        }
        (turns, change_n)
    };
    let mut constant = builtin::texture();
    constant.friction.mu = stribeck(10.0);
    constant
        .grid
        .vertices
        .iter_mut()
        .for_each(|v| v.sigma_m_s2 = 0.0);
    let (turns, change_n) = restless(&texture(Some(stribeck)));
    assert_eq!(turns, 0);
    let (_, of_coulomb_n) = restless(&lower(&constant, None).unwrap().bytes);
    assert!(change_n <= 1.01 * of_coulomb_n, "{change_n} {of_coulomb_n}");
}

/// No work is done on the hand over closed paths of a hand's speed, by a device that absorbs
/// nothing, with the steepest laws that an asset can hold.
#[test]
fn no_law_gives_energy_over_closed_paths() {
    let steep = |points: &[(f64, f64)]| {
        let mut texture = builtin::texture();
        texture
            .grid
            .vertices
            .iter_mut()
            .for_each(|v| v.sigma_m_s2 = 0.0);
        texture.friction.mu = 0.2;
        let points = points
            .iter()
            .map(|&(speed_mm_s, factor)| LawPoint { speed_mm_s, factor });
        texture.friction.law = FrictionLaw::through(points.collect());
        lower(&texture, None).unwrap().bytes
    };
    let renderer = Renderer::new(&Config::default()).unwrap();
    for points in [
        &[(20.0, 7.0), (20.0625, 0.0)][..],
        &[(20.0, 0.0), (20.0625, 7.0)],
        &[(0.0, 7.0), (60.0, 0.0)],
        &[
            (10.0, 0.0),
            (30.0, 7.0),
            (50.0, 0.0),
            (70.0, 7.0),
            (90.0, 0.0),
        ],
    ] {
        let slot = loaded::<Float>(&steep(points));
        for (frequency_hz, amplitude_m) in [
            (0.3, 0.02),
            (1.0, 0.01),
            (2.0, 0.003),
            (5.0, 0.002),
            (10.0, 0.0015),
            (10.0, 0.005),
        ] {
            for press in [0.0, 0.6] {
                let mut state = State::new(1);
                let ticks = (3.0 / frequency_hz / TICK_S) as i32;
                let (mut work_j, mut force_n, mut last_m) = (0.0, 0.0, 0.0);
                for n in 0..=ticks {
                    let turn = std::f64::consts::TAU * 3.0 * f64::from(n) / f64::from(ticks);
                    let x_m = amplitude_m * turn.sin();
                    let depth_m = 1e-3 * (1.0 + press * (turn + 1.0).cos());
                    work_j += force_n * (x_m - last_m);
                    let sample = Sample::at([x_m as f32, 0.0, -depth_m as f32]);
                    let output = renderer.tick(&slot, &mut state, &sample);
                    force_n = f64::from(output.force_n[0]);
                    last_m = x_m;
                }
                assert!(
                    work_j < 1e-9,
                    "{points:?}, {frequency_hz} Hz, {amplitude_m} m: {work_j} J"
                );
            }
        }
    }
}

/// From one law to another in contact, the force goes little by little; without a change the bits
/// are those of the plain tick.
#[test]
fn from_law_to_law_friction_changes_little_by_little() {
    change::<Float>();
    change::<Fixed>();
}

fn change<A: RenderArithmetic>() {
    let textures = [texture(Some(falling)), texture(Some(rising)), texture(None)];
    let renderer = Renderer::<A>::prepare(&Config::default()).unwrap();
    let sample = |n: i32| {
        let x_m = 2.5e-4 * n as f32;
        Sample::of(&Sample::at([x_m, 0.0, -0.002]))
    };
    let (sent, end) = (300, 360);
    for (from, to) in [(0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)] {
        let slots = [loaded::<A>(&textures[from]), loaded::<A>(&textures[to])];
        let alone: [Vec<f32>; 2] = slots.map(|slot| {
            let mut state = State::new(1);
            let tick = |n| {
                renderer
                    .tick(&slot, &mut state, &sample(n))
                    .friction_n
                    .value()
            };
            (0..end).map(tick).collect()
        });
        let (mut playing, mut spare) = (loaded(&textures[from]), Box::new(Texture::new()));
        let mut exchange = Exchange::<HostCapacities, A>::new();
        let (mut preparer, mut player) = exchange.split(&mut playing, [&mut spare], 1);
        let next = Asset::parse(&textures[to]).unwrap();
        let mut forces = Vec::new();
        for n in 0..end {
            if n == sent {
                preparer.prepare(&next, RATE_HZ).unwrap();
            }
            let output = renderer.tick_player(&mut player, &sample(n));
            forces.push(output.friction_n.value());
        }
        let sent = sent as usize;
        assert_eq!(
            forces[..sent],
            alone[0][..sent],
            "the bits of the plain tick"
        );
        let (before, after) = (forces[sent - 1], forces[forces.len() - 1]);
        let (way, arrived) = ((after - before).abs(), alone[1][alone[1].len() - 1]);
        assert!(
            (after / arrived - 1.0).abs() < 1e-3,
            "{after}, not {arrived}"
        );
        assert!(way > 0.05, "{from} to {to}: {way} N of way");
        let steps = forces[sent - 1..]
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).abs());
        let step = steps.fold(0.0, f32::max);
        assert!(
            step <= 0.25 * way,
            "{from} to {to}: {step} of {way} N at once"
        );
    }
}
