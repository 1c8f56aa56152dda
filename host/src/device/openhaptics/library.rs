//! The functions of OpenHaptics HD, and one safe method for each use.
#![allow(unsafe_code, reason = "functions of a foreign library are called")]

use std::ffi::{CStr, CString, c_char, c_double, c_int, c_uint, c_ulong, c_ushort, c_void};
use std::ptr;
use std::sync::Arc;

use super::constants as hd;
use super::scheduled::Scheduled;
use crate::device::vendor_library::{Library, LibraryError, symbols};

/// Scheduler callback, called once a period.
type Callback = extern "C" fn(*mut c_void) -> c_uint;

/// An error of the library.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
struct ErrorInfo {
    code: c_uint,
    internal: c_int,
    device: c_uint,
}

symbols! {
    /// The functions, by name.
    Functions {
        init_device = "hdInitDevice": fn(*const c_char) -> c_uint;
        disable_device = "hdDisableDevice": fn(c_uint);
        make_current_device = "hdMakeCurrentDevice": fn(c_uint);
        begin_frame = "hdBeginFrame": fn(c_uint);
        end_frame = "hdEndFrame": fn(c_uint);
        get_error = "hdGetError": fn() -> ErrorInfo;
        get_error_string = "hdGetErrorString": fn(c_uint) -> *const c_char;
        enable = "hdEnable": fn(c_uint);
        disable = "hdDisable": fn(c_uint);
        get_doubles = "hdGetDoublev": fn(c_uint, *mut c_double);
        set_doubles = "hdSetDoublev": fn(c_uint, *const c_double);
        get_integers = "hdGetIntegerv": fn(c_uint, *mut c_int);
        get_string = "hdGetString": fn(c_uint) -> *const c_char;
        check_calibration = "hdCheckCalibration": fn() -> c_uint;
        update_calibration = "hdUpdateCalibration": fn(c_uint);
        start_scheduler = "hdStartScheduler": fn();
        stop_scheduler = "hdStopScheduler": fn();
        schedule = "hdScheduleAsynchronous": fn(Callback, *mut c_void, c_ushort) -> c_ulong;
        unschedule = "hdUnschedule": fn(c_ulong);
    }
}

/// Name and type of every function that is needed.
#[cfg(test)]
pub(super) const FUNCTIONS: &[(&str, &str)] = Functions::ALL;

/// The most numbers that one parameter has: a transform of 4 by 4. Room for them is always given,
/// so that a library that writes more than expected writes into that room.
const ROOM: usize = 16;

/// A device of the library, by its handle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Handle(c_uint);

/// An error code of the library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Code(pub(super) u32);

/// The library.
#[derive(Debug)]
pub(super) struct Hd {
    functions: Functions,
}

/// A scheduled callback, with the memory that it uses.
#[derive(Debug)]
pub(super) struct Ticket {
    handle: c_ulong,
    /// From [`Arc::into_raw`].
    user: *const Context,
}

// SAFETY: the pointer comes from an `Arc` of a type that threads may share.
unsafe impl Send for Ticket {}

/// User data of the callback.
#[derive(Debug)]
struct Context {
    hd: Arc<Hd>,
    device: Handle,
    scheduled: Arc<Scheduled>,
}

impl Hd {
    pub(super) fn find(library: Library) -> Result<Self, LibraryError> {
        Functions::find(library).map(|functions| Self { functions })
    }

    /// Opens a device by its configured name, the default one without a name.
    pub(super) fn init_device(&self, name: Option<&CString>) -> Result<Handle, Code> {
        let name = name.map_or(ptr::null(), |name| name.as_ptr());
        // SAFETY: a string that ends with a zero, or none.
        let handle = unsafe { (self.functions.init_device)(name) };
        match self.error() {
            Some(code) => Err(code),
            None if handle == hd::HD_INVALID_HANDLE => Err(Code(hd::HD_DEVICE_FAULT)),
            None => Ok(Handle(handle)),
        }
    }

    pub(super) fn disable_device(&self, device: Handle) {
        // SAFETY: a handle of this library; the function checks it.
        unsafe { (self.functions.disable_device)(device.0) }
    }

    pub(super) fn make_current(&self, device: Handle) {
        // SAFETY: as above.
        unsafe { (self.functions.make_current_device)(device.0) }
    }

    fn begin_frame(&self, device: Handle) {
        // SAFETY: as above.
        unsafe { (self.functions.begin_frame)(device.0) }
    }

    fn end_frame(&self, device: Handle) {
        // SAFETY: as above.
        unsafe { (self.functions.end_frame)(device.0) }
    }

    /// Takes the newest error, if there is one.
    fn next_error(&self) -> Option<Code> {
        // SAFETY: the function has no argument, and its result is plain numbers.
        let error = unsafe { (self.functions.get_error)() };
        (error.code != hd::HD_SUCCESS).then_some(Code(error.code))
    }

    /// Takes all errors, and gives the newest.
    pub(super) fn error(&self) -> Option<Code> {
        /// The library keeps a stack of errors. A bound, for a library that always has another.
        const MOST: usize = 32;
        let newest = self.next_error()?;
        for _ in 1..MOST {
            if self.next_error().is_none() {
                break;
            }
        }
        Some(newest)
    }

    /// The library's words for an error.
    pub(super) fn message(&self, code: Code) -> String {
        // SAFETY: any number is allowed.
        let text = unsafe { (self.functions.get_error_string)(code.0) };
        text_of(text).unwrap_or_else(|| "no description".into())
    }

    pub(super) fn enable_force(&self) {
        // SAFETY: a capability of the interface.
        unsafe { (self.functions.enable)(hd::HD_FORCE_OUTPUT) }
    }

    pub(super) fn disable_force(&self) {
        // SAFETY: as above.
        unsafe { (self.functions.disable)(hd::HD_FORCE_OUTPUT) }
    }

    fn doubles(&self, parameter: u32) -> [f64; ROOM] {
        let mut values = [0.0; ROOM];
        // SAFETY: there is room for the longest parameter.
        unsafe { (self.functions.get_doubles)(parameter, values.as_mut_ptr()) };
        values
    }

    /// Reads a scalar parameter.
    pub(super) fn double(&self, parameter: u32) -> f64 {
        self.doubles(parameter)[0]
    }

    fn set_force(&self, force_n: [f64; 3]) {
        // SAFETY: this parameter is read as three numbers.
        unsafe { (self.functions.set_doubles)(hd::HD_CURRENT_FORCE, force_n.as_ptr()) }
    }

    /// A whole number.
    pub(super) fn integer(&self, parameter: u32) -> i32 {
        let mut values: [c_int; ROOM] = [0; ROOM];
        // SAFETY: there is room for the longest parameter.
        unsafe { (self.functions.get_integers)(parameter, values.as_mut_ptr()) };
        values[0]
    }

    /// A text; `None` where there is none.
    pub(super) fn string(&self, parameter: u32) -> Option<String> {
        // SAFETY: a parameter of the interface.
        text_of(unsafe { (self.functions.get_string)(parameter) })
    }

    pub(super) fn check_calibration(&self) -> u32 {
        // SAFETY: no argument.
        unsafe { (self.functions.check_calibration)() }
    }

    pub(super) fn update_calibration(&self, style: u32) {
        // SAFETY: a style that the device says it has.
        unsafe { (self.functions.update_calibration)(style) }
    }

    pub(super) fn start_scheduler(&self) {
        // SAFETY: no argument.
        unsafe { (self.functions.start_scheduler)() }
    }

    pub(super) fn stop_scheduler(&self) {
        // SAFETY: no argument.
        unsafe { (self.functions.stop_scheduler)() }
    }

    /// Lets the scheduler call [`Scheduled::period`] once a period.
    pub(super) fn schedule(self: &Arc<Self>, device: Handle, scheduled: &Arc<Scheduled>) -> Ticket {
        let context = Arc::new(Context {
            hd: Arc::clone(self),
            device,
            scheduled: Arc::clone(scheduled),
        });
        let user = Arc::into_raw(context);
        // SAFETY: `user` stays valid until `unschedule` gives it back.
        let handle = unsafe {
            (self.functions.schedule)(
                callback,
                user.cast_mut().cast(),
                hd::HD_MAX_SCHEDULER_PRIORITY,
            )
        };
        Ticket { handle, user }
    }

    /// Ends what was scheduled. The scheduler must have been stopped.
    pub(super) fn unschedule(&self, ticket: Ticket) {
        // SAFETY: the handle comes from `schedule`.
        unsafe { (self.functions.unschedule)(ticket.handle) };
        // SAFETY: the pointer comes from `Arc::into_raw`, and the stopped scheduler calls nothing.
        drop(unsafe { Arc::from_raw(ticket.user) });
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

/// Entry point for the scheduler's thread. It neither allocates nor panics.
extern "C" fn callback(user: *mut c_void) -> c_uint {
    // SAFETY: `schedule` gave this pointer, and `unschedule` takes it back only when the scheduler
    // has stopped.
    let Context {
        hd,
        device,
        scheduled,
    } = unsafe { &*user.cast::<Context>() };
    hd.begin_frame(*device);
    let [x, y, z, ..] = hd.doubles(hd::HD_CURRENT_POSITION);
    let buttons = hd.integer(hd::HD_CURRENT_BUTTONS);
    hd.set_force(scheduled.force_n());
    hd.end_frame(*device);
    match hd.error() {
        Some(code) => scheduled.failed(code.0),
        None => scheduled.measured([x, y, z], buttons.cast_unsigned()),
    }
    hd::HD_CALLBACK_CONTINUE
}
