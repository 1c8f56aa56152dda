//! Records and events from the servo thread to another one, over bounded lock-free queues.
//!
//! A reader that is too slow loses records, which are counted; the servo thread never waits.
//! Memory is allocated when the queues are made, and not after.

use super::{
    event::Event,
    record::{Observer, Record},
};
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering::Relaxed},
};

/// Events that fit; they are rare.
const EVENTS: usize = 256;

/// The servo thread's end.
#[derive(Debug)]
pub struct RecordWriter {
    records: Producer<Record>,
    events: Producer<Event>,
    lost: Arc<AtomicU64>,
}

/// The other thread's end.
#[derive(Debug)]
pub struct RecordReader {
    records: Consumer<Record>,
    events: Consumer<Event>,
    lost: Arc<AtomicU64>,
}

/// Both ends of queues with room for so many records.
#[must_use]
pub fn queues(records: usize) -> (RecordWriter, RecordReader) {
    let (to_records, from_records) = RingBuffer::new(records.max(1));
    let (to_events, from_events) = RingBuffer::new(EVENTS);
    let lost = Arc::new(AtomicU64::new(0));
    let record_writer = RecordWriter {
        records: to_records,
        events: to_events,
        lost: Arc::clone(&lost),
    };
    let record_reader = RecordReader {
        records: from_records,
        events: from_events,
        lost,
    };
    (record_writer, record_reader)
}

impl Observer for RecordWriter {
    #[inline]
    fn tick(&mut self, record: &Record) {
        if self.records.push(*record).is_err() {
            self.lost.fetch_add(1, Relaxed);
        }
    }

    fn event(&mut self, event: Event) {
        if self.events.push(event).is_err() {
            self.lost.fetch_add(1, Relaxed);
        }
    }
}

impl RecordReader {
    /// The next record, if there is one.
    pub fn record(&mut self) -> Option<Record> {
        self.records.pop().ok()
    }

    /// The next event, if there is one.
    pub fn event(&mut self) -> Option<Event> {
        self.events.pop().ok()
    }

    /// Records and events that found no room so far.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.lost.load(Relaxed)
    }

    /// Returns true if the servo thread has dropped its end and the queues are drained.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.records.is_abandoned() && self.records.is_empty() && self.events.is_empty()
    }
}
