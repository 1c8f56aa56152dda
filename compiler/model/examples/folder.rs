//! Writes the shipped model as a folder, as `asperity-train fit` writes one: for `--model DIR`, for
//! `asperity-train evaluate --model DIR`, or to start a model of one's own from.

use std::{env, fs, io, path::Path};

const FILES: [(&str, &[u8]); 7] = [
    ("model.json", asperity_model::DESCRIPTION.as_bytes()),
    ("text_projection.onnx", asperity_model::TEXT_PROJECTION),
    ("ar_decoder.onnx", asperity_model::AR_DECODER),
    ("tap_decoder.onnx", asperity_model::TAP_DECODER),
    ("encoder.onnx", asperity_model::ENCODER),
    ("config.toml", include_bytes!("../config.toml")),
    ("MODEL_CARD.md", include_bytes!("../MODEL_CARD.md")),
];

fn main() -> io::Result<()> {
    let Some(folder) = env::args_os().nth(1) else {
        return Err(io::Error::other("name the folder to write: folder DIR"));
    };
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    for (name, bytes) in FILES {
        fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
