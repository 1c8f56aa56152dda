//! The contents of a library, and how bytes and names from C are read.

use crate::{
    AsperityError, AsperityStatus, memory,
    status::{Fault, call},
};
use asperity_formats::{FormatError, Library, library::LibraryIndex, limits::MAX_NAME_BYTES};
use core::{
    ffi::{CStr, c_char},
    slice,
};

/// Size of a buffer for the name of any texture and its terminating null, bytes.
pub const ASPERITY_NAME_SIZE: usize = 65;

const _: () = assert!(ASPERITY_NAME_SIZE == MAX_NAME_BYTES + 1);

/// Bytes that C passes.
///
/// # Safety
/// `bytes` is null or leads to `len` readable bytes that nobody writes while the slice
/// lives.
pub(crate) unsafe fn slice<'a>(bytes: *const u8, len: usize) -> Result<&'a [u8], AsperityStatus> {
    if bytes.is_null() {
        return Err(AsperityStatus::NullPointer);
    }
    if len > isize::MAX as usize {
        return Err(AsperityStatus::Memory);
    }
    // SAFETY: not null, not too long, readable and unchanged by the caller's promise.
    Ok(unsafe { slice::from_raw_parts(bytes, len) })
}

/// A name that C passes.
///
/// # Safety
/// `name` is null or ends with a null, and nobody writes to it while the text lives.
pub(crate) unsafe fn name<'a>(name: *const c_char) -> Result<&'a str, AsperityStatus> {
    if name.is_null() {
        return Err(AsperityStatus::NullPointer);
    }
    // SAFETY: not null; the caller promises the null at its end.
    let name = unsafe { CStr::from_ptr(name) };
    name.to_str().map_err(|_| AsperityStatus::Text)
}

/// The index of `name` in a library.
fn find(library: &LibraryIndex<'_>, name: &str) -> Result<usize, AsperityStatus> {
    library.find(name).ok_or(AsperityStatus::NoSuchTexture)
}

/// The bytes of the asset at an index of a whole library: a function of its own, so that loading
/// needs no stack for the library.
#[inline(never)]
pub(crate) fn asset_at(library: &[u8], index: usize) -> Result<&[u8], Fault> {
    Ok(Library::parse(library)?.bytes(index)?)
}

/// The same by name.
#[inline(never)]
pub(crate) fn asset_called<'a>(library: &'a [u8], name: &str) -> Result<&'a [u8], Fault> {
    let library = Library::parse(library)?;
    Ok(library.bytes(find(library.index(), name)?)?)
}

/// Counts the textures of a library. Only the index is checked, so the beginning of a file
/// is enough.
///
/// # Safety
/// `library` is null or `len` readable bytes; `count` and `error` are null or valid for
/// writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_library_count(
    library: *const u8,
    len: usize,
    count: *mut usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let index = LibraryIndex::parse(slice(library, len)?)?;
            Ok(memory::write(count, index.len())?)
        })
    }
}

/// Finds the index of the texture called `texture`.
///
/// # Safety
/// `library` is null or `len` readable bytes, `texture` null or a text that ends with a
/// null; `index` and `error` are null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_library_find(
    library: *const u8,
    len: usize,
    texture: *const c_char,
    index: *mut usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let library = LibraryIndex::parse(slice(library, len)?)?;
            Ok(memory::write(index, find(&library, name(texture)?)?)?)
        })
    }
}

/// Copies the name of the texture at `index`, in order of names, into `text` of `size`
/// bytes; `ASPERITY_NAME_SIZE` are always enough.
///
/// # Safety
/// `library` is null or `len` readable bytes; `text` is null or `size` writable bytes;
/// `error` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_library_name(
    library: *const u8,
    len: usize,
    index: usize,
    text: *mut c_char,
    size: usize,
    error: *mut AsperityError,
) -> AsperityStatus {
    // SAFETY: the caller's promises.
    unsafe {
        call(error, || {
            let library = LibraryIndex::parse(slice(library, len)?)?;
            let name = library.get(index).ok_or(FormatError::NoSuchTexture {
                index,
                count: library.len(),
            })?;
            copy(name.name, text, size)
        })
    }
}

/// # Safety
/// `text` is null or `size` writable bytes.
unsafe fn copy(name: &str, text: *mut c_char, size: usize) -> Result<(), Fault> {
    if text.is_null() {
        return Err(AsperityStatus::NullPointer.into());
    }
    if size <= name.len() {
        return Err(AsperityStatus::Memory.into());
    }
    // SAFETY: the name and its null fit into the caller's `size` bytes, which are no part
    // of the library that is being read.
    unsafe {
        text.copy_from_nonoverlapping(name.as_ptr().cast(), name.len());
        text.add(name.len()).write(0);
    }
    Ok(())
}
