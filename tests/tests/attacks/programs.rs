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

/// Those of the folder that `ASPERITY_PROGRAMS` names, or both built, as `.ci/run` does, so that nothing is
/// built twice.
pub(crate) fn built() -> Programs {
    if let Some(folder) = std::env::var_os("ASPERITY_PROGRAMS") {
        return Programs {
            folder: folder.into(),
        };
    }
    // target/PROFILE/deps/attacks-…
    let test = std::env::current_exe().expect("the test's own path");
    let folder = test.parent().and_then(Path::parent).expect("a profile");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the workspace");
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .current_dir(root)
        .args(["build", "--quiet", "--workspace"])
        .args(["--bin", "asperity", "--bin", "asperity-lab", "--target-dir"])
        .arg(folder.parent().expect("the target folder"));
    if folder.ends_with("release") {
        cargo.arg("--release");
    }
    let status = cargo.status().expect("cargo runs");
    assert!(status.success(), "{cargo:?}: {status}");
    Programs {
        folder: folder.to_owned(),
    }
}
