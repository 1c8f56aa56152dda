//! The stack of every call of the C face, measured by painting.
//!
//! A line a call: its name without `asperity_`, and its bytes. A call that fails prints `failed`, and ends the program.
#![no_std]
#![no_main]
#![allow(unsafe_code, reason = "the calls are those of C")]

use asperity_c::*;
use asperity_firmware::{print, stack};
use core::{mem::MaybeUninit, ptr::null_mut};
use cortex_m_semihosting::debug;

/// Memory of a caller.
#[repr(C, align(64))]
struct Memory<const SIZE: usize>(MaybeUninit<[u8; SIZE]>);

const SLOT: usize = ASPERITY_TEXTURE_SIZE_LARGE;
const SCENE: usize = ASPERITY_SCENE_SIZE + 4 * SLOT;
const EXCHANGE: usize = ASPERITY_EXCHANGE_SIZE + 2 * SLOT;
const RECORDER: usize = ASPERITY_RECORDER_SIZE + 8 * ASPERITY_RECORDER_RECORD_SIZE;
static ASSET: &[u8] = include_bytes!("../../../../../tests/tests/assets/builtin-v1.asp");
static LIBRARY: &[u8] = include_bytes!("../../../../../formats/tests/data/scene-v2.aspl");

/// Paints, calls, and prints how deep the stack went.
#[inline(never)]
fn measure(name: &str, call: &mut dyn FnMut() -> AsperityStatus) {
    stack::paint();
    let status = call();
    let bytes = stack::depth();
    print::line(name, bytes as u64);
    if status != AsperityStatus::Ok {
        print::line("failed", status as u64);
        debug::exit(debug::EXIT_FAILURE);
    }
}

/// Returns the function's name without its prefix, which fits into a line.
fn name_of(function: &str) -> &str {
    function.strip_prefix("asperity_").unwrap_or(function)
}

/// The status of a call that gives a text or a number.
fn given(something: bool) -> AsperityStatus {
    if something {
        AsperityStatus::Ok
    } else {
        AsperityStatus::Internal
    }
}

/// Calls a function of the C face with what C passes, under its name.
macro_rules! measure {
    ($function:ident($($argument:expr),*)) => {
        // SAFETY: statics of the right size, used by this thread alone.
        measure(name_of(stringify!($function)), &mut || unsafe { $function($($argument),*) })
    };
}

fn memory<const SIZE: usize>(memory: &'static mut Memory<SIZE>) -> *mut core::ffi::c_void {
    memory.0.as_mut_ptr().cast()
}

#[cortex_m_rt::entry]
fn main() -> ! {
    static mut RENDERER: Memory<ASPERITY_RENDERER_SIZE> = Memory(MaybeUninit::uninit());
    static mut TEXTURE: Memory<SLOT> = Memory(MaybeUninit::uninit());
    static mut STATE: Memory<ASPERITY_STATE_SIZE> = Memory(MaybeUninit::uninit());
    static mut SCENES: Memory<SCENE> = Memory(MaybeUninit::uninit());
    static mut SCENE_STATE: Memory<ASPERITY_SCENE_STATE_SIZE> = Memory(MaybeUninit::uninit());
    static mut EXCHANGES: Memory<EXCHANGE> = Memory(MaybeUninit::uninit());
    static mut RECORDS: Memory<RECORDER> = Memory(MaybeUninit::uninit());
    static mut CONFIG: MaybeUninit<AsperityConfig> = MaybeUninit::uninit();
    static mut ERROR: MaybeUninit<AsperityError> = MaybeUninit::uninit();
    static mut OUTPUT: MaybeUninit<AsperityOutput> = MaybeUninit::uninit();
    static mut COUNTERS: MaybeUninit<AsperityCounters> = MaybeUninit::uninit();
    static mut COUPLING: MaybeUninit<AsperityCoupling> = MaybeUninit::uninit();
    static mut RECORD: MaybeUninit<AsperityRecord> = MaybeUninit::uninit();
    static mut NAME: [core::ffi::c_char; ASPERITY_NAME_SIZE] = [0; ASPERITY_NAME_SIZE];
    static mut TEXT: [core::ffi::c_char; ASPERITY_TEXT_SIZE] = [0; ASPERITY_TEXT_SIZE];

    let (config, error) = (CONFIG.as_mut_ptr(), ERROR.as_mut_ptr());
    let (output, counters) = (OUTPUT.as_mut_ptr(), COUNTERS.as_mut_ptr());
    let coupling = COUPLING.as_mut_ptr();
    // SAFETY: the first fields of statics that nobody else uses.
    unsafe {
        coupling
            .cast::<u32>()
            .write(size_of::<AsperityCoupling>() as u32);
        error.cast::<u32>().write(size_of::<AsperityError>() as u32);
        output
            .cast::<u32>()
            .write(size_of::<AsperityOutput>() as u32);
        counters
            .cast::<u32>()
            .write(size_of::<AsperityCounters>() as u32);
    }
    let sample = AsperitySample {
        struct_size: size_of::<AsperitySample>() as u32,
        position_m: [0.0, 0.0, -0.001],
        elapsed_ticks: 1,
    };
    let [renderers, textures, states] = [memory(RENDERER), memory(TEXTURE), memory(STATE)];
    let [scenes, scene_states] = [memory(SCENES), memory(SCENE_STATE)];
    let [exchanges, records] = [memory(EXCHANGES), memory(RECORDS)];
    let (asset, asset_len) = (ASSET.as_ptr(), ASSET.len());
    let (library, library_len) = (LIBRARY.as_ptr(), LIBRARY.len());
    let large = ASPERITY_CAPACITY_LARGE;
    for arithmetic in [ASPERITY_ARITHMETIC_FLOAT, ASPERITY_ARITHMETIC_FIXED] {
        let (mut renderer, mut texture, mut state) = (null_mut(), null_mut(), null_mut());
        let (mut scene, mut scene_state) = (null_mut(), null_mut());
        let (mut preparer, mut player, mut recorder) = (null_mut(), null_mut(), null_mut());
        let (mut capacity, mut size, mut count) = (0, 0, 0);
        measure!(asperity_config_default(config, size_of::<AsperityConfig>()));
        // SAFETY: just written.
        unsafe { (*config).arithmetic = arithmetic };
        measure!(asperity_renderer_init(
            renderers,
            ASPERITY_RENDERER_SIZE,
            config,
            &raw mut renderer,
            error
        ));
        measure!(asperity_asset_capacity(
            asset,
            asset_len,
            1000.0,
            &raw mut capacity,
            error
        ));
        measure!(asperity_library_capacity(
            library,
            library_len,
            1000.0,
            &raw mut capacity,
            error
        ));
        measure!(asperity_library_count(
            library,
            library_len,
            &raw mut count,
            error
        ));
        measure!(asperity_library_name(
            library,
            library_len,
            0,
            NAME.as_mut_ptr(),
            ASPERITY_NAME_SIZE,
            error
        ));
        measure!(asperity_library_find(
            library,
            library_len,
            NAME.as_ptr(),
            &raw mut count,
            error
        ));
        measure!(asperity_texture_init(
            textures,
            SLOT,
            renderer,
            large,
            &raw mut texture
        ));
        measure!(asperity_texture_load_asset(
            texture, asset, asset_len, error
        ));
        measure!(asperity_texture_load_index(
            texture,
            library,
            library_len,
            0,
            error
        ));
        measure!(asperity_texture_load_name(
            texture,
            library,
            library_len,
            NAME.as_ptr(),
            error
        ));
        measure!(asperity_texture_load_asset(
            texture, asset, asset_len, error
        ));
        measure!(asperity_texture_coupling(texture, coupling));
        measure!(asperity_state_init(
            states,
            ASPERITY_STATE_SIZE,
            renderer,
            1,
            &raw mut state
        ));
        for _ in 0..40 {
            measure!(asperity_tick(
                renderer,
                texture,
                state,
                &raw const sample,
                output
            ));
        }
        measure!(asperity_state_counters(state, counters));
        measure!(asperity_scene_size(
            library,
            library_len,
            large,
            &raw mut size,
            error
        ));
        measure!(asperity_scene_init(
            scenes,
            SCENE,
            renderer,
            large,
            library,
            library_len,
            &raw mut scene,
            error
        ));
        measure!(asperity_scene_state_init(
            scene_states,
            ASPERITY_SCENE_STATE_SIZE,
            renderer,
            1,
            &raw mut scene_state
        ));
        for _ in 0..40 {
            measure!(asperity_scene_tick(
                renderer,
                scene,
                scene_state,
                &raw const sample,
                output
            ));
        }
        measure!(asperity_scene_state_counters(scene_state, counters));
        measure!(asperity_exchange_size(large, 1, &raw mut size));
        // A new exchange for each load: its only spare slot is on its way then.
        macro_rules! exchanged {
            ($load:ident($($argument:expr),*)) => {
                measure!(asperity_exchange_init(
                    exchanges,
                    EXCHANGE,
                    renderer,
                    large,
                    1,
                    1,
                    &raw mut preparer,
                    &raw mut player
                ));
                measure!($load(preparer, $($argument),*));
            };
        }
        exchanged!(asperity_preparer_load_index(library, library_len, 0, error));
        exchanged!(asperity_preparer_load_name(
            library,
            library_len,
            NAME.as_ptr(),
            error
        ));
        exchanged!(asperity_preparer_load_asset(asset, asset_len, error));
        for _ in 0..40 {
            measure!(asperity_player_tick(
                renderer,
                player,
                &raw const sample,
                output
            ));
        }
        measure!(asperity_player_counters(player, counters));
        measure!(asperity_recorder_init(records, RECORDER, &raw mut recorder));
        measure!(asperity_recorder_write(recorder, &raw const sample, output));
        measure!(asperity_recorder_read(
            recorder,
            RECORD.as_mut_ptr(),
            size_of::<AsperityRecord>(),
            1,
            &raw mut count,
            null_mut()
        ));
        measure!(asperity_counters_text(
            counters,
            TEXT.as_mut_ptr(),
            ASPERITY_TEXT_SIZE
        ));
        measure!(asperity_flags_text(
            1023,
            TEXT.as_mut_ptr(),
            ASPERITY_TEXT_SIZE
        ));
        measure("version", &mut || given(!asperity_version().is_null()));
        measure("version_number", &mut || {
            given(asperity_version_number() != 0)
        });
        measure("error_text", &mut || {
            given(!asperity_error_text(99).is_null())
        });
    }
    debug::exit(debug::EXIT_SUCCESS);
    loop {
        cortex_m::asm::wfi();
    }
}
