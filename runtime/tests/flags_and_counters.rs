//! Flags say what happened in a tick; counters say how often.

use asperity_formats::Asset;
use asperity_runtime::{
    Config, Counters, Fixed, Flags, Float, RenderArithmetic, Renderer, Sample, State,
    arithmetic::Scalar as _,
};
use asperity_tests::{
    texture::{HostSlot, TextureKind, random},
    trajectory::strokes,
};

#[test]
fn flags_are_bits_in_the_order_of_their_names() {
    let names = [
        "contact",
        "tap_started",
        "tap_active",
        "outside_grid",
        "peak_limited",
        "slew_limited",
        "held_sample",
        "safe_state",
        "ramping",
        "vib_clamped",
    ];
    assert_eq!(Flags::ALL.map(|(_, name)| name), names);
    for (at, (flag, name)) in Flags::ALL.into_iter().enumerate() {
        assert_eq!(flag.bits(), 1 << at, "{name}");
        for (other, _) in Flags::ALL {
            assert_eq!(flag.contains(other), flag == other);
            assert!(!Flags::default().contains(other));
        }
        assert!(flag.contains(Flags::default()));
    }
    assert_eq!(Flags::default().bits(), 0);
}

/// Ticks with a script, counted by hand.
fn count<A: RenderArithmetic>(samples: &[Sample]) -> (Vec<Flags>, Counters) {
    count_within::<A>(Config::default().safety.reach_m, samples)
}

fn count_within<A: RenderArithmetic>(reach_m: f32, samples: &[Sample]) -> (Vec<Flags>, Counters) {
    let bytes = random(1, TextureKind::nyquist(8)).encode();
    let mut slot = Box::new(HostSlot::<A>::new());
    slot.load(&Asset::parse(&bytes).unwrap(), 1000.0).unwrap();
    let mut config = Config::default();
    config.safety.reach_m = reach_m;
    let renderer = Renderer::<A>::prepare(&config).unwrap();
    let mut state = State::new(1);
    let tick = |s| renderer.tick(&slot, &mut state, &Sample::of(s)).flags;
    let flags = samples.iter().map(tick).collect();
    (flags, *state.counters())
}

fn script() -> Vec<Sample> {
    let position_m = [0.0, 0.0, -1e-3];
    let pressed = Sample::at(position_m);
    let late = |elapsed_ticks: u32| Sample {
        position_m,
        elapsed_ticks,
    };
    let mut script = vec![pressed; 5];
    // Held, held, a fault, and two more in the safe state.
    script.extend([Sample::STALE; 5]);
    script.extend([pressed; 150]);
    // Two samples that are held, one good one between them.
    script.extend([Sample::at([f32::NAN; 3]), pressed, Sample::STALE]);
    // One and two missed periods, then four: a fault.
    script.extend([late(2), late(3), pressed, late(5)]);
    script.extend([pressed; 200]);
    script
}

#[test]
fn counters_count_bad_samples_missed_periods_and_faults() {
    fn check<A: RenderArithmetic>() {
        let script = script();
        let (flags, counters) = count::<A>(&script);
        assert_eq!(counters.ticks as usize, script.len());
        assert_eq!(counters.bad_samples, 7);
        assert_eq!(counters.missed_ticks, 1 + 2 + 4);
        assert_eq!(counters.faults, 2);
        assert_eq!(counters.taps, 0, "the first contact is no impact");
        let held = |n: usize| flags[n].contains(Flags::HELD_SAMPLE);
        let held: Vec<_> = (0..script.len()).filter(|&n| held(n)).collect();
        assert_eq!(held, [5, 6, 160, 162]);
        let safe = |n: &usize| flags[*n].contains(Flags::SAFE_STATE);
        let safe: Vec<_> = (0..script.len()).filter(safe).collect();
        assert_eq!(safe, [7, 8, 9, 166]);
        let ramping = |n: &usize| flags[*n].contains(Flags::RAMPING);
        let ramping: Vec<_> = (0..script.len()).filter(ramping).collect();
        // A tenth of a second each time; rounding may add a tick.
        let ramps: Vec<_> = ramping.chunk_by(|a, b| a + 1 == *b).collect();
        assert_eq!(ramps.len(), 2);
        for (ramp, from) in ramps.into_iter().zip([10, 167]) {
            assert!(
                ramp[0] == from && (99..=100).contains(&ramp.len()),
                "{ramp:?}"
            );
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Flags in the output and counters agree.
#[test]
fn counters_agree_with_the_flags_of_the_ticks() {
    fn check<A: RenderArithmetic>() {
        let mut samples: Vec<_> = strokes(3, 4000).into_iter().map(Sample::at).collect();
        // Deep enough for the peak, and with jumps that the slew limit holds back.
        for (n, sample) in samples.iter_mut().enumerate() {
            if n % 500 > 450 {
                sample.position_m[2] = -0.02;
            }
        }
        let (flags, counters) = count::<A>(&samples);
        let times = |flag: Flags| flags.iter().filter(|f| f.contains(flag)).count() as u32;
        let found = [counters.taps, counters.peak_limited, counters.slew_limited];
        let wanted = [Flags::TAP_STARTED, Flags::PEAK_LIMITED, Flags::SLEW_LIMITED].map(times);
        assert_eq!(found, wanted);
        assert!(wanted.iter().all(|n| *n > 0), "{wanted:?}");
        assert_eq!((counters.bad_samples, counters.faults), (0, 0));
        assert!(times(Flags::TAP_ACTIVE) > counters.taps);
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn contact_and_the_grid_are_told_apart_at_their_borders() {
    fn check<A: RenderArithmetic>() {
        let deep = |depth_m: f32| Sample::at([0.0, 0.0, -depth_m]);
        // 500 N/m: 4 N, where the grid ends, at 8 mm.
        for (depth_m, contact, outside) in [
            (-1e-3, false, false),
            (0.0, false, false),
            (1e-7, true, false),
            (7.99e-3, true, false),
            (8.01e-3, true, true),
        ] {
            let (flags, _) = count::<A>(&[deep(depth_m)]);
            assert_eq!(flags[0].contains(Flags::CONTACT), contact, "{depth_m}");
            assert_eq!(flags[0].contains(Flags::OUTSIDE_GRID), outside, "{depth_m}");
        }
        // In the air it is the speed that leaves the grid: 0.25 m/s.
        let fast = |speed_m_s: f32| {
            let at = |n| Sample::at([speed_m_s * 1e-3 * n as f32, 0.0, 0.01]);
            let samples: Vec<_> = (0..400).map(at).collect();
            count::<A>(&samples).0[399].contains(Flags::OUTSIDE_GRID)
        };
        assert_eq!([0.245, 0.255].map(fast), [false, true]);
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn a_sample_out_of_reach_is_bad_in_either_arithmetic() {
    fn usable_within<A: RenderArithmetic>(reach_m: f32, x: f32) -> bool {
        let bad = |axis: usize| {
            let mut position_m = [0.0; 3];
            position_m[axis] = x;
            count_within::<A>(reach_m, &[Sample::at(position_m)])
                .1
                .bad_samples
        };
        let bad = [0, 1, 2].map(bad);
        assert!(bad == [0; 3] || bad == [1; 3], "{x}: {bad:?}");
        bad == [0; 3]
    }
    fn usable<A: RenderArithmetic>(x: f32) -> bool {
        usable_within::<A>(Config::default().safety.reach_m, x)
    }
    for sign in [1.0_f32, -1.0] {
        let far = |x| usable_within::<Float>(1e4, sign * x);
        assert!(far(1e4) && !far(1e4_f32.next_up()));
        assert!(usable::<Float>(sign) && !usable::<Float>(sign * 1.0_f32.next_up()));
        let near = |x| usable_within::<Fixed>(0.25, sign * x);
        assert!(near(0.25) && !near(0.25_f32.next_up()));
        assert!(usable::<Fixed>(sign) && !usable::<Fixed>(sign * 1.0_f32.next_up()));
        assert!(!usable::<Float>(sign * f32::INFINITY) && !usable::<Fixed>(sign * f32::INFINITY));
        // Beyond what fixed point can hold, and far beyond.
        assert!(!usable::<Fixed>(sign * 8.0) && !usable::<Fixed>(sign * 1e30));
    }
    assert!(!usable::<Float>(f32::NAN) && !usable::<Fixed>(f32::NAN));
    let stale = Sample {
        position_m: [0.0; 3],
        elapsed_ticks: 0,
    };
    assert_eq!(count::<Float>(&[stale]).1.bad_samples, 1);
    let held = Sample::<Fixed>::of(&Sample::at([0.25, -0.5, 0.125]));
    assert_eq!(held.position_m.map(|x| x.value()), [0.25, -0.5, 0.125]);
}
