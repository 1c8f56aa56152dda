//! Machines that are made of files.

use super::*;
use std::fs;

/// A machine of files.
fn machine(files: &[(&str, &str)]) -> tempfile::TempDir {
    let root = tempfile::tempdir().expect("a folder");
    for (path, text) in files {
        let path = root.path().join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("folders");
        fs::write(path, text).expect("a file");
    }
    root
}

fn by_name<'a>(settings: &'a [Setting], name: &str) -> &'a Setting {
    let found = settings.iter().find(|setting| setting.name == name);
    found.expect("a setting")
}

const SUITED: [(&str, &str); 14] = [
    ("proc/sys/kernel/version", "#1 SMP PREEMPT_RT Debian 6.12\n"),
    ("proc/sys/kernel/sched_rt_runtime_us", "-1\n"),
    ("proc/sys/kernel/sched_rt_period_us", "1000000\n"),
    ("proc/self/status", "Name:\tx\nCapEff:\t0000000000804000\n"),
    (
        "proc/self/limits",
        "Max locked memory         0   0   bytes\n",
    ),
    ("sys/devices/system/cpu/online", "0-3\n"),
    ("sys/devices/system/cpu/isolated", "3\n"),
    ("proc/irq/24/effective_affinity_list", "0-2\n"),
    ("proc/irq/25/smp_affinity_list", "1\n"),
    (
        "sys/devices/system/cpu/cpu3/cpufreq/scaling_governor",
        "performance\n",
    ),
    ("sys/devices/system/cpu/cpu3/cpuidle/state1/name", "C1\n"),
    ("sys/devices/system/cpu/cpu3/cpuidle/state1/latency", "2\n"),
    ("sys/devices/system/cpu/cpu3/cpuidle/state1/disable", "0\n"),
    ("sys/devices/system/cpu/smt/active", "0\n"),
];

/// Claim: a machine that is set up for a loop on its last processor is good in everything that
/// can be read, and each fault alone shows in its own row and in no other.
#[test]
fn each_setting_is_read_from_its_own_file() {
    let good = machine(&SUITED);
    let suited = settings_in(good.path(), Some(3));
    for setting in &suited {
        let measured = setting.name != "hardware latency";
        assert_eq!(setting.good, measured.then_some(true), "{setting:?}");
    }
    for (name, path, text, command) in [
        (
            "kernel",
            "proc/sys/kernel/version",
            "#1 SMP PREEMPT_DYNAMIC",
            "linux-image-rt",
        ),
        (
            "throttling",
            "proc/sys/kernel/sched_rt_runtime_us",
            "950000",
            "sched_rt_runtime_us=-1",
        ),
        (
            "real-time priority",
            "proc/self/status",
            "CapEff:\t0000000000004000",
            "setcap",
        ),
        (
            "locked memory",
            "proc/self/status",
            "CapEff:\t0000000000800000",
            "setcap",
        ),
        (
            "isolated processor",
            "sys/devices/system/cpu/isolated",
            "2",
            "isolcpus=3",
        ),
        (
            "interrupts",
            "proc/irq/24/effective_affinity_list",
            "2-3",
            "smp_affinity_list",
        ),
        (
            "frequency governor",
            "sys/devices/system/cpu/cpu3/cpufreq/scaling_governor",
            "powersave",
            "cpupower frequency-set",
        ),
        (
            "idle states",
            "sys/devices/system/cpu/cpu3/cpuidle/state1/latency",
            "133",
            "idle-set",
        ),
        (
            "hyper-threading",
            "sys/devices/system/cpu/smt/active",
            "1",
            "smt/control",
        ),
    ] {
        let mut files = SUITED.to_vec();
        files.retain(|(other, _)| *other != path);
        files.push((path, text));
        let faulty = machine(&files);
        let settings = settings_in(faulty.path(), Some(3));
        for (setting, suited) in settings.iter().zip(&suited) {
            if setting.name == name {
                assert_eq!(setting.good, Some(false), "{setting:?}");
                assert!(setting.change.contains(command), "{setting:?}");
            } else {
                assert_eq!(setting, suited, "{name}");
            }
        }
        let table = table(&settings);
        let row = table.lines().find(|row| row.starts_with(name));
        assert!(
            row.is_some_and(|row| row.contains("poor") && row.contains(command)),
            "{table}"
        );
    }
}

#[test]
fn limits_stand_for_capabilities() {
    let with = |limits: &str| {
        let files = [
            ("proc/self/status", "CapEff:\t0\n"),
            ("proc/self/limits", limits),
        ];
        settings_in(machine(&files).path(), None)
    };
    let settings =
        with("Max locked memory  unlimited unlimited bytes\nMax realtime priority 95 95\n");
    assert_eq!(by_name(&settings, "locked memory").good, Some(true));
    assert_eq!(by_name(&settings, "real-time priority").good, Some(true));
    let settings = with("Max locked memory  8388608 8388608 bytes\nMax realtime priority 10 10\n");
    assert_eq!(
        by_name(&settings, "locked memory").now,
        "permitted up to 8.4 MB"
    );
    assert_eq!(by_name(&settings, "locked memory").good, Some(false));
    assert_eq!(by_name(&settings, "real-time priority").good, Some(false));
}

/// Claim: where nothing can be read, nothing is judged.
#[test]
fn a_machine_that_tells_nothing_is_not_judged() {
    let empty = machine(&[]);
    for setting in settings_in(empty.path(), Some(0)) {
        assert_eq!(setting.good, None, "{setting:?}");
    }
}
