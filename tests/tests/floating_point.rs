//! The caller's floating point: audio hosts, game engines and C programs linked with `-ffast-math`
//! have denormals flushed (FTZ) or read as zeros (DAZ). No bit may depend on it, and no tick may
//! raise an exception that `docs/floating-point.md` lets a caller unmask.
#![cfg(target_arch = "x86_64")]

use asperity_formats::Solid;
use asperity_runtime::{
    Capacity, Config, ConfigError, Fixed, Float, HostCapacities, LoadError, Output,
    RenderArithmetic, Renderer, Sample, State, Texture, math::rounds_to_nearest,
};
use asperity_session::{
    ARMA_20, Arma20, CASES, Case, Hash, NYQUIST_4, NYQUIST_20, Nyquist4, Nyquist20, Phase, SEED,
    Slot, load,
};

/// The control register of SSE.
#[allow(
    unsafe_code,
    reason = "the register belongs to the thread, and is put back"
)]
mod control {
    use std::arch::asm;

    /// All exceptions masked, none raised, rounding to nearest.
    const DEFAULT: u32 = 0x1f80;
    pub(super) const FTZ: u32 = 1 << 15;
    pub(super) const DAZ: u32 = 1 << 6;
    /// Down, up and toward zero.
    pub(super) const ROUNDINGS: [u32; 3] = [1 << 13, 2 << 13, 3 << 13];
    pub(super) const INVALID: u32 = 1;
    pub(super) const DENORMAL: u32 = 1 << 1;
    pub(super) const DIVISION: u32 = 1 << 2;
    pub(super) const OVERFLOW: u32 = 1 << 3;
    pub(super) const UNDERFLOW: u32 = 1 << 4;

    fn set(value: u32) {
        // SAFETY: every caller puts the default back before it returns.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack)) }
    }

    fn get() -> u32 {
        let mut value = 0_u32;
        // SAFETY: it stores four bytes there.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack)) }
        value
    }

    /// Runs `work` with these bits set. Returns its result and the exceptions raised.
    #[inline(never)]
    pub(super) fn with<T>(bits: u32, work: impl FnOnce() -> T) -> (T, u32) {
        set(DEFAULT | bits);
        let result = std::hint::black_box(work());
        let raised = get() & 0x3f;
        set(DEFAULT);
        (result, raised)
    }
}
use control::{DAZ, DENORMAL, DIVISION, FTZ, INVALID, OVERFLOW, ROUNDINGS, UNDERFLOW, with};

const MODES: [u32; 4] = [0, FTZ, DAZ, FTZ | DAZ];
/// Optimised code may compute what it then throws away, such as a lane that is not used, and raise an
/// exception for an invalid operation there.
const TRAPS: u32 =
    DIVISION | OVERFLOW | UNDERFLOW | if cfg!(debug_assertions) { INVALID } else { 0 };

/// Runs samples through a texture. Returns the hash of all outputs and every exception raised.
fn run<A: RenderArithmetic, S: Capacity>(
    case: &Case,
    config: &Config,
    bits: u32,
    samples: &[Sample],
) -> (u64, u32)
where
    Texture<S, A>: Slot,
{
    let mut slot = Box::new(Texture::<S, A>::new());
    let (loaded, mut raised) = with(bits, || Slot::load(&mut *slot, case));
    loaded.expect("a texture");
    let (renderer, more) = with(bits, || Renderer::<A>::prepare(config));
    raised |= more;
    let renderer = renderer.expect("a configuration");
    let mut state = State::new(SEED);
    let mut hash = Hash::new();
    for sample in samples {
        let sample = Sample::of(sample);
        let (output, more): (Output<A>, _) =
            with(bits, || renderer.tick(&slot, &mut state, &sample));
        raised |= more;
        hash.output(&output);
    }
    (hash.value(), raised)
}

fn run_case(case: &Case, config: &Config, bits: u32, samples: &[Sample]) -> (u64, u32) {
    /// The capacity of a slot.
    trait Held {
        type Capacity: Capacity;
    }
    impl<S: Capacity> Held for Texture<S, Float> {
        type Capacity = S;
    }
    if *case == ARMA_20 {
        run::<Float, <Arma20 as Held>::Capacity>(case, config, bits, samples)
    } else if *case == NYQUIST_20 {
        run::<Float, <Nyquist20 as Held>::Capacity>(case, config, bits, samples)
    } else {
        assert_eq!(*case, NYQUIST_4);
        run::<Float, <Nyquist4 as Held>::Capacity>(case, config, bits, samples)
    }
}

fn session() -> Vec<Sample> {
    let phase = |phase: Phase| (0..asperity_session::PHASE_TICKS).map(move |n| phase.sample(n));
    Phase::ALL.into_iter().flat_map(phase).collect()
}

/// The session as every machine runs it, its samples that are no numbers included.
#[test]
fn no_bit_of_the_session_depends_on_denormals_and_no_tick_raises_an_exception() {
    for case in &CASES {
        let hashes = MODES.map(|bits| {
            let (hash, raised) = run_case(case, &Config::default(), bits, &session());
            assert_eq!(raised & (TRAPS | DENORMAL), 0, "{} {bits:#x}", case.name);
            hash
        });
        assert!(hashes.iter().all(|&hash| hash == hashes[0]), "{hashes:x?}");
    }
}

/// Samples that are hard: a stroke or a tap, then 20 s of rest in contact or above it, in which every
/// state decays; then positions and motions that are denormal or next to it.
fn hard_samples(rest_m: f32) -> Vec<Sample> {
    let mut samples = Vec::new();
    for n in 0..400 {
        let x = n as f32 * 1e-4;
        samples.push(Sample::at([x, -0.3 * x, 1e-3 - x.min(3e-3)]));
    }
    let [x, y, _] = samples[399].position_m;
    samples.extend((0..20_000).map(|_| Sample::at([x, y, rest_m])));
    for exponent in [-149, -130, -127, -126, -110, -80, -62, -50, -38, -30] {
        for sign in [1.0, -1.0] {
            let tiny = sign * 2.0_f64.powi(exponent) as f32;
            samples.extend((0..40).map(|n| {
                let odd = if n % 2 == 0 { tiny } else { 0.0 };
                Sample::at([odd, tiny, -1e-3 + odd])
            }));
            samples.extend(
                (0..40).map(|n| Sample::at([tiny, 0.0, if n % 3 == 0 { tiny } else { -tiny }])),
            );
        }
    }
    samples
}

#[test]
fn rest_and_the_smallest_motions_raise_no_exception_on_any_solid() {
    let solids = [
        Solid::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        Solid::Plane {
            point_m: [0.0, 0.01, 0.0],
            normal: [0.2, -1e-4, 0.9],
        },
        Solid::Sphere {
            center_m: [0.0, 0.0, -0.05],
            radius_m: 0.05,
        },
        Solid::Box {
            center_m: [0.0, 0.0, -0.02],
            half_extents_m: [0.1, 0.1, 0.02],
        },
    ];
    for solid in solids {
        let config = Config {
            solid,
            ..Config::default()
        };
        for rest_m in [-2e-3, 4e-3] {
            let samples = hard_samples(rest_m);
            let hashes = MODES.map(|bits| {
                let (hash, raised) = run_case(&NYQUIST_4, &config, bits, &samples);
                assert_eq!(raised & TRAPS, 0, "{solid:?} at {rest_m} m, {bits:#x}");
                hash
            });
            assert!(
                hashes.iter().all(|&hash| hash == hashes[0]),
                "{solid:?} at {rest_m} m: {hashes:x?}"
            );
        }
    }
}

/// Returns the errors of loading and preparing while the processor rounds in this mode; a slot that refuses keeps its
/// former texture.
fn refusals<A: RenderArithmetic>(bits: u32) -> (Result<(), LoadError>, Option<ConfigError>) {
    let mut slot = Box::new(Texture::<HostCapacities, A>::new());
    load(&NYQUIST_4, &mut slot).expect("a texture");
    let before = format!("{slot:?}");
    let (loaded, _) = with(bits, || load(&ARMA_20, &mut slot));
    let is_kept = format!("{slot:?}") == before;
    assert_eq!(is_kept, loaded.is_err(), "{bits:#x}");
    let config = Config::default();
    let (prepared, _) = with(bits, || Renderer::<A>::prepare(&config).err());
    (loaded, prepared)
}

#[test]
fn another_rounding_is_refused_whatever_becomes_of_denormals() {
    for flushing in MODES {
        assert_eq!(refusals::<Float>(flushing), (Ok(()), None), "{flushing:#x}");
        assert_eq!(refusals::<Fixed>(flushing), (Ok(()), None), "{flushing:#x}");
        for rounding in ROUNDINGS {
            let bits = flushing | rounding;
            assert!(!with(bits, rounds_to_nearest).0, "{bits:#x}");
            let refused = (Err(LoadError::Rounding), Some(ConfigError::ROUNDING));
            assert_eq!(refusals::<Float>(bits), refused, "{bits:#x}");
            assert_eq!(refusals::<Fixed>(bits), refused, "{bits:#x}");
        }
    }
}
