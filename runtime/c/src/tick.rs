//! One servo period.

use crate::{
    AsperityRenderer, AsperityState, AsperityStatus, AsperityTexture,
    memory::{exclusive, read, shared, write},
    status::call,
};
use asperity_runtime::{Output, Sample};
use core::ptr;

/// Device sample of one servo period.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperitySample {
    /// Stylus position in the world frame, m. Anything not finite, or beyond 10 km, is a bad
    /// sample.
    pub position_m: [f32; 3],
    /// Servo periods since the sample before: 1 in a healthy loop, more after missed
    /// periods, 0 when the device had nothing new.
    pub elapsed_ticks: u32,
}

/// Output of a tick.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperityOutput {
    /// Force on the hand in the world frame, N; finite, within peak and slew.
    pub force_n: [f32; 3],
    /// Depth inside the surface, m; 0 outside.
    pub depth_m: f32,
    /// Estimated tangential speed, mm/s.
    pub speed_mm_s: f32,
    /// Normal force of the spring, k·δ, N.
    pub normal_force_n: f32,
    /// Vibration before device gain, m/s².
    pub vib_m_s2: f32,
    /// Tap force along the normal, N.
    pub tap_n: f32,
    /// Magnitude of the friction force, N.
    pub friction_n: f32,
    /// Events: bits `ASPERITY_FLAG_*`.
    pub flags: u32,
}

/// Bits of `AsperityOutput::flags`.
pub mod flags {
    use asperity_runtime::Flags;

    /// The stylus is inside the surface.
    pub const ASPERITY_FLAG_CONTACT: u32 = 1;
    /// A tap transient started.
    pub const ASPERITY_FLAG_TAP_STARTED: u32 = 2;
    /// A tap transient is under way.
    pub const ASPERITY_FLAG_TAP_ACTIVE: u32 = 4;
    /// Speed or force lie outside the grid.
    pub const ASPERITY_FLAG_OUTSIDE_GRID: u32 = 8;
    /// The force was cut to the device's peak.
    pub const ASPERITY_FLAG_PEAK_LIMITED: u32 = 16;
    /// The force was held back by the slew limit.
    pub const ASPERITY_FLAG_SLEW_LIMITED: u32 = 32;
    /// A bad sample; the last good one was held.
    pub const ASPERITY_FLAG_HELD_SAMPLE: u32 = 64;
    /// The safe state: the force goes to zero.
    pub const ASPERITY_FLAG_SAFE_STATE: u32 = 128;
    /// The force comes back after a fault.
    pub const ASPERITY_FLAG_RAMPING: u32 = 256;
    /// The vibration reached its bound.
    pub const ASPERITY_FLAG_VIB_CLAMPED: u32 = 512;

    // The header needs literal numbers. Here they are held to those of the runtime.
    const _: () = {
        assert!(ASPERITY_FLAG_CONTACT == Flags::CONTACT.bits() as u32);
        assert!(ASPERITY_FLAG_TAP_STARTED == Flags::TAP_STARTED.bits() as u32);
        assert!(ASPERITY_FLAG_TAP_ACTIVE == Flags::TAP_ACTIVE.bits() as u32);
        assert!(ASPERITY_FLAG_OUTSIDE_GRID == Flags::OUTSIDE_GRID.bits() as u32);
        assert!(ASPERITY_FLAG_PEAK_LIMITED == Flags::PEAK_LIMITED.bits() as u32);
        assert!(ASPERITY_FLAG_SLEW_LIMITED == Flags::SLEW_LIMITED.bits() as u32);
        assert!(ASPERITY_FLAG_HELD_SAMPLE == Flags::HELD_SAMPLE.bits() as u32);
        assert!(ASPERITY_FLAG_SAFE_STATE == Flags::SAFE_STATE.bits() as u32);
        assert!(ASPERITY_FLAG_RAMPING == Flags::RAMPING.bits() as u32);
        assert!(ASPERITY_FLAG_VIB_CLAMPED == Flags::VIB_CLAMPED.bits() as u32);
        assert!(Flags::ALL.len() == 10);
    };
}

/// Output of a refused tick: no force, safe state.
const NOTHING: AsperityOutput = AsperityOutput {
    force_n: [0.0; 3],
    depth_m: 0.0,
    speed_mm_s: 0.0,
    normal_force_n: 0.0,
    vib_m_s2: 0.0,
    tap_n: 0.0,
    friction_n: 0.0,
    flags: flags::ASPERITY_FLAG_SAFE_STATE,
};

impl From<Output> for AsperityOutput {
    fn from(output: Output) -> Self {
        Self {
            force_n: output.force_n,
            depth_m: output.depth_m,
            speed_mm_s: output.speed_mm_s,
            normal_force_n: output.normal_force_n,
            vib_m_s2: output.vib_m_s2,
            tap_n: output.tap_n,
            friction_n: output.friction_n,
            flags: u32::from(output.flags.bits()),
        }
    }
}

/// One servo period: a device sample in, a limited force out. If the pointers are right and
/// the texture was loaded for the renderer's rate, it succeeds for every sample. Otherwise
/// the output, where there is one, is zero force and the safe state.
///
/// # Safety
/// `renderer`, `texture` and `state` are null or initialised objects; nobody writes to the
/// first two during the call, nobody else uses the third. `sample` is null or readable,
/// `output` null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_tick(
    renderer: *const AsperityRenderer,
    texture: *const AsperityTexture,
    state: *mut AsperityState,
    sample: *const AsperitySample,
    output: *mut AsperityOutput,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            // Stays in place if a check below fails.
            write(output, NOTHING)?;
            let renderer = &shared(renderer)?.renderer;
            let texture = &shared(texture)?.texture;
            let state = &mut exclusive(state)?.state;
            let sample = read(sample)?;
            // Compared exactly: both were given the same number, or they do not belong together.
            if texture.servo_rate_hz() != renderer.config().servo_rate_hz {
                return Err(AsperityStatus::Rate.into());
            }
            let sample = Sample {
                position_m: sample.position_m,
                elapsed_ticks: sample.elapsed_ticks,
            };
            let result = renderer.tick(texture, state, &sample);
            Ok(write(output, result.into())?)
        })
    }
}
