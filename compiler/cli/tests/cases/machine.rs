//! Limits of the machine, and browsers that reach it from elsewhere.

use super::{Case, Check};
use std::process::Command;

pub(super) const CHECKS: &[(&str, Check)] =
    &[("thread-limit-panic", few_threads_bring_no_command_down)];

fn few_threads_bring_no_command_down(case: &Case) {
    let limited = "su nobody -s /bin/bash -c 'ulimit -u 20'";
    let can = Command::new("bash").args(["-c", limited]).output();
    if !can.is_ok_and(|output| output.status.success()) {
        println!(
            "thread-limit-panic: skipped: limits of processes cannot be set here (needs root, su, user nobody)"
        );
        return;
    }
    let output = Command::new("bash")
        .arg(case.file("run.sh"))
        .arg(env!("CARGO_BIN_EXE_asperity"))
        .output()
        .expect("bash runs");
    let said = String::from_utf8_lossy(&output.stdout);
    let text = format!("{said}{}", String::from_utf8_lossy(&output.stderr));
    let statuses: Vec<&str> = said
        .lines()
        .filter_map(|line| line.strip_prefix("rc "))
        .collect();
    assert_eq!(statuses.len(), 2, "{text}");
    assert!(
        statuses.iter().all(|status| ["0", "1"].contains(status)),
        "{text}"
    );
    assert!(!text.contains("panicked"), "{text}");
}
