//! Changing the texture while the servo loop runs. A slot is prepared outside the loop and handed
//! over through a lock-free queue. The old slot comes back through another one.
//!
//! An [`Exchange`] has two halves. [`Preparer`] belongs to whoever loads textures: it fills a spare
//! slot and sends it. [`Player`] belongs to the servo loop: it looks for a slot once a tick, and
//! neither waits nor allocates. From one texture to the next, wall, gains and friction follow
//! within the time constant of the parameters, and the old vibration goes on until the new model is
//! made, as between the surfaces of a [`scene`](crate::scene). A slot waits in the queue while a
//! tap plays, because the tap would go on with other traces, and while the previous change is still
//! under way. Velocity, bristle and noise go on as they were.

use crate::{
    arithmetic::Float,
    capacity::{Capacity, HostCapacities},
    events::Flags,
    load_error::LoadError,
    render_arithmetic::RenderArithmetic,
    renderer::Renderer,
    sample::{Output, Sample},
    state::State,
    texture::Texture,
    texture_change::TextureChange,
};
use asperity_formats::Asset;
use core::mem::MaybeUninit;
use heapless::spsc::{Consumer, Producer, Queue};
use thiserror::Error;

/// The most spare slots beside the one that plays.
pub const MAX_SPARE: usize = 3;
/// A queue holds one less than its room.
const ROOM: usize = MAX_SPARE + 1;

type Slot<'a, S, A> = &'a mut Texture<S, A>;
type Incoming<'q, 'a, S, A> = Consumer<'q, Slot<'a, S, A>>;
type Outgoing<'q, 'a, S, A> = Producer<'q, Slot<'a, S, A>>;

/// The queues between both halves.
#[derive(Default)]
pub struct Exchange<'a, S: Capacity = HostCapacities, A: RenderArithmetic = Float> {
    ready: Queue<Slot<'a, S, A>, ROOM>,
    spare: Queue<Slot<'a, S, A>, ROOM>,
}

impl<'a, S: Capacity, A: RenderArithmetic> Exchange<'a, S, A> {
    /// Empty queues.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            ready: Queue::new(),
            spare: Queue::new(),
        }
    }

    /// Both halves: the first slot plays from the first tick on, the others are spare. `seed` seeds
    /// the excitation. More than [`MAX_SPARE`] spare slots do not compile.
    pub fn split<const N: usize>(
        &mut self,
        playing: Slot<'a, S, A>,
        spare: [Slot<'a, S, A>; N],
        seed: u64,
    ) -> (Preparer<'_, 'a, S, A>, Player<'_, 'a, S, A>) {
        let (preparer, ready, returned) = self.queues(spare);
        (preparer, Player::new(playing, ready, returned, seed))
    }

    /// [`Exchange::split`] with the player, which holds a [`State`], in memory of the caller's. That
    /// takes less stack.
    #[inline(never)]
    pub fn split_in<'q, 'm, const N: usize>(
        &'q mut self,
        memory: &'m mut MaybeUninit<Player<'q, 'a, S, A>>,
        playing: Slot<'a, S, A>,
        spare: [Slot<'a, S, A>; N],
        seed: u64,
    ) -> (Preparer<'q, 'a, S, A>, &'m mut Player<'q, 'a, S, A>) {
        let (preparer, ready, returned) = self.queues(spare);
        let player = memory.write(Player::new(playing, ready, returned, seed));
        (preparer, player)
    }

    /// The preparer, and the player's ends of the queues.
    #[inline(always)]
    fn queues<'q, const N: usize>(
        &'q mut self,
        spare: [Slot<'a, S, A>; N],
    ) -> (
        Preparer<'q, 'a, S, A>,
        Incoming<'q, 'a, S, A>,
        Outgoing<'q, 'a, S, A>,
    ) {
        const { assert!(N <= MAX_SPARE) };
        *self = Self::new();
        let (to_player, ready) = self.ready.split();
        let (mut to_preparer, returned) = self.spare.split();
        for slot in spare {
            // An empty queue has room for them.
            let _ = to_preparer.enqueue(slot);
        }
        let preparer = Preparer {
            spare: None,
            returned,
            ready: to_player,
        };
        (preparer, ready, to_preparer)
    }
}

/// Why a texture was not handed over.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// Every spare slot is on its way; the servo loop hands one back within some ticks, or
    /// after a tap.
    #[error("no slot is spare yet: try again when the servo loop has handed one back")]
    NoneSpare,
    /// The slot refused the texture.
    #[error(transparent)]
    Load(#[from] LoadError),
}

/// The half that loads textures, outside the servo loop.
pub struct Preparer<'q, 'a, S: Capacity = HostCapacities, A: RenderArithmetic = Float> {
    /// A slot that was taken back but not filled.
    spare: Option<Slot<'a, S, A>>,
    returned: Consumer<'q, Slot<'a, S, A>>,
    ready: Producer<'q, Slot<'a, S, A>>,
}

impl<'a, S: Capacity, A: RenderArithmetic> Preparer<'_, 'a, S, A> {
    /// Prepares a validated asset in a spare slot and sends it to the servo loop. Textures play in
    /// the order in which they were sent.
    ///
    /// # Errors
    /// [`PrepareError`]; nothing is sent then.
    pub fn prepare(&mut self, asset: &Asset<'_>, servo_rate_hz: f32) -> Result<(), PrepareError> {
        self.send(|slot| slot.load(asset, servo_rate_hz))
    }

    /// [`Preparer::prepare`] of bytes, as [`Texture::load_haptic`] loads them.
    ///
    /// # Errors
    /// [`PrepareError`]; nothing is sent then.
    pub fn prepare_haptic(&mut self, bytes: &[u8], servo_rate_hz: f32) -> Result<(), PrepareError> {
        self.send(|slot| slot.load_haptic(bytes, servo_rate_hz))
    }

    fn send(
        &mut self,
        load: impl FnOnce(&mut Texture<S, A>) -> Result<(), LoadError>,
    ) -> Result<(), PrepareError> {
        let spare = self.spare.take().or_else(|| self.returned.dequeue());
        let slot = spare.ok_or(PrepareError::NoneSpare)?;
        match load(slot) {
            Ok(()) => {
                // The queue has room for every slot. A slot without room would be kept.
                self.spare = self.ready.enqueue(slot).err();
                Ok(())
            }
            Err(cause) => {
                self.spare = Some(slot);
                Err(cause.into())
            }
        }
    }
}

/// The half of the servo loop: the texture that plays, and everything that changes from tick to
/// tick.
pub struct Player<'q, 'a, S: Capacity = HostCapacities, A: RenderArithmetic = Float> {
    playing: Slot<'a, S, A>,
    ready: Consumer<'q, Slot<'a, S, A>>,
    returned: Producer<'q, Slot<'a, S, A>>,
    state: State<A>,
    crossing: TextureChange<A>,
    /// True if a tap played in the last tick.
    tapping: bool,
}

impl<'q, 'a, S: Capacity, A: RenderArithmetic> Player<'q, 'a, S, A> {
    #[inline(always)]
    fn new(
        playing: Slot<'a, S, A>,
        ready: Incoming<'q, 'a, S, A>,
        returned: Outgoing<'q, 'a, S, A>,
        seed: u64,
    ) -> Self {
        Self {
            playing,
            ready,
            returned,
            state: State::new(seed),
            crossing: TextureChange::START,
            tapping: false,
        }
    }

    /// The texture that plays, or is on its way in.
    #[must_use]
    pub fn texture(&self) -> &Texture<S, A> {
        self.playing
    }

    /// The state of the tick.
    #[must_use]
    pub const fn state(&self) -> &State<A> {
        &self.state
    }

    /// Takes the next slot, if there is one and it may begin.
    #[inline]
    fn poll(&mut self) {
        if self.tapping || self.crossing.is_under_way() || !self.returned.ready() {
            return;
        }
        if let Some(next) = self.ready.dequeue() {
            let before = core::mem::replace(&mut self.playing, next);
            // There is room, as `ready` said above.
            let _ = self.returned.enqueue(before);
        }
    }
}

impl<A: RenderArithmetic> Renderer<A> {
    /// Renders one servo period of a [`Player`]: polls for another texture, then does
    /// [`Renderer::tick`]. Infallible.
    pub fn tick_player<S: Capacity>(
        &self,
        player: &mut Player<'_, '_, S, A>,
        sample: &Sample<A>,
    ) -> Output<A> {
        player.poll();
        let texture = &*player.playing;
        let output = self.tick_crossing(
            &self.field,
            texture,
            &mut player.crossing,
            &mut player.state,
            sample,
        );
        player.tapping = output.flags.contains(Flags::TAP_ACTIVE);
        output
    }
}
