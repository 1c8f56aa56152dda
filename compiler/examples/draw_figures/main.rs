//! The figures of `docs/figures.md`, and the page itself.
//!
//! `cargo run --release -p asperity --example draw_figures` writes `figures.md`, the pictures `texture.png`,
//! `three-prompts.png` and `midpoint.png`, and three sounds to `docs`, or to the folder that it is given, which is
//! created where it is missing. Everything follows from the shipped model.

mod page;
mod sheet;
mod sound;
mod texture;

use asperity::{
    learned::inference::Backend,
    model::{Provenance, TextureModel},
    sources::{
        latents::decode,
        latents::{LatentEditor, Latents, explain},
        prompt::PromptCompiler,
    },
};
use asperity_io::output::write_atomic;
use page::Page;
use std::{env, error::Error, fs, path::PathBuf};

/// Prompts whose order of sharpness and level the paper reports: abrasive, cork, foam.
const THREE: [&str; 3] = [
    "rough abrasive sheet with gritty particles",
    "a cork board for notes",
    "packing foam from a box",
];
/// The ends of a blend.
const ENDS: [&str; 2] = ["towel", "whiteboard"];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env::args().nth(1).unwrap_or_else(|| "docs".to_owned()));
    for part in ["images", "sounds"] {
        let part = folder.join(part);
        fs::create_dir_all(&part).map_err(|error| format!("{}: {error}", part.display()))?;
    }
    let prompt_compiler = PromptCompiler::embedded(&Backend::Portable)?;
    let editor = LatentEditor::new(&prompt_compiler);
    let latents = |prompt: &str| -> Result<Latents, Box<dyn Error>> {
        let meaning = prompt_compiler.meaning(&prompt_compiler.project(prompt)?)?;
        Ok(Latents::whole(meaning.z).shifted(meaning.shift))
    };
    // A picture follows the words of a prompt; that of a mixture follows its neighbours.
    let texture = |name: &str, latents: &Latents, prompt: Option<&str>| {
        let provenance = Provenance {
            prompt: prompt.map(str::to_owned),
            ..Provenance::default()
        };
        decode(prompt_compiler.model(), latents, name, provenance)
    };
    let mut three: Vec<TextureModel> = Vec::new();
    for prompt in THREE {
        three.push(texture(prompt, &latents(prompt)?, Some(prompt))?);
    }
    let ends = [latents(ENDS[0])?, latents(ENDS[1])?];
    let middle = Latents::between(&ends[0], &ends[1], 0.5);
    let blend = [
        texture(ENDS[0], &ends[0], Some(ENDS[0]))?,
        texture("halfway between them", &middle, None)?,
        texture(ENDS[1], &ends[1], Some(ENDS[1]))?,
    ];
    let words = THREE.map(|prompt| explain(&editor, prompt));
    let mut explained = Vec::new();
    for (prompt, words) in THREE.into_iter().zip(words) {
        explained.push((prompt, words?));
    }
    let page = Page {
        three: &three,
        explained: &explained,
        blend: &blend,
    };
    for (file, bytes) in [
        ("images/texture.png", texture::png(&three[0])?),
        ("images/three-prompts.png", sheet::png(&three)?),
        ("images/midpoint.png", sheet::png(&blend)?),
        ("sounds/abrasive.wav", sound::wav(&three[0])?),
        ("sounds/cork.wav", sound::wav(&three[1])?),
        ("sounds/foam.wav", sound::wav(&three[2])?),
        ("figures.md", page.text().into_bytes()),
    ] {
        let file = folder.join(file);
        write_atomic(&file, &bytes).map_err(|error| error.to_string())?;
        println!("{}: {} bytes", file.display(), bytes.len());
    }
    Ok(())
}
