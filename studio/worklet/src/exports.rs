//! The raw exports of the module. It imports nothing.
//!
//! Buffers are static; `buffer_*` gives their addresses, which never change, and nor does the memory
//! grow. The caller writes the asset and the events, then calls; it reads what `process` wrote before
//! it calls again. Functions that can fail return a [`Status`].
#![allow(
    unsafe_code,
    reason = "exports have names, and their buffers are statics of the only thread"
)]

use crate::{
    engine::{Block, Engine, MAX_FRAMES},
    hand::{Pointer, RATE_HZ, ROOM},
    row::RowText,
    session::{SPARE, Session},
    spectrum::Spectrum,
    status::Status,
};
use asperity_runtime::{Exchange, HostTexture, LoadError, PrepareError};
use core::{cell::UnsafeCell, mem::MaybeUninit, panic::PanicInfo};

/// Bytes of an asset without its preview, at most; larger ones do not fit a slot of the runtime.
const ASSET_BYTES: usize = 64 * 1024;
/// Numbers of an event: time, s, on any clock; x, y, z, mm; stroke.
const EVENT_NUMBERS: usize = 5;
/// The hand's delay before `set_delay`, s.
const DELAY_S: f64 = 0.02;

const NOWHERE: Pointer = Pointer {
    time_s: 0.0,
    position_mm: [0.0; 3],
    stroke: 0.0,
};

/// A static of the only thread.
struct Single<T>(UnsafeCell<T>);

// SAFETY: a module without shared memory has one thread.
unsafe impl<T> Sync for Single<T> {}

impl<T> Single<T> {
    const fn new(value: T) -> Self {
        Self(UnsafeCell::new(value))
    }

    /// Exclusive access, which ends before the export returns or [`load`] takes it again.
    #[allow(
        clippy::mut_from_ref,
        reason = "each export takes a static once, and none is entered again, since nothing is imported"
    )]
    fn get(&'static self) -> &'static mut T {
        // SAFETY: as above; what a session holds is taken again only when the session is gone.
        unsafe { &mut *self.0.get() }
    }
}

static ASSET: Single<[u8; ASSET_BYTES]> = Single::new([0; ASSET_BYTES]);
static EVENTS: Single<[[f64; EVENT_NUMBERS]; ROOM]> = Single::new([[0.0; EVENT_NUMBERS]; ROOM]);
static BLOCK: Single<Block> = Single::new(Block::EMPTY);
static ENGINE: Single<Engine<'static, 'static>> = Single::new(Engine::new(DELAY_S));
static EXCHANGE: Single<Exchange<'static>> = Single::new(Exchange::new());
/// The slots that the session owns; an empty slot is not all zeros, and would be in the module's bytes.
static PLAYING: Single<MaybeUninit<HostTexture>> = Single::new(MaybeUninit::uninit());
static WAITING: Single<[MaybeUninit<HostTexture>; SPARE]> =
    Single::new([const { MaybeUninit::uninit() }; SPARE]);
/// Where an asset is loaded before the session ends.
static NEXT: Single<HostTexture> = Single::new(HostTexture::EMPTY);
static REFUSED_RATE_HZ: Single<f32> = Single::new(0.0);
static ROW: Single<RowText> = Single::new(RowText::EMPTY);
static SPECTRUM: Single<Spectrum> = Single::new(Spectrum::SILENT);

/// The bytes of an asset, `asset_capacity` of them.
#[unsafe(no_mangle)]
extern "C" fn buffer_asset() -> *mut u8 {
    ASSET.0.get().cast()
}

/// Bytes of `buffer_asset`.
#[unsafe(no_mangle)]
extern "C" fn asset_capacity() -> usize {
    ASSET_BYTES
}

/// Events for `post`, five `f64` each: time, s, on a clock of the page; x, y, z, mm; stroke.
#[unsafe(no_mangle)]
extern "C" fn buffer_events() -> *mut f64 {
    EVENTS.0.get().cast()
}

/// Events of `buffer_events`.
#[unsafe(no_mangle)]
extern "C" fn events_capacity() -> usize {
    ROOM
}

/// Frames of `process`, `f32` at 48 kHz, m/s².
#[unsafe(no_mangle)]
extern "C" fn buffer_frames() -> *const f32 {
    BLOCK.get().frames.as_ptr()
}

/// Frames that a call of `process` gives at most.
#[unsafe(no_mangle)]
extern "C" fn frames_capacity() -> usize {
    MAX_FRAMES
}

/// The hand in each tick of `process`, three `f32` each: x, y, z, mm.
#[unsafe(no_mangle)]
extern "C" fn buffer_positions() -> *const f32 {
    BLOCK.get().positions_mm.as_ptr().cast()
}

/// Columns 3 to 11 of `asperity render` for each tick of `process`, nine `f32` each; `print_row` takes those of the first.
#[unsafe(no_mangle)]
extern "C" fn buffer_columns() -> *mut f32 {
    BLOCK.get().columns.as_mut_ptr().cast()
}

/// The last column of `asperity render` for each tick of `process`, `u32`.
#[unsafe(no_mangle)]
extern "C" fn buffer_flags() -> *const u32 {
    BLOCK.get().flags.as_ptr()
}

/// Starts a session of the first `len` bytes of the asset, of which those behind the haptic
/// sections may be missing. `high` and `low` are the halves of the seed. If the asset is refused,
/// the session before plays on.
#[unsafe(no_mangle)]
extern "C" fn load(len: usize, high: u32, low: u32) -> Status {
    let Some(asset) = ASSET.get().get(..len) else {
        return Status::Length;
    };
    let next = NEXT.get();
    if let Err(error) = next.load_haptic(asset, RATE_HZ) {
        return refused(&error);
    }
    let engine = ENGINE.get();
    engine.set_session(None);
    // The session that held them is gone.
    let playing = PLAYING.get().write(next.clone());
    let spare = (WAITING.get().each_mut()).map(|slot| slot.write(next.clone()));
    let seed = u64::from(high) << 32 | u64::from(low);
    match Session::start(EXCHANGE.get(), playing, spare, seed) {
        Ok(session) => {
            engine.set_session(Some(session));
            Status::Ok
        }
        Err(_) => Status::Runtime,
    }
}

/// Cross-fades to the asset as soon as the runtime may: after a tap, and the swap before.
#[unsafe(no_mangle)]
extern "C" fn swap(len: usize) -> Status {
    let Some(asset) = ASSET.get().get(..len) else {
        return Status::Length;
    };
    let Some(session) = ENGINE.get().session_mut() else {
        return Status::Empty;
    };
    match session.swap(asset) {
        Ok(()) => Status::Ok,
        Err(PrepareError::Load(error)) => refused(&error),
        Err(error) => (&error).into(),
    }
}

/// The rate of the models, Hz, of the asset last refused with `Status::Rate`.
#[unsafe(no_mangle)]
extern "C" fn refused_rate_hz() -> f32 {
    *REFUSED_RATE_HZ.get()
}

/// Returns the number of the session's swaps that have begun to play.
#[unsafe(no_mangle)]
extern "C" fn swaps() -> u32 {
    ENGINE.get().session().map_or(0, Session::swaps)
}

/// Stiffness of the wall of the texture that plays, N/m; 0 without one.
#[unsafe(no_mangle)]
extern "C" fn stiffness_n_m() -> f32 {
    ENGINE.get().session().map_or(0.0, Session::stiffness_n_m)
}

/// Effective mass of the texture that plays, kg; 0 without one.
#[unsafe(no_mangle)]
extern "C" fn effective_mass_kg() -> f32 {
    let session = ENGINE.get().session();
    session.map_or(0.0, Session::effective_mass_kg)
}

/// Rate of the models of the texture that plays, Hz; 0 without one.
#[unsafe(no_mangle)]
extern "C" fn model_rate_hz() -> f32 {
    ENGINE.get().session().map_or(0.0, Session::model_rate_hz)
}

/// Makes the hand's delay `delay_s`, 0 to 0.1 s: an interval between events and the jitter of
/// their arrival. Ends the session, and the hand starts anew.
#[unsafe(no_mangle)]
extern "C" fn set_delay(delay_s: f64) -> Status {
    if !(0.0..=0.1).contains(&delay_s) {
        return Status::Event;
    }
    *ENGINE.get() = Engine::new(delay_s);
    Status::Ok
}

/// From an event to its sound, s, without the filters of the runtime.
#[unsafe(no_mangle)]
extern "C" fn latency_s() -> f64 {
    ENGINE.get().latency_s()
}

/// Takes the first `count` events, which arrived at the audio time `now_s`, s.
#[unsafe(no_mangle)]
extern "C" fn post(count: usize, now_s: f64) -> Status {
    let Some(events) = EVENTS.get().get(..count) else {
        return Status::Length;
    };
    let mut pointers = [NOWHERE; ROOM];
    for (pointer, &[time_s, x, y, z, stroke]) in pointers.iter_mut().zip(events) {
        *pointer = Pointer {
            time_s,
            position_mm: [x, y, z],
            stroke,
        };
    }
    let pointers = pointers.get(..count).unwrap_or_default();
    match ENGINE.get().post(pointers, now_s) {
        Ok(()) => Status::Ok,
        Err(status) => status,
    }
}

/// Renders `frames` of audio from the audio time `now_s` on, s; returns the ticks that it took.
#[unsafe(no_mangle)]
extern "C" fn process(frames: usize, now_s: f64) -> usize {
    let block = BLOCK.get();
    ENGINE.get().process(frames, now_s, block);
    block.ticks
}

/// The text of `print_row`, ASCII.
#[unsafe(no_mangle)]
extern "C" fn buffer_row() -> *const u8 {
    ROW.get().text.as_ptr()
}

/// Prints the first nine numbers of `buffer_columns` as `asperity render` does, with commas between them; the bytes of
/// the text.
#[unsafe(no_mangle)]
extern "C" fn print_row() -> usize {
    ROW.get().print(&BLOCK.get().columns[0])
}

/// Mixes the model that the texture that plays has at a speed and a force, for `density` and `power`; silence without
/// one.
#[unsafe(no_mangle)]
extern "C" fn mix(speed_mm_s: f32, force_n: f32) {
    let session = ENGINE.get().session();
    *SPECTRUM.get() = session.map_or(Spectrum::SILENT, |s| s.spectrum(speed_mm_s, force_n));
}

/// Power density of the mixed model on one side at a frequency up to half the rate, (m/s²)²/Hz.
#[unsafe(no_mangle)]
extern "C" fn density(freq_hz: f64) -> f64 {
    SPECTRUM.get().density(freq_hz)
}

/// Power of the mixed model above 40 Hz as the sum over `points` frequencies, (m/s²)².
#[unsafe(no_mangle)]
extern "C" fn power(points: u32) -> f64 {
    SPECTRUM.get().power(points)
}

/// Keeps what the page needs to have the asset compiled for another rate.
fn refused(error: &LoadError) -> Status {
    if let LoadError::Rate { model_hz, .. } = *error {
        *REFUSED_RATE_HZ.get() = model_hz;
    }
    error.into()
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
