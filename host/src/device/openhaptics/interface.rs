//! The interface of this back end against openly licensed descriptions of it: symbol by symbol,
//! constant by constant.
//!
//! | source | licence | tells |
//! |---|---|---|
//! | pyOpenHaptics, `pyOpenHaptics/hd_define.py` and `hd.py`, commits 73b3a18 and d13e461 | MIT | the constants; types of most functions |
//! | OpenSurgSim, `SurgSim/Devices/Phantom/PhantomScaffold.cpp`, commit 005be11 | Apache-2.0 | `hdUnschedule`, `hdGetErrorString`, `HDErrorInfo`, units: used, not declared |
//! | Geomagic_Touch_ROS_Drivers, `omni_common/src/omni_state.cpp` | BSD | `hdCheckCalibration`, `hdUpdateCalibration`: used, not declared |
//!
//! `hdDisable` is taken to have the type of `hdEnable`.
//!
//! Where a source only uses a function, its type follows from that use. Nobody has
//! compared these types with the vendor's header.

use super::{constants as hd, library::FUNCTIONS};

/// Every constant that is used, as pyOpenHaptics has it. It calls `HD_EXCEEDED_MAX_FORCE`
/// `HD_EXCEED_MAX_FORCE`.
const DESCRIBED: [(&str, u32, u32); 29] = [
    ("HD_SUCCESS", 0x000, hd::HD_SUCCESS),
    ("HD_WARM_MOTORS", 0x0200, hd::HD_WARM_MOTORS),
    ("HD_EXCEED_MAX_FORCE", 0x0201, hd::HD_EXCEEDED_MAX_FORCE),
    (
        "HD_EXCEEDED_MAX_FORCE_IMPULSE",
        0x0202,
        hd::HD_EXCEEDED_MAX_FORCE_IMPULSE,
    ),
    (
        "HD_EXCEEDED_MAX_VELOCITY",
        0x0203,
        hd::HD_EXCEEDED_MAX_VELOCITY,
    ),
    ("HD_DEVICE_FAULT", 0x0300, hd::HD_DEVICE_FAULT),
    (
        "HD_DEVICE_ALREADY_INITIATED",
        0x0301,
        hd::HD_DEVICE_ALREADY_INITIATED,
    ),
    ("HD_COMM_ERROR", 0x0302, hd::HD_COMM_ERROR),
    ("HD_COMM_CONFIG_ERROR", 0x0303, hd::HD_COMM_CONFIG_ERROR),
    ("HD_TIMER_ERROR", 0x0304, hd::HD_TIMER_ERROR),
    ("HD_CURRENT_BUTTONS", 0x2000, hd::HD_CURRENT_BUTTONS),
    ("HD_CURRENT_POSITION", 0x2050, hd::HD_CURRENT_POSITION),
    ("HD_DEVICE_MODEL_TYPE", 0x2501, hd::HD_DEVICE_MODEL_TYPE),
    ("HD_DEVICE_VENDOR", 0x2503, hd::HD_DEVICE_VENDOR),
    (
        "HD_DEVICE_SERIAL_NUMBER",
        0x2504,
        hd::HD_DEVICE_SERIAL_NUMBER,
    ),
    ("HD_CALIBRATION_STYLE", 0x2555, hd::HD_CALIBRATION_STYLE),
    ("HD_NOMINAL_MAX_FORCE", 0x2603, hd::HD_NOMINAL_MAX_FORCE),
    (
        "HD_NOMINAL_MAX_CONTINUOUS_FORCE",
        0x2604,
        hd::HD_NOMINAL_MAX_CONTINUOUS_FORCE,
    ),
    ("HD_CURRENT_FORCE", 0x2700, hd::HD_CURRENT_FORCE),
    ("HD_FORCE_OUTPUT", 0x4000, hd::HD_FORCE_OUTPUT),
    ("HD_CALIBRATION_OK", 0x5000, hd::HD_CALIBRATION_OK),
    (
        "HD_CALIBRATION_NEEDS_UPDATE",
        0x5001,
        hd::HD_CALIBRATION_NEEDS_UPDATE,
    ),
    (
        "HD_CALIBRATION_NEEDS_MANUAL_INPUT",
        0x5002,
        hd::HD_CALIBRATION_NEEDS_MANUAL_INPUT,
    ),
    (
        "HD_CALIBRATION_ENCODER_RESET",
        1,
        hd::HD_CALIBRATION_ENCODER_RESET,
    ),
    ("HD_CALIBRATION_AUTO", 2, hd::HD_CALIBRATION_AUTO),
    ("HD_CALIBRATION_INKWELL", 4, hd::HD_CALIBRATION_INKWELL),
    ("HD_CALLBACK_CONTINUE", 1, hd::HD_CALLBACK_CONTINUE),
    (
        "HD_MAX_SCHEDULER_PRIORITY",
        65_535,
        hd::HD_MAX_SCHEDULER_PRIORITY as u32,
    ),
    ("HD_INVALID_HANDLE", 0xFFFF_FFFF, hd::HD_INVALID_HANDLE),
];

/// Every function with the type that the sources give. Types of `ctypes` and of C in Rust's words:
/// `HHD`, `HDenum`, `HDerror` and `HDCallbackCode` are unsigned integers, `HDstring` is a pointer to
/// characters, `HDErrorInfo` the structure of an unsigned integer, an integer and a handle.
const DECLARED: [(&str, &str, &str); 19] = [
    (
        "hdInitDevice",
        "fn(*const c_char) -> c_uint",
        "pyOpenHaptics hd.py, init_device",
    ),
    (
        "hdDisableDevice",
        "fn(c_uint)",
        "pyOpenHaptics hd.py, close_device",
    ),
    (
        "hdMakeCurrentDevice",
        "fn(c_uint)",
        "pyOpenHaptics hd.py, make_current_device",
    ),
    (
        "hdBeginFrame",
        "fn(c_uint)",
        "pyOpenHaptics hd.py, begin_frame",
    ),
    ("hdEndFrame", "fn(c_uint)", "pyOpenHaptics hd.py, end_frame"),
    (
        "hdGetError",
        "fn() -> ErrorInfo",
        "pyOpenHaptics hd.py, _get_error",
    ),
    (
        "hdGetErrorString",
        "fn(c_uint) -> *const c_char",
        "OpenSurgSim, as used",
    ),
    (
        "hdEnable",
        "fn(c_uint)",
        "pyOpenHaptics hd.py, enable_force",
    ),
    ("hdDisable", "fn(c_uint)", "as hdEnable"),
    (
        "hdGetDoublev",
        "fn(c_uint, *mut c_double)",
        "pyOpenHaptics hd.py, _get_doublev",
    ),
    (
        "hdSetDoublev",
        "fn(c_uint, *const c_double)",
        "pyOpenHaptics hd.py, _set_doublev",
    ),
    (
        "hdGetIntegerv",
        "fn(c_uint, *mut c_int)",
        "pyOpenHaptics hd.py, _get_integerv",
    ),
    (
        "hdGetString",
        "fn(c_uint) -> *const c_char",
        "pyOpenHaptics hd.py, get_model",
    ),
    (
        "hdCheckCalibration",
        "fn() -> c_uint",
        "Geomagic_Touch_ROS_Drivers, as used",
    ),
    (
        "hdUpdateCalibration",
        "fn(c_uint)",
        "Geomagic_Touch_ROS_Drivers, as used",
    ),
    (
        "hdStartScheduler",
        "fn()",
        "pyOpenHaptics hd.py, start_scheduler",
    ),
    (
        "hdStopScheduler",
        "fn()",
        "pyOpenHaptics hd.py, stop_scheduler",
    ),
    (
        "hdScheduleAsynchronous",
        "fn(Callback, *mut c_void, c_ushort) -> c_ulong",
        "pyOpenHaptics hd_callback.py, hdAsyncSheduler; the result as OpenSurgSim keeps it",
    ),
    ("hdUnschedule", "fn(c_ulong)", "OpenSurgSim, as used"),
];

#[test]
fn every_constant_is_what_the_description_says() {
    for (name, described, used) in DESCRIBED {
        assert_eq!(used, described, "{name}");
    }
    // Nothing that is used escapes the table.
    let defined = include_str!("constants.rs")
        .matches("pub(super) const HD_")
        .count();
    assert_eq!(defined, DESCRIBED.len());
}

#[test]
fn every_function_has_the_type_that_the_sources_give() {
    let declared: Vec<(&str, &str)> = DECLARED
        .iter()
        .map(|&(name, kind, _)| (name, kind))
        .collect();
    assert_eq!(FUNCTIONS, declared);
    for (name, kind, source) in DECLARED {
        println!("{name}: {kind} ({source})");
    }
}
