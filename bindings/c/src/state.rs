//! State of a renderer, which changes from tick to tick.

use crate::{
    AsperityCounters, AsperityRenderer, AsperityStatus,
    arithmetic::{Numbered, by_arithmetic},
    memory::{Object, Tag, room, shared, tag, uninit},
    renderer::RendererOf,
    sized,
    status::call,
};
use asperity_runtime::State;
use core::{ffi::c_void, ptr};

/// Size of the memory of an `AsperityState`, bytes.
pub const ASPERITY_STATE_SIZE: usize = 2048;

/// State of one stylus on one texture. One thread at a time may use it.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityState {
    tag: Tag,
}

/// Object behind an `AsperityState` pointer.
#[repr(C)]
pub(crate) struct StateOf<A: Numbered> {
    tag: Tag,
    pub(crate) state: State<A>,
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl<A: Numbered> Object for StateOf<A> {
    const TAG: Tag = Tag::new(b'S', A::NUMBER, 0);
}

/// Makes a state at rest, without force, in `memory` of at least `ASPERITY_STATE_SIZE` bytes, for
/// the arithmetic of a renderer. `seed` selects the noise of the excitation.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
/// renderer; `state` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_state_init(
    memory: *mut c_void,
    size: usize,
    renderer: *const AsperityRenderer,
    seed: u64,
    state: *mut *mut AsperityState,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                shared::<RendererOf<A>, _>(renderer)?;
                let object = room::<StateOf<A>, _>(memory, size, ASPERITY_STATE_SIZE, state)?;
                State::init(uninit(&raw mut (*object).state), seed);
                (&raw mut (*object).tag).write(StateOf::<A>::TAG);
                state.write(object.cast());
                Ok(())
            }, else AsperityStatus::NotInitialised)
        })
    }
}

/// Reads the counters of a state.
///
/// # Safety
/// `state` is null or an initialised state that nobody writes during the call; `counters`
/// is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_state_counters(
    state: *const AsperityState,
    counters: *mut AsperityCounters,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            by_arithmetic!(tag(state)?.arithmetic(), A => {
                let found = shared::<StateOf<A>, _>(state)?.state.counters();
                Ok(sized::write(counters, &found.into())?)
            }, else AsperityStatus::NotInitialised)
        })
    }
}
