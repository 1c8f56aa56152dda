//! The servo loop allocates nothing, on a thread with a real clock, whatever the device does.

#![allow(unsafe_code, reason = "a global allocator cannot be had without")]

mod support;

use asperity_host::device::{Description, Device, DeviceError, Reading};
use asperity_host::servo::privileges::PrivilegeRequest;
use asperity_host::servo::{Monotonic, Servo, Settings, Start, SwappableTexture, queues};
use asperity_runtime::{Exchange, HostTexture};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::Duration;

/// The system's allocator, which counts the calls of each thread.
struct Counting;

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // This fails only while the thread ends.
    let _ = CALLS.try_with(|calls| calls.set(calls.get() + 1));
}

// SAFETY: every call is passed on unchanged to the system's allocator, which keeps the contract.
// Counting uses a thread-local without a destructor and does not allocate.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's promises are those of the system's allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count();
        // SAFETY: the caller's promises are those of the system's allocator.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The device ends the loop after so many readings.
const READS: u64 = 4000;

/// Counts the calls between its first reading and its last write, on the thread that calls it.
struct Trap<'s> {
    stop: &'s AtomicBool,
    description: Description,
    reads: u64,
    calls_at_first_read: u64,
    calls_since: AtomicU64,
}

impl Device for Trap<'_> {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        if self.reads == 0 {
            self.calls_at_first_read = CALLS.get();
        }
        self.reads += 1;
        self.stop.store(self.reads >= READS, Relaxed);
        match self.reads % 500 {
            100..105 => Err(DeviceError::TimedOut),
            phase => Ok(Reading {
                position_m: [1e-5 * phase as f32, 0.0, -0.001],
                fresh: phase != 250,
                buttons: 0,
            }),
        }
    }

    fn write(&mut self, _: [f32; 3]) -> Result<(), DeviceError> {
        self.calls_since
            .store(CALLS.get() - self.calls_at_first_read, Relaxed);
        if self.reads % 500 == 400 {
            return Err(DeviceError::Stalled);
        }
        Ok(())
    }
}

#[test]
fn ticks_faults_exchanges_and_full_queues_allocate_nothing() {
    let before = CALLS.get();
    drop(std::hint::black_box(Box::new(7)));
    assert_eq!(CALLS.get() - before, 2, "the trap works");

    let (mut texture, renderer) = support::texture(10_000.0);
    let [mut a, mut b] = [(); 2].map(|()| Box::new(HostTexture::new()));
    let mut exchange = Exchange::new();
    let (mut preparer, player) = exchange.split(&mut texture, [&mut a, &mut b], 1);
    let stop = AtomicBool::new(false);
    let mut device = Trap {
        stop: &stop,
        description: Description {
            name: "trap".into(),
            serial: None,
            peak_force_n: 3.3,
            continuous_force_n: 3.3,
            unconfirmed: Vec::new(),
        },
        reads: 0,
        calls_at_first_read: 0,
        calls_since: AtomicU64::new(u64::MAX),
    };
    // Room for a few records alone, so that most are lost.
    let (record_writer, mut record_reader) = queues(16);
    let bytes = include_bytes!("../../runtime/tests/data/builtin-v1.asp");
    let asset = asperity_formats::Asset::parse(bytes).expect("a committed asset");
    let report = std::thread::scope(|scope| {
        let start = Start {
            device: &mut device,
            render: SwappableTexture::new(&renderer, player),
            observer: record_writer,
            settings: Settings::at(10_000),
            clock: Monotonic::spinning(Duration::from_micros(20)),
            privileges: PrivilegeRequest::NOTHING,
            stop: &stop,
        };
        let servo = Servo::spawn(scope, start).expect("a thread");
        // No loop ends before it is stopped.
        assert!(!servo.is_finished() || stop.load(Relaxed));
        while !servo.is_finished() {
            // Refused while no slot is spare.
            let _ = preparer.prepare(&asset, 10_000.0);
            std::thread::sleep(Duration::from_millis(20));
        }
        servo.join().expect("it does not panic")
    });
    assert!(report.ticks > 0 && report.ended_without_force);
    assert!(record_reader.lost() > 0 && record_reader.record().is_some());
    assert!(device.reads >= READS);
    assert_eq!(device.calls_since.load(Relaxed), 0);
}
