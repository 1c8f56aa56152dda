//! For which machine a shared library was built, and whether it is whole. The system's loader does
//! not tell: it calls a library of another machine a file that does not exist, and crashes on one
//! that was cut.

use std::io::Read;
use std::path::Path;

/// Names of machines by their number in an ELF file.
const MACHINES: [(u16, &str); 6] = [
    (3, "x86"),
    (8, "mips"),
    (40, "arm"),
    (62, "x86_64"),
    (183, "aarch64"),
    (243, "riscv64"),
];

/// Kind of a file, from its first bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum BinaryKind {
    /// An ELF file for a machine, by its Rust name where it has one.
    For(String),
    /// No ELF file, or a part of one.
    Foreign,
}

/// Bytes of the head of a 64-bit file.
const HEAD: usize = 64;

/// Reads for which machine a file was built; `None` where it cannot be read.
pub(super) fn kind(path: &Path) -> Option<BinaryKind> {
    let mut head = [0; HEAD];
    let mut file = std::fs::File::open(path).ok()?;
    let length = file.metadata().ok()?.len();
    match file.read_exact(&mut head) {
        Ok(()) if is_cut(&head, length) => Some(BinaryKind::Foreign),
        Ok(()) => Some(of(&head)),
        Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Some(BinaryKind::Foreign)
        }
        Err(_) => None,
    }
}

/// Returns true if a 64-bit little-endian file ends before its section header table, which
/// compilers put last.
fn is_cut(head: &[u8; HEAD], length: u64) -> bool {
    let short = |at: usize| u64::from(u16::from_le_bytes([head[at], head[at + 1]]));
    let table = (0..8)
        .rev()
        .fold(0, |sum, n| sum << 8 | u64::from(head[40 + n]));
    head[4..6] == [2, 1] && table.saturating_add(short(58) * short(60)) > length
}

fn of(head: &[u8; HEAD]) -> BinaryKind {
    let (class, order) = (head[4], head[5]);
    if &head[..4] != b"\x7fELF" || !matches!(class, 1 | 2) || !matches!(order, 1 | 2) {
        return BinaryKind::Foreign;
    }
    let number = [head[18], head[19]];
    let number = if order == 1 {
        u16::from_le_bytes(number)
    } else {
        u16::from_be_bytes(number)
    };
    let name = MACHINES.iter().find(|(machine, _)| *machine == number);
    BinaryKind::For(match (name, class) {
        // The 32-bit programs of a 64-bit machine.
        (Some((62, _)), 1) => "x86_64 with 32-bit pointers".into(),
        (Some((_, name)), _) => (*name).into(),
        (None, _) => format!("ELF machine {number}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn machines_are_named_and_other_files_are_not_libraries() {
        let mut head = [0; HEAD];
        head[..6].copy_from_slice(b"\x7fELF\x02\x01");
        for (number, name) in [(62, "x86_64"), (183, "aarch64"), (999, "ELF machine 999")] {
            head[18..20].copy_from_slice(&u16::to_le_bytes(number));
            assert_eq!(of(&head), BinaryKind::For(name.into()));
        }
        (head[4], head[18], head[19]) = (1, 3, 0);
        assert_eq!(of(&head), BinaryKind::For("x86".into()));
        head[..9].copy_from_slice(b"#!/bin/sh");
        assert_eq!(of(&head), BinaryKind::Foreign);
    }
}
