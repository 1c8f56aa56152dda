//! The limits that `limits.toml` sets.

use crate::{measure::Measured, package::Result, target::Target};
use serde::Deserialize;
use std::{collections::BTreeMap, fs, path::Path};

/// Upper limits of a case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Limit {
    instructions: u64,
    median_instructions: u64,
    spread_percent: u64,
    flash_bytes: u64,
    tick_code_bytes: u64,
    state_bytes: u64,
    slot_bytes: u64,
    stack_bytes: u64,
}

/// The limits of a target's cases, by name; none where the file does not know the target.
pub(crate) fn read(path: &Path, target: &Target) -> Result<BTreeMap<String, Limit>> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut targets: BTreeMap<String, BTreeMap<String, Limit>> = toml::from_str(&text)?;
    let limits = targets.remove(target.triple).unwrap_or_default();
    if limits.is_empty() {
        println!("limits.toml sets no limits for {}", target.triple);
    } else if let Some(case) = target.cases().find(|case| !limits.contains_key(case.name)) {
        return Err(format!(
            "limits.toml: {} has no limits for {}",
            target.triple, case.name
        )
        .into());
    }
    Ok(limits)
}

/// A line for every limit that was exceeded.
pub(crate) fn exceeded(limits: &BTreeMap<String, Limit>, measured: &[Measured]) -> Vec<String> {
    let mut faults = Vec::new();
    for m in measured {
        let Some(limit) = limits.get(m.case.name) else {
            continue;
        };
        let stack_bytes = m.stack_load_bytes.max(m.stack_tick_bytes);
        for (what, found, most) in [
            ("instructions", m.worst(), limit.instructions),
            ("median_instructions", m.median(), limit.median_instructions),
            (
                "spread_percent",
                m.spread_percent().ceil() as u64,
                limit.spread_percent,
            ),
            ("flash_bytes", m.elf.flash_bytes, limit.flash_bytes),
            (
                "tick_code_bytes",
                m.reach.code_bytes as u64,
                limit.tick_code_bytes,
            ),
            ("state_bytes", m.state_bytes, limit.state_bytes),
            ("slot_bytes", m.slot_bytes, limit.slot_bytes),
            ("stack_bytes", stack_bytes, limit.stack_bytes),
        ] {
            if found > most {
                faults.push(format!(
                    "{}: {what} {found}, at most {most} (limits.toml)",
                    m.case.name
                ));
            }
        }
    }
    faults
}
