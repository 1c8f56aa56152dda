//! The calls of a C program, made from Rust, so that an interpreter can detect every invalid
//! access (`cargo +nightly miri test -p asperity-c`).
#![allow(unsafe_code, reason = "calling as C does")]

use asperity_c::{
    ASPERITY_CAPACITY_LARGE, ASPERITY_CAPACITY_MEDIUM, ASPERITY_CAPACITY_SMALL,
    ASPERITY_EXCHANGE_SIZE, ASPERITY_NO_SURFACE, ASPERITY_RECORDER_RECORD_SIZE,
    ASPERITY_RECORDER_SIZE, ASPERITY_RENDERER_SIZE, ASPERITY_SCENE_SIZE, ASPERITY_SCENE_STATE_SIZE,
    ASPERITY_STATE_SIZE, ASPERITY_TEXTURE_SIZE_LARGE, ASPERITY_TEXTURE_SIZE_MEDIUM, AsperityConfig,
    AsperityCounters, AsperityOutput, AsperityRecord, AsperityRenderer, AsperitySample,
    AsperityStatus, asperity_asset_capacity, asperity_config_default, asperity_exchange_init,
    asperity_player_tick, asperity_preparer_load_asset, asperity_recorder_init,
    asperity_recorder_read, asperity_recorder_write, asperity_renderer_init, asperity_scene_init,
    asperity_scene_state_init, asperity_scene_tick, asperity_state_counters, asperity_state_init,
    asperity_texture_init, asperity_texture_load_asset, asperity_texture_load_index,
    asperity_texture_load_name, asperity_tick,
};
use asperity_formats::{
    Asset, Library,
    library::{IndexedTexture, encode_index, encoded_index_len},
};
use asperity_runtime::{Config, Exchange, HostTexture, Renderer, Sample, Scene, SceneState, State};
use std::{mem::MaybeUninit, ptr};

const ASSET: &[u8] = include_bytes!("../../../tests/tests/assets/builtin-v1.asp");
const SCENE: &[u8] = include_bytes!("../../../formats/tests/data/scene-v2.aspl");

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

fn renderer(memory: &mut Memory<ASPERITY_RENDERER_SIZE>) -> *mut AsperityRenderer {
    let mut config = MaybeUninit::<AsperityConfig>::uninit();
    let mut renderer = ptr::null_mut();
    // SAFETY: every pointer leads to memory of its size.
    unsafe {
        let size = size_of::<AsperityConfig>();
        assert_eq!(
            asperity_config_default(config.as_mut_ptr(), size),
            AsperityStatus::Ok
        );
        let (memory, size) = (memory.as_mut_ptr(), ASPERITY_RENDERER_SIZE);
        let (config, out) = (config.as_ptr(), &raw mut renderer);
        let status = asperity_renderer_init(memory, size, config, out, ptr::null_mut());
        assert_eq!(status, AsperityStatus::Ok);
    }
    renderer
}

fn sample(n: u32) -> AsperitySample {
    let x = 1e-4 * n as f32;
    AsperitySample {
        struct_size: size_of::<AsperitySample>() as u32,
        position_m: [x, 0.0, if n == 10 { f32::NAN } else { -1e-3 - x }],
        elapsed_ticks: 1,
    }
}

/// The output of a call that gets one with only its size set.
fn output(tick: impl FnOnce(*mut AsperityOutput) -> AsperityStatus) -> AsperityOutput {
    let mut output = MaybeUninit::<AsperityOutput>::uninit();
    let size = size_of::<AsperityOutput>() as u32;
    // SAFETY: the first field; the call writes the others, all of them numbers.
    unsafe {
        output.as_mut_ptr().cast::<u32>().write(size);
        assert_eq!(tick(output.as_mut_ptr()), AsperityStatus::Ok);
        output.assume_init()
    }
}

fn assert_same(found: &AsperityOutput, expected: [f32; 3]) {
    assert_eq!(found.force_n.map(f32::to_bits), expected.map(f32::to_bits));
}

#[test]
fn objects_live_in_the_callers_memory_and_give_rusts_bits() {
    let mut renderer_memory = Memory::new();
    let mut texture_memory = Memory::<ASPERITY_TEXTURE_SIZE_MEDIUM>::new();
    let mut state_memory = Memory::<ASPERITY_STATE_SIZE>::new();
    let renderer = renderer(&mut renderer_memory);
    let (mut texture, mut state, mut capacity) = (ptr::null_mut(), ptr::null_mut(), 99);
    let none = ptr::null_mut();
    // SAFETY: every pointer leads to memory of its size that lives to the end of the test.
    unsafe {
        let statuses = [
            asperity_asset_capacity(ASSET.as_ptr(), ASSET.len(), 1000.0, &raw mut capacity, none),
            asperity_texture_init(
                texture_memory.as_mut_ptr(),
                ASPERITY_TEXTURE_SIZE_MEDIUM,
                renderer,
                ASPERITY_CAPACITY_MEDIUM,
                &raw mut texture,
            ),
            asperity_texture_load_asset(texture, ASSET.as_ptr(), ASSET.len(), none),
            asperity_state_init(
                state_memory.as_mut_ptr(),
                ASPERITY_STATE_SIZE,
                renderer,
                7,
                &raw mut state,
            ),
        ];
        assert_eq!(statuses, [AsperityStatus::Ok; 4]);
    }
    assert_eq!(capacity, ASPERITY_CAPACITY_MEDIUM);

    let rust = Renderer::new(&Config::default()).unwrap();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&Asset::parse_haptic(ASSET).unwrap(), 1000.0)
        .unwrap();
    let mut rust_state = State::new(7);
    for n in 0..20 {
        let sample = sample(n);
        // SAFETY: as above; the three objects were made there.
        let output = output(|output| unsafe {
            asperity_tick(renderer, texture, state, &raw const sample, output)
        });
        let position = Sample::at(sample.position_m);
        assert_same(
            &output,
            rust.tick(&slot, &mut rust_state, &position).force_n,
        );
    }
    let mut counters = MaybeUninit::<AsperityCounters>::uninit();
    // SAFETY: as above.
    let counters = unsafe {
        let size = size_of::<AsperityCounters>() as u32;
        counters.as_mut_ptr().cast::<u32>().write(size);
        let status = asperity_state_counters(state, counters.as_mut_ptr());
        assert_eq!(status, AsperityStatus::Ok);
        counters.assume_init()
    };
    assert_eq!((counters.ticks, counters.bad_samples), (20, 1));
}

#[test]
fn a_scene_lies_in_one_block_of_memory() {
    let library = Library::parse(SCENE).unwrap();
    let mut renderer_memory = Memory::new();
    let mut scene_memory =
        Memory::<{ ASPERITY_SCENE_SIZE + 4 * ASPERITY_TEXTURE_SIZE_LARGE }>::new();
    let mut state_memory = Memory::<ASPERITY_SCENE_STATE_SIZE>::new();
    let renderer = renderer(&mut renderer_memory);
    let (mut scene, mut state) = (ptr::null_mut(), ptr::null_mut());
    // SAFETY: every pointer leads to memory of its size that lives to the end of the test.
    unsafe {
        let statuses = [
            asperity_scene_init(
                scene_memory.as_mut_ptr(),
                size_of_val(&*scene_memory),
                renderer,
                ASPERITY_CAPACITY_LARGE,
                SCENE.as_ptr(),
                SCENE.len(),
                &raw mut scene,
                ptr::null_mut(),
            ),
            asperity_scene_state_init(
                state_memory.as_mut_ptr(),
                ASPERITY_SCENE_STATE_SIZE,
                renderer,
                7,
                &raw mut state,
            ),
        ];
        assert_eq!(statuses, [AsperityStatus::Ok; 2]);
    }
    let config = Config::default();
    let rust = Renderer::new(&config).unwrap();
    let mut slots: Vec<_> = (0..library.index().len())
        .map(|_| HostTexture::new())
        .collect();
    let rust_scene = Scene::<64>::load(&library, &config, &mut slots).unwrap();
    let mut rust_state = SceneState::new(7);
    for n in 0..20 {
        let sample = sample(n);
        // SAFETY: as above.
        let output = output(|output| unsafe {
            asperity_scene_tick(renderer, scene, state, &raw const sample, output)
        });
        let position = Sample::at(sample.position_m);
        let expected = rust.tick_scene(&rust_scene, &mut rust_state, &position);
        assert_same(&output, expected.force_n);
        let touched = rust_state.touched().map(|index| index as u32);
        assert_eq!(output.surface, touched.unwrap_or(ASPERITY_NO_SURFACE));
    }
    // A copy would play from the memory of the original.
    let mut copy = Memory::<{ ASPERITY_SCENE_SIZE + 4 * ASPERITY_TEXTURE_SIZE_LARGE }>::new();
    let mut untouched = MaybeUninit::<AsperityOutput>::zeroed();
    // SAFETY: both memories have this size; the copy is refused by its first bytes.
    let status = unsafe {
        let bytes = size_of_val(&*copy);
        ptr::copy_nonoverlapping(
            scene_memory.as_mut_ptr().cast::<MaybeUninit<u8>>(),
            copy.as_mut_ptr().cast(),
            bytes,
        );
        let output = untouched.as_mut_ptr();
        output
            .cast::<u32>()
            .write(size_of::<AsperityOutput>() as u32);
        let copied = copy.as_mut_ptr().cast();
        let first = sample(0);
        asperity_scene_tick(renderer, copied, state, &raw const first, output)
    };
    assert_eq!(status, AsperityStatus::NotInitialised);
}

#[test]
fn an_exchange_lies_in_one_block_of_memory() {
    let mut renderer_memory = Memory::new();
    let mut memory = Memory::<{ ASPERITY_EXCHANGE_SIZE + 2 * ASPERITY_TEXTURE_SIZE_LARGE }>::new();
    let renderer = renderer(&mut renderer_memory);
    let (mut preparer, mut player) = (ptr::null_mut(), ptr::null_mut());
    // SAFETY: every pointer leads to memory of its size that lives to the end of the test.
    unsafe {
        let status = asperity_exchange_init(
            memory.as_mut_ptr(),
            size_of_val(&*memory),
            renderer,
            ASPERITY_CAPACITY_LARGE,
            1,
            7,
            &raw mut preparer,
            &raw mut player,
        );
        assert_eq!(status, AsperityStatus::Ok);
    }
    let rust = Renderer::new(&Config::default()).unwrap();
    let mut slots = [HostTexture::new(), HostTexture::new()];
    let [playing, spare] = &mut slots;
    let mut queues = Exchange::new();
    let (mut rust_preparer, mut rust_player) = queues.split(playing, [spare], 7);
    // Small, because it is loaded four times, which takes an interpreter minutes.
    let library = Library::parse(SCENE).unwrap();
    let small = library.bytes(0).unwrap();
    let asset = Asset::parse_haptic(small).unwrap();
    for n in 0..40 {
        if n == 2 || n == 30 {
            rust_preparer.prepare(&asset, 1000.0).unwrap();
            // SAFETY: as above.
            let status = unsafe {
                let (bytes, len) = (small.as_ptr(), small.len());
                asperity_preparer_load_asset(preparer, bytes, len, ptr::null_mut())
            };
            assert_eq!(status, AsperityStatus::Ok);
        }
        let sample = sample(n);
        // SAFETY: as above.
        let output = output(|output| unsafe {
            asperity_player_tick(renderer, player, &raw const sample, output)
        });
        let position = Sample::at(sample.position_m);
        assert_same(
            &output,
            rust.tick_player(&mut rust_player, &position).force_n,
        );
    }
}

/// An empty slot is made of zeros and then emptied: it must be what Rust calls an empty one.
#[test]
fn a_slot_begins_empty_in_any_memory() {
    let mut renderer_memory = Memory::new();
    let mut memory = Memory::<ASPERITY_TEXTURE_SIZE_LARGE>::new();
    let renderer = renderer(&mut renderer_memory);
    for capacity in [
        ASPERITY_CAPACITY_SMALL,
        ASPERITY_CAPACITY_MEDIUM,
        ASPERITY_CAPACITY_LARGE,
    ] {
        let mut texture = ptr::null_mut();
        // SAFETY: every pointer leads to memory of its size; any bytes may be in it.
        let status = unsafe {
            let memory = memory.as_mut_ptr();
            memory
                .cast::<u8>()
                .write_bytes(0xff, ASPERITY_TEXTURE_SIZE_LARGE);
            let size = ASPERITY_TEXTURE_SIZE_LARGE;
            asperity_texture_init(memory, size, renderer, capacity, &raw mut texture)
        };
        assert_eq!(status, AsperityStatus::Ok);
    }
    // What the C face does with a slot of the runtime's.
    let mut slot = Box::<HostTexture>::new_zeroed();
    // SAFETY: a texture is made of numbers, for which zeros are valid.
    let slot = unsafe { slot.assume_init_mut() };
    slot.clear();
    assert!(is_empty(slot));
    slot.load(&Asset::parse_haptic(ASSET).unwrap(), 1000.0)
        .unwrap();
    assert_eq!(slot.servo_rate_hz(), 1000.0);
    slot.clear();
    assert!(is_empty(slot));
}

/// The index entry of a texture is checked against the texture, of which C reads the haptic part alone.
#[test]
fn a_haptic_length_of_the_index_that_is_wrong_is_refused() {
    let (len, haptic_len) = (
        ASSET.len() as u32,
        Asset::parse(ASSET).unwrap().haptic_len() as u32,
    );
    let mut renderer_memory = Memory::new();
    let mut memory = Memory::<ASPERITY_TEXTURE_SIZE_LARGE>::new();
    let renderer = renderer(&mut renderer_memory);
    for (change, expected) in [(0, AsperityStatus::Ok), (1, AsperityStatus::Format)] {
        let textures = [IndexedTexture {
            name: "a",
            len,
            haptic_len: haptic_len - change,
        }];
        let mut library = vec![0; encoded_index_len(&textures)];
        encode_index(&textures, &mut library).unwrap();
        library.extend(ASSET);
        let (bytes, len) = (library.as_ptr(), library.len());
        let (mut texture, error) = (ptr::null_mut(), ptr::null_mut());
        // SAFETY: every pointer leads to memory of its size, or to a text that ends with a null.
        let statuses = unsafe {
            let (capacity, size) = (ASPERITY_CAPACITY_LARGE, ASPERITY_TEXTURE_SIZE_LARGE);
            let memory = memory.as_mut_ptr();
            asperity_texture_init(memory, size, renderer, capacity, &raw mut texture);
            [
                asperity_texture_load_index(texture, bytes, len, 0, error),
                asperity_texture_load_name(texture, bytes, len, c"a".as_ptr(), error),
            ]
        };
        assert_eq!(statuses, [expected; 2]);
    }
}

/// Returns true if every number of a slot is that of an empty one. Miri would print them for
/// minutes, so it compares the rate alone.
fn is_empty(slot: &HostTexture) -> bool {
    slot.servo_rate_hz() == 0.0
        && (cfg!(miri) || format!("{slot:?}") == format!("{:?}", HostTexture::EMPTY))
}

#[test]
fn records_go_from_one_thread_to_another() {
    const RECORDS: usize = 4;
    /// A pointer that two threads share, as C shares it.
    #[derive(Clone, Copy)]
    struct Shared(*mut asperity_c::AsperityRecorder);
    // SAFETY: one thread writes and one reads, as the recorder allows.
    unsafe impl Send for Shared {}

    let mut memory =
        Memory::<{ ASPERITY_RECORDER_SIZE + RECORDS * ASPERITY_RECORDER_RECORD_SIZE }>::new();
    let mut recorder = ptr::null_mut();
    // SAFETY: the pointers lead to memory of their size.
    let status = unsafe {
        asperity_recorder_init(
            memory.as_mut_ptr(),
            size_of_val(&*memory),
            &raw mut recorder,
        )
    };
    assert_eq!(status, AsperityStatus::Ok);
    let writers = Shared(recorder);
    let mut writer = Some(std::thread::spawn(move || {
        let shared = writers;
        let output = output(|output| {
            // SAFETY: the size was set; zeros are a valid output.
            unsafe {
                output
                    .cast::<u32>()
                    .add(1)
                    .write_bytes(0, size_of::<AsperityOutput>() / 4 - 1)
            };
            AsperityStatus::Ok
        });
        for n in 0..100 {
            let sample = sample(n);
            // SAFETY: this thread alone writes.
            let status =
                unsafe { asperity_recorder_write(shared.0, &raw const sample, &raw const output) };
            assert_eq!(status, AsperityStatus::Ok);
        }
    }));
    let (mut next, mut read, mut lost) = (0, 0, 0);
    loop {
        // What the writer did last is seen for certain once it was joined.
        if let Some(writer) = writer.take_if(|writer| writer.is_finished()) {
            writer.join().unwrap();
        }
        let over = writer.is_none();
        let mut records = [MaybeUninit::<AsperityRecord>::uninit(); 3];
        let mut count = 0;
        // SAFETY: this thread alone reads.
        let status = unsafe {
            asperity_recorder_read(
                recorder,
                records.as_mut_ptr().cast(),
                size_of::<AsperityRecord>(),
                records.len(),
                &raw mut count,
                &raw mut lost,
            )
        };
        assert_eq!(status, AsperityStatus::Ok);
        for record in &records[..count] {
            // SAFETY: the call wrote it.
            let record = unsafe { record.assume_init() };
            assert!(record.tick >= next);
            let [expected, found] = [sample(record.tick as u32).position_m, record.position_m]
                .map(|p| p.map(f32::to_bits));
            assert_eq!(found, expected);
            next = record.tick + 1;
        }
        read += count;
        if over && count == 0 {
            break;
        }
    }
    assert_eq!(read + lost as usize, 100);
}
