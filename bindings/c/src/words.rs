//! Counters and flags in words, for a log.

use crate::{
    AsperityCounters, AsperityStatus, sized,
    status::{Fault, call},
    text::Text,
};
use asperity_runtime::Flags;
use core::{
    ffi::c_char,
    fmt::{self, Write as _},
    mem::MaybeUninit,
    ptr, slice,
};

/// Size of a buffer for any text that a function of this header writes, bytes.
pub const ASPERITY_TEXT_SIZE: usize = 256;

/// Writes a text to a place that C passes.
///
/// # Safety
/// `text` is null or `size` writable bytes.
unsafe fn say(
    text: *mut c_char,
    size: usize,
    words: impl FnOnce(&mut Text<'_>) -> fmt::Result,
) -> Result<(), Fault> {
    if text.is_null() {
        return Err(AsperityStatus::NullPointer.into());
    }
    if size == 0 || size > isize::MAX as usize {
        return Err(AsperityStatus::Memory.into());
    }
    // SAFETY: not null, writable by the caller's promise; nothing is read.
    let memory = unsafe { slice::from_raw_parts_mut(text.cast::<MaybeUninit<c_char>>(), size) };
    let mut text = Text::new(memory);
    let _ = words(&mut text);
    if text.is_cut() {
        Err(AsperityStatus::Memory.into())
    } else {
        Ok(())
    }
}

/// A count with its noun.
fn count(text: &mut Text<'_>, number: u32, one: &str, many: &str) -> fmt::Result {
    write!(text, "{number} {}", if number == 1 { one } else { many })
}

/// Puts counters into words, such as `5000 ticks, 2 overruns (missed periods), 11 bad samples, 1
/// entry of the safe state, 4 taps, 0 ticks cut to the peak, 3 ticks held back by the slew limit`.
/// A text that does not fit into `size` bytes is cut, and the status is
/// `ASPERITY_STATUS_MEMORY`; `ASPERITY_TEXT_SIZE` are always enough.
///
/// # Safety
/// `counters` is null or readable; `text` is null or `size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_counters_text(
    counters: *const AsperityCounters,
    text: *mut c_char,
    size: usize,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            let c = sized::read(counters)?;
            say(text, size, |text| {
                let entry = "entry of the safe state";
                let entries = "entries of the safe state";
                count(text, c.ticks, "tick, ", "ticks, ")?;
                count(text, c.missed_ticks, "overrun", "overruns")?;
                text.write_str(" (missed periods), ")?;
                count(text, c.bad_samples, "bad sample, ", "bad samples, ")?;
                count(text, c.faults, entry, entries)?;
                text.write_str(", ")?;
                count(text, c.taps, "tap, ", "taps, ")?;
                count(text, c.peak_limited, "tick", "ticks")?;
                text.write_str(" cut to the peak, ")?;
                count(text, c.slew_limited, "tick", "ticks")?;
                text.write_str(" held back by the slew limit")
            })
        })
    }
}

/// Puts `AsperityOutput::flags` into words: the names of `ASPERITY_FLAG_*` in lower case, a space
/// between two; no text for no flag. Sizes as in `asperity_counters_text`.
///
/// # Safety
/// `text` is null or `size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_flags_text(
    flags: u32,
    text: *mut c_char,
    size: usize,
) -> AsperityStatus {
    // SAFETY: the caller's promises; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            say(text, size, |text| {
                let set = |(flag, _): &(Flags, _)| flags & u32::from(flag.bits()) != 0;
                for (index, (_, name)) in Flags::ALL.iter().filter(|flag| set(flag)).enumerate() {
                    text.write_str(if index > 0 { " " } else { "" })?;
                    text.write_str(name)?;
                }
                Ok(())
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the text of `words` in a buffer of `SIZE` bytes, and the status.
    fn said<const SIZE: usize>(
        words: impl FnOnce(*mut c_char, usize) -> AsperityStatus,
    ) -> (String, AsperityStatus) {
        let mut buffer: [c_char; SIZE] = [0x55; SIZE];
        let status = words(buffer.as_mut_ptr(), SIZE);
        let bytes: Vec<u8> = buffer.iter().map(|byte| *byte as u8).collect();
        let end = bytes.iter().position(|byte| *byte == 0).unwrap();
        (String::from_utf8(bytes[..end].to_vec()).unwrap(), status)
    }

    fn counters(number: u32) -> AsperityCounters {
        AsperityCounters {
            struct_size: size_of::<AsperityCounters>() as u32,
            ticks: number,
            bad_samples: number,
            missed_ticks: number,
            faults: number,
            taps: number,
            peak_limited: number,
            slew_limited: number,
        }
    }

    #[test]
    fn counters_in_words() {
        let text = |number: u32| {
            let counters = counters(number);
            // SAFETY: both pointers lead to local memory.
            let say =
                |text, size| unsafe { asperity_counters_text(&raw const counters, text, size) };
            let (words, status) = said::<ASPERITY_TEXT_SIZE>(say);
            assert_eq!(status, AsperityStatus::Ok);
            words
        };
        assert_eq!(
            text(1),
            "1 tick, 1 overrun (missed periods), 1 bad sample, 1 entry of the safe state, 1 tap, \
             1 tick cut to the peak, 1 tick held back by the slew limit"
        );
        assert!(text(0).starts_with("0 ticks, 0 overruns"));
        // The longest text fits.
        assert!(text(u32::MAX).ends_with("4294967295 ticks held back by the slew limit"));
    }

    #[test]
    fn flags_in_words() {
        // SAFETY: the pointer leads to local memory.
        let text =
            |flags| said::<ASPERITY_TEXT_SIZE>(|t, s| unsafe { asperity_flags_text(flags, t, s) });
        assert_eq!(text(0).0, "");
        assert_eq!(text(1 | 4).0, "contact tap_active");
        let (all, status) = text(u32::MAX);
        assert_eq!((all.split(' ').count(), status), (10, AsperityStatus::Ok));
        // SAFETY: as above.
        let short = said::<10>(|text, size| unsafe { asperity_flags_text(5, text, size) });
        assert_eq!(short, ("contact t".into(), AsperityStatus::Memory));
    }
}
