//! Capacities of texture slots, and the choice of one for a texture.

use crate::{
    AsperityError, AsperityStatus,
    library::slice,
    memory::{self, write},
    status::{Fault, call},
};
use asperity_formats::{Asset, Library};
use asperity_runtime::{Capacities, Capacity, HostCapacities, Needs, Texture};

/// Capacity of a slot: 48 vertices, 64 triangles, order 8 without an MA part, 520 tap samples. That
/// is a material that was compiled with `--fidelity 8`, at 1 kHz.
pub const ASPERITY_CAPACITY_SMALL: u32 = 0;
/// Capacity of a slot: 48 vertices, 64 triangles, order 24 without an MA part, 520 tap samples. That
/// is a material of a prompt, at 1 kHz.
pub const ASPERITY_CAPACITY_MEDIUM: u32 = 1;
/// Capacity of a slot: every texture of the format, at servo rates up to 10 kHz.
pub const ASPERITY_CAPACITY_LARGE: u32 = 2;

/// Size of the memory of an `AsperityTexture` of `ASPERITY_CAPACITY_SMALL`, bytes.
pub const ASPERITY_TEXTURE_SIZE_SMALL: usize = 7168;
/// Size of the memory of an `AsperityTexture` of `ASPERITY_CAPACITY_MEDIUM`, bytes.
pub const ASPERITY_TEXTURE_SIZE_MEDIUM: usize = 10240;
/// Size of the memory of an `AsperityTexture` of `ASPERITY_CAPACITY_LARGE`, bytes.
pub const ASPERITY_TEXTURE_SIZE_LARGE: usize = 40960;

/// A capacity that C can name.
pub(crate) trait Class: Capacity {
    /// Its number.
    const NUMBER: u32;
    /// Size of a slot in the header, bytes.
    const SIZE: usize;
}

pub(crate) type Small = Capacities<48, 64, 8, 0, 520>;
pub(crate) type Medium = Capacities<48, 64, 24, 0, 520>;
pub(crate) type Large = HostCapacities;

impl Class for Small {
    const NUMBER: u32 = ASPERITY_CAPACITY_SMALL;
    const SIZE: usize = ASPERITY_TEXTURE_SIZE_SMALL;
}

impl Class for Medium {
    const NUMBER: u32 = ASPERITY_CAPACITY_MEDIUM;
    const SIZE: usize = ASPERITY_TEXTURE_SIZE_MEDIUM;
}

impl Class for Large {
    const NUMBER: u32 = ASPERITY_CAPACITY_LARGE;
    const SIZE: usize = ASPERITY_TEXTURE_SIZE_LARGE;
}

/// Evaluates `$body` with `$S` as the capacity of a number, or `$none` where there is no
/// such capacity.
macro_rules! by_capacity {
    ($number:expr, $S:ident => $body:expr, else $none:expr) => {
        match $number {
            $crate::capacity::ASPERITY_CAPACITY_SMALL => {
                type $S = $crate::capacity::Small;
                $body
            }
            $crate::capacity::ASPERITY_CAPACITY_MEDIUM => {
                type $S = $crate::capacity::Medium;
                $body
            }
            $crate::capacity::ASPERITY_CAPACITY_LARGE => {
                type $S = $crate::capacity::Large;
                $body
            }
            _ => Err($none.into()),
        }
    };
}

/// Evaluates `$body` with the capacity and the arithmetic that a tag names.
macro_rules! by_kind {
    ($tag:expr, $S:ident, $A:ident => $body:expr) => {{
        let tag: $crate::memory::Tag = $tag;
        $crate::arithmetic::by_arithmetic!(
            tag.arithmetic(),
            $A => $crate::capacity::by_capacity!(
                tag.capacity(),
                $S => $body,
                else $crate::AsperityStatus::NotInitialised
            ),
            else $crate::AsperityStatus::NotInitialised
        )
    }};
}
pub(crate) use {by_capacity, by_kind};

// Slots in either arithmetic take nearly the same room.
const _: () = {
    const HEAD: usize = memory::ASPERITY_ALIGNMENT;
    assert!(size_of::<Texture<Small>>() + HEAD <= ASPERITY_TEXTURE_SIZE_SMALL);
    assert!(size_of::<Texture<Medium>>() + HEAD <= ASPERITY_TEXTURE_SIZE_MEDIUM);
    assert!(size_of::<Texture<Large>>() + HEAD <= ASPERITY_TEXTURE_SIZE_LARGE);
};

/// The smallest capacity for an asset: a function of its own, so that callers do not need stack for
/// one.
#[inline(never)]
fn least(asset: &[u8], servo_rate_hz: f32) -> Result<u32, Fault> {
    // By reference: an asset that is moved takes its room twice.
    let needs = match &Asset::parse_haptic(asset) {
        Ok(asset) => Needs::of(asset, servo_rate_hz)?,
        Err(error) => return Err((*error).into()),
    };
    if needs.fit::<Small>().is_ok() {
        Ok(ASPERITY_CAPACITY_SMALL)
    } else if needs.fit::<Medium>().is_ok() {
        Ok(ASPERITY_CAPACITY_MEDIUM)
    } else {
        needs.fit::<Large>()?;
        Ok(ASPERITY_CAPACITY_LARGE)
    }
}

/// The smallest `ASPERITY_CAPACITY_*` whose slots have room for an asset (`.asp`) at a servo rate.
/// It does not depend on the arithmetic.
///
/// # Safety
/// `asset` is null or `len` readable bytes; `capacity` and `error` are null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_asset_capacity(
    asset: *const u8,
    len: usize,
    servo_rate_hz: f32,
    capacity: *mut u32,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            Ok(write(capacity, least(slice(asset, len)?, servo_rate_hz)?)?)
        })
    }
}

/// The smallest `ASPERITY_CAPACITY_*` whose slots have room for every texture of a library
/// (`.aspl`) at a servo rate.
///
/// # Safety
/// As `asperity_asset_capacity`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_library_capacity(
    library: *const u8,
    len: usize,
    servo_rate_hz: f32,
    capacity: *mut u32,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let library = Library::parse(slice(library, len)?)?;
            let mut largest = ASPERITY_CAPACITY_SMALL;
            for index in 0..library.index().len() {
                largest = largest.max(least(library.bytes(index)?, servo_rate_hz)?);
            }
            Ok(write(capacity, largest)?)
        })
    }
}
