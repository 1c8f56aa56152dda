//! The two programs, built in the profile of the test.

use std::{
    path::{Path, PathBuf},
    process::Command,
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
    if [Program::Compiler, Program::Lab]
        .iter()
        .all(|program| is_fresh(&programs.path(*program)))
    {
        return programs;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the workspace");
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

/// Whether a program is at least as new as each of its sources, which Cargo lists beside it: `PROGRAM: FILE FILE …`.
fn is_fresh(program: &Path) -> bool {
    let changed = |path: &Path| path.metadata().and_then(|file| file.modified()).ok();
    let Ok(listed) = std::fs::read_to_string(program.with_extension("d")) else {
        return false;
    };
    let Some((_, sources)) = listed.split_once(": ") else {
        return false;
    };
    // A blank within a path is written `\ `: such a path is not found, and the program is built again.
    let built = changed(program);
    built.is_some()
        && sources
            .split_whitespace()
            .all(|source| changed(Path::new(source)).is_some_and(|at| Some(at) <= built))
}
