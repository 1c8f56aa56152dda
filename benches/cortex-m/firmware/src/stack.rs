//! Stack depth, measured by painting the memory below the stack.
#![allow(unsafe_code, reason = "memory below the stack pointer is no object's")]

use cortex_m::register::msp;

/// Bytes painted: more than a session needs, less than the smallest machine has free.
const PAINTED: u32 = 4 * 1024;
/// Left alone below the caller, for the painter's own frame.
const MARGIN: u32 = 64;
const PAINT: u32 = 0xa5a5_5a5a;

/// Paints the memory below the stack.
#[inline(never)]
pub fn paint() {
    let top = msp::read() & !3;
    let mut address = top - PAINTED;
    while address < top - MARGIN {
        // SAFETY: RAM below the stack pointer, above the statics (checked by the linker's
        // map of these machines: more than 4 KiB are free), which nothing else uses.
        unsafe { (address as *mut u32).write_volatile(PAINT) };
        address += 4;
    }
}

/// Bytes below this function's caller that were written since [`paint`] was called from
/// the same place; [`PAINTED`] when the paint is gone altogether.
#[inline(never)]
pub fn depth() -> usize {
    let top = msp::read() & !3;
    let mut address = top - PAINTED;
    // SAFETY: as in `paint`; every word was initialised there.
    while address < top && unsafe { (address as *const u32).read_volatile() } == PAINT {
        address += 4;
    }
    (top - address) as usize
}
