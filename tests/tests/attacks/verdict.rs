//! Postconditions of a command, and the tally of all outcomes.

use super::{case::Attack, run::Run};
use std::{
    collections::BTreeMap,
    fmt, fs,
    os::unix::process::ExitStatusExt as _,
    path::{Path, PathBuf},
    time::Duration,
};

/// Resident memory of a command.
const MAX_RSS_BYTES: u64 = 512 << 20;
/// Characters of a message that a failure shows.
const SHOWN: usize = 600;

/// Every file of a folder with its bytes, and everything else by its kind.
#[derive(PartialEq)]
pub(crate) struct Snapshot(BTreeMap<PathBuf, Vec<u8>>);

impl Snapshot {
    pub(crate) fn of(folder: &Path) -> Self {
        let mut all = BTreeMap::new();
        Self::walk(folder, &mut all);
        Self(all)
    }

    fn walk(folder: &Path, all: &mut BTreeMap<PathBuf, Vec<u8>>) {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let Ok(metadata) = fs::symlink_metadata(&path) else {
                continue;
            };
            if metadata.is_dir() {
                all.insert(path.clone(), b"folder".to_vec());
                Self::walk(&path, all);
            } else if metadata.is_file() && metadata.len() < 1 << 30 {
                all.insert(path.clone(), fs::read(&path).unwrap_or_default());
            } else {
                let told = format!("{:?} {}", metadata.file_type(), metadata.len());
                all.insert(path, told.into_bytes());
            }
        }
    }
}

/// Outcome of a case.
pub(crate) struct Verdict {
    command: &'static str,
    accepted: bool,
    cpu: Duration,
    rss_bytes: u64,
    number: usize,
    /// The violated postconditions.
    pub(crate) failure: Option<String>,
}

/// Judges a run.
pub(crate) fn judge(
    number: usize,
    attack: &Attack,
    run: &Run,
    before: &Snapshot,
    folder: &Path,
    max_cpu: Duration,
) -> Verdict {
    let mut faults = Vec::new();
    let code = run.status.code();
    if run.was_killed {
        faults.push(format!("did not end in {:.0?}", run.wall));
    } else if !matches!(code, Some(0..=2)) {
        faults.push(match run.status.signal() {
            Some(signal) => format!("ended by signal {signal}"),
            None => format!("exit status {code:?}"),
        });
    }
    for word in [
        "panicked at",
        "has overflowed its stack",
        "memory allocation of",
    ] {
        if run.stderr.contains(word) {
            faults.push(format!("says {word:?}"));
        }
    }
    if run.cpu > max_cpu {
        faults.push(format!("took {:.1?} of processor time", run.cpu));
    }
    if run.max_rss_bytes > MAX_RSS_BYTES {
        faults.push(format!("took {} MiB", run.max_rss_bytes >> 20));
    }
    let after = Snapshot::of(folder);
    // A build may mend and add to its cache; what it has not finished is found all the same.
    let is_cached = |path: &Path| {
        let name = path.file_name().map(|name| name.to_string_lossy());
        path.starts_with(folder.join("cache")) && name.is_some_and(|name| !name.starts_with('.'))
    };
    for (path, bytes) in &before.0 {
        if after.0.get(path) != Some(bytes) && !is_cached(path) {
            faults.push(format!("changed {}", path.display()));
        }
    }
    let made: Vec<&PathBuf> = after
        .0
        .keys()
        .filter(|path| !before.0.contains_key(*path) && !is_cached(path))
        .collect();
    // Of what lies in an output folder, the programs choose the names; a hidden one is a file in the making.
    let is_output = |path: &Path| {
        let name = path.strip_prefix(folder).unwrap_or(path);
        let last = name.file_name().map(|name| name.to_string_lossy());
        let is_whole = last.is_some_and(|name| !name.starts_with('.'));
        is_whole && attack.outputs.iter().any(|output| name.starts_with(output))
    };
    if code != Some(0) && !made.is_empty() {
        faults.push(format!("failed and left {made:?}"));
    } else if let Some(other) = made.iter().find(|path| !is_output(path)) {
        faults.push(format!("left {}", other.display()));
    }
    // Of these a status of 1 is an answer, which is printed.
    let answers = ["diff ", "device faults "];
    let is_answer = code == Some(1) && answers.iter().any(|line| attack.command.starts_with(line));
    if code != Some(0) && !is_answer && !run.stderr.starts_with("error: ") {
        faults.push("fails without saying why".to_owned());
    }
    let failure = (!faults.is_empty()).then(|| {
        let start: String = run.stderr.chars().take(SHOWN).collect();
        format!(
            "case {number}: {attack}\n  {}\n  status {:?}, {:.2?} processor time, {} MiB\n  {start}\n  {}",
            faults.join("; "),
            code,
            run.cpu,
            run.max_rss_bytes >> 20,
            folder.display()
        )
    });
    Verdict {
        command: attack.command,
        accepted: code == Some(0),
        cpu: run.cpu,
        rss_bytes: run.max_rss_bytes,
        number,
        failure,
    }
}

/// All verdicts together.
#[derive(Default)]
pub(crate) struct Tally {
    pub(crate) failures: Vec<String>,
    pub(crate) refused: usize,
    pub(crate) accepted: usize,
    commands: BTreeMap<&'static str, [usize; 2]>,
    slowest: (Duration, usize),
    largest: (u64, usize),
}

impl Tally {
    pub(crate) fn add(&mut self, verdict: Verdict) {
        let count = self.commands.entry(verdict.command).or_default();
        if verdict.accepted {
            self.accepted += 1;
            count[0] += 1;
        } else {
            self.refused += 1;
            count[1] += 1;
        }
        self.slowest = self.slowest.max((verdict.cpu, verdict.number));
        self.largest = self.largest.max((verdict.rss_bytes, verdict.number));
        self.failures.extend(verdict.failure);
    }

    pub(crate) fn merge(&mut self, other: Self) {
        self.failures.extend(other.failures);
        self.refused += other.refused;
        self.accepted += other.accepted;
        self.slowest = self.slowest.max(other.slowest);
        self.largest = self.largest.max(other.largest);
        for (command, [accepted, refused]) in other.commands {
            let count = self.commands.entry(command).or_default();
            count[0] += accepted;
            count[1] += refused;
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (command, [accepted, refused]) in &self.commands {
            writeln!(f, "{accepted:>5} accepted {refused:>5} refused  {command}")?;
        }
        write!(
            f,
            "{} accepted, {} refused, {} failed; at most {:.2?} of processor time (case {}), {} MiB \
             (case {})",
            self.accepted,
            self.refused,
            self.failures.len(),
            self.slowest.0,
            self.slowest.1,
            self.largest.0 >> 20,
            self.largest.1
        )
    }
}
