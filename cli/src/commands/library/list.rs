//! `asperity list`.

use crate::cli::List;
use asperity::{
    edit_memory::History,
    emit::{raise::attributes, textures::Textures},
    learned::Certainty,
    model::attributes::{Attributes, Meter},
    sources::latents::remembered,
};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Failures, one},
    shown::counted,
};
use serde_json::{Value, json};
use std::fmt::Write as _;

pub(crate) fn run(args: &List, console: Console) -> Result<(), Failures> {
    let mut textures = Textures::open(&args.file).map_err(one)?;
    let printed = if args.json {
        let rows = textures.each(Meter::default, |meter, name, asset| {
            in_json(name, asset, &attributes(asset, meter))
        });
        console.json(&json!({ "textures": Value::from(rows.map_err(one)?) }))
    } else {
        let rows = textures.each(Meter::default, |meter, name, asset| {
            line(name, asset, &attributes(asset, meter))
        });
        let rows = rows.map_err(one)?;
        let count = counted(rows.len(), "texture", "textures");
        let head = "  haptic B  total B  rough dB  sharp Hz  hard Hz      μ  name";
        console.text(&format!("{count}\n{head}\n{}", rows.concat()))
    };
    printed.map_err(one)
}

/// Returns the edit history; `None` for an asset without latents.
fn history(asset: &Asset<'_>) -> Option<History> {
    let memory = remembered(asset).ok().flatten();
    memory.map(|memory| memory.history)
}

fn in_json(name: &str, asset: &Asset<'_>, found: &Attributes) -> Value {
    let history = history(asset);
    let certainty = history.as_ref().and_then(|history| history.certainty);
    json!({
        "name": name,
        "prompt": asset.provenance().and_then(|p| p.prompt),
        "bytes": { "haptic": asset.haptic_len(), "total": asset.total_len() },
        "attributes": found,
        "has_preview": asset.preview_png().is_some(),
        "has_latent": history.is_some(),
        "edits": history.map_or(0, |history| history.steps.len()),
        "certainty_level": certainty,
        "certainty": certainty.map(Certainty::share),
    })
}

fn line(name: &str, asset: &Asset<'_>, found: &Attributes) -> String {
    let figure = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{x:.1}"));
    let mut text = format!(
        "  {:>8}  {:>7}  {:>8}  {:>8}  {:>7}  {:>5.3}  {name}",
        asset.haptic_len(),
        asset.total_len(),
        figure(found.rough_db),
        figure(found.sharp_hz),
        figure(found.hard_hz),
        found.mu,
    );
    let prompt = asset.provenance().and_then(|p| p.prompt);
    if let Some(prompt) = prompt.filter(|prompt| *prompt != name) {
        // Writing to a string cannot fail.
        let _ = write!(text, ": {prompt:?}");
    }
    let history = history(asset).unwrap_or_default();
    if let Some(certainty) = history.certainty {
        let _ = write!(text, ", certainty {certainty}");
    }
    if !history.steps.is_empty() {
        let _ = write!(text, ", {}", counted(history.steps.len(), "edit", "edits"));
    }
    text.push('\n');
    text
}
