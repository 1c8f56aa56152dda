//! Status codes and their texts, and the border, which no panic crosses.

use asperity_formats::FormatError;
use asperity_runtime::{ConfigError, LoadError};
use core::{
    ffi::{CStr, c_char},
    fmt::{self, Write},
};

/// Size of `AsperityError::message`, bytes.
pub const ASPERITY_MESSAGE_SIZE: usize = 252;

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
    /// A pointer does not lead to an initialised object of the right kind.
    NotInitialised = 3,
    /// The bytes are not a valid library or asset.
    Format = 4,
    /// The library has no such texture.
    NoSuchTexture = 5,
    /// The texture is too large for a slot.
    Capacity = 6,
    /// The texture cannot be used at this servo rate, or none was loaded.
    Rate = 7,
    /// A field of the configuration is out of its range.
    Config = 8,
    /// A name is not UTF-8.
    Text = 9,
    /// A panic was caught, which is a defect of this library.
    Internal = 10,
}

const ALL: [(AsperityStatus, &CStr); 11] = [
    (AsperityStatus::Ok, c"done"),
    (
        AsperityStatus::NullPointer,
        c"a pointer is null that must not be",
    ),
    (AsperityStatus::Memory, c"memory is too small or misaligned"),
    (
        AsperityStatus::NotInitialised,
        c"a pointer leads to no object, or to one of another kind",
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
        c"the texture's rate is not the servo's, or none was loaded",
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
];

/// Text of a status. Never null; an unknown number has a text, too.
#[unsafe(no_mangle)]
pub extern "C" fn asperity_error_text(status: i32) -> *const c_char {
    let found = ALL.iter().find(|(known, _)| *known as i32 == status);
    found.map_or(c"unknown status", |(_, text)| text).as_ptr()
}

/// A status and its message, which names the field, its value and the rule where it can.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct AsperityError {
    /// What the function returned.
    pub status: AsperityStatus,
    /// UTF-8 that ends with a null; truncated where it is too long.
    pub message: [c_char; ASPERITY_MESSAGE_SIZE],
}

/// Why a call failed.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Fault {
    Plain(AsperityStatus),
    Load(LoadError),
    Config(ConfigError),
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

impl Fault {
    fn status(&self) -> AsperityStatus {
        match self {
            Self::Plain(status) => *status,
            Self::Load(LoadError::Format(FormatError::NoSuchTexture { .. })) => {
                AsperityStatus::NoSuchTexture
            }
            Self::Load(LoadError::Capacity { .. }) => AsperityStatus::Capacity,
            Self::Load(LoadError::Rate { .. }) => AsperityStatus::Rate,
            Self::Load(_) => AsperityStatus::Format,
            Self::Config(_) => AsperityStatus::Config,
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
        }
    }
}

/// Runs `f` at the border and reports to `error` when there is one.
///
/// # Safety
/// `error` is null or valid for writes.
pub(crate) unsafe fn call(
    error: *mut AsperityError,
    f: impl FnOnce() -> Result<(), Fault>,
) -> AsperityStatus {
    let result = caught(f);
    let status = match &result {
        Ok(()) => AsperityStatus::Ok,
        Err(fault) => fault.status(),
    };
    if !error.is_null() && error.is_aligned() {
        let mut message = Message::default();
        // Writing never fails: a message that does not fit is truncated.
        let _ = match &result {
            Ok(()) => Ok(()),
            Err(fault) => write!(message, "{fault}"),
        };
        let report = AsperityError {
            status,
            message: message.bytes,
        };
        // SAFETY: not null and aligned; the caller promises a valid place.
        unsafe { error.write(report) };
    }
    status
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

/// A message being written. It always ends with a null.
struct Message {
    bytes: [c_char; ASPERITY_MESSAGE_SIZE],
    len: usize,
}

impl Default for Message {
    fn default() -> Self {
        Self {
            bytes: [0; ASPERITY_MESSAGE_SIZE],
            len: 0,
        }
    }
}

impl Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            let mut four = [0; 4];
            let bytes = character.encode_utf8(&mut four).as_bytes();
            if self.len + bytes.len() >= ASPERITY_MESSAGE_SIZE {
                self.len = ASPERITY_MESSAGE_SIZE;
                return Ok(());
            }
            for byte in bytes {
                self.bytes[self.len] = *byte as c_char;
                self.len += 1;
            }
        }
        Ok(())
    }
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

    #[test]
    fn a_long_message_is_cut_between_characters() {
        let mut message = Message::default();
        for _ in 0..200 {
            message.write_str("µ²").unwrap();
        }
        let bytes: Vec<u8> = message.bytes.iter().map(|b| *b as u8).collect();
        let text = CStr::from_bytes_until_nul(&bytes)
            .unwrap()
            .to_str()
            .unwrap();
        assert!(text.len() >= ASPERITY_MESSAGE_SIZE - 2 && text.chars().all(|c| "µ²".contains(c)));
    }
}
