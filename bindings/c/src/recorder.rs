//! Recording what happened in each tick, from the servo loop to another thread.
//!
//! A ring in the caller's memory, one writer and one reader. The writer never waits: a record that
//! finds the ring full is lost and counted.

use crate::{
    AsperityOutput, AsperitySample, AsperityStatus,
    memory::{Object, Tag, room, tag, write},
    sized,
    status::{Fault, call},
};
use core::{
    ffi::c_void,
    ptr,
    sync::atomic::{AtomicU32, Ordering},
};

/// Size of the memory of an `AsperityRecorder` without its records, bytes.
pub const ASPERITY_RECORDER_SIZE: usize = 256;
/// Bytes of memory that a record takes in an `AsperityRecorder`.
pub const ASPERITY_RECORDER_RECORD_SIZE: usize = 128;

/// A ring of records. One thread at a time may write, one may read meanwhile.
#[derive(Debug)]
#[repr(C)]
pub struct AsperityRecorder {
    tag: Tag,
}

/// Input and output of a tick.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperityRecord {
    /// Number of the write, from 0, lost ones included: a gap shows where records were lost.
    pub tick: u64,
    /// `AsperitySample::position_m`.
    pub position_m: [f32; 3],
    /// `AsperitySample::elapsed_ticks`.
    pub elapsed_ticks: u32,
    /// `AsperityOutput::force_n`.
    pub force_n: [f32; 3],
    /// `AsperityOutput::depth_m`.
    pub depth_m: f32,
    /// `AsperityOutput::speed_mm_s`.
    pub speed_mm_s: f32,
    /// `AsperityOutput::normal_force_n`.
    pub normal_force_n: f32,
    /// `AsperityOutput::vib_m_s2`.
    pub vib_m_s2: f32,
    /// `AsperityOutput::tap_n`.
    pub tap_n: f32,
    /// `AsperityOutput::friction_n`.
    pub friction_n: f32,
    /// `AsperityOutput::flags`.
    pub flags: u32,
    /// `AsperityOutput::surface`.
    pub surface: u32,
    /// 0.
    pub reserved: u32,
}

/// Size of a record in the first version, bytes.
const FIRST: usize = 72;

const _: () = {
    assert!(size_of::<AsperityRecord>() == FIRST);
    assert!(size_of::<AsperityRecord>() <= ASPERITY_RECORDER_RECORD_SIZE);
    assert!(size_of::<Ring>() <= ASPERITY_RECORDER_SIZE);
};

/// Object behind an `AsperityRecorder` pointer; its records follow it in memory.
///
/// Positions count from 0 to twice the number of records, so that full and empty differ.
#[repr(C)]
struct Ring {
    tag: Tag,
    records: u32,
    /// Next position of the reader, which alone writes it.
    read: AtomicU32,
    /// The writer's own, behind it.
    writer: Writer,
}

/// Apart from what the reader writes, so that the two threads do not share a cache line.
#[repr(C, align(64))]
struct Writer {
    /// Next position of the writer, which alone writes it.
    written: AtomicU32,
    lost: AtomicU32,
    /// Number of the next write, lower and upper half; only the writer looks at it.
    tick: [AtomicU32; 2],
}

// SAFETY: `repr(C)`, the tag is first.
unsafe impl Object for Ring {
    const TAG: Tag = Tag::new(b'L', 0, 0);
}

impl Ring {
    /// Records that wait, of positions.
    const fn waiting(&self, written: u32, read: u32) -> u32 {
        if written >= read {
            written - read
        } else {
            written + 2 * self.records - read
        }
    }

    const fn next(&self, position: u32) -> u32 {
        if position + 1 == 2 * self.records {
            0
        } else {
            position + 1
        }
    }

    /// The place of a position.
    ///
    /// # Safety
    /// `recorder` leads to this ring and its records.
    unsafe fn place(&self, recorder: *mut AsperityRecorder, position: u32) -> *mut AsperityRecord {
        let index = (position % self.records) as usize;
        let offset = ASPERITY_RECORDER_SIZE + index * ASPERITY_RECORDER_RECORD_SIZE;
        // SAFETY: within the memory that `asperity_recorder_init` was given.
        unsafe { recorder.cast::<u8>().add(offset).cast() }
    }
}

impl Writer {
    /// The number of this write.
    fn number(&self) -> u64 {
        let [low, high] = &self.tick;
        let (found, upper) = (low.load(Ordering::Relaxed), high.load(Ordering::Relaxed));
        low.store(found.wrapping_add(1), Ordering::Relaxed);
        if found == u32::MAX {
            high.store(upper.wrapping_add(1), Ordering::Relaxed);
        }
        u64::from(upper) << 32 | u64::from(found)
    }
}

/// The ring at a pointer. Both threads hold shared references to it.
///
/// # Safety
/// `recorder` is null or leads to at least four readable bytes, and to a ring if they are its tag.
unsafe fn ring<'a>(recorder: *const AsperityRecorder) -> Result<&'a Ring, AsperityStatus> {
    // SAFETY: the caller's promises.
    unsafe {
        if tag(recorder)? != Ring::TAG {
            return Err(AsperityStatus::NotInitialised);
        }
        let ring = recorder.cast::<Ring>();
        if ring.is_aligned() {
            Ok(&*ring)
        } else {
            Err(AsperityStatus::Memory)
        }
    }
}

/// Makes an empty ring in `memory`: `ASPERITY_RECORDER_SIZE` bytes, and
/// `ASPERITY_RECORDER_RECORD_SIZE` for each record, at least one.
///
/// # Safety
/// `memory` is null or `size` bytes that nothing else uses; `recorder` is null or valid for writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_recorder_init(
    memory: *mut c_void,
    size: usize,
    recorder: *mut *mut AsperityRecorder,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            let least = ASPERITY_RECORDER_SIZE + ASPERITY_RECORDER_RECORD_SIZE;
            let ring = room::<Ring, _>(memory, size, least, recorder)?;
            let records = (size - ASPERITY_RECORDER_SIZE) / ASPERITY_RECORDER_RECORD_SIZE;
            ring.write(Ring {
                tag: Ring::TAG,
                records: records.min(i32::MAX as usize) as u32,
                read: AtomicU32::new(0),
                writer: Writer {
                    written: AtomicU32::new(0),
                    lost: AtomicU32::new(0),
                    tick: [AtomicU32::new(0), AtomicU32::new(0)],
                },
            });
            recorder.write(ring.cast());
            Ok(())
        })
    }
}

/// Records a tick, in the thread of the servo loop. If the ring is full, the record is lost and
/// counted. Never waits.
///
/// # Safety
/// `recorder` is null or an initialised ring to which nobody else writes during the call; `sample`
/// and `output` are null or readable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_recorder_write(
    recorder: *mut AsperityRecorder,
    sample: *const AsperitySample,
    output: *const AsperityOutput,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            let ring = ring(recorder)?;
            let (sample, output) = (sized::read(sample)?, sized::read(output)?);
            let writer = &ring.writer;
            let tick = writer.number();
            let written = writer.written.load(Ordering::Relaxed);
            if ring.waiting(written, ring.read.load(Ordering::Acquire)) == ring.records {
                let lost = writer.lost.load(Ordering::Relaxed);
                writer.lost.store(lost.saturating_add(1), Ordering::Relaxed);
                return Ok(());
            }
            // The reader does not look at this place until `written` names it.
            ring.place(recorder, written).write(AsperityRecord {
                tick,
                position_m: sample.position_m,
                elapsed_ticks: sample.elapsed_ticks,
                force_n: output.force_n,
                depth_m: output.depth_m,
                speed_mm_s: output.speed_mm_s,
                normal_force_n: output.normal_force_n,
                vib_m_s2: output.vib_m_s2,
                tap_n: output.tap_n,
                friction_n: output.friction_n,
                flags: output.flags,
                surface: output.surface,
                reserved: 0,
            });
            writer.written.store(ring.next(written), Ordering::Release);
            Ok(())
        })
    }
}

/// Takes up to `room` records out of the ring, the oldest first, in another thread than the
/// writer's or in the same. `record_size` is `sizeof(AsperityRecord)`. `count` says how many were
/// taken, `lost` how many were lost since the ring was made; its pointer may be null.
///
/// # Safety
/// `recorder` is null or an initialised ring from which nobody else reads during the call;
/// `records` is null or has room for `room` records; `count` and `lost` are null or valid for
/// writes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_recorder_read(
    recorder: *mut AsperityRecorder,
    records: *mut AsperityRecord,
    record_size: usize,
    room: usize,
    count: *mut usize,
    lost: *mut u32,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            write(count, 0)?;
            let ring = ring(recorder)?;
            check(records, record_size)?;
            if !lost.is_null() {
                write(lost, ring.writer.lost.load(Ordering::Relaxed))?;
            }
            let mut position = ring.read.load(Ordering::Relaxed);
            let written = ring.writer.written.load(Ordering::Acquire);
            let waiting = ring.waiting(written, position) as usize;
            let taken = waiting.min(room);
            let known = record_size.min(size_of::<AsperityRecord>());
            for index in 0..taken {
                let from = ring.place(recorder, position).cast::<u8>();
                let to = records.cast::<u8>().add(index * record_size);
                ptr::copy_nonoverlapping(from, to, known);
                ptr::write_bytes(to.add(known), 0, record_size - known);
                position = ring.next(position);
            }
            ring.read.store(position, Ordering::Release);
            Ok(write(count, taken)?)
        })
    }
}

/// Checks the place and the size of records that C asks for.
fn check(records: *mut AsperityRecord, record_size: usize) -> Result<(), Fault> {
    if records.is_null() {
        Err(AsperityStatus::NullPointer.into())
    } else if !records.is_aligned() {
        Err(AsperityStatus::Memory.into())
    } else if !(FIRST..=ASPERITY_RECORDER_RECORD_SIZE).contains(&record_size)
        || !record_size.is_multiple_of(align_of::<AsperityRecord>())
    {
        Err(AsperityStatus::StructSize.into())
    } else {
        Ok(())
    }
}
