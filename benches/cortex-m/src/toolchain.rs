//! Cargo for a target: with its standard library where that is installed, else with core
//! built from the sources that a distribution ships.

use crate::{
    package::{Result, home, stdout, target_dir},
    target::Target,
};
use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// Debian's compiler, whose package of sources core can be built from.
const DISTRIBUTION_RUSTC: &str = "/usr/bin/rustc";

/// Cargo's toolchain and target.
#[derive(Debug)]
pub(crate) struct Toolchain {
    /// The linker for core built from source; `None` with an installed target.
    build_core_with: Option<PathBuf>,
    triple: &'static str,
}

impl Toolchain {
    /// Looks for what is installed.
    pub(crate) fn find(target: &Target, build_core: bool) -> Result<Self> {
        let triple = target.triple;
        let libdir =
            stdout(Command::new("rustc").args(["--print", "target-libdir", "--target", triple]))
                .unwrap_or_default();
        let installed = !libdir.is_empty() && Path::new(libdir.trim()).is_dir();
        if installed && !build_core {
            return Ok(Self {
                build_core_with: None,
                triple,
            });
        }
        let sysroot = stdout(Command::new("rustc").args(["--print", "sysroot"]))?;
        let linker =
            Path::new(sysroot.trim()).join("lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
        let sources = Path::new("/usr/lib/rustlib/src");
        if Path::new(DISTRIBUTION_RUSTC).exists() && sources.exists() && linker.exists() {
            Ok(Self {
                build_core_with: Some(linker),
                triple,
            })
        } else {
            Err(format!(
                "no core for {triple}: `rustup target add {triple}`, or Debian's packages \
                 rustc-web and rust-web-src beside a rustup toolchain"
            )
            .into())
        }
    }

    /// Builds a firmware program and returns the path of its ELF, which the next one of this
    /// name replaces.
    pub(crate) fn firmware(&self, name: &str, features: &[&str]) -> Result<PathBuf> {
        self.firmware_with(name, features, &[])
    }

    /// The same with variables that its sources read while they are compiled.
    pub(crate) fn firmware_with(
        &self,
        name: &str,
        features: &[&str],
        variables: &[(&str, usize)],
    ) -> Result<PathBuf> {
        let mut cargo = Command::new("cargo");
        cargo
            .current_dir(home().join("firmware"))
            .args(["build", "--quiet", "--release", "--locked", "--bin", name])
            .args(["--target", self.triple, "--features", &features.join(",")])
            .arg("--target-dir")
            .arg(target_dir())
            .envs(
                variables
                    .iter()
                    .map(|(name, value)| (name, value.to_string())),
            );
        if let Some(linker) = &self.build_core_with {
            let name = self.triple.to_uppercase().replace('-', "_");
            cargo
                .arg("-Zbuild-std=core,alloc")
                .env("RUSTC", DISTRIBUTION_RUSTC)
                .env("RUSTC_BOOTSTRAP", "1")
                .env(format!("CARGO_TARGET_{name}_LINKER"), linker);
        }
        stdout(&mut cargo)?;
        Ok(target_dir().join(self.triple).join("release").join(name))
    }
}

/// Runs the session on the host in a profile, and returns its output.
pub(crate) fn host_session(case: &str, arithmetic: &str, profile: &str) -> Result<String> {
    let program = host_program("host-session", profile, &[])?;
    stdout(Command::new(program).args([case, arithmetic]))
}

/// The release profile of `firmware/Cargo.toml`.
const FIRMWARE_PROFILE: [&str; 5] = [
    "profile.release.codegen-units=1",
    "profile.release.lto=true",
    "profile.release.package.asperity-formats.opt-level='s'",
    "profile.release.package.asperity-runtime.opt-level='s'",
    "profile.release.package.asperity-session.opt-level='s'",
];

/// Builds a program of this package for the host as the firmware is built, so that their
/// instructions can stand side by side, and returns its path.
pub(crate) fn host_program_like_firmware(name: &str) -> Result<PathBuf> {
    host_program(name, "release", &FIRMWARE_PROFILE)
}

/// Builds a program of this package for the host and returns its path.
fn host_program(name: &str, profile: &str, options: &[&str]) -> Result<PathBuf> {
    stdout(
        Command::new("cargo")
            .current_dir(home())
            // With the features that all of the workspace has, so that nothing is built for
            // this program alone.
            .args(["build", "--quiet", "--locked", "--workspace", "--bin", name])
            .args(["--profile", profile, "--target-dir"])
            .arg(target_dir())
            .args(options.iter().flat_map(|option| ["--config", option])),
    )?;
    // Cargo's name of the folder of its profiles with checks.
    let folder = if profile == "test" { "debug" } else { profile };
    Ok(target_dir().join(folder).join(name))
}
