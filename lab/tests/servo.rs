//! `asperity-lab servo` and `asperity-lab jitter` as a user calls them. Nothing here depends on how
//! punctual the machine is.

use serde_json::Value;
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Without what only some machines grant.
const PLAIN: [&str; 5] = ["--policy", "other", "--no-lock", "--deep-idle", "--quiet"];

fn lab(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity-lab"));
    command.current_dir(folder).stdin(Stdio::null());
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    // Merging and comparing run no loop.
    let no_loop = ["merge", "compare", "overlay"].contains(&arguments[1]);
    let plain = if no_loop { &PLAIN[4..] } else { &PLAIN };
    let output = lab(folder).args(arguments).args(plain).output();
    output.expect("the command starts")
}

fn ok(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).expect("text")
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn a_session_on_the_stepped_device_is_recorded_tick_by_tick() {
    let folder = tempfile::tempdir().expect("a folder");
    let device = "sim:?time=stepped&seed=2";
    let told = ok(
        folder.path(),
        &[
            "servo",
            "--device",
            device,
            "--seconds",
            "1",
            "--record",
            "t.csv",
            "--json",
        ],
    );
    let told = json(&told);
    let ticks = told["ticks"].as_u64().expect("a number");
    let missed = told["missed"].as_u64().expect("a number");
    assert!(ticks + missed >= 1000, "{told}");
    assert_eq!(told["ended_without_force"], true);
    assert_eq!(told["read_faults"], 0);
    let rows = fs::read_to_string(folder.path().join("t.csv")).expect("a table");
    let lost = told["lost_records"].as_u64().expect("a number");
    assert_eq!(rows.lines().count() as u64 + lost, ticks + 1);
    let columns = rows.lines().map(|row| row.split(',').count());
    assert!(columns.clone().all(|count| count == 22));
}

#[test]
fn a_record_goes_to_standard_output_and_the_report_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = [
        "servo",
        "--device",
        "null:",
        "--seconds",
        "0.2",
        "--record",
        "-",
    ];
    let output = run(folder.path(), &arguments);
    assert!(output.status.success());
    assert!(output.stdout.starts_with(b"period,t_s,"));
    let report = String::from_utf8(output.stderr).expect("text");
    assert!(report.contains("the force is zero"), "{report}");
}

/// Waits until a loop runs: the record that it writes beside `t.csv` has rows.
#[cfg(unix)]
fn wait_for_rows(folder: &Path) {
    let began = Instant::now();
    let rows = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry.expect("an entry");
        let is_asset = entry.path().extension().is_some_and(|name| name == "asp");
        !is_asset && entry.metadata().is_ok_and(|metadata| metadata.len() > 1000)
    };
    while !fs::read_dir(folder).expect("a folder").any(rows) {
        assert!(began.elapsed() < Duration::from_secs(60), "it never began");
        sleep(Duration::from_millis(10));
    }
}

#[cfg(unix)]
fn interrupt(child: &Child) {
    let id = child.id().to_string();
    let killed = Command::new("kill").args(["-INT", &id]).status();
    assert!(killed.expect("kill").success());
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_loop_without_force_and_keeps_the_record() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = lab(folder.path());
    command.args(["servo", "--device", "sim:", "--record", "t.csv", "--json"]);
    let child = command.args(PLAIN).stdout(Stdio::piped()).spawn();
    let child = child.expect("the command starts");
    wait_for_rows(folder.path());
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success());
    let told = json(&String::from_utf8(output.stdout).expect("text"));
    assert_eq!(
        (&told["end"], &told["ended_without_force"]),
        (&"asked to".into(), &true.into())
    );
    assert!(folder.path().join("t.csv").is_file());
}

#[cfg(unix)]
#[test]
fn a_changed_file_is_felt_anew_and_a_broken_one_is_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let lower = |mu: f64| {
        let mut texture = asperity::sources::builtin::texture();
        texture.name = format!("grit of μ {mu}");
        texture.friction.mu = mu;
        asperity::emit::lower::lower(&texture, None)
            .expect("built in")
            .bytes
    };
    let file = folder.path().join("grit.asp");
    let replace = |bytes: &[u8]| {
        fs::write(folder.path().join("next"), bytes).expect("a file");
        fs::rename(folder.path().join("next"), &file).expect("renamed");
    };
    replace(&lower(0.5));
    let mut command = lab(folder.path());
    command.args([
        "servo", "grit.asp", "--device", "null:", "--watch", "--record", "t.csv", "--json",
    ]);
    let child = command
        .args(PLAIN)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = child.expect("the command starts");
    wait_for_rows(folder.path());
    let mut said = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let mut until = |words: &str| {
        let line = said.find(|line| line.as_ref().is_ok_and(|line| line.contains(words)));
        assert!(line.is_some(), "{words}");
    };
    replace(b"no texture");
    until("the previous version stays in use");
    replace(&lower(1.0));
    until("reloaded");
    interrupt(&child);
    let output = child.wait_with_output().expect("it ends");
    let told = json(&String::from_utf8(output.stdout).expect("text"));
    assert_eq!(told["ended_without_force"], true);
    assert_eq!(told["reloads"], 1);
    assert_eq!(told["texture"], "grit of μ 1", "the texture that plays");
}

#[test]
fn a_run_is_written_merged_and_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let told = ok(
        folder.path(),
        &[
            "jitter",
            "--seconds",
            "2",
            "--out",
            "a",
            "--inject",
            "compute:300:100",
            "--json",
        ],
    );
    let told = json(&told);
    let ticks = told["ticks"].as_u64().expect("a number");
    assert!(ticks > 100 && told["missed"].is_u64());
    assert_eq!(told["period_ns"], 1_000_000);
    for stage in ["wakeup_ns", "compute_ns", "read_ns", "write_ns", "total_ns"] {
        for key in ["p50", "p99", "p99_9", "max"] {
            assert!(told[stage][key].is_u64(), "{stage} {key}");
        }
    }
    // However late the machine is, one tick in a hundred computes for 300 µs or more.
    assert!(told["compute_ns"]["max"].as_u64() >= Some(300_000));
    assert_eq!(told["conditions"]["injected"], "compute:300:100");
    assert_eq!(told["worst"].as_array().map(Vec::len), Some(10));
    let settings = told["settings"].as_array().expect("an array");
    let throttling = settings
        .iter()
        .find(|setting| setting["name"] == "throttling");
    assert_eq!(throttling.is_some(), cfg!(target_os = "linux"));
    assert!(settings.iter().all(|setting| setting["change"].is_string()));
    for name in [
        "run.json",
        "percentiles.csv",
        "run.hlog",
        "wakeup.hgrm",
        "compute-corrected.hgrm",
    ] {
        assert!(at("a").join(name).is_file(), "{name}");
    }
    assert!(
        fs::read(at("a/jitter.png"))
            .expect("a picture")
            .starts_with(b"\x89PNG")
    );
    ok(folder.path(), &["jitter", "--seconds", "1", "-o", "b"]);
    ok(
        folder.path(),
        &["jitter", "merge", "a", "b/run.hlog", "-o", "both.hlog"],
    );
    let shifts = ok(
        folder.path(),
        &["jitter", "compare", "a", "both.hlog", "--json"],
    );
    let shifts = json(&shifts);
    let median = shifts["shifts"].as_array().expect("an array").iter();
    let median = median.filter(|shift| shift["stage"] == "compute" && shift["percentile"] == "50");
    assert_eq!(median.count(), 1);
}

/// Claim: limits decide about the exit status and about nothing else, a series has a line for each
/// tick, and a run is not replaced unawares.
#[test]
fn a_run_beyond_its_limits_exits_with_1_and_is_written_all_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let series = [
        "jitter",
        "--seconds",
        "1",
        "--series",
        "ticks.csv",
        "--out",
        "a",
    ];
    let told = ok(
        folder.path(),
        &[&series[..], &["--max-us", "60000000", "--json"]].concat(),
    );
    let told = json(&told);
    let rows = fs::read_to_string(at("ticks.csv")).expect("a series");
    assert_eq!(
        Some(rows.lines().count() as u64 - 1),
        told["ticks"].as_u64()
    );
    assert!(rows.starts_with("period,t_s,missed,wakeup_ns,"));
    assert_eq!(told["verdict"]["exceeded"], serde_json::json!([]));

    let run_at = fs::read(at("a/run.json")).expect("a run");
    let again = run(folder.path(), &["jitter", "--seconds", "1", "--out", "a"]);
    let errors = String::from_utf8_lossy(&again.stderr).into_owned();
    assert_eq!(again.status.code(), Some(1));
    assert!(
        errors.contains("holds a run") && errors.contains("--force"),
        "{errors}"
    );
    assert_eq!(fs::read(at("a/run.json")).expect("a run"), run_at);

    // A tick in ten computes for 3 ms: periods are missed, and forces come late.
    let late = [
        "jitter",
        "--seconds",
        "1",
        "--inject",
        "compute:3000:10",
        "--json",
    ];
    for (limit, words) in [
        (&["--max-us", "2000"][..], "--max-us 2000"),
        (&["--max-missed", "0"], "--max-missed 0"),
    ] {
        let folders = ["--out", "a", "--force"];
        let output = run(folder.path(), &[&late[..], limit, &folders].concat());
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(errors.contains(words), "{errors}");
        let told = json(&String::from_utf8(output.stdout).expect("text"));
        assert_eq!(told["verdict"]["punctuality"], "missed");
        let written = fs::read_to_string(at("a/run.json")).expect("a run");
        assert_eq!(json(&written), told);
    }
}

/// Claim: any number of runs, of ours and of other tools, are drawn over each other and tabled.
#[test]
fn runs_are_laid_over_each_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    ok(
        folder.path(),
        &[
            "jitter",
            "--seconds",
            "1",
            "--out",
            "a",
            "--series",
            "b.csv",
        ],
    );
    fs::write(
        at("c.json"),
        r#"{"thread": {"0": {"cycles": 3, "max": 40, "histogram": {"12": 2, "40": 1}}}}"#,
    )
    .expect("a file");
    let all = ["a/run.hlog", "a/wakeup.hgrm", "b.csv", "c.json"];
    let told = ok(
        folder.path(),
        &[
            &["jitter", "overlay"],
            &all[..],
            &["-o", "over.png", "--json"],
        ]
        .concat(),
    );
    let told = json(&told);
    let runs = told["runs"].as_array().expect("an array");
    let names: Vec<_> = runs.iter().filter_map(|run| run["name"].as_str()).collect();
    assert_eq!(names, all);
    // The first three are one run.
    let median = |index: usize| runs[index]["percentiles_ns"]["p50"].as_f64().expect("ns");
    assert!((1..3).all(|index| (median(index) / median(0) - 1.0).abs() < 0.05));
    assert_eq!(runs[3]["percentiles_ns"]["count"], 3);
    assert!(
        fs::read(at("over.png"))
            .expect("a picture")
            .starts_with(b"\x89PNG")
    );
    let shifts = ok(
        folder.path(),
        &["jitter", "compare", "a/run.hlog", "c.json", "--json"],
    );
    assert!(
        json(&shifts)["shifts"]
            .as_array()
            .is_some_and(|all| !all.is_empty())
    );
    let output = run(
        folder.path(),
        &[
            "jitter", "overlay", "c.json", "-o", "d.png", "--stage", "read", "--column", "x",
        ],
    );
    assert!(
        output.status.success(),
        "a file of another tool is of the stage that is stated"
    );
    let output = run(
        folder.path(),
        &["jitter", "overlay", "a/percentiles.csv", "-o", "d.png"],
    );
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code() == Some(1) && errors.contains("percentiles"),
        "{errors}"
    );
}

/// Claim: a disk that is full costs the files, not the measurement.
#[cfg(unix)]
#[test]
fn a_run_is_printed_though_its_files_cannot_be_written() {
    let folder = tempfile::tempdir().expect("a folder");
    // Files of at most 2 KiB: the largest of a run and of a series do not fit.
    let script =
        "ulimit -f 4; exec \"$0\" jitter --seconds 1 --policy other --no-lock --deep-idle \"$@\"";
    let limited = |arguments: &[&str]| {
        let mut command = Command::new("sh");
        command.args(["-c", script, env!("CARGO_BIN_EXE_asperity-lab")]);
        command.args(arguments).current_dir(folder.path());
        command.output().expect("sh runs")
    };
    for outputs in [
        &["-o", "a"][..],
        &["--series", "b.csv"],
        &["-o", "a", "--series", "b.csv"],
    ] {
        let arguments = [outputs, &["--json", "--max-us", "0.001"]].concat();
        let output = limited(&arguments);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{errors}");
        let told = json(&String::from_utf8(output.stdout).expect("text"));
        assert!(told["ticks"].as_u64() > Some(0), "{told}");
        for name in outputs.iter().skip(1).step_by(2) {
            assert!(errors.contains(name), "{name}: {errors}");
        }
        assert!(errors.contains("--max-us"), "{errors}");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
    }
    // --quiet silences a result that is in the files, and not one that is nowhere else.
    let output = limited(&["-o", "a", "--quiet"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.code() == Some(1) && said.contains("worst ticks"),
        "{said}"
    );
}

#[test]
fn what_cannot_be_is_refused_before_anything_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("x.hlog"), "no log\n").expect("a file");
    for (arguments, status, words) in [
        (&["servo", "--device", "phantom:"][..], 2, "phantom:"),
        (&["servo", "--device", "null:?deep=1"], 2, "z_mm"),
        (
            &["servo", "--device", "sim:?time=fast"],
            2,
            "real or stepped",
        ),
        (
            &["servo", "--device", "null:", "--rate", "1500"],
            2,
            "--rate 1000",
        ),
        (&["servo", "none.asp", "--device", "null:"], 1, "none.asp"),
        (&["servo", "--device", "null:", "--look"], 2, "--look"),
        (&["jitter", "--inject", "read:1:1"], 2, "read:1:1"),
        (&["jitter", "--out", "no/such/folder"], 1, "no/such/folder"),
        (&["jitter", "--max-us=-1"], 2, "above 0"),
        (&["jitter", "--force"], 2, "--output"),
        (&["jitter", "compare", "x.hlog", "x.hlog"], 1, "x.hlog"),
    ] {
        let output = run(folder.path(), arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            output.status.code(),
            Some(status),
            "{arguments:?}: {errors}"
        );
        assert!(errors.contains(words), "{arguments:?}: {errors}");
    }
}
