//! System calls that no safe library has: the scheduling policy of the calling thread.

#![allow(
    unsafe_code,
    reason = "no light library sets policies of the scheduler"
)]

#[cfg(target_os = "linux")]
mod calls {
    use std::io;

    /// SCHED_FIFO for the calling thread.
    pub(in super::super) fn set_fifo(priority: u8) -> io::Result<()> {
        let parameters = libc::sched_param {
            sched_priority: priority.into(),
        };
        // SAFETY: 0 is the calling thread, and the structure outlives the call, which reads it.
        let result =
            unsafe { libc::sched_setscheduler(0, libc::SCHED_FIFO, &raw const parameters) };
        checked(result.into())
    }

    /// SCHED_DEADLINE for the calling thread, ns.
    pub(in super::super) fn set_deadline(runtime_ns: u64, period_ns: u64) -> io::Result<()> {
        let attributes = libc::sched_attr {
            size: size_of::<libc::sched_attr>() as u32,
            sched_policy: libc::SCHED_DEADLINE as u32,
            sched_flags: 0,
            sched_nice: 0,
            sched_priority: 0,
            sched_runtime: runtime_ns,
            sched_deadline: period_ns,
            sched_period: period_ns,
        };
        // SAFETY: 0 is the calling thread; the structure says its size, outlives the call, and is
        // only read.
        let result = unsafe { libc::syscall(libc::SYS_sched_setattr, 0, &raw const attributes, 0) };
        checked(result)
    }

    fn checked(result: libc::c_long) -> io::Result<()> {
        if result == 0 {
            Ok(())
        } else {
            Err(io::Error::last_os_error())
        }
    }
}

#[cfg(target_os = "macos")]
mod calls {
    use std::io;

    pub(in super::super) const INTERACTIVE: &str = "QoS class user interactive";

    /// The highest quality-of-service class for the calling thread. Untested.
    pub(in super::super) fn set_interactive() -> io::Result<()> {
        let class = libc::qos_class_t::QOS_CLASS_USER_INTERACTIVE;
        // SAFETY: the call takes two numbers and acts on the calling thread.
        match unsafe { libc::pthread_set_qos_class_self_np(class, 0) } {
            0 => Ok(()),
            error => Err(io::Error::from_raw_os_error(error)),
        }
    }
}

#[cfg(windows)]
mod calls {
    use std::io;
    use windows_sys::Win32::System::Threading::AvSetMmThreadCharacteristicsW;

    pub(in super::super) const INTERACTIVE: &str = "MMCSS task Pro Audio";

    /// The multimedia class scheduler for the calling thread, until it ends. Untested.
    pub(in super::super) fn set_interactive() -> io::Result<()> {
        let task: Vec<u16> = "Pro Audio\0".encode_utf16().collect();
        let mut index = 0;
        // SAFETY: the name ends with a zero, and both pointers outlive the call.
        let handle = unsafe { AvSetMmThreadCharacteristicsW(task.as_ptr(), &raw mut index) };
        if handle.is_null() {
            Err(io::Error::last_os_error())
        } else {
            Ok(())
        }
    }
}

#[cfg(not(any(target_os = "linux", target_os = "macos", windows)))]
mod calls {
    use std::io;

    pub(in super::super) const INTERACTIVE: &str = "a real-time policy";

    pub(in super::super) fn set_interactive() -> io::Result<()> {
        Err(io::Error::from(io::ErrorKind::Unsupported))
    }
}

pub(super) use calls::*;
