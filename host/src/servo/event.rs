//! What a servo loop tells once, apart from its records.

use crate::device::{DeviceError, supervised};

/// What a servo loop tells once, apart from its records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// The device began to fail.
    Failed {
        /// Period since the loop began.
        period: u64,
        /// The first fault.
        fault: DeviceError,
    },
    /// The device answers again.
    Back {
        /// Period since the loop began.
        period: u64,
        /// Ticks with a fault.
        faulty_ticks: u64,
    },
    /// A recovery was tried and failed.
    NotRecovered {
        /// Period since the loop began.
        period: u64,
        /// Why.
        fault: DeviceError,
    },
}

impl Event {
    /// What the supervision of a device reports in a period.
    pub(super) fn of(report: supervised::Report, period: u64) -> Self {
        match report {
            supervised::Report::Began(fault) => Self::Failed { period, fault },
            supervised::Report::Ended { periods, .. } => Self::Back {
                period,
                faulty_ticks: periods.into(),
            },
        }
    }
}
