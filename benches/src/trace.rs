//! Cache lines that a tick touches, from a trace of every access.
//!
//! `valgrind --tool=lackey --trace-mem=yes` prints a line for each instruction and each access. The
//! measured program writes to a mark before and after a tick, which cuts the trace into ticks.

use std::{collections::HashSet, io::BufRead, ops::Range};

/// Bytes of a cache line.
pub const LINE: u64 = 64;

/// Owner of an address.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Owner {
    /// Instructions.
    Code,
    /// The state.
    State,
    /// The slot: the texture as it was loaded.
    Slot,
    /// The renderer: the configuration and what follows from it.
    Renderer,
    /// The stack, the sample and constants.
    Other,
}

impl Owner {
    /// Every owner with its name, in the order of [`Lines`].
    pub const ALL: [(Self, &'static str); 5] = [
        (Self::Code, "code"),
        (Self::State, "state"),
        (Self::Slot, "slot"),
        (Self::Renderer, "renderer"),
        (Self::Other, "stack, sample, constants"),
    ];
}

/// Where the measured program keeps what a tick reads.
#[derive(Debug, Clone)]
pub struct Places {
    /// Address of the mark, a byte.
    pub mark: u64,
    /// Addresses of state, slot and renderer.
    pub ranges: [(Owner, Range<u64>); 3],
}

impl Places {
    fn owner(&self, address: u64) -> Owner {
        let place = self
            .ranges
            .iter()
            .find(|(_, range)| range.contains(&address));
        place.map_or(Owner::Other, |(owner, _)| *owner)
    }
}

/// Distinct lines that one tick touches, by [`Owner`].
pub type Lines = [usize; Owner::ALL.len()];

/// The lines of every tick of a trace.
///
/// # Errors
/// What the reader reports.
pub fn lines_of_ticks(trace: impl BufRead, places: &Places) -> std::io::Result<Vec<Lines>> {
    let mut ticks = Vec::new();
    let mut touched: Option<HashSet<(Owner, u64)>> = None;
    for line in trace.lines() {
        let line = line?;
        let Some((kind, address, bytes)) = access(&line) else {
            continue;
        };
        if kind == 'S' && address == places.mark {
            touched = match touched.take() {
                None => Some(HashSet::new()),
                Some(lines) => {
                    ticks.push(Owner::ALL.map(|(owner, _)| {
                        lines.iter().filter(|(other, _)| *other == owner).count()
                    }));
                    None
                }
            };
            continue;
        }
        if let Some(lines) = &mut touched {
            let owner = if kind == 'I' {
                Owner::Code
            } else {
                places.owner(address)
            };
            for line in address / LINE..=(address + bytes - 1) / LINE {
                lines.insert((owner, line));
            }
        }
    }
    Ok(ticks)
}

/// Kind, address and size of an access: `I  0010a0c4,3`, ` L 1ffeffe7a0,8`.
fn access(line: &str) -> Option<(char, u64, u64)> {
    let mut words = line.split_ascii_whitespace();
    let kind = words.next()?;
    let (address, bytes) = words.next()?.split_once(',')?;
    let kind = match kind {
        "I" | "L" | "S" | "M" => kind.chars().next()?,
        _ => return None,
    };
    let bytes = bytes.parse::<u64>().ok()?.max(1);
    Some((kind, u64::from_str_radix(address, 16).ok()?, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_counted_once_and_by_owner() {
        let trace = "==1== valgrind\nI  001000,3\n S 005000,1\nI  001003,3\nI  00103e,4\n L 006000,4\n \
                     L 006004,4\n M 00603c,8\n L 009000,8\n S 005000,1\n L 006100,4\n S 005000,1\n S 005000,1\n";
        let places = Places {
            mark: 0x5000,
            ranges: [
                (Owner::State, 0x6000..0x6400),
                (Owner::Slot, 0x7000..0x8000),
                (Owner::Renderer, 0x8000..0x8100),
            ],
        };
        let ticks = lines_of_ticks(trace.as_bytes(), &places).expect("bytes can be read");
        assert_eq!(ticks, [[2, 2, 0, 0, 1], [0; 5]]);
    }
}
