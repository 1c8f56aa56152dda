//! The stack of every call of the C face on a target.

use crate::{
    emulate,
    package::{Result, home},
    target::Target,
    toolchain::Toolchain,
};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
};

/// The most that a call may take, bytes; less than the 4 KiB that the firmware paints.
const LIMIT: u64 = 3072;

/// The functions that the header of the C face declares, without `asperity_`.
fn functions() -> Result<BTreeSet<String>> {
    let header = fs::read_to_string(home().join("../../bindings/c/include/asperity.h"))?;
    let words = header.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '('));
    Ok(words
        .filter_map(|word| word.split_once('(')?.0.strip_prefix("asperity_"))
        .map(str::to_owned)
        .collect())
}

/// Builds and runs the firmware that makes every call, prints what each took, and fails above the
/// limit, or if a function of the header is missing.
pub(crate) fn print(target: &Target, toolchain: &Toolchain) -> Result<()> {
    let path = toolchain.firmware("c-stack", &["c"])?;
    let run = emulate::run(target, &path, 0)?;
    println!("stack of each call on {}, bytes", target.triple);
    // Calls that were made more than once: the deepest counts.
    let mut most = BTreeMap::new();
    for (name, bytes) in &run.lines {
        let found = most.entry(name).or_insert(0);
        *found = (*bytes).max(*found);
    }
    for (name, bytes) in &most {
        println!("asperity_{name:<25}{bytes:>6}");
    }
    let faults: Vec<_> = (most.iter())
        .filter(|(_, bytes)| **bytes > LIMIT)
        .map(|(name, bytes)| format!("asperity_{name}: {bytes} bytes of stack, at most {LIMIT}"))
        .chain(
            functions()?
                .iter()
                .filter(|name| !most.contains_key(name))
                .map(|name| format!("asperity_{name}: not measured")),
        )
        .collect();
    if faults.is_empty() {
        Ok(())
    } else {
        Err(faults.join("\ncortex-m: ").into())
    }
}
