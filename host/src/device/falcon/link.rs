//! Two threads that carry frames, so that the servo thread never waits for USB.
//!
//! One always has a transfer to the computer pending and puts each answer into a slot. The other
//! sleeps until the servo thread has put a command into the other slot, and sends it. On full-speed
//! USB a command and its answer take two to three frames of 1 ms; with one thread that sends, then
//! receives, that would be the period. With two the period is that of the commands.
//!
//! Safety lies here as well. No command steps a motor by more than a limit from what was last sent,
//! whatever was lost in between. No answer counts that waited behind a transfer which failed: it
//! tells where the grip was. If the servo thread falls silent, the motors go to zero by such
//! steps.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::frame::{Command, FRAME_BYTES, Frames};
use super::ftdi::{self, PACKET_BYTES, STATUS_BYTES, Setting, payload};
use super::motors::approach;
use super::slot::{Held, Slot};
use super::transport::{Direction, TransferError, Transport};
use crate::device::DeviceError;

/// Time after which a servo thread counts as silent.
const SERVO_SILENT: Duration = Duration::from_millis(20);
/// Time between commands while nobody commands: the device answers only what it is sent.
const KEEP_ALIVE: Duration = Duration::from_millis(5);
/// Time without an answer after which the device counts as silent.
const DEVICE_SILENT: Duration = Duration::from_millis(100);
/// Time of one transfer; a stop waits for it.
const PATIENCE: Duration = Duration::from_millis(50);
/// Frames in which a stop brings the motors to zero, at most.
const STOP_FRAMES: usize = 16;

/// Link statistics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LinkCounts {
    /// Answers.
    pub received: u64,
    /// Bytes that belonged to no answer.
    pub skipped_bytes: u64,
    /// Transfers that ended early.
    pub short: u64,
    /// Stalls, each cleared.
    pub stalled: u64,
    /// Transfers that timed out.
    pub timed_out: u64,
    /// Other errors.
    pub failed: u64,
    /// Watchdog events: the servo thread fell silent and the motors were ramped to zero.
    pub servo_silent: u64,
}

impl std::ops::Add for LinkCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            received: self.received + other.received,
            skipped_bytes: self.skipped_bytes + other.skipped_bytes,
            short: self.short + other.short,
            stalled: self.stalled + other.stalled,
            timed_out: self.timed_out + other.timed_out,
            failed: self.failed + other.failed,
            servo_silent: self.servo_silent + other.servo_silent,
        }
    }
}

#[derive(Debug, Default)]
struct Shared {
    newest: Slot,
    wanted: Slot,
    fault: AtomicU8,
    stop: AtomicBool,
    received: AtomicU64,
    skipped: AtomicU64,
    short: AtomicU64,
    stalled: AtomicU64,
    timed_out: AtomicU64,
    failed: AtomicU64,
    servo_silent: AtomicU64,
}

/// Link status, as the threads report it to the servo thread.
const FINE: u8 = 0;
const SILENT: u8 = 1;
const GONE: u8 = 2;

/// A device that is being talked to. Dropping it brings the motors to zero and ends the threads.
pub struct Link {
    shared: Arc<Shared>,
    sender: Option<JoinHandle<()>>,
    receiver: Option<JoinHandle<()>>,
}

impl Link {
    /// Starts the threads on a device whose firmware runs. `step` is the largest change of a
    /// motor's command from one frame to the next.
    ///
    /// # Errors
    /// What the system says where it gives no thread.
    pub fn start(transport: Arc<dyn Transport>, step: i16) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let mut link = Self {
            shared: shared.clone(),
            sender: None,
            receiver: None,
        };
        let (for_sender, for_receiver) = (shared.clone(), transport.clone());
        let named = |name: &str| thread::Builder::new().name(name.into());
        let sender = move || send(&*transport, &for_sender, step);
        link.sender = Some(named("falcon-out").spawn(sender)?);
        let receiver = move || receive(&*for_receiver, &shared);
        link.receiver = Some(named("falcon-in").spawn(receiver)?);
        Ok(link)
    }

    /// Returns the newest answer.
    #[must_use]
    pub(super) fn newest(&self) -> Held {
        self.shared.newest.held()
    }

    /// Returns the fault of the link, if any.
    #[must_use]
    pub fn fault(&self) -> Option<DeviceError> {
        match self.shared.fault.load(Ordering::Acquire) {
            FINE => None,
            SILENT => Some(DeviceError::TimedOut),
            _ => Some(DeviceError::Disconnected),
        }
    }

    /// Has a command sent. It wakes a thread, and neither waits nor allocates.
    pub fn command(&self, command: &Command) {
        self.shared.wanted.put_command(command);
        if let Some(sender) = &self.sender {
            sender.thread().unpark();
        }
    }

    /// The counts so far.
    #[must_use]
    pub fn counts(&self) -> LinkCounts {
        let of = |count: &AtomicU64| count.load(Ordering::Relaxed);
        let shared = &self.shared;
        LinkCounts {
            received: of(&shared.received),
            skipped_bytes: of(&shared.skipped),
            short: of(&shared.short),
            stalled: of(&shared.stalled),
            timed_out: of(&shared.timed_out),
            failed: of(&shared.failed),
            servo_silent: of(&shared.servo_silent),
        }
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Release);
        if let Some(sender) = self.sender.take() {
            sender.thread().unpark();
            let _ = sender.join();
        }
        if let Some(receiver) = self.receiver.take() {
            let _ = receiver.join();
        }
    }
}

impl Shared {
    /// Counts an error, clears a stall, and tells a lost device. Gives whether to go on.
    fn met(&self, error: TransferError, transport: &dyn Transport, direction: Direction) -> bool {
        let add = |count: &AtomicU64| count.fetch_add(1, Ordering::Relaxed);
        match error {
            TransferError::TimedOut => {
                add(&self.timed_out);
            }
            TransferError::Stalled => {
                add(&self.stalled);
                if transport.clear_stall(direction) == Err(TransferError::Disconnected) {
                    return self.met(TransferError::Disconnected, transport, direction);
                }
            }
            TransferError::Disconnected => {
                self.fault.store(GONE, Ordering::Release);
                self.stop.store(true, Ordering::Release);
                return false;
            }
            TransferError::Failed => {
                add(&self.failed);
                // An error that comes at once must not keep a processor busy.
                thread::sleep(Duration::from_millis(1));
            }
        }
        true
    }
}

fn receive(transport: &dyn Transport, shared: &Shared) {
    let mut frames = Frames::default();
    let mut last = Instant::now();
    let mut newest = None;
    while !shared.stop.load(Ordering::Acquire) {
        let mut packet = [0; PACKET_BYTES];
        match transport.receive(&mut packet, PATIENCE) {
            Ok(length) => {
                if length < STATUS_BYTES {
                    shared.short.fetch_add(1, Ordering::Relaxed);
                }
                newest = frames.push(payload(&packet[..length])).or(newest);
                // More waits behind a full packet, and is newer.
                let drained = length < PACKET_BYTES;
                if let Some(answer) = newest.take_if(|_| drained) {
                    shared.newest.put_answer(&answer);
                    shared.received.fetch_add(1, Ordering::Relaxed);
                    last = Instant::now();
                    // A device that is gone stays so.
                    let _ = shared.fault.compare_exchange(
                        SILENT,
                        FINE,
                        Ordering::AcqRel,
                        Ordering::Relaxed,
                    );
                }
                shared.skipped.store(frames.skipped, Ordering::Relaxed);
            }
            Err(error) => {
                if !shared.met(error, transport, Direction::In) {
                    return;
                }
                // What waits is as old as the transfer, and what came before lacks its end.
                let _ = ftdi::set(transport, &[Setting::PurgeReceived]);
                frames.clear();
                newest = None;
            }
        }
        if last.elapsed() > DEVICE_SILENT {
            let _ =
                shared
                    .fault
                    .compare_exchange(FINE, SILENT, Ordering::AcqRel, Ordering::Relaxed);
        }
    }
}

fn send(transport: &dyn Transport, shared: &Shared, step: i16) {
    let mut motors = Motors::default();
    let mut known = shared.wanted.held();
    let mut heard = Instant::now();
    let mut silent = false;
    loop {
        let stop = shared.stop.load(Ordering::Acquire);
        let wanted = shared.wanted.held();
        if wanted.sequence() != known.sequence() {
            (known, heard, silent) = (wanted, Instant::now(), false);
        } else if !silent && heard.elapsed() > SERVO_SILENT {
            silent = true;
            if motors.sent != [0; 3] {
                shared.servo_silent.fetch_add(1, Ordering::Relaxed);
            }
        }
        if stop {
            break;
        }
        let target = if silent {
            [0; 3]
        } else {
            known.command().motors
        };
        motors.send(transport, shared, target, known.command().leds, step);
        thread::park_timeout(KEEP_ALIVE);
    }
    for _ in 0..STOP_FRAMES {
        if shared.fault.load(Ordering::Acquire) == GONE {
            return;
        }
        if motors.send(transport, shared, [0; 3], 0, step) && motors.sent == [0; 3] {
            return;
        }
    }
}

/// Motor commands on their way to the device.
#[derive(Default)]
struct Motors {
    sent: [i16; 3],
    /// Sent in a failed transfer: may or may not have reached the motors.
    unsure: Option<[i16; 3]>,
}

impl Motors {
    /// Goes a step towards `target`; gives whether the command reached the device. After a failure
    /// the same command goes out again: it is within a step of whatever the motors heard last.
    fn send(
        &mut self,
        transport: &dyn Transport,
        shared: &Shared,
        target: [i16; 3],
        leds: u8,
        step: i16,
    ) -> bool {
        let motors = self
            .unsure
            .unwrap_or_else(|| approach(self.sent, target, step));
        let command = Command {
            motors,
            leds,
            // Without it the encoders would lose their zero.
            homing: true,
        };
        let arrived = put(transport, shared, &command);
        self.unsure = (!arrived).then_some(motors);
        if arrived {
            self.sent = motors;
        }
        arrived
    }
}

/// Sends one command; gives whether it reached the device as a whole.
fn put(transport: &dyn Transport, shared: &Shared, command: &Command) -> bool {
    match transport.send(&command.encode(), PATIENCE) {
        Ok(FRAME_BYTES) => true,
        Ok(_) => {
            shared.short.fetch_add(1, Ordering::Relaxed);
            false
        }
        Err(error) => {
            shared.met(error, transport, Direction::Out);
            false
        }
    }
}
