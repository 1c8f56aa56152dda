//! Recorded data of a tick.

use asperity_runtime::{Output, Sample};

use crate::device::DeviceError;

/// A tick: input and output of the renderer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Input of the renderer. A position that is not finite keeps its bits.
    pub sample: Sample,
    /// Force of the renderer, N.
    pub force_n: [f32; 3],
    /// Bits of the output's flags.
    pub flags: u16,
    /// Buttons that were held.
    pub buttons: u32,
    /// Fault of the reading in this period.
    pub read_fault: Option<DeviceError>,
    /// Fault of the write in this period.
    pub write_fault: Option<DeviceError>,
    /// True if the next announced texture began to play in this tick.
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

    /// Returns true if two entries are bit-identical, NaN included.
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
