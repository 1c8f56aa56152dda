//! Linux.

use super::{Grant, Policy, PrivilegeRequest, Refusal, system};
use rustix::{
    mm::{MlockAllFlags, mlockall},
    process::{Resource, getrlimit},
    thread::{CapabilitySet, CpuSet, capabilities, sched_setaffinity, set_current_timer_slack},
};
use std::fs::{File, OpenOptions};
use std::io::{self, Write as _};
use std::num::NonZeroU64;

/// Lets a command ask for real-time policies and lock its memory.
const CAPABILITIES: &str = "sudo setcap cap_sys_nice,cap_ipc_lock+ep \"$(which asperity-lab)\"";
/// As long as this file is open, processors stay in states that take at most so many µs to leave.
const IDLE_FILE: &str = "/dev/cpu_dma_latency";

pub(super) fn acquire(
    request: &PrivilegeRequest,
    rate_hz: u32,
    grants: &mut Vec<Grant>,
    held: &mut Vec<File>,
) {
    let mut answer = |what, wanted: String, answer: Result<(), Refusal>| {
        grants.push(Grant {
            what,
            wanted,
            refusal: answer.err(),
        });
    };
    if request.lock_memory {
        answer("memory", "locked".into(), lock_memory());
    }
    if request.shallow_idle {
        let opened = shallow_idle().map(|file| held.push(file));
        answer("idle", "shallow".into(), opened);
    }
    if let Some(cpu) = request.cpu {
        answer("processor", cpu.to_string(), pin(cpu));
    }
    // Without it, timers of ordinary threads are up to 50 µs late on purpose.
    let slack = set_current_timer_slack(NonZeroU64::new(1));
    let slack = slack.map_err(|error| Refusal {
        why: error.to_string(),
        remedy: "use a real-time policy, which has no timer slack".into(),
    });
    answer("timer slack", "1 ns".into(), slack);
    if request.policy != Policy::Other {
        let policy = schedule(request, rate_hz);
        answer("policy", request.policy.to_string(), policy);
    }
}

fn lock_memory() -> Result<(), Refusal> {
    let limited = getrlimit(Resource::Memlock).current.is_some();
    let capable =
        capabilities(None).is_ok_and(|sets| sets.effective.contains(CapabilitySet::IPC_LOCK));
    if limited && !capable {
        // Locked within a limit, the process would die of the first allocation beyond it.
        return Err(Refusal {
            why: "the limit of locked memory (ulimit -l) is not `unlimited`".into(),
            remedy: format!(
                "{CAPABILITIES}, or add `@realtime - memlock unlimited` to /etc/security/limits.conf and join the group realtime"
            ),
        });
    }
    mlockall(MlockAllFlags::CURRENT | MlockAllFlags::FUTURE).map_err(|error| Refusal {
        why: error.to_string(),
        remedy: CAPABILITIES.into(),
    })
}

fn shallow_idle() -> Result<File, Refusal> {
    let open = || -> io::Result<File> {
        let mut file = OpenOptions::new().write(true).open(IDLE_FILE)?;
        file.write_all(&0_i32.to_ne_bytes())?;
        Ok(file)
    };
    open().map_err(|error| Refusal {
        why: format!("{IDLE_FILE}: {error}"),
        remedy: format!(
            "sudo setfacl -m u:$USER:rw {IDLE_FILE}, until the next start of the system"
        ),
    })
}

fn pin(cpu: usize) -> Result<(), Refusal> {
    let refusal = |why| Refusal {
        why,
        remedy: "choose a processor that /sys/devices/system/cpu/online lists, and taskset allows"
            .into(),
    };
    if cpu >= CpuSet::MAX_CPU {
        return Err(refusal(format!("there is no processor {cpu}")));
    }
    let mut set = CpuSet::new();
    set.set(cpu);
    sched_setaffinity(None, &set).map_err(|error| refusal(error.to_string()))
}

fn schedule(request: &PrivilegeRequest, rate_hz: u32) -> Result<(), Refusal> {
    let remedy = |error: &io::Error| match (request.policy, error.raw_os_error()) {
        (Policy::Deadline { .. }, Some(libc::EBUSY)) => {
            "ask for a smaller share, such as deadline:20; the kernel has promised the rest".into()
        }
        (Policy::Deadline { .. }, Some(libc::EPERM)) if request.cpu.is_some() => {
            "leave out --cpu: a thread with a deadline may run on every processor".into()
        }
        _ => format!(
            "{CAPABILITIES}, or add `@realtime - rtprio 95` to /etc/security/limits.conf and join the group realtime"
        ),
    };
    let scheduled = match request.policy {
        Policy::Other => Ok(()),
        Policy::Fifo { priority } => system::set_fifo(priority),
        Policy::Deadline { percent } => {
            let period_ns = 1_000_000_000 / u64::from(rate_hz.max(1));
            system::set_deadline(period_ns * u64::from(percent) / 100, period_ns)
        }
    };
    scheduled.map_err(|error| Refusal {
        why: error.to_string(),
        remedy: remedy(&error),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Real-time priority and policy of the calling thread, as the kernel states them: fields 40 and 41 of
    /// proc_pid_stat(5).
    fn scheduled() -> [u32; 2] {
        let text = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
        // The name, which may hold spaces, ends with the last parenthesis; the third field follows.
        let fields: Vec<&str> = text[text.rfind(')').unwrap() + 1..]
            .split_ascii_whitespace()
            .collect();
        [40, 41].map(|field| fields[field - 3].parse().unwrap())
    }

    #[test]
    fn a_policy_that_is_granted_is_the_one_that_the_kernel_states() {
        // No kernel has a priority of 100.
        for priority in [1, 100] {
            let request = PrivilegeRequest {
                policy: Policy::Fifo { priority },
                ..PrivilegeRequest::NOTHING
            };
            let asked = std::thread::spawn(move || {
                let before = scheduled();
                let mut grants = Vec::new();
                acquire(&request, 1000, &mut grants, &mut Vec::new());
                let policy = grants.into_iter().find(|grant| grant.what == "policy");
                (policy.unwrap().refusal.is_none(), before, scheduled())
            });
            let (granted, before, after) = asked.join().unwrap();
            assert_eq!(before, [0, 0]);
            assert!(!granted || priority == 1);
            let fifo = [1, libc::SCHED_FIFO.cast_unsigned()];
            assert_eq!(after, if granted { fifo } else { before });
        }
    }
}
