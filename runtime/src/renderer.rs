//! A checked configuration with all that follows from it.

use crate::{
    arithmetic::Float,
    config::{Config, ConfigError},
    coupling::Coupling,
    math::rounds_to_nearest,
    quantity::{Quantity, unit::Fraction},
    render_arithmetic::RenderArithmetic,
    stage::{
        contact::{DistanceField, unit},
        contact_law::ContactLaw,
        friction::Bristle,
        limiter::Limiter,
        passivity::{Lowered, Passivity},
        sample_gate::Gate,
        tap::impact::Detector,
        velocity::VelocityEstimator,
        wall::Wall,
    },
    state::State,
    update::following::{Following, fraction_after},
};
use asperity_formats::{self as formats, Solid};
use core::mem::MaybeUninit;

/// A checked configuration with all that follows from it.
#[derive(Debug, Clone)]
pub struct Renderer<A: RenderArithmetic = Float> {
    config: Config,
    pub(crate) gate: Gate<A>,
    pub(crate) field: DistanceField<A>,
    pub(crate) velocity: VelocityEstimator<A>,
    pub(crate) bristle: Bristle<A>,
    pub(crate) detector: Detector<A>,
    pub(crate) passivity: Passivity<A>,
    pub(crate) limiter: Limiter<A>,
    /// The fraction of its way that a line spectrum goes in a cycle.
    pub(crate) following: Following<A>,
    /// The fraction of their way to another texture that wall, gains and friction go in a tick.
    pub(crate) coupling_fraction: Quantity<A, Fraction>,
}

impl Renderer {
    /// Checks a configuration and prepares it.
    ///
    /// # Errors
    /// The first field out of its range, or [`ConfigError::ROUNDING`].
    pub fn new(config: &Config) -> Result<Self, ConfigError> {
        Self::prepare(config)
    }
}

impl<A: RenderArithmetic> Renderer<A> {
    /// [`Renderer::new`] for any arithmetic.
    ///
    /// # Errors
    /// The first field outside its range or the range of the arithmetic, or
    /// [`ConfigError::ROUNDING`].
    pub fn prepare(config: &Config) -> Result<Self, ConfigError> {
        check::<A>(config)?;
        Ok(Self::of(config))
    }

    /// [`Renderer::prepare`] in memory of the caller's, which takes less stack.
    ///
    /// # Errors
    /// As [`Renderer::prepare`]; nothing is written then.
    #[inline(never)]
    pub fn prepare_in<'m>(
        memory: &'m mut MaybeUninit<Self>,
        config: &Config,
    ) -> Result<&'m mut Self, ConfigError> {
        check::<A>(config)?;
        Ok(memory.write(Self::of(config)))
    }

    #[inline(always)]
    fn of(config: &Config) -> Self {
        let rate_hz = config.servo_rate_hz;
        let constant_ticks = config.parameter_time_constant_s * rate_hz;
        let delay_ticks = config.mechanics.delay_ticks;
        Self {
            config: Config {
                solid: normalised(config.solid),
                ..config.clone()
            },
            gate: Gate::new(&config.safety, rate_hz),
            field: DistanceField::new(&config.solid),
            velocity: VelocityEstimator::new(
                config.velocity_cutoff_hz,
                config.normal_cutoff_hz,
                rate_hz,
            ),
            bristle: Bristle::new(&config.friction, delay_ticks, rate_hz),
            detector: Detector::new(&config.tap, rate_hz),
            passivity: Passivity::new(&config.mechanics, config.limits.peak_n, rate_hz),
            limiter: Limiter::new(&config.limits, rate_hz),
            following: Following::new(constant_ticks),
            coupling_fraction: Quantity::of(fraction_after(1.0, constant_ticks)),
        }
    }

    /// The configuration. The normal of a plane has unit length.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// The wall that is rendered where an asset asks for this one: the same where the device can
    /// bear it, else a lowered one.
    #[inline]
    #[must_use]
    pub fn wall(&self, coupling: &formats::Coupling) -> Wall<A> {
        let asked = Wall::of(coupling.stiffness_n_m, coupling.damping_n_s_m);
        self.passivity.bear(asked)
    }

    /// The parts of a contact law that are rendered on the wall of an asset: the same where the device
    /// can bear them, else lowered ones.
    #[must_use]
    pub fn contact_law(
        &self,
        coupling: &formats::Coupling,
        law: &formats::ContactLaw<'_>,
    ) -> Lowered<A> {
        let mut prepared = ContactLaw::NONE;
        prepared.load(Some(law), self.config.servo_rate_hz);
        prepared.lowered(&self.passivity, self.wall(coupling))
    }

    /// Takes a wall, and the contact law on it, lowered to what the device can bear.
    #[inline(always)]
    pub(crate) fn lower(
        &self,
        coupling: &Coupling<A>,
        law: Option<&ContactLaw<A>>,
        state: &mut State<A>,
    ) {
        state.lowered.wall = self.passivity.bear(coupling.wall);
        if let Some(law) = law {
            self.lower_law(law, state);
        }
    }

    #[cold]
    #[inline(never)]
    fn lower_law(&self, law: &ContactLaw<A>, state: &mut State<A>) {
        state.lowered = law.lowered(&self.passivity, state.lowered.wall);
    }
}

/// A function of its own, so that its stack is free again when the renderer is made.
#[inline(never)]
fn check<A: RenderArithmetic>(config: &Config) -> Result<(), ConfigError> {
    if !rounds_to_nearest() {
        return Err(ConfigError::ROUNDING);
    }
    config.check()?;
    A::check_config(config)
}

/// The solid, with the normal of a plane at unit length.
fn normalised(solid: Solid) -> Solid {
    match solid {
        Solid::Plane { point_m, normal } => Solid::Plane {
            point_m,
            normal: unit(normal),
        },
        other => other,
    }
}
