//! Fuzzed ticks: random bits as samples, faults, textures swapped under a running state,
//! configurations at their bounds.

use crate::{
    draw::Draw,
    force_limits::ForceLimits,
    texture::{HostSlot, TextureKind, random, random_direction, random_law},
};
use asperity_formats::{Asset, Direction, Numerator};
use asperity_runtime::{
    Config, LoadError, RenderArithmetic, Renderer, Sample, Solid, State, VibrationAxis,
    arithmetic::Scalar as _,
};

/// Textures to swap between.
const TEXTURES: u64 = 24;
const MODEL_RATE_HZ: f32 = 1000.0;
/// Servo rates as multiples of the rate of the models.
const TICKS_PER_SAMPLE: [u8; 3] = [1, 5, 10];
/// Cut-offs as fractions of the servo rate; the last one is the highest that is allowed.
const CUTOFFS: [f32; 3] = [0.002, 0.02, 0.45];
/// Ticks for which one renderer and one state are kept.
const SESSION_TICKS: u64 = 20_000;

/// Counts of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Summary {
    /// Ticks.
    pub ticks: u64,
    /// Textures swapped under a running state.
    pub swaps: u64,
    /// Ticks in contact.
    pub contacts: u64,
    /// Taps.
    pub taps: u64,
    /// Times the safe state was entered.
    pub faults: u64,
    /// Ticks whose force was cut or held back.
    pub limited: u64,
    /// FNV-1a hash of the bits of every force. The same number of ticks and the same seed give
    /// the same hash.
    pub hash: u64,
}

/// Runs `ticks` ticks that are drawn from `seed`, in the arithmetic `A`. Each of them must obey
/// the law of [`ForceLimits`].
///
/// # Panics
/// If a tick panics or breaks the law. The message names seed, session and tick.
#[must_use]
pub fn fuzz_ticks<A: RenderArithmetic>(seed: u64, ticks: u64) -> Summary {
    let textures = TICKS_PER_SAMPLE.map(|ticks| textures::<A>(seed, ticks));
    let mut summary = Summary {
        hash: 0xcbf2_9ce4_8422_2325,
        ..Summary::default()
    };
    let mut session = 0;
    while summary.ticks < ticks {
        let count = SESSION_TICKS.min(ticks - summary.ticks);
        let mut draw = Draw::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ session);
        let rate = draw.below(TICKS_PER_SAMPLE.len());
        let servo_rate_hz = f32::from(TICKS_PER_SAMPLE[rate]) * MODEL_RATE_HZ;
        let config = config::<A>(&mut draw, servo_rate_hz);
        run(&mut draw, &config, &textures[rate], count, &mut summary);
        session += 1;
    }
    summary
}

/// Ticks of one renderer and one state.
fn run<A: RenderArithmetic>(
    draw: &mut Draw,
    config: &Config,
    textures: &[Box<HostSlot<A>>],
    ticks: u64,
    summary: &mut Summary,
) {
    let renderer = Renderer::<A>::prepare(config).expect("a valid configuration");
    let mut state = State::new(draw.bits());
    let mut limits = ForceLimits::new(config);
    let mut motion = Motion::new(draw);
    let mut texture = &textures[0];
    for _ in 0..ticks {
        if draw.below(300) == 0 {
            texture = &textures[draw.below(textures.len())];
            summary.swaps += 1;
        }
        let output = renderer.tick(texture, &mut state, &Sample::of(&motion.next(draw)));
        limits.check(&output);
        summary.contacts += u64::from(output.depth_m.value() > 0.0);
        for force in output.force_n {
            let word = u64::from(force.value().to_bits());
            summary.hash = (summary.hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    let counters = state.counters();
    summary.ticks += ticks;
    summary.taps += u64::from(counters.taps);
    summary.faults += u64::from(counters.faults);
    summary.limited += u64::from(counters.peak_limited) + u64::from(counters.slew_limited);
}

/// Textures that the arithmetic can hold, for a servo loop of `ticks_per_sample`.
fn textures<A: RenderArithmetic>(seed: u64, ticks_per_sample: u8) -> Vec<Box<HostSlot<A>>> {
    let textures: Vec<_> = (0..4 * TEXTURES)
        .filter_map(|index| texture::<A>(seed ^ index, ticks_per_sample))
        .take(TEXTURES as usize)
        .collect();
    assert_eq!(
        textures.len() as u64,
        TEXTURES,
        "most textures are in range"
    );
    textures
}

/// A texture of any kind. Some are louder and stiffer than any device. `None` if the
/// arithmetic cannot hold it.
fn texture<A: RenderArithmetic>(seed: u64, ticks_per_sample: u8) -> Option<Box<HostSlot<A>>> {
    let mut draw = Draw::new(seed);
    let mut texture = random(
        seed,
        TextureKind {
            ar_order: 1 + draw.below(24),
            ma_order: 1 + draw.below(24),
            numerator: [Numerator::None, Numerator::Nyquist, Numerator::Lsf][draw.below(3)],
            lattice: (2 + draw.below(6), 2 + draw.below(6)),
        },
    );
    texture.traces.truncate(draw.below(14));
    texture.mu = draw.range(0.0, 10.0) as f32;
    if draw.below(2) == 0 {
        // μ times a factor is 10 at most.
        let highest = (9.99 / f64::from(texture.mu)).min(7.99);
        texture.law = random_law(&mut draw, 400.0, highest);
    }
    if draw.below(3) == 0 {
        let direction = random_direction(&mut draw);
        let [mu_forward, mu_backward] =
            [direction.mu_forward, direction.mu_backward].map(|mu| mu / 2.0);
        texture.direction = Some(Direction {
            mu_forward,
            mu_backward,
            ..direction
        });
    }
    texture.coupling.vib_s2_m = [0.05, 1.0, 1000.0][draw.below(3)];
    texture.coupling.stiffness_n_m = [1.0, 500.0, 1e5][draw.below(3)];
    texture.coupling.damping_n_s_m = [0.0, 0.2, 1e3][draw.below(3)];
    texture.coupling.effective_mass_kg = [0.01, 0.1, 100.0][draw.below(3)];
    let mut slot = Box::new(HostSlot::new());
    let bytes = texture.encode();
    let asset = Asset::parse(&bytes).expect("a valid texture");
    match slot.load(&asset, f32::from(ticks_per_sample) * MODEL_RATE_HZ) {
        Ok(()) => Some(slot),
        Err(LoadError::Range { .. }) => None,
        Err(error) => panic!("a texture that does not fit: {error}"),
    }
}

fn config<A: RenderArithmetic>(draw: &mut Draw, servo_rate_hz: f32) -> Config {
    let mut config = Config {
        solid: match draw.below(4) {
            0 => Solid::Sphere {
                center_m: [0.0, 0.0, -0.01],
                radius_m: 0.01,
            },
            1 => Solid::Box {
                center_m: [0.0; 3],
                half_extents_m: [0.004, 0.005, 0.006],
            },
            2 => Solid::Plane {
                point_m: [0.001, 0.002, -0.003],
                normal: [1e-3, 2e-3, -1e-4],
            },
            _ => Config::default().solid,
        },
        vibration_axis: [VibrationAxis::Tangent, VibrationAxis::Binormal][draw.below(2)],
        servo_rate_hz,
        velocity_cutoff_hz: servo_rate_hz * CUTOFFS[draw.below(CUTOFFS.len())],
        normal_cutoff_hz: servo_rate_hz * CUTOFFS[draw.below(CUTOFFS.len())],
        ..Config::default()
    };
    config.limits.peak_n = 10_f64.powf(draw.range(-2.0, 2.0)) as f32;
    // Drawn per tick: fixed point refuses less than 10⁻⁴ N a tick.
    config.limits.slew_n_s = 10_f64.powf(draw.range(-4.0, 2.0)) as f32 * servo_rate_hz;
    config.safety.hold_ticks = draw.below(3) as u32;
    config.safety.ramp_s = [0.0, 0.1, 10.0][draw.below(3)];
    // As far as the arithmetic goes, or a desk.
    let farthest_m = if A::OUT_OF_REACH_M < 10.0 { 1.0 } else { 1.0e4 };
    config.safety.reach_m = [0.1, farthest_m][draw.below(2)];
    config.parameter_time_constant_s = [0.0, 0.005, 0.04][draw.below(3)];
    config.tap.min_speed_m_s = [0.0, 0.01][draw.below(2)];
    config
}

/// A motion made of stretches, each of one kind.
struct Motion {
    kind: usize,
    left: usize,
    position_m: [f32; 3],
    step_m: [f32; 3],
}

impl Motion {
    fn new(draw: &mut Draw) -> Self {
        let mut motion = Self {
            kind: 0,
            left: 0,
            position_m: [0.0; 3],
            step_m: [0.0; 3],
        };
        motion.turn(draw);
        motion
    }

    /// Starts the next stretch.
    fn turn(&mut self, draw: &mut Draw) {
        self.kind = draw.below(9);
        self.left = 1 + draw.below(200);
        let mut metres = |range: f64| [0; 3].map(|_: i32| draw.range(-range, range) as f32);
        self.position_m = metres(0.01);
        self.step_m = metres(1e-3);
    }

    fn next(&mut self, draw: &mut Draw) -> Sample {
        if self.left == 0 {
            self.turn(draw);
        }
        self.left -= 1;
        match self.kind {
            // A stroke, a jitter about a point, rest.
            0..=2 => {
                for (x, step) in self.position_m.iter_mut().zip(self.step_m) {
                    *x += step;
                }
                Sample::at(self.position_m)
            }
            3 => Sample::at(self.position_m.map(|x| x + draw.range(-1e-3, 1e-3) as f32)),
            4 => Sample::at(self.position_m),
            // Random bits as position and as elapsed time.
            5 => any_bits(draw),
            6 => special(draw),
            // Any position within the reach of fixed point.
            7 => Sample::at([0; 3].map(|_: i32| draw.range(-1.0, 1.0) as f32)),
            _ if draw.below(3) == 0 => Sample::STALE,
            _ => Sample {
                position_m: self.position_m,
                elapsed_ticks: draw.below(8) as u32,
            },
        }
    }
}

fn any_bits(draw: &mut Draw) -> Sample {
    let (low, high) = (draw.bits(), draw.bits());
    Sample {
        position_m: [low as u32, (low >> 32) as u32, high as u32].map(f32::from_bits),
        elapsed_ticks: match (high >> 32) % 4 {
            0 => (high >> 34) as u32,
            _ => 1,
        },
    }
}

fn special(draw: &mut Draw) -> Sample {
    const VALUES: [f32; 14] = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        1e-45,
        0.0,
        -0.0,
        1e4,
        -1e4,
        10_000.001,
        1e-20,
        -0.01,
    ];
    Sample {
        position_m: [0; 3].map(|_: i32| VALUES[draw.below(VALUES.len())]),
        elapsed_ticks: [1, 1, 1, 0, 2, 3, 4, u32::MAX][draw.below(8)],
    }
}
