//! Plain structs that begin with their size, so that they can grow.
//!
//! A program sets `struct_size` to the `sizeof` of its own header. A struct of an older header is
//! shorter than ours: what it lacks has its default on the way in, and is left out on the way out. A
//! struct of a newer header is longer: on the way in the rest must be zero, because we do not know
//! what it asks for; on the way out we fill the rest with zeros.

use crate::AsperityStatus;
use core::{ptr, slice};

/// A struct whose first field is its size.
///
/// # Safety
/// `repr(C)`, first a `u32`, then only numbers (any bits are a valid value), and no padding.
pub(crate) unsafe trait Sized: Copy {
    /// Size of the struct in the first version of this major version, bytes.
    const FIRST: usize;
    /// Defaults of the fields that a program of an older header leaves out.
    const DEFAULT: Self;
}

/// No struct of a later version is larger.
const LONGEST: usize = 4096;

/// The size that a program states, where it can be right: at least that of the first version.
///
/// # Safety
/// `value` is null or leads to a readable `u32`.
pub(crate) unsafe fn stated<T>(value: *const T, first: usize) -> Result<usize, AsperityStatus> {
    if value.is_null() {
        return Err(AsperityStatus::NullPointer);
    }
    if !value.is_aligned() {
        return Err(AsperityStatus::Memory);
    }
    // SAFETY: not null and aligned for more than a u32, readable by the caller's promise.
    let size = unsafe { value.cast::<u32>().read() } as usize;
    if (first..=LONGEST).contains(&size) && size.is_multiple_of(align_of::<T>()) {
        Ok(size)
    } else {
        Err(AsperityStatus::StructSize)
    }
}

/// Reads a struct that C passes.
///
/// # Safety
/// `value` is null or leads to as many readable bytes as its first field says.
pub(crate) unsafe fn read<T: Sized>(value: *const T) -> Result<T, AsperityStatus> {
    // SAFETY: the caller's promise.
    let stated = unsafe { stated(value, T::FIRST)? };
    let known = stated.min(size_of::<T>());
    let bytes = value.cast::<u8>();
    // SAFETY: within the stated size.
    let unknown = unsafe { slice::from_raw_parts(bytes.add(known), stated - known) };
    if unknown.iter().any(|byte| *byte != 0) {
        return Err(AsperityStatus::StructSize);
    }
    let mut found = T::DEFAULT;
    // SAFETY: `known` bytes are readable, and no more than a `T` has. Any bits are a `T`.
    unsafe { ptr::copy_nonoverlapping(bytes, ptr::from_mut(&mut found).cast(), known) };
    Ok(found)
}

/// Writes a struct to a place that C passes. The size at the place stays as it is.
///
/// # Safety
/// `place` is null or leads to as many writable bytes as its first field says.
pub(crate) unsafe fn write<T: Sized>(place: *mut T, value: &T) -> Result<(), AsperityStatus> {
    const HEAD: usize = size_of::<u32>();
    // SAFETY: the caller's promise.
    let stated = unsafe { stated(place, T::FIRST)? };
    let known = stated.min(size_of::<T>());
    let (to, from) = (place.cast::<u8>(), ptr::from_ref(value).cast::<u8>());
    // SAFETY: within the stated size and within a `T`; a local value is no part of C's memory.
    unsafe {
        ptr::copy_nonoverlapping(from.add(HEAD), to.add(HEAD), known - HEAD);
        ptr::write_bytes(to.add(known), 0, stated - known);
    }
    Ok(())
}

/// Implements [`Sized`] for a struct whose last field of the first version is named, and checks at
/// compile time what the trait asks for.
macro_rules! sized {
    ($name:ident, first version ends with $last:ident, lacking fields are $default:expr) => {
        const _: () = {
            assert!(core::mem::offset_of!($name, struct_size) == 0);
            assert!(align_of::<$name>() == align_of::<u32>());
        };

        // SAFETY: `repr(C)` and numbers of four bytes, as its definition shows; the size is first.
        unsafe impl $crate::sized::Sized for $name {
            const FIRST: usize = $crate::sized::end!($name, $last);
            const DEFAULT: Self = $default;
        }
    };
}

/// Where a field ends.
macro_rules! end {
    ($name:ident, $field:ident) => {{
        const fn of<T, F>(_: fn(&T) -> &F, offset: usize) -> usize {
            offset + size_of::<F>()
        }
        of(
            |value: &$name| &value.$field,
            core::mem::offset_of!($name, $field),
        )
    }};
}

pub(crate) use {end, sized};
