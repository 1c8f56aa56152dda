//! Another texture while the servo loop runs.

use crate::{
    AsperityCounters, AsperityError, AsperityOutput, AsperityRenderer, AsperitySample,
    AsperityStatus,
    arithmetic::{Numbered, by_arithmetic},
    capacity::{Class, by_capacity, by_kind},
    library::{asset_at, asset_called, name, slice},
    memory::{Object, Tag, exclusive, room, shared, tag, uninit, write},
    renderer::RendererOf,
    sized,
    status::{Fault, call},
    texture::empty,
    tick::{rendered, same_rate},
};
use asperity_runtime::{Exchange, Player, Preparer, Sample, Texture, exchange::MAX_SPARE};
use core::{
    ffi::{c_char, c_void},
    ptr,
};

/// Size of the memory of an exchange without its slots, bytes. The slot that plays and each spare
/// one add `ASPERITY_TEXTURE_SIZE_*`.
pub const ASPERITY_EXCHANGE_SIZE: usize = 4096;
/// Largest number of spare slots.
pub const ASPERITY_EXCHANGE_SPARE: u32 = 3;

const _: () = assert!(ASPERITY_EXCHANGE_SPARE as usize == MAX_SPARE);

/// The half of an exchange that loads textures, outside of the servo loop. One thread at a time may
/// use it, also while another one uses the player.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityPreparer {
    tag: Tag,
}

/// The half of an exchange that the servo loop plays. One thread at a time may use it, also while
/// another one uses the preparer.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityPlayer {
    tag: Tag,
}

/// Object behind an `AsperityPreparer` pointer.
#[repr(C, align(64))]
struct PreparerOf<S: Class, A: Numbered> {
    tag: Tag,
    /// Address at which it was initialised.
    home: usize,
    servo_rate_hz: f32,
    preparer: Preparer<'static, 'static, S, A>,
}

/// Object behind an `AsperityPlayer` pointer.
#[repr(C, align(64))]
struct PlayerOf<S: Class, A: Numbered> {
    tag: Tag,
    /// Address at which it was initialised.
    home: usize,
    servo_rate_hz: f32,
    player: Player<'static, 'static, S, A>,
}

/// The memory of an exchange; its slots lie behind it, so it cannot be moved.
#[repr(C)]
struct Both<S: Class, A: Numbered> {
    queues: Exchange<'static, S, A>,
    preparer: PreparerOf<S, A>,
    player: PlayerOf<S, A>,
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<S: Class, A: Numbered> Object for PreparerOf<S, A> {
    const TAG: Tag = Tag::new(b'E', A::NUMBER, S::NUMBER);

    fn is_in_place(&self) -> bool {
        self.home == ptr::from_ref(self).addr()
    }
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<S: Class, A: Numbered> Object for PlayerOf<S, A> {
    const TAG: Tag = Tag::new(b'P', A::NUMBER, S::NUMBER);

    fn is_in_place(&self) -> bool {
        self.home == ptr::from_ref(self).addr()
    }
}

/// Bytes of an exchange.
const fn bytes(spare: u32, slot: usize) -> Result<usize, AsperityStatus> {
    if spare == 0 || spare > ASPERITY_EXCHANGE_SPARE {
        return Err(AsperityStatus::Argument);
    }
    Ok(ASPERITY_EXCHANGE_SIZE + (spare as usize + 1) * slot)
}

/// Bytes of memory that `asperity_exchange_init` needs: `ASPERITY_EXCHANGE_SIZE` and
/// `ASPERITY_TEXTURE_SIZE_*` for `spare + 1` slots.
///
/// # Safety
/// `size` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_exchange_size(
    capacity: u32,
    spare: u32,
    size: *mut usize,
) -> AsperityStatus {
    // SAFETY: the caller's promise; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_capacity!(capacity, S => {
                Ok(write(size, bytes(spare, S::SIZE)?)?)
            }, else AsperityStatus::Argument)
        })
    }
}

/// Makes an exchange with an empty slot that plays and 1 to `ASPERITY_EXCHANGE_SPARE` spare ones of
/// `capacity` (`ASPERITY_CAPACITY_*`), in `memory` of at least as many bytes as
/// `asperity_exchange_size` says, for the servo rate and the arithmetic of a renderer. The memory
/// must not be copied elsewhere: a copy is refused as not initialised. `seed` selects the noise of
/// the excitation. Until a texture is loaded there is no force. One spare slot is enough; with two,
/// a texture can be prepared while another one is on its way.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
/// renderer; `preparer` and `player` are null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_exchange_init(
    memory: *mut c_void,
    size: usize,
    renderer: *const AsperityRenderer,
    capacity: u32,
    spare: u32,
    seed: u64,
    preparer: *mut *mut AsperityPreparer,
    player: *mut *mut AsperityPlayer,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                let config = shared::<RendererOf<A>, _>(renderer)?.renderer.config();
                by_capacity!(capacity, S => {
                    let both = room::<Both<S, A>, _>(memory, size, bytes(spare, S::SIZE)?, preparer)?;
                    room::<Both<S, A>, _>(memory, size, 0, player)?;
                    make::<S, A>(both, config.servo_rate_hz, spare, seed);
                    preparer.write((&raw mut (*both).preparer).cast());
                    player.write((&raw mut (*both).player).cast());
                    Ok(())
                }, else AsperityStatus::Argument)
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Builds queues, slots and both halves.
///
/// # Safety
/// `both` is aligned and has room for [`bytes`].
unsafe fn make<S: Class, A: Numbered>(
    both: *mut Both<S, A>,
    servo_rate_hz: f32,
    spare: u32,
    seed: u64,
) {
    const {
        assert!(size_of::<Both<S, A>>() <= ASPERITY_EXCHANGE_SIZE);
        assert!(size_of::<Texture<S, A>>() <= S::SIZE);
    }
    // SAFETY: the slots lie behind the halves, `S::SIZE` apart; each is used once. Nobody uses the
    // queues but the halves, which live as long as the memory.
    unsafe {
        let slot = move |index: usize| -> &'static mut Texture<S, A> {
            let offset = ASPERITY_EXCHANGE_SIZE + index * S::SIZE;
            let slot = both.cast::<u8>().add(offset).cast::<Texture<S, A>>();
            empty(slot);
            &mut *slot
        };
        let queues = &raw mut (*both).queues;
        queues.write(Exchange::new());
        let queues: &'static mut Exchange<'static, S, A> = &mut *queues;
        let player = uninit(&raw mut (*both).player.player);
        let (preparer, _) = match spare {
            1 => queues.split_in(player, slot(0), [slot(1)], seed),
            2 => queues.split_in(player, slot(0), [slot(1), slot(2)], seed),
            _ => queues.split_in(player, slot(0), [slot(1), slot(2), slot(3)], seed),
        };
        (&raw mut (*both).preparer).write(PreparerOf {
            tag: PreparerOf::<S, A>::TAG,
            home: (&raw const (*both).preparer).addr(),
            servo_rate_hz,
            preparer,
        });
        (&raw mut (*both).player.home).write((&raw const (*both).player).addr());
        (&raw mut (*both).player.servo_rate_hz).write(servo_rate_hz);
        (&raw mut (*both).player.tag).write(PlayerOf::<S, A>::TAG);
    }
}

/// # Safety
/// As `asperity_preparer_load_asset`.
unsafe fn prepare(preparer: *mut AsperityPreparer, asset: &[u8]) -> Result<(), Fault> {
    // SAFETY: the caller's promises.
    unsafe {
        by_kind!(tag(preparer)?, S, A => {
            let half = exclusive::<PreparerOf<S, A>, _>(preparer)?;
            Ok(half.preparer.prepare_haptic(asset, half.servo_rate_hz)?)
        })
    }
}

/// Loads one asset (`.asp`) into a spare slot and sends it to the servo loop, which neither waits
/// nor is waited for. Textures play in the order in which they were sent. If no slot is spare
/// (`ASPERITY_STATUS_BUSY`), or the asset is refused, nothing is sent. The bytes are not needed
/// afterwards.
///
/// # Safety
/// `preparer` is null or an initialised preparer that nobody else uses during the call; `asset` is
/// null or `len` readable bytes; `error` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_preparer_load_asset(
    preparer: *mut AsperityPreparer,
    asset: *const u8,
    len: usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe { call(error, || prepare(preparer, slice(asset, len)?)) }
}

/// `asperity_preparer_load_asset` for the texture at `index` of a whole library (`.aspl`).
///
/// # Safety
/// As `asperity_preparer_load_asset`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_preparer_load_index(
    preparer: *mut AsperityPreparer,
    library: *const u8,
    len: usize,
    index: usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            prepare(preparer, asset_at(slice(library, len)?, index)?)
        })
    }
}

/// `asperity_preparer_load_asset` for the texture called `texture_name` of a whole library
/// (`.aspl`).
///
/// # Safety
/// As `asperity_preparer_load_asset`; `texture_name` is null or ends with a null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_preparer_load_name(
    preparer: *mut AsperityPreparer,
    library: *const u8,
    len: usize,
    texture_name: *const c_char,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let library = slice(library, len)?;
            prepare(preparer, asset_called(library, name(texture_name)?)?)
        })
    }
}

/// Renders one servo period of a player: takes the next texture, if one was sent and may begin, and
/// then does what `asperity_tick` does.
///
/// # Safety
/// As `asperity_tick`; nobody else uses `player` during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_player_tick(
    renderer: *const AsperityRenderer,
    player: *mut AsperityPlayer,
    sample: *const AsperitySample,
    output: *mut AsperityOutput,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        rendered(sample, output, |sample| {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                let renderer = &shared::<RendererOf<A>, _>(renderer)?.renderer;
                by_capacity!(tag(player)?.capacity(), S => {
                    let half = exclusive::<PlayerOf<S, A>, _>(player)?;
                    same_rate(renderer, half.servo_rate_hz)?;
                    Ok(renderer.tick_player(&mut half.player, &Sample::of(sample)).into())
                }, else AsperityStatus::NotInitialised)
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Reads the counters of a player, in the thread that plays it.
///
/// # Safety
/// `player` is null or an initialised player that nobody writes during the call; `counters` is null
/// or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_player_counters(
    player: *const AsperityPlayer,
    counters: *mut AsperityCounters,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_kind!(tag(player)?, S, A => {
                let half = shared::<PlayerOf<S, A>, _>(player)?;
                Ok(sized::write(counters, &half.player.state().counters().into())?)
            })
        })
    }
}
