//! From the records of a servo loop to entries.

use super::Entry;
use crate::servo::Record;

/// Makes an entry of every record that arrives. Records that were lost on the way leave gaps in
/// the count of ticks, which the next entry tells.
#[derive(Debug, Clone, Copy, Default)]
pub struct FromServo {
    /// The tick that is next.
    tick: u64,
    exchanges: u32,
    buttons: u32,
    lost: u64,
}

impl FromServo {
    /// The entry of a record.
    pub fn entry(&mut self, record: &Record) -> Entry {
        let lost = record.tick.saturating_sub(self.tick);
        self.lost += lost;
        self.tick = record.tick + 1;
        let next_texture = record.exchanges != self.exchanges;
        self.exchanges = record.exchanges;
        self.buttons = record
            .reading
            .map_or(self.buttons, |reading| reading.buttons);
        Entry {
            buttons: self.buttons,
            read_fault: record.reading.err(),
            write_fault: record.written.err(),
            next_texture,
            lost_before: u32::try_from(lost).unwrap_or(u32::MAX),
            ..Entry::new(record.sample, &record.output)
        }
    }

    /// Records that were lost before the last one that arrived.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.lost
    }
}
