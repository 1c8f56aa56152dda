//! Events of a servo loop, each reported once, apart from its records.

use crate::device::{DeviceError, supervised};

/// An event of a servo loop, reported once, apart from its records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// The device started to fail.
    Failed {
        /// Period since the loop began.
        period: u64,
        /// The first fault.
        fault: DeviceError,
    },
    /// The device recovered.
    Back {
        /// Period since the loop began.
        period: u64,
        /// Ticks with a fault.
        faulty_ticks: u64,
    },
    /// A recovery failed.
    NotRecovered {
        /// Period since the loop began.
        period: u64,
        /// Why.
        fault: DeviceError,
    },
}

impl Event {
    /// Converts a report of the supervision in a period.
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
