//! Every output of the tick agrees with the f64 oracle within the stated tolerances, on seeded
//! trajectories over plane, sphere and box, bad samples included.

use asperity_formats::{Asset, Numerator};
use asperity_runtime::{
    Config, Fixed, Float, RenderArithmetic, Renderer, Sample, Solid, State, VibrationAxis,
    arithmetic::Scalar as _,
};
use asperity_tests::{
    draw::Draw,
    oracle::{Oracle, Tick},
    texture::{HostSlot, TextureKind, random, random_contact, random_direction, random_law},
    trajectory::{strokes, strokes_at},
};

/// Largest difference of each output.
#[derive(Debug, Default)]
struct Worst {
    force_n: f64,
    depth_um: f64,
    speed_mm_s: f64,
    normal_force_n: f64,
    vib_m_s2: f64,
    tap_n: f64,
    friction_n: f64,
    /// Loudest sample of the oracle, so that silence does not count as agreement.
    loudest_m_s2: f64,
    hardest_tap_n: f64,
}

/// Compares in floats and in fixed point.
fn compare(
    bytes: &[u8],
    config: &Config,
    seed: u64,
    samples: &[Sample],
) -> [(Worst, Tolerance); 2] {
    [
        (compare_in::<Float>(bytes, config, seed, samples), FLOAT),
        (compare_in::<Fixed>(bytes, config, seed, samples), FIXED),
    ]
}

fn compare_in<A: RenderArithmetic>(
    bytes: &[u8],
    config: &Config,
    seed: u64,
    samples: &[Sample],
) -> Worst {
    let asset = Asset::parse(bytes).unwrap();
    let renderer = Renderer::<A>::prepare(config).unwrap();
    let mut texture = Box::new(HostSlot::<A>::new());
    texture.load(&asset, config.servo_rate_hz).unwrap();
    let mut state = State::new(seed);
    let mut oracle = Oracle::new(&asset, texture.cycle_samples(), config, seed);
    let mut worst = Worst::default();
    for sample in samples {
        let ours = renderer.tick(&texture, &mut state, &Sample::of(sample));
        let exact: Tick = oracle.tick(sample);
        let note = |worst: &mut f64, a: f32, b: f64| *worst = worst.max((f64::from(a) - b).abs());
        for (a, b) in ours.force_n.iter().zip(exact.force_n) {
            note(&mut worst.force_n, a.value(), b);
        }
        let depth_um = ours.depth_m.value() * 1e6;
        note(&mut worst.depth_um, depth_um, exact.depth_m * 1e6);
        note(
            &mut worst.speed_mm_s,
            ours.speed_mm_s.value(),
            exact.speed_mm_s,
        );
        note(
            &mut worst.normal_force_n,
            ours.normal_force_n.value(),
            exact.normal_force_n,
        );
        note(&mut worst.vib_m_s2, ours.vib_m_s2.value(), exact.vib_m_s2);
        note(&mut worst.tap_n, ours.tap_n.value(), exact.tap_n);
        note(
            &mut worst.friction_n,
            ours.friction_n.value(),
            exact.friction_n,
        );
        worst.loudest_m_s2 = worst.loudest_m_s2.max(exact.vib_m_s2.abs());
        worst.hardest_tap_n = worst.hardest_tap_n.max(exact.tap_n.abs());
    }
    worst
}

fn fresh(positions: Vec<[f32; 3]>) -> Vec<Sample> {
    positions.into_iter().map(Sample::at).collect()
}

fn kinds() -> [TextureKind; 5] {
    let lsf = |ar_order, ma_order| TextureKind {
        ar_order,
        ma_order,
        numerator: Numerator::Lsf,
        lattice: (7, 6),
    };
    let none = TextureKind {
        numerator: Numerator::None,
        ..TextureKind::nyquist(21)
    };
    [
        TextureKind::nyquist(4),
        TextureKind::nyquist(20),
        none,
        lsf(20, 18),
        lsf(23, 24),
    ]
}

/// Largest difference of each output from the oracle.
#[derive(Debug, Clone, Copy)]
struct Tolerance {
    depth_um: f64,
    normal_force_n: f64,
    /// At 1 kHz.
    speed_mm_s: f64,
    /// Relative to the loudest sample.
    vib: f64,
    /// Relative to the hardest tap, or to 0.1 N.
    tap: f64,
    friction_n: f64,
    force_n: f64,
}

/// Rounding of f32, in positions of centimetres and in a hundred coefficients.
const FLOAT: Tolerance = Tolerance {
    depth_um: 0.02,
    normal_force_n: 1e-5,
    // The difference of two f32 positions of 5 cm, times the rate, filtered.
    speed_mm_s: 0.01,
    vib: 1e-3,
    tap: 1e-4,
    friction_n: 2e-5,
    force_n: 3e-4,
};

/// Steps of 15 µN and of 15 µm/s², which the resonances of a model amplify. The limiter stays a
/// step within its limits, and a slow slew adds these steps up.
const FIXED: Tolerance = Tolerance {
    depth_um: 0.02,
    normal_force_n: 3e-5,
    speed_mm_s: 0.03,
    vib: 3e-3,
    tap: 1e-3,
    friction_n: 6e-4,
    force_n: 2e-3,
};

fn assert_close(compared: &[(Worst, Tolerance); 2], rate_hz: f32, case: &str) {
    for (worst, within) in compared {
        println!("{case}: {worst:?}");
        let rate = f64::from(rate_hz / 1000.0);
        // The nearer the poles of the velocity filter are to 1, the more rounding moves them: with
        // the square of the rate. Speed decides what vibrates.
        let growth = if rate > 4.0 { rate * rate / 4.0 } else { 1.0 };
        let hardest_n = worst.hardest_tap_n.max(0.1);
        for (found, most) in [
            (worst.depth_um, within.depth_um),
            (worst.normal_force_n, within.normal_force_n),
            (worst.speed_mm_s, within.speed_mm_s * rate.max(growth)),
            (worst.vib_m_s2, within.vib * growth * worst.loudest_m_s2),
            (worst.tap_n, within.tap * hardest_n),
            (worst.friction_n, within.friction_n * growth),
            (worst.force_n, within.force_n * growth),
        ] {
            assert!(found < most, "{case}: {worst:?}, not within {within:?}");
        }
        assert!(worst.loudest_m_s2 > 0.05, "{case} says nothing: {worst:?}");
    }
}

#[test]
fn strokes_and_taps_on_a_plane_with_every_kind_of_texture() {
    for (seed, kind) in (1..).zip(kinds()) {
        let bytes = random(seed, kind).encode();
        let samples = fresh(strokes(seed, 10_000));
        let worst = compare(&bytes, &Config::default(), seed, &samples);
        assert!(worst[0].0.hardest_tap_n > 0.1, "no tap: {worst:?}");
        assert_close(&worst, 1000.0, &format!("{kind:?}"));
    }
}

/// Laws that fall and rise over the speeds of the strokes, at every rate.
#[test]
fn friction_that_depends_on_speed() {
    let mut draw = Draw::new(60);
    for (seed, kind) in (60..).zip(kinds()) {
        let mut texture = random(seed, kind);
        texture.law = random_law(&mut draw, 200.0, 2.0);
        let bytes = texture.encode();
        let samples = fresh(strokes(seed, 10_000));
        let config = Config::default();
        // What speed may be off, friction is off by the slope of the law.
        let slopes = texture.law.windows(2).map(|p| {
            let factor = p[1].factor() - p[0].factor();
            (factor / (p[1].speed_mm_s() - p[0].speed_mm_s())).abs()
        });
        let steepest = f64::from(slopes.fold(0.0, f32::max) * texture.mu * config.limits.peak_n);
        let worst = compare(&bytes, &config, seed, &samples).map(|(worst, within)| {
            let by_speed = steepest * within.speed_mm_s;
            let within = Tolerance {
                friction_n: within.friction_n + by_speed,
                force_n: within.force_n + by_speed,
                ..within
            };
            (worst, within)
        });
        assert_close(&worst, 1000.0, &format!("law, {kind:?}"));
    }
}

/// Ribs, grains and naps along any axis, on each solid, with a law of friction and without, at two rates.
#[test]
fn textures_with_a_direction() {
    let mut draw = Draw::new(95);
    for seed in 95..107 {
        let mut texture = random(seed, TextureKind::nyquist(8));
        texture.direction = Some(random_direction(&mut draw));
        if seed % 2 == 0 {
            texture.law = random_law(&mut draw, 200.0, 2.0);
        }
        let bytes = texture.encode();
        let rate_hz = [1000.0, 4000.0][usize::from(seed % 4 == 3)];
        let config = Config {
            solid: solids()[seed as usize % 3],
            servo_rate_hz: rate_hz,
            ..Config::default()
        };
        let samples = fresh(strokes_at(rate_hz.into(), seed, 10_000));
        // Speed decides on the law, and rounding on the sense of a stroke across the axis.
        let worst = compare(&bytes, &config, seed, &samples).map(|(worst, within)| {
            let within = Tolerance {
                vib: 3.0 * within.vib,
                friction_n: 5.0 * within.friction_n + 2e-3,
                force_n: within.force_n + 3e-3,
                ..within
            };
            (worst, within)
        });
        assert_close(&worst, rate_hz, &format!("{:?}", texture.direction));
    }
}

/// Laws of every mixture of parts, on strokes, taps, held samples and missed periods.
#[test]
fn materials_that_give_way() {
    let mut draw = Draw::new(70);
    let mut parts = [0; 6];
    for seed in 70..90 {
        let mut texture = random(seed, TextureKind::nyquist(8));
        let contact = random_contact(&mut draw);
        for (count, there) in parts.iter_mut().zip([
            !contact.spring.is_empty(),
            contact.damping_s_m > 0.0,
            contact.relaxation.stiffness_n_m > 0.0,
            contact.imprint.share > 0.0,
            contact.drag.viscous_n_s_m2 > 0.0,
            contact.adhesion.pull_n > 0.0,
        ]) {
            *count += u32::from(there);
        }
        texture.coupling.stiffness_n_m = draw.range(100.0, 500.0) as f32;
        // What speed may be off by, and a step of the load, count for drag and for what yields.
        let drag = f64::from(contact.drag.viscous_n_s_m2) * 6e-3;
        // Rounding may change in which tick a surface yields or the load ends, hence how fast grains
        // crunch, how far the surface heals in that tick, and whether the bristle is let go.
        let (crunches, healed_n, let_go_n) = if contact.imprint.share > 0.0 {
            (0.02, 5e-3, 2e-2)
        } else {
            (0.0, 0.0, 0.0)
        };
        texture.contact = Some(contact);
        let bytes = texture.encode();
        let mut samples = fresh(strokes(seed, 10_000));
        for sample in samples.iter_mut().skip(100) {
            match draw.below(300) {
                0 => sample.elapsed_ticks = 2 + draw.below(2) as u32,
                1 => *sample = Sample::STALE,
                _ => {}
            }
        }
        let worst = compare(&bytes, &Config::default(), seed, &samples).map(|(worst, within)| {
            let by_speed = drag * within.speed_mm_s / 1000.0;
            let within = Tolerance {
                normal_force_n: 6e-4 + healed_n,
                vib: within.vib + crunches,
                friction_n: within.friction_n + by_speed + 6e-4 + let_go_n,
                force_n: within.force_n + by_speed + 2e-3 + let_go_n,
                ..within
            };
            (worst, within)
        });
        assert_close(
            &worst,
            1000.0,
            &format!("seed {seed}: {:?}", texture.contact),
        );
    }
    assert!(parts.iter().all(|&count| count > 5), "{parts:?}");
}

/// A sphere, a box and a tilted plane.
fn solids() -> [Solid; 3] {
    [
        Solid::Sphere {
            center_m: [0.0, 0.0, -0.05],
            radius_m: 0.05,
        },
        Solid::Box {
            center_m: [0.002, 0.001, -0.02],
            half_extents_m: [0.012, 0.015, 0.02],
        },
        Solid::Plane {
            point_m: [0.0, 0.001, 0.0],
            normal: [0.3, -0.4, 2.0],
        },
    ]
}

#[test]
fn spheres_boxes_tilted_planes_and_the_other_axis() {
    let bytes = random(7, TextureKind::nyquist(20)).encode();
    for (seed, solid) in (20..).zip(solids()) {
        for vibration_axis in [VibrationAxis::Tangent, VibrationAxis::Binormal] {
            let config = Config {
                solid,
                vibration_axis,
                ..Config::default()
            };
            let worst = compare(&bytes, &config, seed, &fresh(strokes(seed, 10_000)));
            assert_close(&worst, 1000.0, &format!("{solid:?} {vibration_axis:?}"));
        }
    }
}

#[test]
fn bad_samples_are_held_then_safe_then_ramped() {
    let bytes = random(9, TextureKind::nyquist(20)).encode();
    for seed in 30..35 {
        let mut draw = Draw::new(seed);
        let mut bad = 0;
        let samples: Vec<_> = strokes(seed, 10_000)
            .into_iter()
            .map(|position_m| {
                if bad == 0 && draw.below(200) == 0 {
                    bad = 1 + draw.below(6);
                }
                let is_bad = bad > 0;
                bad = bad.saturating_sub(1);
                match (is_bad, draw.below(4)) {
                    (false, 0) if draw.below(60) == 0 => Sample {
                        position_m,
                        elapsed_ticks: 2 + draw.below(4) as u32,
                    },
                    (false, _) => Sample::at(position_m),
                    (true, 0) => Sample::STALE,
                    (true, 1) => Sample::at([f32::NAN, 0.0, 0.0]),
                    (true, 2) => Sample::at([0.0, f32::INFINITY, 0.0]),
                    (true, _) => Sample::at([0.0, 0.0, -2e4]),
                }
            })
            .collect();
        let worst = compare(&bytes, &Config::default(), seed, &samples);
        assert_close(&worst, 1000.0, &format!("bad samples, seed {seed}"));
    }
}

#[test]
fn other_rates_cut_offs_and_limits() {
    for (seed, rate) in [(40, 500.0), (41, 2000.0), (42, 4000.0)] {
        let mut texture = random(seed, TextureKind::nyquist(10));
        texture.sample_rate_hz = rate;
        let mut config = Config {
            servo_rate_hz: rate,
            velocity_cutoff_hz: 35.0,
            normal_cutoff_hz: 60.0,
            parameter_time_constant_s: 0.02,
            ..Config::default()
        };
        config.limits.peak_n = 1.0;
        config.limits.slew_n_s = 100.0;
        let worst = compare(
            &texture.encode(),
            &config,
            seed,
            &fresh(strokes(seed, 10_000)),
        );
        assert_close(&worst, rate, &format!("{rate} Hz"));
    }
}

/// Models and taps keep their own rates; the loop runs at a multiple of that of the models.
#[test]
fn servo_loops_faster_than_the_models() {
    let rates = [2000.0, 3000.0, 5000.0, 8000.0, 10_000.0];
    for ((seed, kind), rate) in (50..).zip(kinds()).zip(rates) {
        let config = Config {
            servo_rate_hz: rate,
            ..Config::default()
        };
        let bytes = random(seed, kind).encode();
        let ticks = 5 * rate as usize;
        let samples = fresh(strokes_at(rate.into(), seed, ticks));
        let worst = compare(&bytes, &config, seed, &samples);
        assert!(worst[0].0.hardest_tap_n > 0.1, "no tap: {worst:?}");
        assert_close(&worst, rate, &format!("{rate} Hz, {kind:?}"));
    }
}
