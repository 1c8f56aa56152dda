//! A firmware in QEMU, every tick's instructions counted.

use crate::{
    package::{Result, home, stdout, target_dir},
    target::Target,
};
use std::{fs, path::Path, process::Command};

/// Output of an emulator run.
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

/// Runs a firmware to its end; it marks `expected` ticks.
pub(crate) fn run(target: &Target, firmware: &Path, expected: usize) -> Result<Run> {
    let mut machine = qemu("qemu-system-arm");
    machine
        .args(["-M", target.machine, "-display", "none", "-monitor", "none"])
        .args(["-serial", "none", "-semihosting-config"])
        .arg("enable=on,target=native");
    let (printed, instructions) = counted(machine, "-kernel", firmware, expected)?;
    let lines = printed.lines().map(line).collect::<Result<_>>()?;
    Ok(Run {
        lines,
        instructions,
    })
}

/// Executed instructions of each tick of a program of the host, x86-64.
pub(crate) fn run_on_host(program: &Path, expected: usize) -> Result<Vec<u64>> {
    Ok(counted(qemu("qemu-x86_64"), "--", program, expected)?.1)
}

/// An emulator that cannot hang its caller.
fn qemu(name: &str) -> Command {
    let mut command = Command::new("timeout");
    command.args(["600", name]);
    command
}

/// Runs a program in the emulator. Returns its output, and the instructions of each tick.
fn counted(
    mut emulator: Command,
    program_flag: &str,
    program: &Path,
    expected: usize,
) -> Result<(String, Vec<u64>)> {
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
    let counts = program.with_extension("ticks");
    let printed = stdout(
        emulator
            .arg("-plugin")
            .arg(format!(
                "{},begin=mark_begin,end=mark_end,out={}",
                plugin.display(),
                counts.display()
            ))
            .arg(program_flag)
            .arg(program),
    )?;
    let instructions = fs::read_to_string(&counts)?
        .lines()
        .map(str::parse)
        .collect::<std::result::Result<Vec<u64>, _>>()
        .map_err(|_| "a marker of the tick was met without the other")?;
    if instructions.len() != expected {
        let found = instructions.len();
        return Err(format!("{found} ticks counted, {expected} expected").into());
    }
    Ok((printed, instructions))
}

fn line(text: &str) -> Result<(String, u64)> {
    let parsed = text
        .split_once(' ')
        .and_then(|(name, hex)| Some((name.to_owned(), u64::from_str_radix(hex, 16).ok()?)));
    parsed.ok_or_else(|| format!("the firmware printed `{text}`").into())
}
