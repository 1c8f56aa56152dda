//! The same asset in a servo loop that is faster than its models. The samples of the models are
//! those of a loop at their own rate, spectrum and level are kept, taps play at their source
//! rate, and forces stay within their limits.

use crate::support;
use asperity_formats::{Asset, Numerator};
use asperity_runtime::quantity::Quantity;
use asperity_runtime::{
    Config, Exchange, Flags, HostCapacities, HostTexture, LoadError, Output, Renderer, Sample,
    State,
    stage::vibration::{LAG_SAMPLES, Vibration},
};
use asperity_tests::{
    draw::Draw,
    force_limits::ForceLimits,
    oracle::Interpolator,
    spectrum::{band_levels_db, periodogram, third_octaves},
    texture::{TextureKind, random},
};

/// Rate of the models, Hz.
const MODELS_HZ: f32 = 1000.0;
const RATIOS: [u8; 6] = [2, 4, 5, 8, 10, 20];

fn loaded(bytes: &[u8], ratio: u8) -> Box<HostTexture> {
    let mut slot = Box::new(HostTexture::new());
    let servo_hz = MODELS_HZ * f32::from(ratio);
    slot.load(&Asset::parse(bytes).unwrap(), servo_hz).unwrap();
    assert_eq!(slot.ticks_per_sample(), ratio);
    slot
}

fn config(ratio: u8) -> Config {
    Config {
        servo_rate_hz: MODELS_HZ * f32::from(ratio),
        ..Config::default()
    }
}

fn kinds() -> [TextureKind; 3] {
    let arma = TextureKind {
        ma_order: 18,
        numerator: Numerator::Lsf,
        ..TextureKind::nyquist(20)
    };
    [TextureKind::nyquist(20), TextureKind::nyquist(5), arma]
}

/// Every query and contact lasts one sample. The output is the response of the low-pass to
/// exactly the samples of a loop at the rate of the models.
#[test]
fn samples_are_those_of_a_loop_at_the_models_rate() {
    for (seed, kind) in (1..).zip(kinds()) {
        let bytes = random(seed, kind).encode();
        let slow = loaded(&bytes, 1);
        let mut draw = Draw::new(seed);
        let queries: Vec<(f32, f32, bool)> = (0..4000)
            .map(|n| {
                let query = |limit| draw.range(0.0, limit) as f32;
                let mut query = query;
                (query(250.0), query(4.0), n % 500 < 400)
            })
            .collect();
        for ratio in RATIOS {
            let fast = loaded(&bytes, ratio);
            let mut models = Vibration::new(seed);
            let mut ours = Vibration::new(seed);
            let mut low_pass = Interpolator::new(ratio.into());
            let (mut worst, mut loudest) = (0.0_f64, 0.0_f64);
            for &(speed, force, sounding) in &queries {
                let at = (Quantity(speed), Quantity(force), Quantity(0.7));
                let y = models.step(&slow, at.0, at.1, at.2, sounding).y.value();
                for tick in 0..ratio {
                    let entering = if tick == 0 { f64::from(y) } else { 0.0 };
                    let exact = low_pass.step(entering);
                    let sounded = ours.step(&fast, at.0, at.1, at.2, sounding);
                    assert!(!sounded.clamped);
                    let out = sounded.y.value();
                    if sounding {
                        worst = worst.max((f64::from(out) - exact).abs());
                        loudest = loudest.max(exact.abs());
                    } else {
                        assert_eq!(out, 0.0);
                    }
                }
                if !sounding {
                    low_pass.reset();
                }
            }
            println!("{ratio}: {worst:.2e} of {loudest:.3} m/s²");
            assert!(loudest > 0.1 && worst < 2e-5 * loudest, "{worst} {loudest}");
        }
    }
}

/// A stroke at a constant speed and depth on a circle of 1 m, for any servo rate.
fn stroke(renderer: &Renderer, slot: &HostTexture, seed: u64, seconds: f64) -> Vec<f64> {
    let rate_hz = f64::from(renderer.config().servo_rate_hz);
    let mut state = State::new(seed);
    let settle = rate_hz as usize / 2;
    let ticks = (seconds * rate_hz) as usize;
    let all = (0..settle + ticks).map(|n| {
        let angle = 0.1 * n as f64 / rate_hz;
        let position_m = [angle.sin() as f32, angle.cos() as f32, -2e-3];
        f64::from(
            renderer
                .tick(slot, &mut state, &Sample::at(position_m))
                .vib_m_s2,
        )
    });
    all.skip(settle).collect()
}

/// Third octaves from 10 to 450 Hz, and with them the level, are within 0.3 dB of those at the
/// rate of the models. The power above 550 Hz is at least 40 dB below that of the band.
#[test]
fn spectrum_and_level_are_kept_and_images_are_not_felt() {
    let textures = [
        support::builtin(),
        random(3, TextureKind::nyquist(20)).encode(),
    ];
    for bytes in textures {
        let at = |ratio: u8| {
            let renderer = Renderer::new(&config(ratio)).unwrap();
            stroke(&renderer, &loaded(&bytes, ratio), 5, 120.0)
        };
        let bands = third_octaves(10.0, 900.0);
        let models_hz = f64::from(MODELS_HZ);
        let levels = |power: &[f64]| band_levels_db(power, models_hz, &bands);
        let own = levels(&periodogram(&at(1)));
        for ratio in [5, 10] {
            let ours = at(ratio);
            // One output per sample is kept, so that the rest of the images folds back.
            let folded: Vec<f64> = ours.iter().step_by(ratio.into()).copied().collect();
            for ((band, ours), own) in bands.iter().zip(levels(&periodogram(&folded))).zip(&own) {
                let difference = ours - own;
                assert!(
                    difference.abs() < 0.3,
                    "{ratio}, {:.0} Hz: {difference} dB",
                    band.0
                );
            }
            let power = periodogram(&ours);
            let hz = f64::from(MODELS_HZ) * f64::from(ratio) / (2 * (power.len() - 1)) as f64;
            let sum = |low: f64, high: f64| -> f64 {
                let inside = |&(bin, _): &(usize, &f64)| (low..high).contains(&(bin as f64 * hz));
                let bins = power.iter().enumerate().filter(inside);
                bins.map(|(_, power)| power).sum()
            };
            let images = 10.0 * (sum(550.0, f64::INFINITY) / sum(10.0, 450.0)).log10();
            println!("{ratio}: images {images:.1} dB");
            assert!(images < -40.0, "{ratio}: {images} dB");
        }
    }
}

/// Samples from a query to the first one of its model.
fn samples_to_effect(slot: &HostTexture) -> usize {
    LAG_SAMPLES + 1 - usize::from(slot.cycle_samples())
}

/// A jump of the query is heard after at most ten samples, and sooner if the texture is small:
/// after 3 to 10 at order 4, after 5 to 10 with an MA part.
#[test]
fn a_change_is_heard_within_ten_samples() {
    let arma = TextureKind {
        ma_order: 20,
        numerator: Numerator::Lsf,
        ..TextureKind::nyquist(20)
    };
    let mut cycles = Vec::new();
    for kind in [TextureKind::nyquist(4), TextureKind::nyquist(20), arma] {
        let bytes = random(4, kind).encode();
        for ratio in [1, 2, 5, 10] {
            let slot = loaded(&bytes, ratio);
            let (ticks, cycle) = (usize::from(ratio), usize::from(slot.cycle_samples()));
            let heard = |jump: usize| {
                let mut vibration = Vibration::new(1);
                (0..jump + 20 * ticks)
                    .position(|tick| {
                        // At zero speed and force a texture has no level.
                        let (speed, force) = if tick < jump {
                            (0.0, 0.0)
                        } else {
                            (150.0, 2.0)
                        };
                        {
                            let at = (Quantity(speed), Quantity(force), Quantity(0.7));
                            vibration.step(&slot, at.0, at.1, at.2, true).y.value() != 0.0
                        }
                    })
                    .expect("a sound")
                    - jump
            };
            let whole_cycle = 60 * ticks..(60 + cycle) * ticks;
            let (least, most) = whole_cycle
                .map(heard)
                .fold((usize::MAX, 0), |(low, high), n| (low.min(n), high.max(n)));
            println!("{cycle} samples a cycle, {ratio}: {least} to {most} ticks");
            let soonest = (samples_to_effect(&slot) - 1) * ticks + 1;
            assert!(
                least == soonest && most == LAG_SAMPLES * ticks,
                "{least} {most}"
            );
            cycles.push(cycle);
        }
    }
    assert_eq!(cycles, [8, 8, 8, 8, 8, 8, 8, 8, 6, 6, 6, 6]);
}

/// Taps at their source rate are those of the asset to the bit, and the force follows them.
#[test]
fn a_tap_at_its_source_rate_plays_its_samples() {
    let bytes = random(6, TextureKind::nyquist(8)).encode();
    let asset = Asset::parse(&bytes).unwrap();
    let slot = loaded(&bytes, 10);
    assert_eq!(asset.taps().sample_rate_hz(), 10_000.0);
    assert_eq!(slot.taps().ticks(), asset.taps().samples());
    for trace in asset.taps().traces() {
        let selection = slot.taps().select(Quantity(trace.speed_m_s));
        for (n, a) in trace.accel_m_s2().enumerate() {
            assert_eq!(slot.taps().acceleration(&selection, n).value(), a);
        }
    }
    // Down at 0.3 m/s, between two traces or on one, within the rounding of eight heights.
    let renderer = Renderer::new(&config(10)).unwrap();
    let mut state = State::new(1);
    let outputs: Vec<_> = (0..1000)
        .map(|n| Sample::at([0.0, 0.0, 0.015 - 0.3e-4 * n as f32]))
        .map(|sample| renderer.tick(&slot, &mut state, &sample))
        .collect();
    let started = |o: &Output| o.flags.contains(Flags::TAP_STARTED);
    let start = outputs.iter().position(started).expect("a tap");
    let selection = slot.taps().select(Quantity(0.3));
    for (n, output) in outputs[start..start + 100].iter().enumerate() {
        let wanted =
            slot.coupling().effective_mass_kg * slot.taps().acceleration(&selection, n).value();
        assert!(
            (output.tap_n - wanted).abs() < 2e-3 * slot.coupling().effective_mass_kg * 360.0,
            "{n}: {} {wanted}",
            output.tap_n
        );
    }
}

/// For any samples, forces are finite and within peak and slew, and end at zero.
#[test]
fn forces_stay_within_their_limits() {
    let bytes = [support::builtin(), random(8, kinds()[2]).encode()];
    for ratio in [5, 10] {
        let config = config(ratio);
        let renderer = Renderer::new(&config).unwrap();
        for (seed, bytes) in (1..).zip(&bytes) {
            let slot = loaded(bytes, ratio);
            let (mut state, mut draw) = (State::new(seed), Draw::new(seed));
            let mut limits = ForceLimits::new(&config);
            let odd = [
                f32::NAN,
                f32::INFINITY,
                f32::NEG_INFINITY,
                1e30,
                -0.0,
                1e-40,
            ];
            for n in 0..100_000 {
                let near = |draw: &mut Draw, around: f64| (around + draw.range(-1e-3, 1e-3)) as f32;
                let t = f64::from(n) * 1e-3 / f64::from(ratio);
                let mut position_m = [
                    near(&mut draw, 0.03 * (9.0 * t).sin()),
                    near(&mut draw, 0.0),
                    near(&mut draw, 4e-3 * (20.0 * t).sin()),
                ];
                if draw.below(50) == 0 {
                    position_m[draw.below(3)] = odd[draw.below(odd.len())];
                }
                let elapsed_ticks = if draw.below(50) == 0 {
                    draw.below(6)
                } else {
                    1
                };
                let sample = Sample {
                    position_m,
                    elapsed_ticks: elapsed_ticks as u32,
                };
                let output = renderer.tick(&slot, &mut state, &sample);
                limits.check(&output);
                if !output.flags.contains(Flags::CONTACT) {
                    assert_eq!(output.vib_m_s2, 0.0);
                }
            }
            for _ in 0..1000 {
                let away = Sample::at([0.0, 0.0, 0.1]);
                limits.check(&renderer.tick(&slot, &mut state, &away));
            }
            assert!(limits.last_n().iter().all(|f| f.abs() < 1e-6));
        }
    }
}

/// At rest the state of the low-pass fades to zero, and not to denormals, which slow a processor.
#[test]
fn a_stroke_that_ends_ends_in_silence() {
    let slot = loaded(&random(9, TextureKind::nyquist(20)).encode(), 10);
    let mut vibration = Vibration::new(1);
    let (force, fraction) = (Quantity(2.0), Quantity(0.7));
    let mut step = |speed| {
        let sounded = vibration.step(&slot, Quantity(speed), force, fraction, true);
        sounded.y.value()
    };
    assert!((0..2000).map(|_| step(150.0)).any(|y| y.abs() > 0.1));
    let last: Vec<f32> = (0..100_000).map(|_| step(0.0)).collect();
    assert!(last.iter().all(|y| *y == 0.0 || y.is_normal()));
    assert_eq!(last.last(), Some(&0.0));
}

#[test]
fn a_rate_that_is_no_multiple_is_refused_and_the_slot_kept() {
    let bytes = random(1, TextureKind::nyquist(20)).encode();
    let asset = Asset::parse(&bytes).unwrap();
    let mut slot = loaded(&bytes, 5);
    let before = slot.filter_at(90.0, 1.0);
    for servo_hz in [500.0, 1500.0, 4800.0, 21_000.0, f32::NAN] {
        let refused = slot.load(&asset, servo_hz).unwrap_err();
        assert!(matches!(refused, LoadError::Rate { .. }), "{refused:?}");
        assert!(refused.to_string().contains("a whole number"), "{refused}");
        assert_eq!((slot.ticks_per_sample(), slot.servo_rate_hz()), (5, 5000.0));
        assert_eq!(slot.filter_at(90.0, 1.0), before);
    }
}

/// Tick in which the second texture is sent, and ticks after it that count as the crossing.
const SENT: usize = 2000;
const AROUND: usize = 300;

/// A stroke at 100 mm/s, 2 mm deep, in a loop at 5 kHz, on the first texture before tick [`SENT`]
/// and on the second one from then on.
fn crossed(from: &[u8], to: Option<&[u8]>, seed: u64) -> Vec<Output> {
    let config = config(5);
    let renderer = Renderer::new(&config).unwrap();
    let slot = || Box::new(HostTexture::new());
    let (mut playing, mut spare) = (slot(), slot());
    let load = |bytes| Asset::parse(bytes).unwrap();
    playing.load(&load(from), config.servo_rate_hz).unwrap();
    let mut exchange = Exchange::<HostCapacities>::new();
    let (mut preparer, mut player) = exchange.split(&mut playing, [&mut spare], seed);
    let tick = |n: usize| {
        if let (SENT, Some(to)) = (n, to) {
            preparer.prepare(&load(to), config.servo_rate_hz).unwrap();
        }
        let position_m = [0.02e-3 * n as f32, 0.0, (1e-3 - 1e-5 * n as f32).max(-2e-3)];
        renderer.tick_player(&mut player, &Sample::at(position_m))
    };
    (0..SENT + 2 * AROUND).map(tick).collect()
}

/// From one texture to another, whose models have the same clock or one of their own, the
/// vibration makes no larger step than either does by itself. In the end only the second one
/// sounds.
#[test]
fn textures_of_any_clock_follow_each_other() {
    let mut texture = random(11, TextureKind::nyquist(20));
    let one = texture.encode();
    texture.models.reverse();
    let two = texture.encode();
    texture.sample_rate_hz = 5000.0;
    let five = texture.encode();
    let largest_step = |outputs: &[Output]| {
        let steps = outputs
            .windows(2)
            .map(|pair| (pair[1].vib_m_s2 - pair[0].vib_m_s2).abs());
        steps.fold(0.0, f32::max)
    };
    for (name, from, to) in [
        ("1 to 1 kHz", &one, &two),
        ("1 to 5 kHz", &one, &five),
        ("5 to 1 kHz", &five, &one),
    ] {
        let (mut across, mut alone) = (0.0_f32, 0.0_f32);
        for seed in 0..100 {
            let outputs = crossed(from, Some(to), seed);
            across = across.max(largest_step(&outputs[SENT - 1..SENT + AROUND]));
            for bytes in [from, to] {
                let outputs = crossed(bytes, None, seed);
                alone = alone.max(largest_step(&outputs[SENT - 1..SENT + AROUND]));
            }
            let level =
                |outputs: &[Output]| outputs.iter().map(|o| o.vib_m_s2 * o.vib_m_s2).sum::<f32>();
            assert!(level(&outputs[SENT + AROUND..]) > 0.0);
        }
        println!("{name}: {across} m/s² across, {alone} alone");
        assert!(across <= 1.1 * alone, "{name}: {across} of {alone}");
    }
    // While the new model is made, the old one sounds as before.
    let (kept, changed) = (crossed(&one, None, 7), crossed(&one, Some(&two), 7));
    let sound = |outputs: &[Output]| -> Vec<f32> { outputs.iter().map(|o| o.vib_m_s2).collect() };
    let differ = sound(&kept)
        .iter()
        .zip(sound(&changed))
        .position(|(a, b)| (a - b).abs() > 1e-3);
    let differ = differ.expect("another sound");
    let soonest = SENT + 5 * samples_to_effect(&loaded(&two, 5));
    assert!((soonest..soonest + 45).contains(&differ), "{differ}");
}

/// Two slots of one asset for two servo rates are two textures to a state. Each begins with a
/// query of its own, whatever the other one was doing.
#[test]
fn one_asset_at_two_rates_is_two_textures() {
    let bytes = random(9, TextureKind::nyquist(20)).encode();
    let slots = [1, 5].map(|ratio| loaded(&bytes, ratio));
    let mut vibration = Vibration::new(9);
    let mut draw = Draw::new(9);
    let mut heard = 0;
    for _ in 0..2000 {
        for slot in &slots {
            let ticks = draw.range(1.0, 80.0) as usize;
            for tick in 0..ticks {
                let (speed, force) = (draw.range(0.0, 250.0) as f32, draw.range(0.0, 4.0) as f32);
                let at = (Quantity(speed), Quantity(force), Quantity(0.7));
                let sounded = vibration.step(slot, at.0, at.1, at.2, true);
                let y = sounded.y.value();
                assert!(y.is_finite() && !sounded.clamped);
                let begun = tick >= samples_to_effect(slot) * usize::from(slot.ticks_per_sample());
                assert!(begun || y == 0.0, "tick {tick}: {y} m/s²");
                heard += usize::from(y != 0.0);
            }
        }
    }
    assert!(heard > 10_000, "{heard} ticks");
}
