//! The two programs, built in the profile of the test.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, SystemTime},
};
use wait4::Wait4 as _;

/// Processor time of a command on a machine of today. A build with assertions takes several times as long.
const MAX_CPU: Duration = Duration::from_secs(if cfg!(debug_assertions) { 12 } else { 2 });
/// The same on a slower machine, in times that a plain prompt takes there.
const MAX_PROMPTS: u32 = 50;

/// Which program a command belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Program {
    /// `asperity`.
    Compiler,
    /// `asperity-lab`.
    Lab,
}

impl Program {
    fn within(self, folder: &Path) -> PathBuf {
        folder.join(match self {
            Self::Compiler => "asperity",
            Self::Lab => "asperity-lab",
        })
    }
}

/// Where the programs lie.
pub(crate) struct Programs {
    folder: PathBuf,
    /// Processor time that a command may take here.
    pub(crate) max_cpu: Duration,
}

impl Programs {
    fn of(folder: PathBuf) -> Self {
        let mut programs = Self {
            folder,
            max_cpu: MAX_CPU,
        };
        let of_a_prompt = (0..3).map(|_| programs.of_a_prompt()).min();
        programs.max_cpu = MAX_CPU.max(MAX_PROMPTS * of_a_prompt.unwrap_or_default());
        programs
    }

    /// Processor time that a prompt takes.
    fn of_a_prompt(&self) -> Duration {
        let mut child = Command::new(self.path(Program::Compiler))
            .args([
                "compile",
                "cork",
                "--json",
                "--no-preview",
                "-o",
                "/dev/null",
            ])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let usage = child.wait4().expect("the child ends");
        assert!(usage.status.success(), "a plain prompt is compiled");
        usage.rusage.utime + usage.rusage.stime
    }

    pub(crate) fn path(&self, program: Program) -> PathBuf {
        program.within(&self.folder)
    }
}

/// Those of the folder that `ASPERITY_PROGRAMS` names, or both in the profile of the test. `cargo test` of the
/// workspace has built them; Cargo would build them again, because a build without tests asks for other features.
pub(crate) fn built() -> Programs {
    if let Some(folder) = std::env::var_os("ASPERITY_PROGRAMS") {
        return Programs::of(folder.into());
    }
    // target/PROFILE/deps/it-…
    let test = std::env::current_exe().expect("the test's own path");
    let folder = test.parent().and_then(Path::parent).expect("a profile");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the workspace");
    let both = [Program::Compiler, Program::Lab];
    if both
        .iter()
        .all(|program| is_fresh(&program.within(folder), root))
    {
        return Programs::of(folder.to_owned());
    }
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .current_dir(root)
        .args(["build", "--quiet", "--bin", "asperity"])
        .args(["--bin", "asperity-lab", "--target-dir"])
        .arg(folder.parent().expect("the target folder"));
    if folder.ends_with("release") {
        cargo.arg("--release");
    }
    let status = cargo.status().expect("cargo runs");
    assert!(status.success(), "{cargo:?}: {status}");
    Programs::of(folder.to_owned())
}

/// Returns true if a program is newer than everything that it may be built from.
fn is_fresh(program: &Path, root: &Path) -> bool {
    let Ok(built) = program.metadata().and_then(|file| file.modified()) else {
        return false;
    };
    let sources = [
        "Cargo.toml",
        "Cargo.lock",
        "formats",
        "runtime",
        "host",
        "compiler",
        "studio",
        "cli",
        "device-sim",
        "lab",
        "training",
    ];
    sources
        .iter()
        .all(|source| newest(&root.join(source)).is_some_and(|changed| changed < built))
}

/// When a file, or the newest one in a folder, was changed. What other workspaces build, and tests, are left out.
fn newest(path: &Path) -> Option<SystemTime> {
    let metadata = path.symlink_metadata().ok()?;
    if !metadata.is_dir() {
        return metadata.modified().ok();
    }
    std::fs::read_dir(path)
        .ok()?
        .flatten()
        .filter(|entry| {
            !["target", "tests", "python", "train"]
                .iter()
                .any(|name| entry.file_name() == *name)
        })
        .filter_map(|entry| newest(&entry.path()))
        .max()
}
