//! A device that the library has opened, from calibration to release.

use std::ffi::CString;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::constants as hd;
use super::library::{Code, Handle, Hd, Ticket};
use super::scheduled::Scheduled;
use crate::device::DeviceError;
use crate::device::vendor_library::VendorError;

/// Timeout for the first measurement when opening.
const OPENING: Duration = Duration::from_secs(2);
/// Timeout for the force to reach zero on release.
const RELEASE: Duration = Duration::from_secs(1);
/// Time without a period after which the scheduler counts as stalled.
const STANDSTILL: Duration = Duration::from_millis(100);

/// Calibration instructions for the user.
const HOW: &str = "put the stylus into the inkwell of the device (older models: into the pose that \
                   the vendor's set-up program shows), then try again";

/// An open device whose callback runs.
#[derive(Debug)]
pub(super) struct ScheduledDevice {
    pub(super) hd: Arc<Hd>,
    pub(super) scheduled: Arc<Scheduled>,
    device: Handle,
    ticket: Option<Ticket>,
}

/// Maps an error code within a period to a device error.
pub(super) fn fault(code: u32) -> DeviceError {
    match code {
        hd::HD_WARM_MOTORS => DeviceError::WarmMotors,
        hd::HD_EXCEEDED_MAX_FORCE
        | hd::HD_EXCEEDED_MAX_FORCE_IMPULSE
        | hd::HD_EXCEEDED_MAX_VELOCITY => DeviceError::ForceExceeded,
        hd::HD_DEVICE_FAULT | hd::HD_COMM_ERROR => DeviceError::Disconnected,
        hd::HD_TIMER_ERROR => DeviceError::TimedOut,
        other => DeviceError::Vendor(other.cast_signed()),
    }
}

impl ScheduledDevice {
    /// Opens, calibrates and starts the device of a configured name.
    pub(super) fn open(hd: &Arc<Hd>, name: Option<&CString>) -> Result<Self, VendorError> {
        let shown = name.map_or("the default OpenHaptics device".into(), |name| {
            format!("OpenHaptics device \"{}\"", name.to_string_lossy())
        });
        // What an earlier owner left behind is no error of ours.
        hd.error();
        let device = hd
            .init_device(name)
            .map_err(|code| refusal(hd, &shown, "opening", code))?;
        let mut session = Self {
            hd: Arc::clone(hd),
            scheduled: Arc::new(Scheduled::default()),
            device,
            ticket: None,
        };
        hd.make_current(device);
        calibrate(hd, &shown)?;
        hd.enable_force();
        session.ticket = Some(hd.schedule(device, &session.scheduled));
        hd.start_scheduler();
        if let Some(code) = hd.error() {
            return Err(refusal(hd, &shown, "starting its scheduler", code));
        }
        session.wait_for_a_period(&shown)?;
        Ok(session)
    }

    /// Waits until the scheduler has run once, so that a dead one is an error of opening.
    fn wait_for_a_period(&self, shown: &str) -> Result<(), VendorError> {
        let until = Instant::now() + OPENING;
        while Instant::now() < until {
            if let Some(code) = self.scheduled.take_fault() {
                return Err(refusal(&self.hd, shown, "reading its position", Code(code)));
            }
            if self.scheduled.newest().is_some() {
                return Ok(());
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Err(VendorError::NoDevice {
            device: shown.into(),
            message: "its scheduler does not run".into(),
            code: hd::HD_TIMER_ERROR.cast_signed(),
        })
    }
}

impl Drop for ScheduledDevice {
    fn drop(&mut self) {
        self.scheduled.stop();
        let until = Instant::now() + RELEASE;
        let mut seen = (self.scheduled.periods(), Instant::now());
        while !self.scheduled.is_released() && Instant::now() < until {
            std::thread::sleep(Duration::from_millis(1));
            if self.scheduled.periods() != seen.0 {
                seen = (self.scheduled.periods(), Instant::now());
            } else if seen.1.elapsed() > STANDSTILL {
                // The scheduler stands still: nobody can lower the force.
                break;
            }
        }
        self.hd.make_current(self.device);
        self.hd.stop_scheduler();
        if let Some(ticket) = self.ticket.take() {
            self.hd.unschedule(ticket);
        }
        self.hd.disable_force();
        self.hd.disable_device(self.device);
        self.hd.error();
    }
}

fn calibrate(hd: &Hd, shown: &str) -> Result<(), VendorError> {
    if hd.check_calibration() == hd::HD_CALIBRATION_NEEDS_UPDATE {
        let styles = hd.integer(hd::HD_CALIBRATION_STYLE).cast_unsigned();
        let preferred = [
            hd::HD_CALIBRATION_AUTO,
            hd::HD_CALIBRATION_INKWELL,
            hd::HD_CALIBRATION_ENCODER_RESET,
        ];
        if let Some(style) = preferred.into_iter().find(|style| styles & style != 0) {
            hd.update_calibration(style);
        }
    }
    if let Some(code) = hd.error() {
        return Err(refusal(hd, shown, "calibrating", code));
    }
    match hd.check_calibration() {
        hd::HD_CALIBRATION_OK => Ok(()),
        hd::HD_CALIBRATION_NEEDS_UPDATE | hd::HD_CALIBRATION_NEEDS_MANUAL_INPUT => {
            Err(VendorError::NotCalibrated {
                device: shown.into(),
                how: HOW,
            })
        }
        other => Err(refusal(hd, shown, "calibrating", Code(other))),
    }
}

fn refusal(hd: &Hd, shown: &str, doing: &'static str, Code(number): Code) -> VendorError {
    let (device, message) = (shown.to_owned(), hd.message(Code(number)));
    let code = number.cast_signed();
    match number {
        hd::HD_DEVICE_ALREADY_INITIATED => VendorError::InUse { device },
        hd::HD_WARM_MOTORS => VendorError::WarmMotors { device },
        hd::HD_DEVICE_FAULT | hd::HD_COMM_ERROR => VendorError::NoDevice {
            device,
            message,
            code,
        },
        hd::HD_COMM_CONFIG_ERROR => VendorError::Configuration {
            device,
            message,
            code,
        },
        _ => VendorError::Refused {
            device,
            doing,
            message,
            code,
        },
    }
}
