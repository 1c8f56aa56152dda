//! What changes from tick to tick.

use crate::{
    AsperityStatus,
    memory::{self, ASPERITY_STATE_SIZE, Object, place, shared},
    status::call,
};
use asperity_runtime::State;
use core::{ffi::c_void, ptr};

/// State of one stylus. One thread at a time may use it.
#[derive(Debug)]
pub struct AsperityState {
    tag: u32,
    pub(crate) state: State,
}

impl Object for AsperityState {
    const TAG: u32 = u32::from_le_bytes(*b"aspS");
    const SIZE: usize = ASPERITY_STATE_SIZE;

    fn tag(this: *const Self) -> *const u32 {
        // SAFETY: the address is computed and nothing is read; the caller's pointer leads
        // to memory of this size.
        unsafe { &raw const (*this).tag }
    }
}

/// Counts of events since the state was made. They saturate.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AsperityCounters {
    /// Ticks.
    pub ticks: u32,
    /// Bad samples: stale, not finite, out of reach.
    pub bad_samples: u32,
    /// Servo periods that the caller reported as missed.
    pub missed_ticks: u32,
    /// Times the safe state was entered.
    pub faults: u32,
    /// Taps.
    pub taps: u32,
    /// Ticks whose force was cut to the peak.
    pub peak_limited: u32,
    /// Ticks whose force was held back by the slew limit.
    pub slew_limited: u32,
}

/// Makes a state at rest, without force, in `memory` of at least `ASPERITY_STATE_SIZE`
/// bytes. `seed` selects the noise of the excitation.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `state` is null or valid for
/// writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_state_init(
    memory: *mut c_void,
    size: usize,
    seed: u64,
    state: *mut *mut AsperityState,
) -> AsperityStatus {
    let object = || AsperityState {
        tag: AsperityState::TAG,
        state: State::new(seed),
    };
    // SAFETY: the caller's promises; no error to fill.
    unsafe { call(ptr::null_mut(), || Ok(place(memory, size, state, object)?)) }
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
            let found = *shared(state)?.state.counters();
            let value = AsperityCounters {
                ticks: found.ticks,
                bad_samples: found.bad_samples,
                missed_ticks: found.missed_ticks,
                faults: found.faults,
                taps: found.taps,
                peak_limited: found.peak_limited,
                slew_limited: found.slew_limited,
            };
            Ok(memory::write(counters, value)?)
        })
    }
}
