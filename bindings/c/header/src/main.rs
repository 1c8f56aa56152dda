//! Writes `include/asperity.h` from the sources of `asperity-c`. With `--check` it writes
//! nothing and fails if the committed header differs.
#![forbid(unsafe_code)]

use std::{env, error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let builder = cbindgen::Builder::new()
        .with_config(cbindgen::Config::from_file(folder.join("cbindgen.toml"))?)
        .with_src(folder.join("src/lib.rs"));
    let mut header = Vec::new();
    builder.generate()?.write(&mut header);
    let path = folder.join("include/asperity.h");
    if env::args().nth(1).as_deref() != Some("--check") {
        fs::create_dir_all(folder.join("include"))?;
        return Ok(fs::write(path, header)?);
    }
    if fs::read(&path)? == header {
        Ok(())
    } else {
        Err(
            "bindings/c/include/asperity.h is not what the sources give: \
             cargo run --manifest-path bindings/c/header/Cargo.toml"
                .into(),
        )
    }
}
