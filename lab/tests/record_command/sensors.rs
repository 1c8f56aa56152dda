//! Sensors on serial ports and in WAV files: what damages a recording, and what ends it.

use super::*;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::process::Child;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

/// The board's end of a line, and the name of the other one.
fn pty() -> (File, String) {
    let board = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a pseudo-terminal");
    // The commands of other tests do not hold the port.
    rustix::io::fcntl_setfd(&board, rustix::io::FdFlags::CLOEXEC).expect("flags");
    grantpt(&board).expect("it is granted");
    unlockpt(&board).expect("it is unlocked");
    let name = ptsname(&board, Vec::new()).expect("a name");
    // What nobody reads does not keep the board waiting.
    let flags = rustix::fs::fcntl_getfl(&board).expect("flags") | rustix::fs::OFlags::NONBLOCK;
    rustix::fs::fcntl_setfl(&board, flags).expect("flags");
    (File::from(board), name.into_string().expect("text"))
}

/// Lines of a board with a clock, three axes and a force, from a number on.
fn lines(from: u64, count: u64) -> String {
    let line = |n: u64| {
        let a = libm::sin(0.3 * n as f64);
        format!(
            "{},{a:.4},{:.4},1.0,{:.3}\r\n",
            1_000_000 + 500 * n,
            -a,
            0.01 * a
        )
    };
    let header = if from.is_multiple_of(1000) {
        "#t_us,ax_g,ay_g,az_g,fz_N\r\n"
    } else {
        ""
    };
    header.to_owned() + &(from..from + count).map(line).collect::<String>()
}

/// Sends 2000 lines a second until told to stop.
fn board(mut to: File, until: Arc<AtomicBool>) -> thread::JoinHandle<File> {
    thread::spawn(move || {
        let mut sent = 0;
        let began = Instant::now();
        while !until.load(Relaxed) && began.elapsed() < Duration::from_secs(60) {
            let due = began.elapsed().as_millis() as u64 * 2;
            while sent < due {
                // A port that is not read loses lines.
                let _ = to.write_all(lines(sent, 20).as_bytes());
                sent += 20;
            }
            sleep(Duration::from_millis(5));
        }
        to
    })
}

fn wait(child: Child) -> Output {
    child.wait_with_output().expect("it ends")
}

fn spawn(folder: &Path, accel: &str, more: &[&str]) -> Child {
    let arguments = [
        &["oak", "--device", "null:", "--accel", accel, "--json"],
        more,
    ]
    .concat();
    let mut command = command(folder, &arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the command starts")
}

/// A recording whose board is unplugged after a time.
fn unplugged(folder: &Path, after: Duration) -> Output {
    let (end, name) = pty();
    let until = Arc::new(AtomicBool::new(false));
    let board = board(end, Arc::clone(&until));
    let child = spawn(folder, &format!("serial:{name}?baud=230400&g=16"), &[]);
    sleep(after);
    until.store(true, Relaxed);
    drop(board.join().expect("the board"));
    wait(child)
}

#[test]
fn a_serial_port_is_read_and_one_that_is_unplugged_keeps_what_it_sent() {
    let folder = tempfile::tempdir().expect("a folder");
    let (end, name) = pty();
    let until = Arc::new(AtomicBool::new(false));
    let board = board(end, Arc::clone(&until));
    let accel = format!("serial:{name}?baud=230400&g=16");
    let output = wait(spawn(folder.path(), &accel, &["--seconds", "3"]));
    assert!(output.status.success(), "{}", errors(&output));
    let said = told(&output);
    assert_eq!(said["end"], "time is over");
    let rate_hz = said["sensor_rate_hz"].as_f64().expect("a number");
    assert!((rate_hz - 2000.0).abs() < 2.0, "{rate_hz} Hz");
    let recording = kept(&folder.path().join("oak"));
    let labels: Vec<&str> = recording
        .channels
        .iter()
        .map(|c| c.label.as_str())
        .collect();
    assert_eq!(
        labels[3..],
        [
            "acceleration x",
            "acceleration y",
            "acceleration z",
            "force z"
        ]
    );

    until.store(true, Relaxed);
    drop(board.join().expect("the board"));
    fs::rename(folder.path().join("oak"), folder.path().join("first")).expect("it is renamed");
    // On a busy machine the command takes seconds to begin.
    let after = [4, 16].map(Duration::from_secs);
    let output = unplugged(folder.path(), after[0]);
    let output = match errors(&output).contains("overlap for less than one second") {
        true => unplugged(folder.path(), after[1]),
        false => output,
    };
    assert_eq!(output.status.code(), Some(1));
    let error = errors(&output);
    assert!(error.contains("was the sensor unplugged?"), "{error}");
    assert_eq!(told(&output)["end"], "device or sensor has gone");
    kept(&folder.path().join("oak"));
}

#[test]
fn a_port_that_sends_no_samples_is_told_and_leaves_nothing() {
    let ports = [
        ("\u{1b}[31mhello\r\n", "", "its header did not come"),
        ("1,2\r\n", "?columns=ax", "are not samples"),
        (
            "nan,nan,nan,nan\r\n",
            "?columns=ax,ay,az,fz",
            "only missing values",
        ),
        ("", "", "no sample came"),
        ("#t_us,ax_gee\r\n", "", "`gee`"),
        (
            "0.1,0.2,1.0\r\n",
            "?columns=ax,ay,az",
            "nothing measures the force",
        ),
        ("0.1,0.2\r\n", "?columns=ax,fx", "not the one along z"),
    ];
    // Each command waits for its port.
    thread::scope(|scope| {
        for (sent, columns, part) in ports {
            scope.spawn(move || a_port_that_sends(sent, columns, part));
        }
    });
}

/// Records from a port that sends a line again and again; the command must fail with a part of its message.
fn a_port_that_sends(sent: &str, columns: &str, part: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut end, name) = pty();
    let child = spawn(folder.path(), &format!("serial:{name}{columns}"), &[]);
    let until = AtomicBool::new(false);
    let output = thread::scope(|scope| {
        scope.spawn(|| {
            while !until.load(Relaxed) {
                // The other end may not be open yet, or no more.
                let _ = end.write_all(sent.repeat(10).as_bytes());
                sleep(Duration::from_millis(10));
            }
        });
        let output = wait(child);
        until.store(true, Relaxed);
        output
    });
    let error = errors(&output);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(
        error.contains(part) && error.contains("help:"),
        "{part} in {error}"
    );
    assert!(!error.contains('\u{1b}'));
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0);
}

#[test]
fn a_port_that_is_none_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.txt"), "1,2,3\n").expect("a file");
    let with = |accel| ["oak", "--device", "null:", "--accel", accel];
    refused(folder.path(), &with("serial:none"), 1, "cannot open it");
    refused(folder.path(), &with("serial:a.txt"), 1, "cannot open it");
    refused(
        folder.path(),
        &with("serial:/dev/null"),
        1,
        "the data ended",
    );
    refused(
        folder.path(),
        &with("serial:/dev/zero"),
        1,
        "a line has more than",
    );
}

/// Appends 16-bit frames of two channels, 4000 a second, after a header.
fn arecord(path: &Path, until: &AtomicBool) {
    let mut header = b"RIFF\x24\0\0\x80WAVEfmt \x10\0\0\0\x01\0\x02\0".to_vec();
    header.extend(4000_u32.to_le_bytes());
    header.extend(16_000_u32.to_le_bytes());
    header.extend(b"\x04\0\x10\0data\0\0\0\x80");
    let mut file = OpenOptions::new()
        .append(true)
        .create_new(true)
        .open(path)
        .expect("a file");
    for part in header.chunks(7) {
        file.write_all(part).expect("the header");
    }
    let (began, mut frames) = (Instant::now(), 0_u64);
    while !until.load(Relaxed) && began.elapsed() < Duration::from_secs(60) {
        let due = began.elapsed().as_millis() as u64 * 4;
        let frame = |n: u64| [((n % 7) as i16 * 100).to_le_bytes(), [0, 0x20]].concat();
        let bytes: Vec<u8> = (frames..due).flat_map(frame).collect();
        file.write_all(&bytes).expect("it grows");
        frames = frames.max(due);
        sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_growing_wav_is_followed_and_what_came_before_it_was_shortened_is_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.wav");
    let until = Arc::new(AtomicBool::new(false));
    let (to, done) = (path.clone(), Arc::clone(&until));
    let accel = "wav:a.wav?columns=az,fz&g=16&n=20";
    // It waits for the file.
    let child = spawn(folder.path(), accel, &[]);
    sleep(Duration::from_millis(300));
    let writer = thread::spawn(move || arecord(&to, &done));
    sleep(Duration::from_secs(3));
    let file = OpenOptions::new()
        .write(true)
        .open(&path)
        .expect("the file");
    file.set_len(100).expect("it is shortened");
    let output = wait(child);
    until.store(true, Relaxed);
    writer.join().expect("the writer");
    assert_eq!(output.status.code(), Some(1));
    assert!(
        errors(&output).contains("it was shortened"),
        "{}",
        errors(&output)
    );
    let recording = kept(&folder.path().join("oak"));
    let force = recording.channels.last().expect("the force");
    assert_eq!((force.label.as_str(), force.samples[100]), ("force z", 5.0));
}

fn interrupt(child: &Child) {
    let id = child.id().to_string();
    let killed = Command::new("kill").args(["-INT", &id]).status();
    assert!(killed.expect("kill").success());
}

#[test]
fn an_interrupt_keeps_what_was_recorded_or_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (end, name) = pty();
    let until = Arc::new(AtomicBool::new(false));
    let board = board(end, Arc::clone(&until));
    let child = spawn(folder.path(), &format!("serial:{name}"), &[]);
    sleep(Duration::from_secs(4));
    interrupt(&child);
    let output = wait(child);
    assert!(output.status.success(), "{}", errors(&output));
    assert_eq!(told(&output)["end"], "asked to");
    kept(&folder.path().join("oak"));
    until.store(true, Relaxed);
    drop(board.join().expect("the board"));

    // Before the sensor sent anything.
    let (silent, name) = pty();
    fs::remove_dir_all(folder.path().join("oak")).expect("it is removed");
    let child = spawn(folder.path(), &format!("serial:{name}"), &[]);
    while !folder.path().join("oak").exists() {
        sleep(Duration::from_millis(2));
    }
    sleep(Duration::from_millis(100));
    interrupt(&child);
    let output = wait(child);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        errors(&output).contains("nothing was kept"),
        "{}",
        errors(&output)
    );
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0);
    drop(silent);
}

#[test]
fn a_full_disk_is_told_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    // A file may have 50 KiB, and going beyond is an error instead of a signal.
    let limited = "ulimit -f 100; trap '' XFSZ; exec \"$0\" \"$@\"";
    let mut command = Command::new("sh");
    command.current_dir(folder.path()).args(["-c", limited]);
    command.arg(env!("CARGO_BIN_EXE_asperity-lab"));
    let arguments = [
        "record",
        "oak",
        "--device",
        "sim:",
        "--accel",
        "sim:",
        "--seconds",
        "3",
    ];
    let output = command
        .args(arguments)
        .args(PLAIN)
        .output()
        .expect("sh runs");
    assert_eq!(output.status.code(), Some(1));
    let error = errors(&output);
    assert!(
        error.contains("oak") && error.contains("the recording was not kept"),
        "{error}"
    );
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0);
}
