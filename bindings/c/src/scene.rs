//! Scenes: several surfaces, each with a texture of a library.

use crate::{
    AsperityCounters, AsperityError, AsperityOutput, AsperityRenderer, AsperitySample,
    AsperityStatus,
    arithmetic::{Numbered, by_arithmetic},
    capacity::{Class, by_capacity},
    library::slice,
    memory::{Object, Tag, exclusive, room, shared, tag, uninit, write},
    renderer::RendererOf,
    sized,
    status::call,
    texture::empty,
    tick::{ASPERITY_NO_SURFACE, rendered, same_rate},
};
use asperity_formats::{Library, limits::MAX_SURFACES};
use asperity_runtime::{Sample, Scene, SceneState, Texture};
use core::{ffi::c_void, mem::MaybeUninit, ptr, slice::from_raw_parts_mut};

/// Size of the memory of an `AsperityScene` without its textures, bytes. Each texture of the
/// library adds `ASPERITY_TEXTURE_SIZE_*`.
pub const ASPERITY_SCENE_SIZE: usize = 8192;
/// Size of the memory of an `AsperitySceneState`, bytes.
pub const ASPERITY_SCENE_STATE_SIZE: usize = 2048;

/// The surfaces of a library and their textures. It serves any number of states; a tick only reads
/// it.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityScene {
    tag: Tag,
}

/// Object behind an `AsperityScene` pointer; its textures follow it in memory, so it cannot be moved.
#[repr(C)]
pub(crate) struct SceneOf<S: Class, A: Numbered> {
    tag: Tag,
    /// Address at which it was initialised.
    home: usize,
    servo_rate_hz: f32,
    scene: MaybeUninit<Scene<'static, MAX_SURFACES, S, A>>,
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<S: Class, A: Numbered> Object for SceneOf<S, A> {
    const TAG: Tag = Tag::new(b'C', A::NUMBER, S::NUMBER);

    fn is_in_place(&self) -> bool {
        self.home == ptr::from_ref(self).addr()
    }
}

/// State of one stylus in a scene. One thread at a time may use it.
#[derive(Debug)]
#[repr(C)]
pub struct AsperitySceneState {
    tag: Tag,
}

/// Object behind an `AsperitySceneState` pointer.
#[repr(C)]
pub(crate) struct SceneStateOf<A: Numbered> {
    tag: Tag,
    state: SceneState<A>,
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<A: Numbered> Object for SceneStateOf<A> {
    const TAG: Tag = Tag::new(b'D', A::NUMBER, 0);
}

/// Bytes of a scene of so many textures.
const fn scene_size(textures: usize, slot: usize) -> Result<usize, AsperityStatus> {
    match textures.checked_mul(slot) {
        Some(slots) if slots < isize::MAX as usize - ASPERITY_SCENE_SIZE => {
            Ok(ASPERITY_SCENE_SIZE + slots)
        }
        _ => Err(AsperityStatus::Capacity),
    }
}

/// Bytes of memory that `asperity_scene_init` needs for a library (`.aspl`) in slots of `capacity`
/// (`ASPERITY_CAPACITY_*`; `asperity_library_capacity` has the smallest).
///
/// # Safety
/// `library` is null or `len` readable bytes; `size` and `error` are null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_scene_size(
    library: *const u8,
    len: usize,
    capacity: u32,
    size: *mut usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let library = Library::parse(slice(library, len)?)?;
            if library.scene().is_none() {
                return Err(AsperityStatus::NoScene.into());
            }
            by_capacity!(capacity, S => {
                Ok(write(size, scene_size(library.index().len(), S::SIZE)?)?)
            }, else AsperityStatus::Argument)
        })
    }
}

/// Loads every surface and texture of a library (`.aspl`) that holds a scene, in `memory` of at
/// least as many bytes as `asperity_scene_size` says, for the servo rate and the arithmetic of a
/// renderer. The memory must not be copied elsewhere: a copy is refused as not initialised. The
/// bytes are not needed afterwards. A library that is refused leaves no scene.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
/// renderer; `library` is null or `len` readable bytes outside of `memory`; `scene` and `error` are
/// null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_scene_init(
    memory: *mut c_void,
    size: usize,
    renderer: *const AsperityRenderer,
    capacity: u32,
    library: *const u8,
    len: usize,
    scene: *mut *mut AsperityScene,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                let config = shared::<RendererOf<A>, _>(renderer)?.renderer.config();
                by_capacity!(capacity, S => {
                    let library = Library::parse(slice(library, len)?)?;
                    let count = library.index().len();
                    let size_needed = scene_size(count, S::SIZE)?;
                    let object = room::<SceneOf<S, A>, _>(memory, size, size_needed, scene)?;
                    let slots = memory
                        .cast::<u8>()
                        .add(ASPERITY_SCENE_SIZE)
                        .cast::<Texture<S, A>>();
                    for index in 0..count {
                        empty(slots.add(index));
                    }
                    // No scene while it is being made.
                    (&raw mut (*object).tag).write(Tag::NONE);
                    (&raw mut (*object).home).write(object.addr());
                    (&raw mut (*object).servo_rate_hz).write(config.servo_rate_hz);
                    let slots: &'static mut [_] = from_raw_parts_mut(slots, count);
                    Scene::load_in(&mut (*object).scene, &library, config, slots)?;
                    (&raw mut (*object).tag).write(SceneOf::<S, A>::TAG);
                    scene.write(object.cast());
                    Ok(())
                }, else AsperityStatus::Argument)
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Makes a state at rest, without force, in `memory` of at least `ASPERITY_SCENE_STATE_SIZE` bytes,
/// for the arithmetic of a renderer. `seed` selects the noise of the excitation.
///
/// # Safety
/// As `asperity_state_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_scene_state_init(
    memory: *mut c_void,
    size: usize,
    renderer: *const AsperityRenderer,
    seed: u64,
    state: *mut *mut AsperitySceneState,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                shared::<RendererOf<A>, _>(renderer)?;
                let size_needed = ASPERITY_SCENE_STATE_SIZE;
                let object = room::<SceneStateOf<A>, _>(memory, size, size_needed, state)?;
                SceneState::init(uninit(&raw mut (*object).state), seed);
                (&raw mut (*object).tag).write(SceneStateOf::<A>::TAG);
                state.write(object.cast());
                Ok(())
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Reads the counters of a state in a scene.
///
/// # Safety
/// As `asperity_state_counters`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_scene_state_counters(
    state: *const AsperitySceneState,
    counters: *mut AsperityCounters,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_arithmetic!(tag(state)?.arithmetic(), A => {
                let found = shared::<SceneStateOf<A>, _>(state)?.state.state().counters();
                Ok(sized::write(counters, &found.into())?)
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Renders one servo period in a scene: as `asperity_tick`, on the touched surface instead of the
/// solid of the configuration. `AsperityOutput::surface` says which one is in contact.
///
/// # Safety
/// As `asperity_tick`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_scene_tick(
    renderer: *const AsperityRenderer,
    scene: *const AsperityScene,
    state: *mut AsperitySceneState,
    sample: *const AsperitySample,
    output: *mut AsperityOutput,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        rendered(sample, output, |sample| {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                let renderer = &shared::<RendererOf<A>, _>(renderer)?.renderer;
                by_capacity!(tag(scene)?.capacity(), S => {
                    let scene = shared::<SceneOf<S, A>, _>(scene)?;
                    let state = &mut exclusive::<SceneStateOf<A>, _>(state)?.state;
                    same_rate(renderer, scene.servo_rate_hz)?;
                    // The tag says that the scene was loaded.
                    let scene = scene.scene.assume_init_ref();
                    let result = renderer.tick_scene(scene, state, &Sample::of(sample));
                    let touched = state.touched().and_then(|index| u32::try_from(index).ok());
                    Ok(AsperityOutput {
                        surface: touched.unwrap_or(ASPERITY_NO_SURFACE),
                        ..result.into()
                    })
                }, else AsperityStatus::NotInitialised)
            }, else AsperityStatus::NotInitialised)
        })
    }
}
