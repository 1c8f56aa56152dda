//! The functions of Force Dimension DHD, and one safe method for each use.
#![allow(unsafe_code, reason = "functions of a foreign library are called")]

use std::ffi::{CStr, c_char, c_double, c_int, c_uint, c_ushort};

use super::constants::{MAX_STATUS, TIMEGUARD};
use crate::device::vendor_library::{Library, LibraryError, symbols};

/// The vendor's `char`, a device's number.
type Id = i8;

symbols! {
    /// The functions, by name.
    Functions {
        open = "dhdOpen": fn() -> c_int;
        open_serial = "dhdOpenSerial": fn(c_int) -> c_int;
        close = "dhdClose": fn(Id) -> c_int;
        enable_force = "dhdEnableForce": fn(bool, Id) -> c_int;
        get_position = "dhdGetPosition": fn(*mut c_double, *mut c_double, *mut c_double, Id) -> c_int;
        get_button_mask = "dhdGetButtonMask": fn(Id) -> c_uint;
        set_force = "dhdSetForce": fn(c_double, c_double, c_double, Id) -> c_int;
        get_status = "dhdGetStatus": fn(*mut c_int, Id) -> c_int;
        get_system_name = "dhdGetSystemName": fn(Id) -> *const c_char;
        get_serial_number = "dhdGetSerialNumber": fn(*mut c_ushort, Id) -> c_int;
        error_get_last = "dhdErrorGetLast": fn() -> c_int;
        error_get_str = "dhdErrorGetStr": fn(c_int) -> *const c_char;
    }
}

/// Name and type of every function that is needed.
#[cfg(test)]
pub(super) const FUNCTIONS: &[(&str, &str)] = Functions::ALL;

/// An open device of the library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Number(Id);

/// An error code of the library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Code(pub(super) i32);

/// The library.
#[derive(Debug)]
pub(super) struct Dhd {
    functions: Functions,
}

impl Dhd {
    pub(super) fn find(library: Library) -> Result<Self, LibraryError> {
        Functions::find(library).map(|functions| Self { functions })
    }

    /// The last error.
    fn error(&self) -> Code {
        // SAFETY: no argument.
        Code(unsafe { (self.functions.error_get_last)() })
    }

    /// A result that is negative in a failure.
    fn checked(&self, result: c_int) -> Result<c_int, Code> {
        if result < 0 {
            Err(self.error())
        } else {
            Ok(result)
        }
    }

    /// The library's words for an error.
    pub(super) fn message(&self, code: Code) -> String {
        // SAFETY: any number is allowed.
        text_of(unsafe { (self.functions.error_get_str)(code.0) })
            .unwrap_or_else(|| "no description".into())
    }

    /// Opens the device with a serial number, the first one without.
    pub(super) fn open(&self, serial: Option<u16>) -> Result<Number, Code> {
        let number = match serial {
            // SAFETY: a plain number.
            Some(serial) => unsafe { (self.functions.open_serial)(c_int::from(serial)) },
            // SAFETY: no argument.
            None => unsafe { (self.functions.open)() },
        };
        let number = self.checked(number)?;
        Id::try_from(number).map(Number).map_err(|_| Code(-1))
    }

    pub(super) fn close(&self, device: Number) -> Result<(), Code> {
        // SAFETY: a number from `open`; the function checks it.
        self.checked(unsafe { (self.functions.close)(device.0) })
            .map(drop)
    }

    pub(super) fn enable_force(&self, device: Number, on: bool) -> Result<(), Code> {
        // SAFETY: as above.
        self.checked(unsafe { (self.functions.enable_force)(on, device.0) })
            .map(drop)
    }

    /// Position, m, in the device's frame, and whether it was measured anew.
    pub(super) fn position(&self, device: Number) -> Result<([f64; 3], bool), Code> {
        let [mut x, mut y, mut z] = [0.0; 3];
        // SAFETY: room for a number each.
        let result =
            unsafe { (self.functions.get_position)(&raw mut x, &raw mut y, &raw mut z, device.0) };
        self.checked(result)
            .map(|result| ([x, y, z], result != TIMEGUARD))
    }

    /// Held buttons, a bit each.
    pub(super) fn buttons(&self, device: Number) -> u32 {
        // SAFETY: a number from `open`.
        unsafe { (self.functions.get_button_mask)(device.0) }
    }

    /// Commands a force, N, in the device's frame. A force that a motor cannot give in full is
    /// shortened, which is a success.
    pub(super) fn set_force(&self, device: Number, [x, y, z]: [f64; 3]) -> Result<(), Code> {
        // SAFETY: plain numbers.
        self.checked(unsafe { (self.functions.set_force)(x, y, z, device.0) })
            .map(drop)
    }

    pub(super) fn status(&self, device: Number) -> Result<[i32; MAX_STATUS], Code> {
        // More room than the interface asks for, should a newer library write more.
        let mut status: [c_int; 2 * MAX_STATUS] = [0; 2 * MAX_STATUS];
        // SAFETY: there is room for every place of a status.
        self.checked(unsafe { (self.functions.get_status)(status.as_mut_ptr(), device.0) })?;
        Ok(std::array::from_fn(|place| status[place]))
    }

    pub(super) fn name(&self, device: Number) -> Option<String> {
        // SAFETY: a number from `open`.
        text_of(unsafe { (self.functions.get_system_name)(device.0) })
    }

    pub(super) fn serial(&self, device: Number) -> Option<u16> {
        let mut serial = 0;
        // SAFETY: room for a number.
        let result = unsafe { (self.functions.get_serial_number)(&raw mut serial, device.0) };
        (result == 0).then_some(serial)
    }
}

fn text_of(text: *const c_char) -> Option<String> {
    if text.is_null() {
        return None;
    }
    // SAFETY: the library's texts are static and end with a zero.
    let text = unsafe { CStr::from_ptr(text) };
    Some(text.to_string_lossy().into_owned())
}
