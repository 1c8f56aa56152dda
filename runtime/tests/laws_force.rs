//! For any samples the force is finite and within peak and slew. The same input gives the same
//! bits, and good samples bring the force back.

use asperity_formats::Asset;
use asperity_runtime::{Config, Flags, HostTexture, Renderer, Sample, Solid, State};
use asperity_tests::{
    force_limits::{ForceLimits, size},
    texture::{TextureKind, random},
};
use proptest::{collection::vec, prelude::*};
use std::sync::OnceLock;

fn texture() -> &'static HostTexture {
    static TEXTURE: OnceLock<Box<HostTexture>> = OnceLock::new();
    TEXTURE.get_or_init(|| {
        let mut texture = random(3, TextureKind::nyquist(20));
        // Loud and stiff, so that the limiter has work to do.
        texture.coupling.vib_s2_m = 1.0;
        texture.coupling.stiffness_n_m = 2000.0;
        texture.coupling.effective_mass_kg = 0.1;
        let bytes = texture.encode();
        let mut slot = Box::new(HostTexture::new());
        slot.load(&Asset::parse(&bytes).unwrap(), 1000.0).unwrap();
        slot
    })
}

/// A device that bears the texture's 2000 N/m.
fn config() -> Config {
    let mut config = Config::default();
    config.mechanics.damping_n_s_m = 2.0;
    config
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        8 => -0.01_f32..0.01,
        2 => -1e5_f32..1e5,
        2 => any::<u32>().prop_map(f32::from_bits),
        1 => prop::sample::select(vec![
            f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 0.0, -0.0,
            f32::MIN_POSITIVE, f32::from_bits(1), -f32::from_bits(77), 1e4, -1e4, 1e4_f32.next_up(),
        ]),
    ]
}

fn sample() -> impl Strategy<Value = Sample> {
    let elapsed = prop_oneof![10 => Just(1), 1 => 0_u32..6, 1 => any::<u32>()];
    ([number(), number(), number()], elapsed).prop_map(|(position_m, elapsed_ticks)| Sample {
        position_m,
        elapsed_ticks,
    })
}

/// Stretches of motion, with bad samples between them.
fn samples() -> impl Strategy<Value = Vec<Sample>> {
    let stretch = (
        sample(),
        [-1e-3_f32..1e-3, -1e-3_f32..1e-3, -1e-3_f32..1e-3],
        0_usize..40,
    )
        .prop_map(|(first, step, count)| {
            let mut position_m = first.position_m;
            let rest = (0..count).map(move |_| {
                position_m = std::array::from_fn(|i| position_m[i] + step[i]);
                Sample::at(position_m)
            });
            std::iter::once(first).chain(rest).collect::<Vec<_>>()
        });
    vec(stretch, 1..20).prop_map(|stretches| stretches.concat())
}

fn solid() -> impl Strategy<Value = Solid> {
    prop_oneof![
        Just(Config::default().solid),
        Just(Solid::Sphere {
            center_m: [0.0, 0.0, -0.01],
            radius_m: 0.01
        }),
        Just(Solid::Box {
            center_m: [0.0; 3],
            half_extents_m: [0.004, 0.005, 0.006]
        }),
        Just(Solid::Plane {
            point_m: [1.0, 2.0, -3.0],
            normal: [1e-3, 2e-3, -1e-4]
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_samples_whatever_drive_the_force_beyond_its_limits(
        samples in samples(),
        solid in solid(),
        (peak_n, slew_n_s) in (0.01_f32..100.0, 0.1_f32..1e5),
        seed in any::<u64>(),
    ) {
        let mut config = Config { solid, ..config() };
        config.safety.reach_m = 1e4;
        (config.limits.peak_n, config.limits.slew_n_s) = (peak_n, slew_n_s);
        let renderer = Renderer::new(&config).unwrap();
        let (mut state, mut twin) = (State::new(seed), State::new(seed));
        let mut limits = ForceLimits::new(&config);
        for sample in &samples {
            let output = renderer.tick(texture(), &mut state, sample);
            limits.check(&output);
            // The same input gives the same bits.
            let again = renderer.tick(texture(), &mut twin, sample);
            prop_assert_eq!(output.force_n.map(f32::to_bits), again.force_n.map(f32::to_bits));
            prop_assert_eq!(output.vib_m_s2.to_bits(), again.vib_m_s2.to_bits());
        }
        prop_assert_eq!(state, twin);
    }

    /// After any samples, the force at rest in contact is that of the wall, and out of contact
    /// there is none.
    #[test]
    fn good_samples_bring_the_force_back(samples in samples(), seed in any::<u64>()) {
        let mut config = config();
        config.safety.reach_m = 1e4;
        let renderer = Renderer::new(&config).unwrap();
        let mut state = State::new(seed);
        for sample in &samples {
            renderer.tick(texture(), &mut state, sample);
        }
        let rest = |state: &mut State, z: f32| {
            let mut output = renderer.tick(texture(), state, &Sample::at([0.0, 0.0, z]));
            for _ in 0..1500 {
                output = renderer.tick(texture(), state, &Sample::at([0.0, 0.0, z]));
            }
            output
        };
        let output = rest(&mut state, -0.0005);
        prop_assert!(!output.flags.contains(Flags::SAFE_STATE) && !output.flags.contains(Flags::RAMPING));
        prop_assert!((output.force_n[2] - 1.0).abs() < 0.01, "{:?}", output);
        let output = rest(&mut state, 0.02);
        prop_assert!(size(output.force_n) == 0.0, "{:?}", output);
    }
}

#[test]
fn a_fault_is_safe_within_one_tick_and_falls_at_the_slew_limit() {
    let config = config();
    let renderer = Renderer::new(&config).unwrap();
    let pressed = Sample::at([0.0, 0.0, -0.0015]);
    let faults: [&[Sample]; 4] = [
        &[Sample::STALE; 3],
        &[Sample::at([f32::NAN, 0.0, 0.0]); 3],
        &[Sample::at([0.0, f32::INFINITY, 0.0]); 3],
        &[Sample {
            elapsed_ticks: 4,
            ..pressed
        }],
    ];
    for fault in faults {
        let mut state = State::new(1);
        for _ in 0..500 {
            renderer.tick(texture(), &mut state, &pressed);
        }
        let (&last, held) = fault.split_last().unwrap();
        let mut before = 0.0;
        for sample in held {
            let output = renderer.tick(texture(), &mut state, sample);
            assert!(output.flags.contains(Flags::HELD_SAMPLE), "{output:?}");
            assert!(!output.flags.contains(Flags::SAFE_STATE), "{output:?}");
            before = size(output.force_n);
            assert!(before > 2.9, "the last good sample is held: {output:?}");
        }
        if held.is_empty() {
            before = 3.0;
        }
        let output = renderer.tick(texture(), &mut state, &last);
        assert!(output.flags.contains(Flags::SAFE_STATE), "{output:?}");
        // 2000 N/s at 1 kHz.
        assert!(
            (before - size(output.force_n) - 2.0).abs() < 0.01,
            "{output:?}"
        );
        if fault.len() > 1 {
            let output = renderer.tick(texture(), &mut state, &Sample::STALE);
            assert!(size(output.force_n) < 1e-6, "{output:?}");
        }
        assert_eq!(state.counters().faults, 1);
        // A ramp of 100 ms, without a step.
        let mut last = 0.0;
        for _ in 0..150 {
            let output = renderer.tick(texture(), &mut state, &pressed);
            let force = size(output.force_n);
            assert!(force - last < 0.08, "a step of {} N", force - last);
            last = force;
        }
        assert!(last > 2.9, "{last} N after the ramp");
    }
}
