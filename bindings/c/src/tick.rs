//! Servo period: sample, output and tick.

use crate::{
    AsperityRenderer, AsperityState, AsperityStatus, AsperityTexture,
    arithmetic::{Numbered, by_arithmetic},
    capacity::by_capacity,
    memory::{exclusive, shared, tag},
    renderer::RendererOf,
    sized::{self, sized},
    state::StateOf,
    status::{Fault, call},
    texture::TextureOf,
};
use asperity_runtime::{
    Output, Renderer, Sample,
    math::rounds_to_nearest,
    quantity::{
        Quantity,
        unit::{Metre, MillimetrePerSecond, Newton, VibrationAcceleration},
    },
};
use core::ptr;

/// `AsperityOutput::surface` where no surface of a scene is in contact.
pub const ASPERITY_NO_SURFACE: u32 = 0xffff_ffff;

/// Device sample of one servo period. Set `struct_size`, or begin with `ASPERITY_SAMPLE_INIT`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperitySample {
    /// `sizeof(AsperitySample)`, from the caller.
    pub struct_size: u32,
    /// Stylus position in the world frame, m. Anything not finite, or beyond the
    /// configuration's `reach_m`, is a bad sample.
    pub position_m: [f32; 3],
    /// Servo periods since the sample before: 1 in a healthy loop, more after missed
    /// periods, 0 when the device had nothing new.
    pub elapsed_ticks: u32,
}

sized!(AsperitySample, first version ends with elapsed_ticks, lacking fields are AsperitySample {
    struct_size: size_of::<AsperitySample>() as u32,
    position_m: [0.0; 3],
    elapsed_ticks: 0,
});

/// Output of a tick. Set `struct_size` once, or begin with `ASPERITY_OUTPUT_INIT`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperityOutput {
    /// `sizeof(AsperityOutput)`, from the caller.
    pub struct_size: u32,
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
    /// Index in the scene of the surface in contact, `ASPERITY_NO_SURFACE` for none and outside of
    /// scenes.
    pub surface: u32,
}

sized!(AsperityOutput, first version ends with flags, lacking fields are NOTHING);

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
    struct_size: size_of::<AsperityOutput>() as u32,
    force_n: [0.0; 3],
    depth_m: 0.0,
    speed_mm_s: 0.0,
    normal_force_n: 0.0,
    vib_m_s2: 0.0,
    tap_n: 0.0,
    friction_n: 0.0,
    flags: flags::ASPERITY_FLAG_SAFE_STATE,
    surface: ASPERITY_NO_SURFACE,
};

impl<A: Numbered> From<Output<A>> for AsperityOutput {
    fn from(output: Output<A>) -> Self {
        Self {
            force_n: output.force_n.map(|x| Quantity::<A, Newton>(x).value()),
            depth_m: Quantity::<A, Metre>(output.depth_m).value(),
            speed_mm_s: Quantity::<A, MillimetrePerSecond>(output.speed_mm_s).value(),
            normal_force_n: Quantity::<A, Newton>(output.normal_force_n).value(),
            vib_m_s2: Quantity::<A, VibrationAcceleration>(output.vib_m_s2).value(),
            tap_n: Quantity::<A, Newton>(output.tap_n).value(),
            friction_n: Quantity::<A, Newton>(output.friction_n).value(),
            flags: u32::from(output.flags.bits()),
            ..NOTHING
        }
    }
}

/// Runs a tick between the structs of C. The output of a tick that is refused is [`NOTHING`].
///
/// # Safety
/// `sample` and `output` are null or lead to as many bytes as their first fields say.
pub(crate) unsafe fn rendered(
    sample: *const AsperitySample,
    output: *mut AsperityOutput,
    tick: impl FnOnce(&Sample) -> Result<AsperityOutput, Fault>,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            // Stays in place if a check below fails.
            sized::write(output, &NOTHING)?;
            if !rounds_to_nearest() {
                return Err(AsperityStatus::Rounding.into());
            }
            let sample = sized::read(sample)?;
            let result = tick(&Sample {
                position_m: sample.position_m,
                elapsed_ticks: sample.elapsed_ticks,
            })?;
            Ok(sized::write(output, &result)?)
        })
    }
}

/// Checks that a texture was loaded for the rate of a renderer. Compared exactly: both were given
/// the same number, or they do not belong together.
pub(crate) fn same_rate<A: Numbered>(
    renderer: &Renderer<A>,
    servo_rate_hz: f32,
) -> Result<(), AsperityStatus> {
    if servo_rate_hz == renderer.config().servo_rate_hz {
        Ok(())
    } else if servo_rate_hz == 0.0 {
        Err(AsperityStatus::NotLoaded)
    } else {
        Err(AsperityStatus::Rate)
    }
}

/// Renders one servo period: a device sample in, a limited force out. If the pointers are right,
/// the texture was loaded for the renderer's rate and the processor rounds to nearest, it succeeds
/// for every sample. Otherwise the output, where there is one, is zero force and the safe state.
///
/// # Safety
/// `renderer`, `texture` and `state` are null or initialised objects; nobody writes to the
/// first two during the call, nobody else uses the third. `sample` is null or readable,
/// `output` null or valid for writes, both as long as their `struct_size` says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_tick(
    renderer: *const AsperityRenderer,
    texture: *const AsperityTexture,
    state: *mut AsperityState,
    sample: *const AsperitySample,
    output: *mut AsperityOutput,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        rendered(sample, output, |sample| {
            by_arithmetic!(tag(renderer)?.arithmetic(), A => {
                let renderer = &shared::<RendererOf<A>, _>(renderer)?.renderer;
                by_capacity!(tag(texture)?.capacity(), S => {
                    let texture = &shared::<TextureOf<S, A>, _>(texture)?.texture;
                    let state = &mut exclusive::<StateOf<A>, _>(state)?.state;
                    same_rate(renderer, texture.servo_rate_hz())?;
                    Ok(renderer.tick(texture, state, &Sample::of(sample)).into())
                }, else AsperityStatus::NotInitialised)
            }, else AsperityStatus::NotInitialised)
        })
    }
}
