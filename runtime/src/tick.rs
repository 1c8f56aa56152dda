//! One servo period: device sample in, limited force out.

use asperity_formats::Surface;

use crate::{
    Config, ConfigError, Counters, Flags, Texture, VibrationAxis,
    arithmetic::{
        Arithmetic, Float, Four, Number, Scalar as _, Three,
        units::{
            Acceleration, Gain, Metre, MetrePerSecond, MillimetrePerSecond, Newton, Ratio,
            STRONGEST_N, TapAcceleration, Unit,
        },
    },
    contact::Solid,
    cycle::Cycle,
    friction::{Bristle, FrictionState, Stretched},
    limiter::Limiter,
    math::{exp, max},
    safety::Gate,
    tap::{Detector, TapState},
    texture::Feel,
    velocity::{VelocityEstimator, VelocityState},
    vibration::Vibration,
    wall::{Passivity, Wall},
};

/// Below this speed the direction of motion is the last one, m/s.
const DIRECTION_FLOOR_M_S: f32 = 1.0e-4;
/// m/s to mm/s.
const MM: i32 = 1000;

/// Share of its way that a one-pole of time constant `constant` goes in a time.
fn share_after<A: Arithmetic>(time: f32, constant: f32) -> Number<A, Unit> {
    let constants = constant / time;
    Number::of(if constants > 0.0125 {
        1.0 - exp(-1.0 / constants)
    } else {
        1.0
    })
}

/// What the device says in one servo period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<A: Arithmetic = Float> {
    /// Stylus position in the world frame, m. Anything not finite, or beyond 10 km (in fixed
    /// point 1 m), is a bad sample.
    pub position_m: [A::Scalar<Metre>; 3],
    /// Servo periods since the sample before: 1 in a healthy loop, more after missed
    /// periods, 0 when the device had nothing new.
    pub elapsed_ticks: u32,
}

impl<A: Arithmetic> Sample<A> {
    /// A fresh sample of a healthy loop.
    #[must_use]
    pub const fn at(position_m: [A::Scalar<Metre>; 3]) -> Self {
        Self {
            position_m,
            elapsed_ticks: 1,
        }
    }

    /// The same in another arithmetic; what it cannot hold is no position.
    #[must_use]
    pub fn of(sample: &Sample) -> Self {
        let number = |x: f32| {
            if A::Scalar::<Metre>::holds(x) {
                A::Scalar::of(x)
            } else {
                A::Scalar::MISSING
            }
        };
        Self {
            position_m: sample.position_m.map(number),
            elapsed_ticks: sample.elapsed_ticks,
        }
    }

    /// The device had nothing new, or is lost.
    pub const STALE: Self = Self {
        position_m: [A::Scalar::MISSING; 3],
        elapsed_ticks: 0,
    };
}

/// What a tick gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output<A: Arithmetic = Float> {
    /// Force on the hand in the world frame, N; finite, within peak and slew.
    pub force_n: [A::Scalar<Newton>; 3],
    /// Depth inside the surface, m; 0 outside.
    pub depth_m: A::Scalar<Metre>,
    /// Estimated tangential speed, mm/s.
    pub speed_mm_s: A::Scalar<MillimetrePerSecond>,
    /// k·δ, N: what looks up the grid and what friction is proportional to.
    pub normal_force_n: A::Scalar<Newton>,
    /// y\[n\] before device gain, m/s².
    pub vib_m_s2: A::Scalar<Acceleration>,
    /// Tap force along the normal, N.
    pub tap_n: A::Scalar<Newton>,
    /// Magnitude of the friction force, N.
    pub friction_n: A::Scalar<Newton>,
    /// What happened.
    pub flags: Flags,
}

/// Everything that changes from tick to tick. Texture and configuration are outside
/// it, so a swap of texture copies no history. Under another renderer the wall is the new one's
/// from the next query on, at most eight samples of the models later.
#[derive(Debug, Clone, PartialEq)]
pub struct State<A: Arithmetic = Float> {
    pub(crate) vibration: Vibration<A>,
    gate: Gate<A>,
    velocity: VelocityState<A>,
    direction: Three<A, Unit>,
    tap: TapState<A>,
    friction: FrictionState<A>,
    force_n: Three<A, Newton>,
    /// What the device can bear of the texture's.
    wall: Wall<A>,
    counters: Counters,
}

impl<A: Arithmetic> State<A> {
    /// A state at rest, without force; the seed is that of the excitation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            vibration: Vibration::new(seed),
            gate: Gate::new(),
            velocity: VelocityState::REST,
            direction: Three::of(Four::whole([1, 0, 0, 0])),
            tap: TapState::IDLE,
            friction: FrictionState::default(),
            force_n: Three::ZERO,
            wall: Wall::NONE,
            counters: Counters::default(),
        }
    }

    /// How often what happened.
    #[must_use]
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Another surface is touched from here on: the way there is no motion along its normal.
    #[cold]
    pub(crate) fn cross(&mut self, solid: &Solid<A>) {
        let (distance_m, _) = solid.touch(self.gate.position_m());
        self.tap.cross(distance_m.0);
    }

    /// Another texture, on the same surface.
    #[cold]
    fn change_texture(&mut self, texture: u32, wall: Wall<A>) {
        self.vibration.change_texture(texture);
        self.wall = wall;
    }

    /// Motion starts anew: no velocity, no bristle, no impact, no sound.
    #[cold]
    fn restart(&mut self, distance_m: Number<A, Metre>) {
        self.velocity = VelocityState::REST;
        self.vibration.silence();
        self.friction = FrictionState::default();
        self.tap.restart(distance_m.0);
    }
}

/// What is touched, apart from the sound of its texture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Felt<'a, A: Arithmetic> {
    pub(crate) solid: &'a Solid<A>,
    pub(crate) feel: &'a Feel<A>,
    /// What the device can bear of the feel's.
    pub(crate) wall: Wall<A>,
}

/// A checked configuration with all that follows from it.
#[derive(Debug, Clone)]
pub struct Renderer<A: Arithmetic = Float> {
    config: Config,
    solid: Solid<A>,
    velocity: VelocityEstimator<A>,
    limiter: Limiter<A>,
    bristle: Bristle<A>,
    passivity: Passivity<A>,
    detector: Detector<A>,
    /// Shares of the way that parameters go in a cycle, by ticks a sample and kind of cycle.
    follow_shares: [[Number<A, Unit>; Cycle::KINDS]; 32],
    /// Share of the way that wall, gains and friction go in a tick, to another texture.
    pub(crate) texture_share: Number<A, Unit>,
    ramp_step: Number<A, Gain>,
}

impl Renderer {
    /// Checks a configuration and prepares it.
    ///
    /// # Errors
    /// The first field out of its range.
    pub fn new(config: &Config) -> Result<Self, ConfigError> {
        Self::prepare(config)
    }
}

impl<A: Arithmetic> Renderer<A> {
    /// [`Renderer::new`] for any arithmetic.
    ///
    /// # Errors
    /// The first field out of its range, or out of that of the arithmetic.
    pub fn prepare(config: &Config) -> Result<Self, ConfigError> {
        config.check()?;
        A::check_config(config)?;
        let rate = config.servo_rate_hz;
        let ticks = config.parameter_time_constant_s * rate;
        let [plane, normal] = [config.velocity_cutoff_hz, config.normal_cutoff_hz];
        Ok(Self {
            config: Config {
                surface: config.surface.normalised(),
                ..config.clone()
            },
            solid: Solid::new(&config.surface),
            velocity: VelocityEstimator::new([plane, plane, plane, normal], rate),
            limiter: Limiter::new(&config.limits, rate),
            bristle: Bristle::new(&config.friction, config.mechanics.delay_ticks, rate),
            passivity: Passivity::new(&config.mechanics, rate),
            detector: Detector::new(&config.tap, rate),
            follow_shares: core::array::from_fn(|per_sample| {
                let mut shares = [Number::ZERO; Cycle::KINDS];
                for cycle in Cycle::ALL {
                    let cycle_ticks = usize::from(cycle.ticks()) * per_sample.max(1);
                    shares[cycle.kind()] = share_after(cycle_ticks as f32, ticks);
                }
                shares
            }),
            texture_share: share_after(1.0, ticks),
            ramp_step: Number::of(1.0 / max(config.safety.ramp_s * rate, 1.0)),
        })
    }

    /// The configuration.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// Share of the way that parameters go in a cycle, at so many ticks a sample.
    #[inline(always)]
    pub(crate) fn follow_share(&self, ticks_per_sample: u8, cycle: Cycle) -> Number<A, Unit> {
        self.follow_shares[usize::from(ticks_per_sample % 32)][cycle.kind()]
    }

    /// What the device can bear of a wall.
    #[inline(always)]
    pub(crate) fn wall_of(&self, feel: &Feel<A>) -> Wall<A> {
        let (stiffness_n_m, damping_n_s_m) = (feel.stiffness_n_m, feel.damping_n_s_m);
        self.passivity.wall(stiffness_n_m.0, damping_n_s_m.0)
    }

    /// What is touched.
    pub(crate) const fn solid(&self) -> &Solid<A> {
        &self.solid
    }

    /// The wall that is rendered for an asset's: as the asset says where the device can bear
    /// it.
    #[inline]
    #[must_use]
    pub fn wall(&self, surface: &Surface) -> Wall<A> {
        let damping_n_s_m = A::Scalar::of(surface.damping_n_s_m);
        self.passivity
            .wall(A::Scalar::of(surface.stiffness_n_m), damping_n_s_m)
    }

    /// One servo period. Infallible: every sample gives a finite force within the
    /// limits. The work hardly depends on the sample: a few instructions in a hundred.
    ///
    /// `F = F_n n̂ − F_t t̂ + F_vib t̂` with F_n = kδ − bḋ + m_eff·a_tap and
    /// F_vib = g_vib·y\[n\]·F_max.
    pub fn tick<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>(
        &self,
        texture: &Texture<V, T, P, Q, K, A>,
        state: &mut State<A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        if !state.vibration.is_on(texture.id()) {
            state.change_texture(texture.id(), self.wall_of(&texture.feel));
        }
        let follow_share = |ticks, cycle| self.follow_share(ticks, cycle);
        state.vibration.prepare(texture, follow_share);
        let felt = Felt {
            solid: &self.solid,
            feel: &texture.feel,
            wall: state.wall,
        };
        let (lags, interpolator) = (texture.lags(), texture.interpolator());
        let sound =
            |vibration: &mut Vibration<A>, sounding| vibration.sound(lags, interpolator, sounding);
        let output = self.tick_on(felt, texture, state, sample, sound);
        if state.vibration.takes_query() {
            state.wall = self.wall_of(&texture.feel);
            let (speed_mm_s, force_n) = (output.speed_mm_s, output.normal_force_n);
            let vibration = &mut state.vibration;
            vibration.query(texture, Number(speed_mm_s), Number(force_n));
        }
        output
    }

    /// [`Renderer::tick`] on a solid, with wall, gains and friction as given; `sound` gives the
    /// vibration, told whether it is to be heard. Its parameters are made around this, where
    /// little else is at hand.
    #[inline(always)]
    pub(crate) fn tick_on<
        const V: usize,
        const T: usize,
        const P: usize,
        const Q: usize,
        const K: usize,
    >(
        &self,
        felt: Felt<'_, A>,
        texture: &Texture<V, T, P, Q, K, A>,
        state: &mut State<A>,
        sample: &Sample<A>,
        sound: impl FnOnce(&mut Vibration<A>, bool) -> (Number<A, Acceleration>, bool),
    ) -> Output<A> {
        let config = &self.config;
        let feel = felt.feel;

        let gated = state
            .gate
            .step(sample, config.safety.hold_ticks, self.ramp_step.0);
        let mut flags = gated.flags;
        let (distance_m, normal) = felt.solid.touch(gated.position_m);
        if flags.contains(Flags::RESTART) {
            state.restart(distance_m);
        }

        let motion_m = gated.motion_m;
        let motions_m = motion_m.with_fourth(distance_m - state.tap.distance_m());
        let (filters, elapsed_ticks) = (&self.velocity, gated.elapsed_ticks);
        let velocity_m_s = filters.advance(&mut state.velocity, motions_m, elapsed_ticks);
        let outward_m_s: Number<A, MetrePerSecond> = velocity_m_s.fourth();

        let depth_m = (-distance_m).max(Number::ZERO);
        let touching = depth_m > Number::ZERO;
        flags = flags.and(Flags::CONTACT.when(touching));
        let wall = felt.wall;
        let stiffness_n = wall.spring_n(depth_m);

        // The deflection waits for motion alone, not for velocities.
        let moved_m = state.friction.moved(motion_m).tangential(normal);
        let slide_m_s = velocity_m_s.first_three().tangential(normal);
        let [polar, sliding] = A::polar_pair(moved_m.0, slide_m_s.0);
        let stretched = Stretched { moved_m, polar };
        let speed_m_s = Number::<A, MetrePerSecond>(A::length(sliding));
        if speed_m_s > Number::of(DIRECTION_FLOOR_M_S) {
            state.direction = Three::of(slide_m_s.direction(sliding));
        }
        let speed_mm_s = speed_m_s.times(Number::<A, Ratio>::whole(MM));
        let outside = texture.is_outside(speed_mm_s, stiffness_n);
        flags = flags.and(Flags::OUTSIDE_GRID.when(outside));
        let limit_n = feel.mu.times(stiffness_n);
        let (along, friction_n) =
            state
                .friction
                .slip(&self.bristle, stretched, motion_m, stiffness_n, limit_n);

        let tap = state.tap.step(&texture.taps, distance_m.0, &self.detector);
        flags = flags.and(tap.flags);
        let tap_m_s2 = Number::<A, TapAcceleration>(tap.accel_m_s2);
        let tap_n = feel.effective_mass_kg.times_within(tap_m_s2, STRONGEST_N);

        let sounding = flags.of(Flags::CONTACT.and(Flags::SAFE_STATE)) == Flags::CONTACT;
        let (vib_m_s2, clamped) = sound(&mut state.vibration, sounding);
        if clamped {
            flags = flags.and(Flags::VIB_CLAMPED);
        }

        let pushing_n = Number::<A, Newton>(wall.force_n(stiffness_n.0, outward_m_s.0));
        let normal_n: Number<A, Newton> = pushing_n + tap_n;
        let axis = match config.vibration_axis {
            VibrationAxis::Tangent => state.direction.four(),
            VibrationAxis::Binormal => state.direction.four().cross(normal),
        };
        let vib_n: Number<A, Newton> = feel.gain_kg.times_within(vib_m_s2, STRONGEST_N);
        let friction: Four<A, Newton> = along.scaled(friction_n);
        // What is known last comes last.
        let total_n = normal.scaled(normal_n) + axis.scaled(vib_n) - friction;
        let wanted_n = if flags.meets(Flags::LOWERED) {
            total_n.scaled(gated.gain)
        } else {
            total_n
        };
        let (force_n, limited) = self.limiter.advance(state.force_n.four(), wanted_n);
        state.force_n = Three::of(force_n);
        flags = flags.and(limited);

        state.counters.count(flags, sample.elapsed_ticks);
        Output {
            force_n: force_n.xyz(),
            depth_m: depth_m.0,
            speed_mm_s: speed_mm_s.0,
            normal_force_n: stiffness_n.0,
            vib_m_s2: vib_m_s2.0,
            tap_n: tap_n.0,
            friction_n: friction_n.0,
            flags: flags.seen(),
        }
    }
}
