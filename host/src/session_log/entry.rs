//! What is recorded of a tick.

use asperity_runtime::{Output, Sample};

use crate::device::DeviceError;

/// One tick: what went into the renderer, and what came out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// What the renderer was given. A position that is not finite keeps its bits.
    pub sample: Sample,
    /// What the renderer answered, N.
    pub force_n: [f32; 3],
    /// Bits of the output's flags.
    pub flags: u16,
    /// Buttons that were held.
    pub buttons: u32,
    /// Why the device gave nothing in this period.
    pub read_fault: Option<DeviceError>,
    /// Why the force did not reach the device in this period.
    pub write_fault: Option<DeviceError>,
    /// Whether the next texture that was announced began to play in this tick.
    pub next_texture: bool,
    /// Ticks before this one that were not recorded, since the queue was full.
    pub lost_before: u32,
}

impl Entry {
    /// A tick without faults.
    #[must_use]
    pub fn new(sample: Sample, output: &Output) -> Self {
        Self {
            sample,
            force_n: output.force_n,
            flags: output.flags.bits(),
            buttons: 0,
            read_fault: None,
            write_fault: None,
            next_texture: false,
            lost_before: 0,
        }
    }

    /// Whether two entries have the same bits, NaN included.
    #[must_use]
    pub fn has_bits_of(&self, other: &Self) -> bool {
        let bits = |v: [f32; 3]| v.map(f32::to_bits);
        let plain = |entry: &Self| Self {
            sample: Sample {
                position_m: [0.0; 3],
                ..entry.sample
            },
            force_n: [0.0; 3],
            ..*entry
        };
        bits(self.sample.position_m) == bits(other.sample.position_m)
            && bits(self.force_n) == bits(other.force_n)
            && plain(self) == plain(other)
    }
}
