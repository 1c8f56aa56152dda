//! Wake-up latencies of `cyclictest`, of the package rt-tests, in the same run.
//!
//! It is started with the same interval, policy, priority and processor. Our loop begins a quarter of
//! a period after a full second of the monotonic clock, cyclictest three quarters after it: they never
//! wait for each other on one processor, and at 1 kHz neither wakes with the kernel's own tick, which
//! comes at full milliseconds.

use super::run::Counts;
use crate::servo::privileges::Policy;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use thiserror::Error;

/// Largest latency of the histogram, µs: the most that cyclictest accepts. Larger ones are in no percentile.
const TOLD_APART_US: u32 = 1_000_000;

/// Why there is nothing of cyclictest.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CyclictestError {
    /// It is not installed.
    #[error("cyclictest is not installed: apt-get install rt-tests")]
    Missing,
    /// It cannot be started, or ended badly.
    #[error("cyclictest failed: {0}")]
    Failed(String),
    /// It has no such interval.
    #[error("cyclictest takes intervals of whole µs that fit into a second, not {0} Hz")]
    Rate(u32),
    /// It does not set this policy.
    #[error("cyclictest has no SCHED_DEADLINE")]
    Policy,
    /// Its file is not what version 2 of rt-tests writes.
    #[error("not what `cyclictest --json` writes: {0}")]
    Json(#[from] serde_json::Error),
    /// It ran without a histogram.
    #[error("cyclictest counted no histogram, so that only its extremes and its mean are known")]
    NoHistogram,
    /// Numbers that no measurement gives.
    #[error("latencies or counts of cyclictest are too large")]
    Range,
}

/// cyclictest at work.
#[derive(Debug)]
pub struct Cyclictest {
    child: Child,
}

/// Results of cyclictest.
#[derive(Debug, Clone, PartialEq)]
pub struct Wakeups {
    /// Version of rt-tests.
    pub version: String,
    /// Its command line.
    pub command: String,
    /// Latencies in ns, cut to µs as cyclictest counts them without `-N`.
    pub counts: Counts,
    /// Latencies beyond its histogram, which are in no count.
    pub beyond: u64,
    /// The largest, ns.
    pub max_ns: u64,
}

impl Cyclictest {
    /// Start of a loop at this rate relative to a full second of the monotonic clock, ns, so that
    /// it is comparable with cyclictest.
    #[must_use]
    pub fn offset_ns(rate_hz: u32) -> u64 {
        1_000_000_000 / u64::from(rate_hz) / 4
    }

    /// Starts it for so many ticks; it writes its results to `json`.
    ///
    /// # Errors
    /// [`CyclictestError`].
    pub fn start(
        rate_hz: u32,
        ticks: u64,
        policy: Policy,
        cpu: Option<usize>,
        json: &Path,
    ) -> Result<Self, CyclictestError> {
        if 1_000_000 % rate_hz != 0 {
            return Err(CyclictestError::Rate(rate_hz));
        }
        let interval_us = 1_000_000 / rate_hz;
        let mut command = Command::new("cyclictest");
        command
            .args(["--quiet", "--mlockall", "--threads=1"])
            .arg(format!("--interval={interval_us}"))
            .arg(format!("--loops={ticks}"))
            .arg(format!("--histogram={TOLD_APART_US}"))
            .arg(format!("--secaligned={}", 3 * interval_us / 4))
            .arg(format!("--json={}", json.display()));
        match policy {
            Policy::Other => command.arg("--policy=other"),
            Policy::Fifo { priority } => {
                command.args(["--policy=fifo".into(), format!("--priority={priority}")])
            }
            Policy::Deadline { .. } => return Err(CyclictestError::Policy),
        };
        if let Some(cpu) = cpu {
            command.arg(format!("--affinity={cpu}"));
        }
        command.stdin(Stdio::null()).stdout(Stdio::null());
        let child = command.stderr(Stdio::piped()).spawn();
        let child = child.map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => CyclictestError::Missing,
            _ => CyclictestError::Failed(error.to_string()),
        })?;
        Ok(Self { child })
    }

    /// Waits until it has ended and reads its results.
    ///
    /// # Errors
    /// [`CyclictestError`].
    pub fn finish(mut self, json: &Path) -> Result<Wakeups, CyclictestError> {
        let failed = |error: io::Error| CyclictestError::Failed(error.to_string());
        let mut said = String::new();
        if let Some(mut stderr) = self.child.stderr.take() {
            io::Read::read_to_string(&mut stderr, &mut said).map_err(failed)?;
        }
        let status = self.child.wait().map_err(failed)?;
        if !status.success() {
            let last = said.lines().last().unwrap_or("no message");
            return Err(CyclictestError::Failed(format!("{status}: {last}")));
        }
        Wakeups::parse(&std::fs::read(json).map_err(failed)?)
    }
}

impl Drop for Cyclictest {
    fn drop(&mut self) {
        // It has ended already where it was waited for.
        if matches!(self.child.try_wait(), Ok(None)) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

#[derive(Deserialize)]
struct File {
    #[serde(rename = "cmdline:", alias = "cmdline", default)]
    command: String,
    #[serde(rename = "rt_test_version:", alias = "rt_test_version", default)]
    version: String,
    /// 1 where latencies are ns (`-N`), 0 where they are µs.
    #[serde(default)]
    resolution_in_ns: u64,
    thread: BTreeMap<String, Thread>,
}

#[derive(Deserialize)]
struct Thread {
    histogram: BTreeMap<u64, u64>,
    cycles: u64,
    max: u64,
}

impl Wakeups {
    /// Reads what `cyclictest --json` of rt-tests 2 writes.
    ///
    /// # Errors
    /// [`CyclictestError::Json`], [`CyclictestError::NoHistogram`] and [`CyclictestError::Range`].
    pub fn parse(bytes: &[u8]) -> Result<Self, CyclictestError> {
        let file: File = serde_json::from_slice(bytes)?;
        let unit_ns = match file.resolution_in_ns {
            0 => 1000,
            stated => stated,
        };
        let in_ns = |latency: u64| latency.checked_mul(unit_ns).ok_or(CyclictestError::Range);
        let sum = |a: u64, b: u64| a.checked_add(b).ok_or(CyclictestError::Range);
        let mut counts: BTreeMap<u64, u64> = BTreeMap::new();
        let (mut cycles, mut counted, mut max_ns) = (0, 0, 0);
        for thread in file.thread.values() {
            for (latency, count) in &thread.histogram {
                counted = sum(counted, *count)?;
                *counts.entry(in_ns(*latency)?).or_default() += count;
            }
            cycles = sum(cycles, thread.cycles)?;
            max_ns = max_ns.max(in_ns(thread.max)?);
        }
        if counted == 0 && cycles > 0 {
            return Err(CyclictestError::NoHistogram);
        }
        Ok(Self {
            version: file.version,
            command: file.command,
            counts: Counts(counts.into_iter().collect()),
            beyond: cycles.saturating_sub(counted),
            max_ns,
        })
    }
}
