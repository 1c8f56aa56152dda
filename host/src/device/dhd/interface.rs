//! The interface of this back end against an openly licensed description of it: symbol by symbol,
//! constant by constant.
//!
//! The source is `forcedimension-core` 1.0.0 of PyPI (LGPL-3.0), modules
//! `forcedimension_core.constants` and `forcedimension_core.dhd`, which target version 3.16 of the
//! vendor's library. Only facts of the interface are taken from it.

use super::{constants as dhd, library::FUNCTIONS};

/// Every constant that is used, by its name in `constants`.
const DESCRIBED: [(&str, i32, i32); 15] = [
    ("TIMEGUARD", 1, dhd::TIMEGUARD),
    ("MAX_STATUS", 17, dhd::MAX_STATUS as i32),
    ("StatusIndex.RESET", 3, dhd::STATUS_RESET as i32),
    ("StatusIndex.FORCE", 5, dhd::STATUS_FORCE as i32),
    ("StatusIndex.ERROR", 9, dhd::STATUS_ERROR as i32),
    (
        "StatusIndex.FORCEOFFCAUSE",
        14,
        dhd::STATUS_FORCEOFFCAUSE as i32,
    ),
    ("ForceOffCause.VELOCITY", 2, dhd::FORCE_OFF_VELOCITY),
    ("ErrorNum.COM", 2, dhd::ERROR_COM),
    ("ErrorNum.DHC_BUSY", 3, dhd::ERROR_DHC_BUSY),
    ("ErrorNum.NO_DRIVER_FOUND", 4, dhd::ERROR_NO_DRIVER_FOUND),
    ("ErrorNum.NO_DEVICE_FOUND", 5, dhd::ERROR_NO_DEVICE_FOUND),
    ("ErrorNum.TIMEOUT", 7, dhd::ERROR_TIMEOUT),
    ("ErrorNum.DEVICE_NOT_READY", 12, dhd::ERROR_DEVICE_NOT_READY),
    ("ErrorNum.CONFIGURATION", 14, dhd::ERROR_CONFIGURATION),
    ("ErrorNum.DEVICE_IN_USE", 20, dhd::ERROR_DEVICE_IN_USE),
];

/// Every function with the `argtypes` and `restype` of `dhd/__init__.py`, in Rust's words. `Id` is
/// `c_byte`.
const DECLARED: [(&str, &str); 12] = [
    ("dhdOpen", "fn() -> c_int"),
    ("dhdOpenSerial", "fn(c_int) -> c_int"),
    ("dhdClose", "fn(Id) -> c_int"),
    ("dhdEnableForce", "fn(bool, Id) -> c_int"),
    (
        "dhdGetPosition",
        "fn(*mut c_double, *mut c_double, *mut c_double, Id) -> c_int",
    ),
    ("dhdGetButtonMask", "fn(Id) -> c_uint"),
    (
        "dhdSetForce",
        "fn(c_double, c_double, c_double, Id) -> c_int",
    ),
    ("dhdGetStatus", "fn(*mut c_int, Id) -> c_int"),
    ("dhdGetSystemName", "fn(Id) -> *const c_char"),
    ("dhdGetSerialNumber", "fn(*mut c_ushort, Id) -> c_int"),
    ("dhdErrorGetLast", "fn() -> c_int"),
    ("dhdErrorGetStr", "fn(c_int) -> *const c_char"),
];

#[test]
fn every_constant_is_what_the_description_says() {
    for (name, described, used) in DESCRIBED {
        assert_eq!(used, described, "{name}");
    }
    // Nothing that is used escapes the table.
    let defined = include_str!("constants.rs")
        .matches("pub(super) const ")
        .count();
    assert_eq!(defined, DESCRIBED.len());
}

#[test]
fn every_function_has_the_type_that_the_description_gives() {
    assert_eq!(FUNCTIONS, DECLARED);
}
