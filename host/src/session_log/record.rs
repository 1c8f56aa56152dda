//! Records of ticks: a mask that says what differs from the tick before, then those values.
//!
//! Numbers are LEB128. The bits of a float are combined with those of the tick before by exclusive
//! or, so that a small change gives a small number. The first record of a block follows a tick in
//! which everything is zero, so blocks are read on their own.

use asperity_runtime::Sample;

use super::Entry;
use crate::device::DeviceError;

const LOST: u16 = 1;
const NEXT_TEXTURE: u16 = 1 << 1;
const ELAPSED: u16 = 1 << 2;
/// The first of three.
const POSITION: u16 = 1 << 3;
/// The first of three.
const FORCE: u16 = 1 << 6;
const BUTTONS: u16 = 1 << 9;
const FLAGS: u16 = 1 << 10;
const READ_FAULT: u16 = 1 << 11;
const WRITE_FAULT: u16 = 1 << 12;
const KNOWN: u16 = (1 << 13) - 1;

/// Previous values, the base of delta encoding.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Before {
    position: [u32; 3],
    force: [u32; 3],
    buttons: u32,
    flags: u16,
}

pub(super) fn put(bytes: &mut Vec<u8>, mut number: u64) {
    while number >= 0x80 {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

/// Takes a number from the front.
pub(super) fn take(bytes: &mut &[u8]) -> Result<u64, &'static str> {
    let mut number = 0;
    for place in 0..10 {
        let (&byte, rest) = bytes
            .split_first()
            .ok_or("the block ends within a number")?;
        *bytes = rest;
        if place == 9 && byte > 1 {
            break;
        }
        number |= u64::from(byte & 0x7f) << (7 * place);
        if byte < 0x80 {
            return Ok(number);
        }
    }
    Err("a number is longer than 64 bits")
}

fn take_u32(bytes: &mut &[u8]) -> Result<u32, &'static str> {
    u32::try_from(take(bytes)?).map_err(|_| "a number is longer than 32 bits")
}

/// Code and detail of a fault.
fn of_fault(fault: DeviceError) -> (u64, u64) {
    match fault {
        DeviceError::TimedOut => (1, 0),
        DeviceError::Disconnected => (2, 0),
        DeviceError::ShortTransfer { got, wanted } => (3, u64::from(got) << 16 | u64::from(wanted)),
        DeviceError::Stalled => (4, 0),
        DeviceError::Garbled => (5, 0),
        DeviceError::WarmMotors => (6, 0),
        DeviceError::ForceExceeded => (7, 0),
        DeviceError::NotCalibrated => (8, 0),
        DeviceError::Vendor(code) => (9, u64::from(code.cast_unsigned())),
    }
}

fn take_fault(bytes: &mut &[u8]) -> Result<DeviceError, &'static str> {
    let code = take(bytes)?;
    let detail = take_u32(bytes)?;
    let fault = match code {
        1 => DeviceError::TimedOut,
        2 => DeviceError::Disconnected,
        3 => DeviceError::ShortTransfer {
            got: (detail >> 16) as u16,
            wanted: detail as u16,
        },
        4 => DeviceError::Stalled,
        5 => DeviceError::Garbled,
        6 => DeviceError::WarmMotors,
        7 => DeviceError::ForceExceeded,
        8 => DeviceError::NotCalibrated,
        9 => DeviceError::Vendor(detail.cast_signed()),
        _ => return Err("a fault of no known kind"),
    };
    Ok(fault)
}

/// Appends a record.
pub(super) fn encode(bytes: &mut Vec<u8>, before: &mut Before, entry: &Entry) {
    let at = bytes.len();
    bytes.extend_from_slice(&[0; 2]);
    let mut mask = 0;
    let mut give = |bytes: &mut Vec<u8>, bit: u16, there: bool, number: u64| {
        if there {
            mask |= bit;
            put(bytes, number);
        }
    };
    give(
        bytes,
        LOST,
        entry.lost_before != 0,
        u64::from(entry.lost_before),
    );
    let elapsed = entry.sample.elapsed_ticks;
    give(bytes, ELAPSED, elapsed != 1, u64::from(elapsed));
    let now = Before {
        position: entry.sample.position_m.map(f32::to_bits),
        force: entry.force_n.map(f32::to_bits),
        buttons: entry.buttons,
        flags: entry.flags,
    };
    for (first, now, last) in [
        (POSITION, now.position, before.position),
        (FORCE, now.force, before.force),
    ] {
        for axis in 0..3 {
            let change = now[axis] ^ last[axis];
            give(bytes, first << axis, change != 0, u64::from(change));
        }
    }
    give(
        bytes,
        BUTTONS,
        now.buttons != before.buttons,
        u64::from(now.buttons),
    );
    give(
        bytes,
        FLAGS,
        now.flags != before.flags,
        u64::from(now.flags),
    );
    for (bit, fault) in [
        (READ_FAULT, entry.read_fault),
        (WRITE_FAULT, entry.write_fault),
    ] {
        if let Some((code, detail)) = fault.map(of_fault) {
            give(bytes, bit, true, code);
            put(bytes, detail);
        }
    }
    if entry.next_texture {
        mask |= NEXT_TEXTURE;
    }
    bytes[at..at + 2].copy_from_slice(&mask.to_le_bytes());
    *before = now;
}

/// Takes a record from the front.
pub(super) fn decode(bytes: &mut &[u8], before: &mut Before) -> Result<Entry, &'static str> {
    let Some((mask, rest)) = bytes.split_first_chunk::<2>() else {
        return Err("the block ends within a record");
    };
    *bytes = rest;
    let mask = u16::from_le_bytes(*mask);
    if mask & !KNOWN != 0 {
        return Err("a record has fields of a later version");
    }
    let has = |bit: u16| mask & bit != 0;
    let lost_before = if has(LOST) { take_u32(bytes)? } else { 0 };
    let elapsed_ticks = if has(ELAPSED) { take_u32(bytes)? } else { 1 };
    for (first, values) in [(POSITION, &mut before.position), (FORCE, &mut before.force)] {
        for (axis, value) in values.iter_mut().enumerate() {
            if has(first << axis) {
                *value ^= take_u32(bytes)?;
            }
        }
    }
    if has(BUTTONS) {
        before.buttons = take_u32(bytes)?;
    }
    if has(FLAGS) {
        before.flags = u16::try_from(take(bytes)?).map_err(|_| "flags are longer than 16 bits")?;
    }
    let read_fault = if has(READ_FAULT) {
        Some(take_fault(bytes)?)
    } else {
        None
    };
    let write_fault = if has(WRITE_FAULT) {
        Some(take_fault(bytes)?)
    } else {
        None
    };
    Ok(Entry {
        sample: Sample {
            position_m: before.position.map(f32::from_bits),
            elapsed_ticks,
        },
        force_n: before.force.map(f32::from_bits),
        flags: before.flags,
        buttons: before.buttons,
        read_fault,
        write_fault,
        next_texture: has(NEXT_TEXTURE),
        lost_before,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_core::{Rng, SeedableRng};
    use rand_xoshiro::Xoshiro256PlusPlus;

    fn any(rng: &mut Xoshiro256PlusPlus) -> Entry {
        let mut float = || f32::from_bits(rng.next_u64() as u32);
        let (position_m, force_n) = ([float(), float(), float()], [float(), float(), float()]);
        let n = rng.next_u64();
        let fault = |n: u64| match n % 12 {
            0 => Some(DeviceError::ShortTransfer {
                got: n as u16,
                wanted: (n >> 16) as u16,
            }),
            1 => Some(DeviceError::Vendor((n >> 20) as i32)),
            2 => Some(DeviceError::Stalled),
            3 => Some(DeviceError::NotCalibrated),
            _ => None,
        };
        Entry {
            sample: Sample {
                position_m,
                elapsed_ticks: (n >> 60) as u32,
            },
            force_n,
            flags: n as u16,
            buttons: (n >> 32) as u32,
            read_fault: fault(n >> 8),
            write_fault: fault(n >> 16),
            next_texture: n.is_multiple_of(5),
            lost_before: if n.is_multiple_of(7) { n as u32 } else { 0 },
        }
    }

    #[test]
    fn every_record_reads_back_to_the_bit_and_cut_ones_are_refused() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(5);
        let entries: Vec<Entry> = (0..500).map(|_| any(&mut rng)).collect();
        let mut bytes = Vec::new();
        let mut before = Before::default();
        for entry in &entries {
            encode(&mut bytes, &mut before, entry);
        }
        let mut rest = &bytes[..];
        let mut before = Before::default();
        for entry in &entries {
            assert!(
                decode(&mut rest, &mut before)
                    .expect("a record")
                    .has_bits_of(entry)
            );
        }
        assert!(rest.is_empty());

        let mut one = Vec::new();
        encode(&mut one, &mut Before::default(), &entries[0]);
        for length in 0..one.len() {
            assert!(
                decode(&mut &one[..length], &mut Before::default()).is_err(),
                "{length}"
            );
        }
    }

    #[test]
    fn random_bytes_never_panic() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(6);
        for _ in 0..20_000 {
            let bytes: Vec<u8> = (0..rng.next_u64() % 40)
                .map(|_| rng.next_u64() as u8)
                .collect();
            let mut rest = &bytes[..];
            while !rest.is_empty() && decode(&mut rest, &mut Before::default()).is_ok() {}
        }
    }

    #[test]
    fn a_resting_hand_takes_two_bytes_a_tick() {
        let entry = Entry {
            flags: 1,
            ..any(&mut Xoshiro256PlusPlus::seed_from_u64(1))
        };
        let entry = Entry {
            sample: Sample::at([0.01, 0.02, 0.03]),
            read_fault: None,
            write_fault: None,
            next_texture: false,
            lost_before: 0,
            ..entry
        };
        let (mut bytes, mut before) = (Vec::new(), Before::default());
        encode(&mut bytes, &mut before, &entry);
        let first = bytes.len();
        encode(&mut bytes, &mut before, &entry);
        assert_eq!(bytes.len() - first, 2);
    }
}
