//! Real-time privileges of a servo thread, each acquired if permitted and otherwise reported with
//! its remedy.
//!
//! | asked | Linux | macOS | Windows |
//! |---|---|---|---|
//! | policy | SCHED_FIFO, SCHED_DEADLINE | QoS class *user interactive* | MMCSS, task *Pro Audio* |
//! | memory | `mlockall` | – | – |
//! | processor | affinity | – | – |
//! | shallow idle | `/dev/cpu_dma_latency` | – | – |
//! | timer slack | 1 ns | – | – |
//!
//! Nobody has tested the columns of macOS and Windows.

#[cfg_attr(target_os = "linux", path = "linux.rs")]
#[cfg_attr(not(target_os = "linux"), path = "elsewhere.rs")]
mod platform;
mod policy;
mod stack;
mod system;

pub use policy::{Policy, PolicyError};

use std::fs::File;

/// Requested privileges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PrivilegeRequest {
    /// Scheduling policy of the thread.
    pub policy: Policy,
    /// Keep all memory of the process in RAM.
    pub lock_memory: bool,
    /// Run on this processor alone.
    pub cpu: Option<usize>,
    /// Keep processors out of deep idle states.
    pub shallow_idle: bool,
}

impl PrivilegeRequest {
    /// Nothing: what an ordinary thread has.
    pub const NOTHING: Self = Self {
        policy: Policy::Other,
        lock_memory: false,
        cpu: None,
        shallow_idle: false,
    };
}

/// Result of a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grant {
    /// Kind of privilege, such as `policy`.
    pub what: &'static str,
    /// Requested value, such as `SCHED_FIFO 80`.
    pub wanted: String,
    /// Why it was refused, if it was.
    pub refusal: Option<Refusal>,
}

/// Why a request was refused, and what grants it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Message of the system.
    pub why: String,
    /// Remedy for the user, a command if there is one.
    pub remedy: String,
}

/// Privileges of the thread. Dropping it gives up those held by an open file.
#[derive(Debug)]
pub(super) struct Acquired {
    pub(super) grants: Vec<Grant>,
    _held: Vec<File>,
}

/// Asks for everything that is wanted, for the calling thread.
pub(super) fn acquire(request: &PrivilegeRequest, rate_hz: u32) -> Acquired {
    let mut acquired = Acquired {
        grants: Vec::new(),
        _held: Vec::new(),
    };
    platform::acquire(request, rate_hz, &mut acquired.grants, &mut acquired._held);
    stack::touch();
    acquired
}
