//! The C library, and commands that build with it. A `cc` that takes our flags is Unix's.
#![cfg(unix)]

use std::{
    path::{Path, PathBuf},
    process::{Command, Output},
    sync::OnceLock,
};

/// The folder of the workspace.
pub(crate) fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().expect("the workspace")
}

/// Runs a command, which must succeed, and returns its output.
pub(crate) fn succeeded(command: &mut Command) -> Output {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}; a C compiler is a prerequisite"));
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

/// The static C library in release, built once, where Cargo builds: what the commands needed is not built again.
pub(crate) fn library() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| {
        let target = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let target = target.parent().expect("the target folder");
        succeeded(
            Command::new(env!("CARGO"))
                .current_dir(root())
                .args(["build", "--quiet", "--release", "--package", "asperity-c"])
                .arg("--target-dir")
                .arg(target),
        );
        target.join("release/libasperity_c.a")
    })
}
