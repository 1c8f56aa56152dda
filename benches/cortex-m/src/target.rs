//! The processors, and the machines that QEMU has of them.

use crate::package::Result;
use asperity_session::{CASES, Case};

/// A processor that the firmware is built for.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) triple: &'static str,
    pub(crate) processor: &'static str,
    /// Arithmetic of the firmware, as it is passed to `host-session`.
    pub(crate) arithmetic: &'static str,
    /// QEMU's machine; `firmware/build.rs` picks its memory map.
    pub(crate) machine: &'static str,
    /// RAM left for a slot, bytes: cases that need more are left out.
    slot_room: usize,
}

const TARGETS: [Target; 3] = [
    Target {
        triple: "thumbv7em-none-eabihf",
        processor: "Cortex-M4F",
        arithmetic: "float",
        machine: "mps2-an386",
        slot_room: 1 << 20,
    },
    Target {
        triple: "thumbv7m-none-eabi",
        processor: "Cortex-M3",
        arithmetic: "fixed",
        machine: "mps2-an385",
        slot_room: 1 << 20,
    },
    Target {
        triple: "thumbv6m-none-eabi",
        processor: "Cortex-M0",
        arithmetic: "fixed",
        machine: "microbit",
        slot_room: 8 << 10,
    },
];

/// The target of a triple.
pub(crate) fn find(triple: &str) -> Result<&'static Target> {
    let known = TARGETS.iter().map(|t| t.triple).collect::<Vec<_>>();
    TARGETS
        .iter()
        .find(|target| target.triple == triple)
        .ok_or_else(|| format!("--target {triple}: known are {}", known.join(", ")).into())
}

impl Target {
    /// The cases whose slots fit the machine.
    pub(crate) fn cases(&self) -> impl Iterator<Item = &'static Case> {
        let room = self.slot_room;
        CASES.iter().filter(move |case| case.slot_bytes <= room)
    }
}
