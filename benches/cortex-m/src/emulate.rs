//! A firmware in QEMU, every tick's instructions counted.

use crate::{Result, home, target::Target, target_dir, toolchain::stdout};
use asperity_session::{PHASE_TICKS, Phase};
use std::{fs, path::Path, process::Command};

/// What came out of the emulator.
#[derive(Debug)]
pub(crate) struct Run {
    /// Lines that the firmware printed: name and value.
    pub(crate) lines: Vec<(String, u64)>,
    /// Executed instructions of each tick.
    pub(crate) instructions: Vec<u64>,
}

impl Run {
    /// The value of a line.
    pub(crate) fn value(&self, name: &str) -> Result<u64> {
        let found = self.lines.iter().find(|(found, _)| found == name);
        found
            .map(|(_, value)| *value)
            .ok_or_else(|| format!("the firmware printed no `{name}`").into())
    }
}

/// Runs an ELF to its end.
pub(crate) fn run(target: &Target, firmware: &Path) -> Result<Run> {
    let plugin = target_dir().join("libtickcount.so");
    stdout(
        Command::new("cc")
            .args([
                "-std=c11",
                "-D_GNU_SOURCE",
                "-O2",
                "-Wall",
                "-Wextra",
                "-Werror",
            ])
            .args(["-shared", "-fPIC", "-fvisibility=hidden", "-o"])
            .arg(&plugin)
            .arg(home().join("tickcount.c")),
    )?;
    let counts = firmware.with_extension("ticks");
    let printed = stdout(
        // A firmware that hangs must not hang the caller.
        Command::new("timeout")
            .args(["600", "qemu-system-arm", "-M", target.machine])
            .args(["-display", "none", "-monitor", "none", "-serial", "none"])
            .args(["-semihosting-config", "enable=on,target=native", "-plugin"])
            .arg(format!(
                "{},begin=mark_begin,end=mark_end,out={}",
                plugin.display(),
                counts.display()
            ))
            .arg("-kernel")
            .arg(firmware),
    )?;
    let instructions = fs::read_to_string(&counts)?
        .lines()
        .map(str::parse)
        .collect::<std::result::Result<Vec<u64>, _>>()
        .map_err(|_| "a marker of the tick was met without the other")?;
    let expected = Phase::ALL.len() * PHASE_TICKS as usize;
    if instructions.len() != expected {
        let found = instructions.len();
        return Err(format!("{found} ticks counted, {expected} in the session").into());
    }
    let lines = printed.lines().map(line).collect::<Result<_>>()?;
    Ok(Run {
        lines,
        instructions,
    })
}

fn line(text: &str) -> Result<(String, u64)> {
    let parsed = text
        .split_once(' ')
        .and_then(|(name, hex)| Some((name.to_owned(), u64::from_str_radix(hex, 16).ok()?)));
    parsed.ok_or_else(|| format!("the firmware printed `{text}`").into())
}
