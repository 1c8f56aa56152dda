//! Objects in the caller's memory, and the checks on a pointer to one.

use crate::AsperityStatus;
use core::{ffi::c_void, mem::MaybeUninit};

/// Alignment of the memory of every object, bytes.
pub const ASPERITY_ALIGNMENT: usize = 64;

/// Tag at the start of an object: its kind, arithmetic and capacity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct Tag(u32);

impl Tag {
    /// No object.
    pub(crate) const NONE: Self = Self(0);

    /// `kind` differs from kind to kind.
    pub(crate) const fn new(kind: u8, arithmetic: u32, capacity: u32) -> Self {
        Self(u32::from_le_bytes([
            0xa5,
            kind,
            arithmetic as u8,
            capacity as u8,
        ]))
    }

    pub(crate) const fn arithmetic(self) -> u32 {
        self.0.to_le_bytes()[2] as u32
    }

    pub(crate) const fn capacity(self) -> u32 {
        self.0.to_le_bytes()[3] as u32
    }
}

/// An object that C holds by an opaque pointer.
///
/// # Safety
/// `repr(C)`, and the first field is a [`Tag`].
pub(crate) unsafe trait Object: Sized {
    /// Different for every type.
    const TAG: Tag;

    /// Returns true if it lies where it was initialised. An object with pointers into its own
    /// memory is invalid where it was copied to.
    fn is_in_place(&self) -> bool {
        true
    }
}

/// Checks memory for an object of type `T` that the header gives `room` bytes.
pub(crate) fn room<T, P>(
    memory: *mut c_void,
    size: usize,
    room: usize,
    out: *mut *mut P,
) -> Result<*mut T, AsperityStatus> {
    if memory.is_null() || out.is_null() {
        return Err(AsperityStatus::NullPointer);
    }
    let misaligned = !memory.addr().is_multiple_of(ASPERITY_ALIGNMENT) || !out.is_aligned();
    let fits = size >= room && size >= size_of::<T>() && align_of::<T>() <= ASPERITY_ALIGNMENT;
    if misaligned || !fits {
        return Err(AsperityStatus::Memory);
    }
    Ok(memory.cast())
}

/// A place in memory that is not initialised yet.
///
/// # Safety
/// `place` is aligned and valid for writes of a `T`, and nothing else uses it meanwhile.
pub(crate) unsafe fn uninit<'a, T>(place: *mut T) -> &'a mut MaybeUninit<T> {
    // SAFETY: the caller's promise; any bytes are a `MaybeUninit`.
    unsafe { &mut *place.cast() }
}

/// The tag at a pointer.
///
/// # Safety
/// `object` is null or leads to four readable bytes.
pub(crate) unsafe fn tag<P>(object: *const P) -> Result<Tag, AsperityStatus> {
    if object.is_null() {
        Err(AsperityStatus::NullPointer)
    } else if !object.addr().is_multiple_of(align_of::<Tag>()) {
        Err(AsperityStatus::Memory)
    } else {
        // SAFETY: not null, aligned and readable by the caller's promise; any bits are a tag.
        Ok(unsafe { object.cast::<Tag>().read() })
    }
}

/// Checks that a pointer leads to a `T`.
///
/// # Safety
/// `object` is null or leads to at least four readable bytes, and to a `T` if they are its tag.
unsafe fn check<T: Object, P>(object: *const P) -> Result<*const T, AsperityStatus> {
    // SAFETY: the caller's promise.
    let found = unsafe { tag(object)? };
    let object = object.cast::<T>();
    if !object.is_aligned() {
        Err(AsperityStatus::Memory)
    } else if found != T::TAG {
        Err(AsperityStatus::NotInitialised)
    } else {
        // SAFETY: aligned; a right tag means that `init` wrote the object, or somebody copied it.
        let in_place = unsafe { (*object).is_in_place() };
        in_place
            .then_some(object)
            .ok_or(AsperityStatus::NotInitialised)
    }
}

/// A shared reference to an object.
///
/// # Safety
/// As `check`; while the reference lives nobody writes to the object.
pub(crate) unsafe fn shared<'a, T: Object, P>(object: *const P) -> Result<&'a T, AsperityStatus> {
    // SAFETY: the caller's promise. A right tag means that `init` wrote the object.
    unsafe { Ok(&*check::<T, P>(object)?) }
}

/// An exclusive reference to an object.
///
/// # Safety
/// As `check`; while the reference lives nobody else reads or writes the object.
pub(crate) unsafe fn exclusive<'a, T: Object, P>(
    object: *mut P,
) -> Result<&'a mut T, AsperityStatus> {
    // SAFETY: the caller's promise. A right tag means that `init` wrote the object.
    unsafe { Ok(&mut *check::<T, P>(object)?.cast_mut()) }
}

/// Writes a number or a pointer to a place that C passes.
///
/// # Safety
/// `place` is null or valid for writes.
pub(crate) unsafe fn write<T: Copy>(place: *mut T, value: T) -> Result<(), AsperityStatus> {
    if place.is_null() {
        Err(AsperityStatus::NullPointer)
    } else if !place.is_aligned() {
        Err(AsperityStatus::Memory)
    } else {
        // SAFETY: not null, aligned, writable by the caller's promise.
        unsafe { place.write(value) };
        Ok(())
    }
}
