//! The stack of every call of the C face on a target.

use crate::{emulate, package::Result, target::Target, toolchain::Toolchain};
use std::collections::BTreeMap;

/// The most that a call may take, bytes; less than the 4 KiB that the firmware paints.
fn limit(name: &str) -> u64 {
    let loads = name.contains("_load_") || name == "scene_init";
    if loads { 4000 } else { 3072 }
}

/// Builds and runs the firmware that makes every call, prints what each took, and fails above the
/// limit.
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
    let above: Vec<_> = (most.iter())
        .filter(|(name, bytes)| **bytes > limit(name))
        .map(|(name, bytes)| {
            format!(
                "asperity_{name}: {bytes} bytes of stack, at most {}",
                limit(name)
            )
        })
        .collect();
    if run.lines.is_empty() {
        Err("the firmware measured nothing".into())
    } else if above.is_empty() {
        Ok(())
    } else {
        Err(above.join("\ncortex-m: ").into())
    }
}
