//! Servo period: device sample in, limited force out.
//!
//! ```text
//! F = F_n n̂ − F_t t̂ + F_vib t̂
//! ```
//!
//! with F_n = kδ − bḋ + m_eff·a_tap, F_t ≤ μ(v)·kδ and F_vib = g_vib·F_max·y\[n\]: the paper's
//! force equation, with damping added to the wall and a bristle to the friction. A tick sums the
//! stages in this order; each is a file in [`stage`](crate::stage).
//!
//! The tap, a part of F_n, comes after friction, and each flag is raised where it arises: both
//! reduce the live values. The model of the vibration is computed around the stages, not between
//! them: `Vibration::prepare` begins a tick and `Vibration::query` ends it, where few other values
//! are live (`update/`).

use crate::{
    capacity::Capacity,
    config::VibrationAxis,
    coupling::Coupling,
    events::Flags,
    quantity::{
        Quantity,
        unit::{FrictionCoefficient, MillimetrePerMetre, MillimetrePerSecond},
    },
    render_arithmetic::RenderArithmetic,
    renderer::Renderer,
    sample::{Output, Sample},
    stage::{contact::DistanceField, recursion::VibrationSample, vibration::Vibration, wall::Wall},
    state::State,
    texture::Texture,
};

/// Touched surface, without the vibration of its texture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touched<'a, A: RenderArithmetic> {
    pub(crate) field: &'a DistanceField<A>,
    pub(crate) coupling: &'a Coupling<A>,
    /// The wall of the coupling, lowered to what the device can bear.
    pub(crate) wall: Wall<A>,
}

impl<A: RenderArithmetic> Renderer<A> {
    /// Renders one servo period. Infallible: every sample yields a finite force within the limits.
    /// Its execution time varies with the sample by a few percent.
    pub fn tick<S: Capacity>(
        &self,
        texture: &Texture<S, A>,
        state: &mut State<A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        if !state.vibration.is_on(texture.id()) {
            state.change_texture(texture.id(), self.wall_of(&texture.coupling));
        }
        let fraction = || self.following.of(&texture.plan);
        state.vibration.prepare(texture, fraction);
        let touched = Touched {
            field: &self.field,
            coupling: &texture.coupling,
            wall: state.wall,
        };
        let (recursion, upsampler) = (texture.recursion(), texture.upsampler());
        let sound = |vibration: &mut Vibration<A>, sounding| {
            vibration.sound(recursion, upsampler, sounding)
        };
        let mu = |speed| texture.friction_at(speed);
        let output = self.force(touched, texture, state, sample, mu, sound);
        if state.vibration.takes_query() {
            state.wall = self.wall_of(&texture.coupling);
        }
        state.vibration.query(
            texture,
            Quantity(output.speed_mm_s),
            Quantity(output.normal_force_n),
        );
        output
    }

    /// The force equation on what is touched. `mu` gives μ at a speed; `sound` steps the vibration;
    /// its flag says whether it may be heard.
    #[inline(always)]
    pub(crate) fn force<S: Capacity>(
        &self,
        touched: Touched<'_, A>,
        texture: &Texture<S, A>,
        state: &mut State<A>,
        sample: &Sample<A>,
        mu: impl FnOnce(Quantity<A, MillimetrePerSecond>) -> Quantity<A, FrictionCoefficient>,
        sound: impl FnOnce(&mut Vibration<A>, bool) -> VibrationSample<A>,
    ) -> Output<A> {
        let Touched {
            field,
            coupling,
            wall,
        } = touched;

        // Where the stylus is, and how it moves: δ, n̂, v, t̂.
        let gated = self.gate.step(&mut state.gate, sample);
        let contact = field.step(gated.position);
        let (depth, normal) = (contact.depth(), contact.normal);
        let mut flags = gated
            .flags
            .union(Flags::CONTACT.when(depth > Quantity::ZERO));
        if gated.flags.contains(Flags::RESTART) {
            state.restart(contact.distance);
        }
        let velocity = self.velocity.step(
            &mut state.velocity,
            gated.motion,
            contact.distance - state.tap.distance(),
            gated.elapsed_ticks,
        );
        let speed = velocity.slide(normal, &mut state.direction)
            * Quantity::<A, MillimetrePerMetre>::whole(1000);
        let mu = mu(speed);

        // F_n n̂: the wall. Its spring is the load.
        let normal_force = wall.step(depth, velocity.outward);
        let load = normal_force.spring;
        flags = flags.union(Flags::OUTSIDE_GRID.when(texture.is_outside(speed, load)));

        // F_t: friction of the load.
        let friction = self
            .bristle
            .step(&mut state.friction, gated.motion, normal, load, mu);
        let friction_force = friction.direction * friction.size;

        // The tap's part of F_n.
        let tap = self
            .detector
            .step(&mut state.tap, &texture.taps, contact.distance);
        let tap_force = coupling.effective_mass * tap.acceleration;
        flags = flags.union(tap.flags);

        // F_vib t̂: the vibration, in contact only.
        let sounding =
            flags.intersection(Flags::CONTACT.union(Flags::SAFE_STATE)) == Flags::CONTACT;
        let VibrationSample { y, clamped } = sound(&mut state.vibration, sounding);
        let vibration_force = coupling.vib_mass * y;
        let axis = match self.config().vibration_axis {
            VibrationAxis::Tangent => state.direction.get(),
            VibrationAxis::Binormal => state.direction.get().cross(normal),
        };

        // The sum, lowered by the gate and limited to what the device allows.
        let total =
            normal * (normal_force.total + tap_force) + axis * vibration_force - friction_force;
        let wanted = if flags.intersects(Flags::LOWERED) {
            total * gated.gain
        } else {
            total
        };
        let (force, limited) = self.limiter.step(state.force.get(), wanted.settled());
        state.force = force.into();

        flags = flags.union(Flags::VIB_CLAMPED.when(clamped)).union(limited);
        state.counters.count(flags, sample.elapsed_ticks);
        Output {
            force_n: force.to_array(),
            depth_m: depth.0,
            speed_mm_s: speed.0,
            normal_force_n: load.0,
            vib_m_s2: y.0,
            tap_n: tap_force.0,
            friction_n: friction.size.0,
            flags: flags.seen(),
        }
    }
}
