//! Writes the tiny folder: `cargo run -p asperity-diffusion --example tiny -- FOLDER`.

use asperity_diffusion::tiny;
use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or("give the folder to write")?;
    for (part, bytes) in tiny::folder(&tiny::Options::default()) {
        let file = folder.join(part);
        if let Some(parent) = file.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(&file, bytes)?;
        println!("{}", file.display());
    }
    Ok(())
}
