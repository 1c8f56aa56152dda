//! The two programs, built in the profile of the test.

use std::{
    path::{Path, PathBuf},
    process::Command,
    time::SystemTime,
};

/// Which program a command belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Program {
    /// `asperity`.
    Compiler,
    /// `asperity-lab`.
    Lab,
}

/// Where the programs lie.
pub(crate) struct Programs {
    folder: PathBuf,
}

impl Programs {
    pub(crate) fn path(&self, program: Program) -> PathBuf {
        self.folder.join(match program {
            Program::Compiler => "asperity",
            Program::Lab => "asperity-lab",
        })
    }
}

/// Those of the folder that `ASPERITY_PROGRAMS` names, or both in the profile of the test. `cargo test` of the
/// workspace has built them; Cargo would build them again, because a build without tests asks for other features.
pub(crate) fn built() -> Programs {
    if let Some(folder) = std::env::var_os("ASPERITY_PROGRAMS") {
        return Programs {
            folder: folder.into(),
        };
    }
    // target/PROFILE/deps/it-…
    let test = std::env::current_exe().expect("the test's own path");
    let folder = test.parent().and_then(Path::parent).expect("a profile");
    let programs = Programs {
        folder: folder.to_owned(),
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the workspace");
    let both = [Program::Compiler, Program::Lab];
    if both
        .iter()
        .all(|program| is_fresh(&programs.path(*program), root))
    {
        return programs;
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
    programs
}

/// Whether a program is newer than everything that it may be built from.
fn is_fresh(program: &Path, root: &Path) -> bool {
    let Ok(built) = program.metadata().and_then(|file| file.modified()) else {
        return false;
    };
    let sources = [
        "Cargo.toml",
        "Cargo.lock",
        "formats",
        "runtime",
        "compiler",
        "device-sim",
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
