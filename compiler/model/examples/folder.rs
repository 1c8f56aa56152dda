//! Writes the shipped model as a folder, as `asperity-train fit` writes one: for `--model DIR`, for
//! `asperity-train evaluate --model DIR`, or to start a model of one's own from.

use std::{env, fs, io, path::Path};

/// Provenance of the model: its training configuration and its model card.
const PROVENANCE: [(&str, &[u8]); 2] = [
    ("config.toml", include_bytes!("../config.toml")),
    ("MODEL_CARD.md", include_bytes!("../MODEL_CARD.md")),
];

fn main() -> io::Result<()> {
    let Some(folder) = env::args_os().nth(1) else {
        return Err(io::Error::other("name the folder to write: folder DIR"));
    };
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    for (name, bytes) in asperity_model::folder().into_iter().chain(PROVENANCE) {
        fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
