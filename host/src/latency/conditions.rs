//! Conditions of a run.

use crate::servo::privileges::Grant;
use serde::{Deserialize, Serialize};
use std::fs;

/// The machine and its settings, as far as the system tells.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Name, release and version of the kernel.
    pub kernel: String,
    /// Preemption model of the kernel, as far as known.
    pub preemption: String,
    /// Processor model.
    pub processor: Option<String>,
    /// Processors available to this process.
    pub processors: usize,
    /// True for a virtual machine, as far as the processor reports it.
    pub virtual_machine: Option<bool>,
    /// Clock source.
    pub clock_source: Option<String>,
    /// Frequency governor.
    pub governor: Option<String>,
    /// Isolated processors.
    pub isolated: Option<String>,
    /// Processors without a regular tick.
    pub nohz_full: Option<String>,
    /// Processors that leave callbacks of RCU to others.
    pub rcu_nocbs: Option<String>,
    /// Load of the last minute when the run began.
    pub load_average: Option<String>,
}

impl Machine {
    /// Asks the system. `cpu` is the processor of the loop.
    #[must_use]
    pub fn now(cpu: Option<usize>) -> Self {
        let cpu = cpu.unwrap_or(0);
        let info = line("/proc/cpuinfo");
        let field = |name: &str| {
            let line = info
                .as_deref()?
                .lines()
                .find(|line| line.starts_with(name))?;
            line.split_once(':')
                .map(|(_, value)| value.trim().to_owned())
        };
        let command_line = line("/proc/cmdline").unwrap_or_default();
        let option = |name: &str| {
            let mut words = command_line.split_whitespace();
            words.find_map(|word| Some(word.strip_prefix(name)?.to_owned()))
        };
        let kernel = kernel();
        Self {
            preemption: preemption(&kernel),
            kernel,
            processor: field("model name"),
            processors: std::thread::available_parallelism().map_or(1, Into::into),
            virtual_machine: field("flags")
                .map(|flags| flags.split(' ').any(|flag| flag == "hypervisor")),
            clock_source: line("/sys/devices/system/clocksource/clocksource0/current_clocksource"),
            governor: line(&format!(
                "/sys/devices/system/cpu/cpu{cpu}/cpufreq/scaling_governor"
            )),
            isolated: line("/sys/devices/system/cpu/isolated"),
            nohz_full: line("/sys/devices/system/cpu/nohz_full"),
            rcu_nocbs: option("rcu_nocbs="),
            load_average: line("/proc/loadavg")
                .and_then(|text| text.split(' ').next().map(str::to_owned)),
        }
    }
}

/// A file of the system, without the space around it; `None` if it is missing or empty.
fn line(path: &str) -> Option<String> {
    let text = fs::read_to_string(path).ok()?;
    let text = text.trim();
    (!text.is_empty() && text != "(null)").then(|| text.to_owned())
}

#[cfg(target_os = "linux")]
fn kernel() -> String {
    let name = rustix::system::uname();
    let texts = [name.sysname(), name.release(), name.version()];
    texts.map(|text| text.to_string_lossy()).join(" ")
}

#[cfg(not(target_os = "linux"))]
fn kernel() -> String {
    std::env::consts::OS.into()
}

/// The preemption model: what the running kernel chose where it says so, else how it was built.
fn preemption(kernel: &str) -> String {
    // Of `none voluntary (full)`, the word in brackets.
    let chosen = line("/sys/kernel/debug/sched/preempt").and_then(|text| {
        let (_, rest) = text.split_once('(')?;
        rest.split_once(')').map(|(word, _)| word.to_owned())
    });
    let built = ["PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT"];
    let built = built.into_iter().find(|word| kernel.contains(word));
    match (built, chosen) {
        (Some(built), Some(chosen)) => format!("{built}, {chosen}"),
        (Some(built), None) => built.into(),
        (None, Some(chosen)) => chosen,
        (None, None) => "unknown".into(),
    }
}

/// Conditions of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Conditions {
    /// The machine.
    pub machine: Machine,
    /// Ticks a second, Hz.
    pub rate_hz: u32,
    /// Overrun policy.
    pub overrun: String,
    /// Busy-wait before each tick, µs.
    pub spin_us: u64,
    /// Privileges granted by the system.
    pub granted: Vec<String>,
    /// Privileges refused, with the reason.
    pub refused: Vec<String>,
    /// The device.
    pub device: String,
    /// The texture or scene.
    pub texture: String,
    /// Injected delay.
    pub injected: Option<String>,
    /// Version of Asperity.
    pub version: String,
}

impl Conditions {
    /// Splits grants into both lists.
    #[must_use]
    pub fn with_grants(mut self, grants: &[Grant]) -> Self {
        for grant in grants {
            let asked = format!("{}: {}", grant.what, grant.wanted);
            match &grant.refusal {
                None => self.granted.push(asked),
                Some(refusal) => self.refused.push(format!("{asked}: {}", refusal.why)),
            }
        }
        self
    }
}
