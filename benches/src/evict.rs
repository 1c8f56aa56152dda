//! Cache eviction, as by other work between two ticks of a servo loop.

use std::hint::black_box;

/// Bytes that are read: several times the second-level cache of a core.
const DATA_BYTES: usize = 8 << 20;
/// Bytes of a cache line.
const LINE: usize = 64;

/// Code that fills the first-level instruction cache: every number gives a function of its own.
#[inline(never)]
fn other_code<const N: usize>(mut x: usize) -> usize {
    // Different constants keep the linker from making one function of them all.
    for shift in [1, 3, 7, 11, 13, 17] {
        x = black_box(x ^ N).wrapping_mul(2 * N + 3).rotate_left(shift);
    }
    x
}

type Other = fn(usize) -> usize;

macro_rules! row {
    ($base:expr; $($n:literal)*) => { [$(other_code::<{ $base * 16 + $n }> as Other),*] };
}
macro_rules! rows {
    ($($base:literal)*) => { [$(row!($base; 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)),*] };
}

/// 512 functions of more than a line each.
static CODE: [[Other; 16]; 32] = rows!(
    0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31
);

/// Takes caches over from a tick.
pub struct Others {
    data: Vec<u8>,
}

impl Default for Others {
    fn default() -> Self {
        Self::new()
    }
}

impl Others {
    /// The data of the others.
    #[must_use]
    pub fn new() -> Self {
        Self {
            data: vec![1; DATA_BYTES],
        }
    }

    /// Writes to every line of the data and runs all of the code.
    pub fn run(&mut self) {
        for line in self.data.chunks_exact_mut(LINE) {
            line[0] = line[0].wrapping_add(1);
        }
        let mut x = usize::from(self.data[0]);
        for function in CODE.as_flattened() {
            x = function(x);
        }
        black_box(x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn the_code_fills_a_first_level_cache() {
        let addresses: HashSet<usize> = CODE
            .as_flattened()
            .iter()
            .map(|function| *function as usize / LINE)
            .collect();
        assert_eq!(addresses.len(), 512);
    }
}
