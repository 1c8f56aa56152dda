//! Everything that changes from tick to tick.

use crate::{
    arithmetic::Float,
    events::Counters,
    quantity::{
        Quantity, StoredVector, Vector,
        unit::{Fraction, Metre, Newton},
    },
    render_arithmetic::RenderArithmetic,
    stage::{
        contact::DistanceField, contact_law::ContactState, direction::Heading,
        friction::FrictionState, passivity::Lowered, sample_gate::GateState, tap::TapState,
        velocity::VelocityState, vibration::Vibration,
    },
};
use core::mem::MaybeUninit;

/// Everything that changes from tick to tick. Texture and configuration are outside it, so a swap
/// of texture copies no history. If another renderer takes over a state, its own wall is rendered
/// from the next query on, at most eight samples of the models later.
#[derive(Debug, Clone, PartialEq)]
pub struct State<A: RenderArithmetic = Float> {
    pub(crate) vibration: Vibration<A>,
    pub(crate) gate: GateState<A>,
    pub(crate) velocity: VelocityState<A>,
    /// Direction t̂ of the last motion in the tangent plane.
    pub(crate) direction: StoredVector<A, Fraction>,
    /// What it makes of speed, level and μ, where the texture has an axis.
    pub(crate) heading: Heading<A>,
    pub(crate) tap: TapState<A>,
    pub(crate) friction: FrictionState<A>,
    /// What the surface remembers, where it gives way.
    pub(crate) contact: ContactState<A>,
    /// The last force, N.
    pub(crate) force: StoredVector<A, Newton>,
    /// Wall and contact law of the texture, lowered to what the device can bear.
    pub(crate) lowered: Lowered<A>,
    pub(crate) counters: Counters,
}

impl<A: RenderArithmetic> State<A> {
    /// A state at rest, without force. `seed` seeds the excitation.
    #[inline]
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            vibration: Vibration::new(seed),
            gate: GateState::new(),
            velocity: VelocityState::REST,
            direction: Vector::whole([1, 0, 0]).into(),
            heading: Heading::none(),
            tap: TapState::IDLE,
            friction: FrictionState::default(),
            contact: ContactState::UNTOUCHED,
            force: StoredVector::ZERO,
            lowered: Lowered::NONE,
            counters: Counters::default(),
        }
    }

    /// [`State::new`] in memory of the caller's, which takes less stack.
    #[inline(never)]
    pub fn init(memory: &mut MaybeUninit<Self>, seed: u64) -> &mut Self {
        memory.write(Self::new(seed))
    }

    /// Counts of what happened since the state was made.
    #[must_use]
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Another surface is touched from here on. The change of distance is no motion along its
    /// normal.
    #[cold]
    pub(crate) fn cross(&mut self, field: &DistanceField<A>) {
        let contact = field.step(self.gate.position());
        self.tap.cross(contact.distance);
        self.contact = ContactState::UNTOUCHED;
        self.heading = Heading::none();
    }

    /// Changes to another texture on the same solid.
    #[cold]
    pub(crate) fn change_texture(&mut self, texture: u32) {
        self.vibration.change_texture(texture);
        self.contact = ContactState::UNTOUCHED;
    }

    /// Motion starts anew: no velocity, no bristle, no impact, no sound.
    #[cold]
    pub(crate) fn restart(&mut self, distance: Quantity<A, Metre>) {
        self.velocity = VelocityState::REST;
        self.vibration.silence();
        self.friction = FrictionState::default();
        self.contact = ContactState::UNTOUCHED;
        self.tap.restart(distance);
    }
}
