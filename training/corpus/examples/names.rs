//! Writes the tables of the prompt reader: names of the materials of the reference corpus, their
//! synonyms and the things of the lexicon, and the words that say how these feel.
//!
//! `cargo run --release -p asperity-corpus --example names`

use asperity_corpus::reference::names;
use std::{fs, io, path::Path};

fn main() -> io::Result<()> {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../compiler/language/src/lexicon"
    );
    let write = |file: &str, text: String| fs::write(Path::new(folder).join(file), text);
    write("names.tsv", names::table())?;
    write("qualities.txt", names::qualities())
}
