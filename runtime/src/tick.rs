//! Servo period: device sample in, limited force out.
//!
//! ```text
//! F = F_n n̂ − F_t t̂ + F_vib t̂
//! ```
//!
//! with F_n = kδ − bḋ + m_eff·a_tap, F_t ≤ μ(v)·kδ (or what a [contact law](crate::stage::contact_law)
//! makes of both) and F_vib = g_vib·F_max·y\[n\]: the paper's
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
        Quantity, Vector,
        unit::{
            Fraction, FrictionCoefficient, FrictionFactor, MillimetrePerMetre, MillimetrePerSecond,
        },
    },
    render_arithmetic::RenderArithmetic,
    renderer::Renderer,
    sample::{Output, Sample},
    stage::{
        contact::DistanceField,
        contact_law::{ContactLaw, Pressing, SurfaceForce},
        recursion::VibrationSample,
        vibration::Vibration,
        wall::NormalForce,
    },
    state::State,
    texture::Texture,
};

/// Touched surface, without the vibration of its texture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touched<'a, S: Capacity, A: RenderArithmetic> {
    pub(crate) texture: &'a Texture<S, A>,
    pub(crate) field: &'a DistanceField<A>,
    pub(crate) coupling: &'a Coupling<A>,
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
            self.change_texture(texture, state);
        }
        let fraction = || self.following.of(&texture.plan);
        let gain = || state.heading.level;
        state.vibration.prepare(texture, fraction, gain);
        let touched = Touched {
            texture,
            field: &self.field,
            coupling: &texture.coupling,
        };
        let (recursion, upsampler) = (texture.recursion(), texture.upsampler());
        let sound = |vibration: &mut Vibration<A>, sounding| {
            vibration.sound(recursion, upsampler, sounding)
        };
        let across = texture.coupling.mu;
        let mu = |factor: Option<_>| factor.map_or(across, |factor| across * factor);
        let output = self.force(touched, state, sample, mu, |force| force, sound);
        if state.vibration.takes_query() {
            self.lower(&texture.coupling, texture.contact_law(), state);
        }
        Self::query(texture, state, &output);
        output
    }

    /// Ends a tick: asks for the model of a stroke, where a query is due.
    #[inline(always)]
    pub(crate) fn query<S: Capacity>(
        texture: &Texture<S, A>,
        state: &mut State<A>,
        output: &Output<A>,
    ) {
        let speed = Quantity::<A, MillimetrePerSecond>(output.speed_mm_s) * state.heading.speed;
        state.vibration.query(
            texture,
            speed + state.contact.crunch,
            Quantity(output.normal_force_n),
        );
    }

    /// [`State::change_texture`], and what the device bears of the new one.
    #[cold]
    #[inline(never)]
    fn change_texture<S: Capacity>(&self, texture: &Texture<S, A>, state: &mut State<A>) {
        state.change_texture(texture.id());
        self.lower(&texture.coupling, texture.contact_law(), state);
    }

    /// The forces of a contact law: a function of its own, so that a tick without one keeps its
    /// registers.
    #[cold]
    #[inline(never)]
    fn give_way(
        &self,
        law: &ContactLaw<A>,
        state: &mut State<A>,
        tip: &Pressing<A>,
    ) -> SurfaceForce<A> {
        if law.heals() {
            let lengths = self
                .bristle
                .lengths(&state.friction, tip.motion, tip.normal);
            law.heal(&mut state.contact, lengths, |length| {
                self.bristle.force(length)
            });
        }
        law.step(
            &state.lowered,
            self.passivity.period(),
            &mut state.contact,
            tip,
        )
    }

    /// The factor of μ at a speed and in the direction of the stroke, where μ depends on either.
    #[inline(always)]
    fn friction_factor<S: Capacity>(
        &self,
        texture: &Texture<S, A>,
        state: &mut State<A>,
        speed: Quantity<A, MillimetrePerSecond>,
        normal: Vector<A, Fraction>,
    ) -> Option<Quantity<A, FrictionFactor>> {
        let Some(axis) = texture.axis() else {
            return Some(texture.law.factor(speed));
        };
        if state.vibration.takes_query() {
            axis.turn(&mut state.heading, state.direction.get(), normal);
        }
        let in_direction = state.heading.follow(self.coupling_fraction);
        Some(if texture.law.is_some() {
            texture.law.factor(speed) * in_direction
        } else {
            Quantity::<A, FrictionFactor>::whole(1) * in_direction
        })
    }

    /// The force equation on what is touched. `mu` gives μ with its factor; `mix` adds what remains of
    /// another surface; `sound` steps the vibration, and its flag says whether it may be heard.
    #[inline(always)]
    pub(crate) fn force<S: Capacity>(
        &self,
        touched: Touched<'_, S, A>,
        state: &mut State<A>,
        sample: &Sample<A>,
        mu: impl FnOnce(Option<Quantity<A, FrictionFactor>>) -> Quantity<A, FrictionCoefficient>,
        mix: impl FnOnce(SurfaceForce<A>) -> SurfaceForce<A>,
        sound: impl FnOnce(&mut Vibration<A>, bool) -> VibrationSample<A>,
    ) -> Output<A> {
        let Touched {
            texture,
            field,
            coupling,
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
        let slide = velocity.slide(normal, &mut state.direction);
        let speed = slide * Quantity::<A, MillimetrePerMetre>::whole(1000);
        let mu = mu(if texture.mu_varies() {
            self.friction_factor(texture, state, speed, normal)
        } else {
            None
        });

        // F_n n̂: the wall, or a contact law in its place. Its elastic part is the load.
        let surface = if let Some(law) = texture.contact_law() {
            let tip = Pressing {
                before: (-state.tap.distance()).max(Quantity::ZERO),
                depth,
                outward: velocity.outward,
                motion: gated.motion,
                normal,
                speed: slide,
                mu,
                elapsed_ticks: gated.elapsed_ticks,
            };
            self.give_way(law, state, &tip)
        } else {
            let NormalForce { spring, total } = state.lowered.wall.step(depth, velocity.outward);
            SurfaceForce {
                load: spring,
                total,
                grip: spring,
                limit: mu * spring,
            }
        };
        let SurfaceForce {
            load,
            total,
            grip,
            limit,
        } = mix(surface);
        flags = flags.union(Flags::OUTSIDE_GRID.when(texture.is_outside(speed, load)));

        // F_t: friction of the load, and drag.
        let friction = self
            .bristle
            .step(&mut state.friction, gated.motion, normal, grip, limit);
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
        let sum = normal * (total + tap_force) + axis * vibration_force - friction_force;
        let wanted = if flags.intersects(Flags::LOWERED) {
            sum * gated.gain
        } else {
            sum
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
