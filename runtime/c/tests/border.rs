//! The calls of a C program, made from Rust, so that an interpreter can detect every invalid
//! access (`cargo +nightly miri test -p asperity-c`).
#![allow(unsafe_code, reason = "calling as C does")]

use asperity_c::{
    ASPERITY_RENDERER_SIZE, ASPERITY_STATE_SIZE, ASPERITY_TEXTURE_SIZE, AsperityConfig,
    AsperityCounters, AsperityError, AsperityOutput, AsperitySample, AsperityStatus,
    asperity_config_default, asperity_renderer_init, asperity_state_counters, asperity_state_init,
    asperity_texture_init, asperity_texture_load_asset, asperity_tick,
};
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use std::{mem::MaybeUninit, ptr};

const ASSET: &[u8] = include_bytes!("../../../tests/tests/assets/builtin-v1.asp");

/// Uninitialised memory of a caller, as `malloc` returns it.
#[repr(C, align(64))]
struct Memory<const SIZE: usize>(MaybeUninit<[u8; SIZE]>);

impl<const SIZE: usize> Memory<SIZE> {
    fn new() -> Box<Self> {
        Box::new(Self(MaybeUninit::uninit()))
    }

    fn as_mut_ptr(&mut self) -> *mut core::ffi::c_void {
        self.0.as_mut_ptr().cast()
    }
}

#[test]
fn objects_live_in_the_callers_memory_and_give_rusts_bits() {
    let mut texture_memory = Memory::<ASPERITY_TEXTURE_SIZE>::new();
    let mut renderer_memory = Memory::<ASPERITY_RENDERER_SIZE>::new();
    let mut state_memory = Memory::<ASPERITY_STATE_SIZE>::new();
    let mut config = MaybeUninit::<AsperityConfig>::uninit();
    let mut error = MaybeUninit::<AsperityError>::uninit();
    let (mut renderer, mut texture, mut state) =
        (ptr::null_mut(), ptr::null_mut(), ptr::null_mut());
    // SAFETY: every pointer leads to memory of its size that lives to the end of the test.
    unsafe {
        let statuses = [
            asperity_config_default(config.as_mut_ptr()),
            asperity_renderer_init(
                renderer_memory.as_mut_ptr(),
                ASPERITY_RENDERER_SIZE,
                config.as_ptr(),
                &raw mut renderer,
                error.as_mut_ptr(),
            ),
            asperity_texture_init(
                texture_memory.as_mut_ptr(),
                ASPERITY_TEXTURE_SIZE,
                &raw mut texture,
            ),
            asperity_texture_load_asset(
                texture,
                ASSET.as_ptr(),
                ASSET.len(),
                1000.0,
                error.as_mut_ptr(),
            ),
            asperity_state_init(
                state_memory.as_mut_ptr(),
                ASPERITY_STATE_SIZE,
                7,
                &raw mut state,
            ),
        ];
        assert_eq!(statuses, [AsperityStatus::Ok; 5]);
        assert_eq!(error.assume_init().message[0], 0);
    }

    let rust = Renderer::new(&Config::default()).unwrap();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&Asset::parse_haptic(ASSET).unwrap(), 1000.0)
        .unwrap();
    let mut rust_state = State::new(7);
    for n in 0..20 {
        let x = 1e-4 * n as f32;
        let position_m = [x, 0.0, if n == 10 { f32::NAN } else { -1e-3 - x }];
        let sample = AsperitySample {
            position_m,
            elapsed_ticks: 1,
        };
        let mut output = MaybeUninit::<AsperityOutput>::uninit();
        // SAFETY: as above; the three objects were made there.
        let (status, output) = unsafe {
            let status = asperity_tick(
                renderer,
                texture,
                state,
                &raw const sample,
                output.as_mut_ptr(),
            );
            (status, output.assume_init())
        };
        assert_eq!(status, AsperityStatus::Ok);
        let expected = rust.tick(&slot, &mut rust_state, &Sample::at(position_m));
        assert_eq!(
            output.force_n.map(f32::to_bits),
            expected.force_n.map(f32::to_bits)
        );
    }
    let mut counters = MaybeUninit::<AsperityCounters>::uninit();
    // SAFETY: as above.
    let counters = unsafe {
        assert_eq!(
            asperity_state_counters(state, counters.as_mut_ptr()),
            AsperityStatus::Ok
        );
        counters.assume_init()
    };
    assert_eq!((counters.ticks, counters.bad_samples), (20, 1));
}
