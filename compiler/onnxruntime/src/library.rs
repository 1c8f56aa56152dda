//! Opens a file as ONNX Runtime, in steps that can each fail with a reason.

use std::{
    ffi::{CStr, OsStr, c_char},
    ptr::NonNull,
};

use libloading::Library;
use ort::sys::{ORT_API_VERSION, OrtApi};
use thiserror::Error;

/// `OrtApiBase` of onnxruntime_c_api.h. Its functions may be null, since the library may be any.
#[repr(C)]
struct ApiBase {
    get_api: Option<unsafe extern "system" fn(version: u32) -> *const OrtApi>,
    version: Option<unsafe extern "system" fn() -> *const c_char>,
}

/// Why a file is not an ONNX Runtime that we can use.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub(crate) enum Refusal {
    #[error("cannot be opened as a library: {0}")]
    Open(String),
    #[error("has no function OrtGetApiBase, so is not ONNX Runtime")]
    Entry,
    #[error("OrtGetApiBase gives nothing")]
    Base,
    #[error(
        "is version {version}, which has no API level {ORT_API_VERSION}; 1.{ORT_API_VERSION} or newer is needed"
    )]
    Level { version: String },
}

/// An opened library; it stays open until the process ends.
#[derive(Debug)]
pub(crate) struct Opened {
    /// The version that it reports, for example `1.31.1`.
    pub(crate) version: String,
    api: NonNull<OrtApi>,
}

/// Opens a library by its path, or by its name along the system's search path.
#[allow(
    unsafe_code,
    reason = "the functions of a library that is found at run time"
)]
pub(crate) fn open(name: &OsStr) -> Result<Opened, Refusal> {
    // SAFETY: opening runs the library's initialisers. The file is one that the user named or
    // installed as ONNX Runtime; its initialisers expect nothing of the process.
    let library =
        unsafe { Library::new(name) }.map_err(|error| Refusal::Open(error.to_string()))?;
    // SAFETY: the C API declares `const OrtApiBase* OrtGetApiBase(void)` with the platform's C
    // calling convention, which is "system" on all 64-bit targets.
    let entry =
        unsafe { library.get::<unsafe extern "system" fn() -> *const ApiBase>(b"OrtGetApiBase\0") };
    let entry = *entry.map_err(|_| Refusal::Entry)?;
    // Threads of the library may run on, so it is never closed, used or not.
    std::mem::forget(library);
    // SAFETY: the library is open for good, and the signature is that of the C API.
    let base = unsafe { entry() };
    // SAFETY: `OrtGetApiBase` gives null or a pointer to a table of constants of the library
    // with these two members first, in every version.
    let base = unsafe { base.as_ref() }.ok_or(Refusal::Base)?;
    let (Some(get_api), Some(version)) = (base.get_api, base.version) else {
        return Err(Refusal::Base);
    };
    // SAFETY: takes no arguments and gives a constant string of the library.
    let version = unsafe { version() };
    if version.is_null() {
        return Err(Refusal::Base);
    }
    // SAFETY: not null, and a constant string ends with a zero byte.
    let version = unsafe { CStr::from_ptr(version) }
        .to_string_lossy()
        .into_owned();
    // SAFETY: any number is allowed; unknown levels give null.
    let api = unsafe { get_api(ORT_API_VERSION) };
    match NonNull::new(api.cast_mut()) {
        Some(api) => Ok(Opened { version, api }),
        None => Err(Refusal::Level { version }),
    }
}

impl Opened {
    /// Hands the library's functions to `ort`; the first library wins for the whole process.
    #[allow(unsafe_code, reason = "copies the table of functions")]
    pub(crate) fn install(&self) -> bool {
        // SAFETY: `GetApi` gave a table of at least the functions of level `ORT_API_VERSION`, which is
        // the size of `OrtApi` as `ort` is built here; it is constant, and the library stays open.
        // The table is plain function pointers, so a copy of it is as good.
        ort::set_api(unsafe { self.api.as_ptr().read() })
    }
}
