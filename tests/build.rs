//! Looks for HaTT materials, in the folder of `ASPERITY_HATT` or in `../shared/hatt/models` beside the workspace. Where
//! they are, `cfg(hatt)` and `HATT_FOLDER` are set; where they are not, tests that need them are reported as ignored.

use std::path::{Path, PathBuf};

fn main() {
    println!("cargo::rustc-check-cfg=cfg(hatt)");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=ASPERITY_HATT");
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/hatt/models");
    let folder = std::env::var_os("ASPERITY_HATT").map_or(beside, PathBuf::from);
    let is_material = |path: &Path| {
        path.extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("xml"))
    };
    if let Ok(entries) = std::fs::read_dir(&folder)
        && entries.flatten().any(|entry| is_material(&entry.path()))
    {
        // Cargo takes a path that does not exist for one that has changed, and would build again each time.
        println!("cargo::rerun-if-changed={}", folder.display());
        println!("cargo::rustc-env=HATT_FOLDER={}", folder.display());
        println!("cargo::rustc-cfg=hatt");
    }
}
