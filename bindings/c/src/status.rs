//! Status codes and their texts, and the border, which no panic crosses.

use crate::{sized::stated, text::Text};
use asperity_formats::FormatError;
use asperity_runtime::{ConfigError, LoadError, PrepareError, SceneError};
use core::{
    ffi::{CStr, c_char},
    fmt::{self, Write as _},
    mem::{self, MaybeUninit},
    slice,
};

/// Size of `AsperityError::message`, bytes.
pub const ASPERITY_MESSAGE_SIZE: usize = 248;

/// Result of a call.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AsperityStatus {
    /// Success.
    Ok = 0,
    /// A required pointer is null.
    NullPointer = 1,
    /// The memory is too small or misaligned.
    Memory = 2,
    /// A pointer does not lead to an initialised object of the right kind, or leads to an exchange
    /// or a scene that was copied.
    NotInitialised = 3,
    /// The bytes are not a valid library or asset.
    Format = 4,
    /// The library has no such texture.
    NoSuchTexture = 5,
    /// The texture is too large for a slot.
    Capacity = 6,
    /// The texture cannot be used at this servo rate, or was loaded for another.
    Rate = 7,
    /// A field of the configuration is out of its range.
    Config = 8,
    /// A name is not UTF-8.
    Text = 9,
    /// A panic was caught, which is a defect of this library.
    Internal = 10,
    /// The `struct_size` of a struct is not that of any version, or the struct asks for something
    /// that this version does not know.
    StructSize = 11,
    /// A number is none of those that the header names, such as a capacity.
    Argument = 12,
    /// Every spare slot of an exchange is on its way: try again some ticks later.
    Busy = 13,
    /// The library has textures but no surfaces.
    NoScene = 14,
    /// The processor is set to round otherwise than to nearest: forces would have other bits.
    Rounding = 15,
    /// The slot holds no texture: none was loaded, or the last load was refused.
    NotLoaded = 16,
}

const ALL: [(AsperityStatus, &CStr); 17] = [
    (AsperityStatus::Ok, c"done"),
    (
        AsperityStatus::NullPointer,
        c"a pointer is null that must not be",
    ),
    (AsperityStatus::Memory, c"memory is too small or misaligned"),
    (
        AsperityStatus::NotInitialised,
        c"a pointer leads to no object, to one of another kind or arithmetic, or to a copied exchange or scene",
    ),
    (
        AsperityStatus::Format,
        c"the bytes are no valid library or asset",
    ),
    (
        AsperityStatus::NoSuchTexture,
        c"the library has no such texture",
    ),
    (
        AsperityStatus::Capacity,
        c"the texture is too large for a slot",
    ),
    (
        AsperityStatus::Rate,
        c"the texture was loaded for another servo rate, or cannot be used at this one",
    ),
    (
        AsperityStatus::Config,
        c"a field of the configuration is out of its range",
    ),
    (AsperityStatus::Text, c"a name is not UTF-8"),
    (
        AsperityStatus::Internal,
        c"a defect of the library: a panic was caught",
    ),
    (
        AsperityStatus::StructSize,
        c"struct_size is not set, or the struct is of a later version",
    ),
    (
        AsperityStatus::Argument,
        c"an argument is none of the numbers in the header",
    ),
    (
        AsperityStatus::Busy,
        c"no slot is spare yet: try again some ticks later",
    ),
    (
        AsperityStatus::NoScene,
        c"the library holds no scene: build one with `asperity build`",
    ),
    (
        AsperityStatus::Rounding,
        c"the processor rounds otherwise than to nearest: call fesetround(FE_TONEAREST)",
    ),
    (
        AsperityStatus::NotLoaded,
        c"no texture was loaded into the slot, or its last load was refused",
    ),
];

/// Text of a status. Never null; an unknown number has a text, too.
#[unsafe(no_mangle)]
pub extern "C" fn asperity_error_text(status: i32) -> *const c_char {
    let found = ALL.iter().find(|(known, _)| *known as i32 == status);
    found.map_or(c"unknown status", |(_, text)| text).as_ptr()
}

/// A status and its message, which names the field, its value and the rule where it can. Begin with
/// `ASPERITY_ERROR_INIT`.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct AsperityError {
    /// `sizeof(AsperityError)`, from the caller.
    pub struct_size: u32,
    /// Return value of the function.
    pub status: AsperityStatus,
    /// UTF-8 that ends with a null; truncated where it is too long.
    pub message: [c_char; ASPERITY_MESSAGE_SIZE],
}

const _: () = assert!(size_of::<AsperityError>() == 8 + ASPERITY_MESSAGE_SIZE);

/// Why a call failed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fault {
    Plain(AsperityStatus),
    Load(LoadError),
    Config(ConfigError),
    Scene(SceneError),
    /// A field of the configuration that holds none of the numbers it may.
    Choice {
        field: &'static str,
        value: u32,
        known: &'static str,
    },
}

impl From<AsperityStatus> for Fault {
    fn from(status: AsperityStatus) -> Self {
        Self::Plain(status)
    }
}

impl From<LoadError> for Fault {
    fn from(error: LoadError) -> Self {
        Self::Load(error)
    }
}

impl From<FormatError> for Fault {
    fn from(error: FormatError) -> Self {
        Self::Load(error.into())
    }
}

impl From<ConfigError> for Fault {
    fn from(error: ConfigError) -> Self {
        Self::Config(error)
    }
}

impl From<SceneError> for Fault {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

impl From<PrepareError> for Fault {
    fn from(error: PrepareError) -> Self {
        match error {
            PrepareError::Load(error) => Self::Load(error),
            _ => Self::Plain(AsperityStatus::Busy),
        }
    }
}

/// The status of a texture that was refused.
const fn refusal(error: &LoadError) -> AsperityStatus {
    match error {
        LoadError::Format(FormatError::NoSuchTexture { .. }) => AsperityStatus::NoSuchTexture,
        LoadError::Capacity { .. } => AsperityStatus::Capacity,
        LoadError::Rate { .. } => AsperityStatus::Rate,
        LoadError::Rounding => AsperityStatus::Rounding,
        _ => AsperityStatus::Format,
    }
}

impl Fault {
    fn status(&self) -> AsperityStatus {
        match self {
            Self::Plain(status) => *status,
            Self::Load(error) | Self::Scene(SceneError::Texture { cause: error, .. }) => {
                refusal(error)
            }
            Self::Scene(SceneError::NoScene) => AsperityStatus::NoScene,
            Self::Scene(SceneError::Capacity { .. }) => AsperityStatus::Capacity,
            Self::Scene(_) => AsperityStatus::Format,
            Self::Config(error) if *error == ConfigError::ROUNDING => AsperityStatus::Rounding,
            Self::Config(_) | Self::Choice { .. } => AsperityStatus::Config,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plain(status) => {
                let text = ALL.iter().find(|(known, _)| known == status);
                f.write_str(text.map_or("", |(_, text)| text.to_str().unwrap_or("")))
            }
            Self::Load(error) => error.fmt(f),
            Self::Config(error) => error.fmt(f),
            Self::Scene(error) => error.fmt(f),
            Self::Choice {
                field,
                value,
                known,
            } => write!(f, "{field} is {value}, but must be {known}"),
        }
    }
}

/// Runs `f` at the border and reports to `error` when there is one.
///
/// # Safety
/// `error` is null or leads to as many writable bytes as its first field says.
pub(crate) unsafe fn call(
    error: *mut AsperityError,
    f: impl FnOnce() -> Result<(), Fault>,
) -> AsperityStatus {
    // SAFETY: the caller's promise.
    let room = match unsafe { room(error) } {
        Ok(room) => room,
        Err(status) => return status,
    };
    let result = caught(f);
    let status = match &result {
        Ok(()) => AsperityStatus::Ok,
        Err(fault) => fault.status(),
    };
    if let Some(room) = room {
        // SAFETY: `room` found the place of a status and a text.
        let message = unsafe {
            (&raw mut (*error).status).write(status);
            let text = (&raw mut (*error).message).cast::<c_char>();
            slice::from_raw_parts_mut(text.cast::<MaybeUninit<c_char>>(), room)
        };
        let mut message = Text::new(message);
        if let Err(fault) = &result {
            // Writing never fails: a message that does not fit is truncated.
            let _ = write!(message, "{fault}");
        }
    }
    status
}

/// Bytes for the message of an error, if there is one.
///
/// # Safety
/// As `call`.
unsafe fn room(error: *mut AsperityError) -> Result<Option<usize>, AsperityStatus> {
    if error.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    let size = unsafe { stated(error, size_of::<AsperityError>())? };
    Ok(Some(size - mem::offset_of!(AsperityError, message)))
}

#[cfg(feature = "std")]
fn caught(f: impl FnOnce() -> Result<(), Fault>) -> Result<(), Fault> {
    // A panic can leave an object half written. It holds plain numbers, so any value is valid.
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(f))
        .unwrap_or(Err(Fault::Plain(AsperityStatus::Internal)))
}

#[cfg(not(feature = "std"))]
fn caught(f: impl FnOnce() -> Result<(), Fault>) -> Result<(), Fault> {
    f()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(status: i32) -> String {
        // SAFETY: every text ends with a null and lives for ever.
        let text = unsafe { CStr::from_ptr(asperity_error_text(status)) };
        text.to_str().unwrap().to_owned()
    }

    #[test]
    fn every_status_has_a_text_of_its_own() {
        let texts: Vec<_> = (0..ALL.len() as i32).map(text).collect();
        for (index, one) in texts.iter().enumerate() {
            assert!(!one.is_empty() && !texts[..index].contains(one), "{one}");
        }
        for none in [-1, ALL.len() as i32, i32::MIN, i32::MAX] {
            assert_eq!(text(none), "unknown status");
        }
    }

    #[test]
    fn a_panic_becomes_a_status() {
        // SAFETY: no error to fill.
        let status = unsafe { call(core::ptr::null_mut(), || panic!("on purpose")) };
        assert_eq!(status, AsperityStatus::Internal);
    }
}
