//! Everything that a function can reach by branches and calls.

use crate::{
    elf::{Elf, Function},
    thumb::{Flow, decode},
};
use std::collections::BTreeSet;

/// Code reachable from a function.
#[derive(Debug, Default)]
pub(crate) struct Reach {
    /// Bytes of code, the function's own included.
    pub(crate) code_bytes: usize,
    /// Functions.
    pub(crate) functions: usize,
    /// Why it cannot be said that no panic is reached; empty when it can.
    pub(crate) faults: Vec<String>,
}

/// Follows every branch from the function of this name.
pub(crate) fn from(elf: &Elf, name: &str) -> Reach {
    let mut reach = Reach::default();
    let Some(root) = elf.functions.iter().find(|f| f.name == name) else {
        reach.faults.push(format!("no function `{name}`"));
        return reach;
    };
    let mut seen = BTreeSet::from([root.start]);
    let mut waiting = vec![root];
    while let Some(function) = waiting.pop() {
        reach.functions += 1;
        reach.code_bytes += function.code.len();
        if function.name.contains("panic") || function.name.contains("rust_begin_unwind") {
            reach
                .faults
                .push(format!("`{name}` reaches `{}`", function.name));
        }
        for (at, flow) in flows(function) {
            match flow {
                Flow::Plain => {}
                Flow::Trap => reach
                    .faults
                    .push(format!("a trap at {at:#x} in `{}`", function.name)),
                Flow::Unknown => {
                    reach.faults.push(format!(
                        "an indirect branch at {at:#x} in `{}`",
                        function.name
                    ));
                }
                Flow::To(address) => match holder(elf, address) {
                    None => reach.faults.push(format!(
                        "a branch at {at:#x} in `{}` leaves the code",
                        function.name
                    )),
                    Some(next) if seen.insert(next.start) => waiting.push(next),
                    Some(_) => {}
                },
            }
        }
    }
    reach
}

fn holder(elf: &Elf, address: u32) -> Option<&Function> {
    let after = elf.functions.partition_point(|f| f.start <= address);
    let function = elf.functions.get(after.checked_sub(1)?)?;
    (address < function.start + function.code.len() as u32).then_some(function)
}

fn flows(function: &Function) -> Vec<(u32, Flow)> {
    let half = |offset: u32| {
        let at = offset as usize;
        function
            .code
            .get(at..at + 2)
            .map_or(0, |two| u16::from_le_bytes([two[0], two[1]]))
    };
    let (mut offset, mut flows) = (0, Vec::new());
    while (offset as usize) < function.code.len() {
        let address = function.start + offset;
        if let Some((_, end)) = function
            .data
            .iter()
            .find(|(start, end)| (*start..*end).contains(&address))
        {
            offset = end - function.start;
            continue;
        }
        let (flow, len) = decode(address, half(offset), half(offset + 2));
        flows.push((address, flow));
        offset += len;
    }
    flows
}
