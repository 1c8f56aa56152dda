//! Each setting, as far as the system tells.

use super::{
    Setting,
    files::{Files, listed},
};
use crate::shown::counted;

/// Bits of the effective capabilities: memory may be locked, priorities may be raised.
pub(super) const CAP_IPC_LOCK: u32 = 14;
pub(super) const CAP_SYS_NICE: u32 = 23;
/// Idle states that take longer to leave than this are deep, µs.
const DEEP_US: u64 = 10;
/// Grants what the loop asks for itself.
const GRANT: &str = r#"sudo setcap cap_sys_nice,cap_ipc_lock+ep "$(which asperity-lab)""#;

/// A setting that is so, and whether that suits; `None` where the system does not tell.
fn setting(
    name: &'static str,
    found: Option<(String, bool)>,
    change: impl Into<String>,
) -> Setting {
    let good = found.as_ref().map(|(_, good)| *good);
    Setting {
        name,
        now: found.map_or_else(|| "unknown".into(), |(now, _)| now),
        good,
        change: change.into(),
    }
}

pub(super) fn preemption(files: &Files) -> Setting {
    let found = files.text("proc/sys/kernel/version").map(|version| {
        let models = ["PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT"];
        let model = models.into_iter().find(|model| version.contains(model));
        let model = model.unwrap_or("not preemptible");
        (model.to_owned(), model == "PREEMPT_RT")
    });
    setting(
        "kernel",
        found,
        "sudo apt install linux-image-rt-amd64, or your distribution's real-time kernel",
    )
}

/// By default the kernel stops real-time threads for 5 % of each second.
pub(super) fn throttling(files: &Files) -> Setting {
    let runtime_us: Option<i64> = files.number("proc/sys/kernel/sched_rt_runtime_us");
    let period_us: Option<i64> = files.number("proc/sys/kernel/sched_rt_period_us");
    let found = runtime_us.zip(period_us).map(|(runtime_us, period_us)| {
        if runtime_us < 0 || runtime_us >= period_us {
            ("off".to_owned(), true)
        } else {
            let now = format!("real-time threads get {runtime_us} of {period_us} µs");
            (now, false)
        }
    });
    setting(
        "throttling",
        found,
        "sudo sysctl -w kernel.sched_rt_runtime_us=-1",
    )
}

/// Checks that this process has a capability, or a sufficient resource limit in its place: `enough` is the least
/// sufficient value, `shown` words a lower one.
pub(super) fn privilege(
    files: &Files,
    name: &'static str,
    capability: u32,
    (limit, enough): (&str, u64),
    shown: fn(u64) -> String,
) -> Setting {
    let status = files.text("proc/self/status");
    let capable = status.as_deref().and_then(|status| {
        let line = status
            .lines()
            .find_map(|line| line.strip_prefix("CapEff:"))?;
        let bits = u64::from_str_radix(line.trim(), 16).ok()?;
        Some(bits & (1 << capability) != 0)
    });
    let limits = files.text("proc/self/limits");
    let allowed = limits.as_deref().and_then(|limits| {
        let line = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        match line.split_whitespace().next()? {
            "unlimited" => Some(u64::MAX),
            limit => limit.parse().ok(),
        }
    });
    let found = match (capable, allowed) {
        (Some(true), _) | (_, Some(u64::MAX)) => Some(("permitted".to_owned(), true)),
        (_, Some(0)) | (Some(false), None) => Some(("not permitted".to_owned(), false)),
        (_, Some(limit)) => {
            let now = format!("permitted up to {}", shown(limit));
            Some((now, limit >= enough))
        }
        (None, None) => None,
    };
    setting(name, found, GRANT)
}

pub(super) fn isolation(files: &Files, cpu: Option<usize>) -> Setting {
    let last = files.processors() - 1;
    let wanted = cpu.unwrap_or(last);
    let isolated = files.text("sys/devices/system/cpu/isolated");
    let isolated = isolated.map_or_else(Vec::new, |list| listed(&list));
    let good = cpu.is_some_and(|cpu| isolated.contains(&cpu));
    let range = |first: usize, last: usize| match last.checked_sub(first) {
        Some(0) => Some(first.to_string()),
        Some(_) => Some(format!("{first}-{last}")),
        None => None,
    };
    let below = wanted.checked_sub(1).and_then(|below| range(0, below));
    let others: Vec<String> = below.into_iter().chain(range(wanted + 1, last)).collect();
    let others = others.join(",");
    Setting {
        name: "isolated processor",
        now: match (isolated.as_slice(), cpu) {
            ([], _) => "none".to_owned(),
            (list, None) => {
                let list: Vec<String> = list.iter().map(usize::to_string).collect();
                format!("{}, and the loop is not pinned there", list.join(","))
            }
            (_, Some(cpu)) if good => format!("{cpu}, the loop's"),
            (_, Some(cpu)) => format!("not {cpu}, the loop's"),
        },
        good: (files.processors() > 1 || good).then_some(good),
        change: format!(
            "kernel parameters isolcpus={wanted} nohz_full={wanted} rcu_nocbs={wanted} irqaffinity={others}, then --cpu {wanted}"
        ),
    }
}

/// Interrupts that the loop's processor may be given.
pub(super) fn interrupts(files: &Files, cpu: Option<usize>) -> Setting {
    let names = files.names("proc/irq");
    let numbers = || names.iter().filter(|name| name.parse::<u32>().is_ok());
    let served_by = |cpu: usize| {
        let served = numbers().filter(|number| {
            let affinity = ["effective_affinity_list", "smp_affinity_list"];
            let list = affinity
                .iter()
                .find_map(|file| files.text(&format!("proc/irq/{number}/{file}")));
            list.is_some_and(|list| listed(&list).contains(&cpu))
        });
        served.count() as u64
    };
    let found = (numbers().count() > 0).then(|| {
        let count = |count| counted(count, "interrupt", "interrupts");
        match cpu {
            Some(cpu) => {
                let served = served_by(cpu);
                (format!("{} on processor {cpu}", count(served)), served == 0)
            }
            None => {
                let all = count(numbers().count() as u64);
                (
                    format!("{all}, and the loop is not pinned (--cpu N)"),
                    false,
                )
            }
        }
    });
    setting(
        "interrupts",
        found,
        "for f in /proc/irq/[0-9]*/smp_affinity_list; do echo 0 | sudo tee $f; done, where the loop is not on processor 0",
    )
}

pub(super) fn governor(files: &Files, cpu: usize) -> Setting {
    let path = format!("sys/devices/system/cpu/cpu{cpu}/cpufreq/scaling_governor");
    let found = files.text(&path).map(|governor| {
        let good = governor == "performance";
        (governor, good)
    });
    setting(
        "frequency governor",
        found,
        "sudo cpupower frequency-set -g performance",
    )
}

/// The deepest idle state that is not disabled. The loop holds them shallow itself where it may.
pub(super) fn idle(files: &Files, cpu: usize) -> Setting {
    let folder = format!("sys/devices/system/cpu/cpu{cpu}/cpuidle");
    let states = files.names(&folder);
    let states = states.iter().filter_map(|state| {
        let enabled = files.text(&format!("{folder}/{state}/disable")).as_deref() != Some("1");
        let latency_us: u64 = files.number(&format!("{folder}/{state}/latency"))?;
        let name = files.text(&format!("{folder}/{state}/name"))?;
        enabled.then_some((latency_us, name))
    });
    let found = states.max().map(|(latency_us, name)| {
        let now = format!("down to {name}, {latency_us} µs to leave");
        (now, latency_us <= DEEP_US)
    });
    setting(
        "idle states",
        found,
        format!("sudo cpupower idle-set -D {DEEP_US}, or write access to /dev/cpu_dma_latency"),
    )
}

pub(super) fn smt(files: &Files) -> Setting {
    let active = files.text("sys/devices/system/cpu/smt/active");
    let found = active.map(|active| match active.as_str() {
        "1" => ("on".to_owned(), false),
        _ => ("off".to_owned(), true),
    });
    setting(
        "hyper-threading",
        found,
        "echo off | sudo tee /sys/devices/system/cpu/smt/control",
    )
}

/// Checks that the kernel can detect latency caused by firmware or a hypervisor (hwlat).
pub(super) fn hardware(files: &Files) -> Setting {
    let folders = ["sys/kernel/tracing", "sys/kernel/debug/tracing"];
    let tracers = folders
        .iter()
        .find_map(|folder| files.text(&format!("{folder}/available_tracers")));
    let has = tracers.map(|tracers| tracers.split_whitespace().any(|tracer| tracer == "hwlat"));
    Setting {
        name: "hardware latency",
        now: match has {
            Some(true) => "not measured; this kernel can (hwlat)".to_owned(),
            Some(false) => "not measured; this kernel has no hwlat".to_owned(),
            None => "not measured; the kernel's tracers cannot be read".to_owned(),
        },
        good: None,
        change: "sudo hwlatdetect --duration=60 (rt-tests; the kernel needs CONFIG_HWLAT_TRACER)"
            .to_owned(),
    }
}
