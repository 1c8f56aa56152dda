//! `asperity list`.

use crate::cli::List;
use asperity::{
    attributes,
    console::Console,
    diagnostic::{Failures, one},
    edit::remembered,
    library::Shelf,
    raise::raise,
};
use asperity_formats::Asset;
use serde_json::{Value, json};
use std::fmt::Write as _;

pub(crate) fn run(args: &List, console: Console) -> Result<(), Failures> {
    let shelf = Shelf::open(&args.file).map_err(one)?;
    let mut rows = Vec::with_capacity(shelf.textures.len());
    let mut text = format!(
        "  haptic   total  rough dB  sharp Hz  hard Hz      μ  name ({} textures)\n",
        shelf.textures.len()
    );
    for (name, bytes) in &shelf.textures {
        // Parsed when it was read.
        let Ok(asset) = Asset::parse(bytes) else {
            continue;
        };
        let found = attributes::of(&raise(&asset));
        let prompt = asset.provenance().and_then(|p| p.prompt);
        let memory = remembered(&asset).ok().flatten();
        let edits = memory.as_ref().map_or(0, |m| m.history.steps.len());
        if args.json {
            rows.push(json!({
                "name": name,
                "prompt": prompt,
                "bytes": { "haptic": asset.haptic_len(), "total": asset.total_len() },
                "attributes": found,
                "has_preview": asset.preview_png().is_some(),
                "has_latent": memory.is_some(),
                "edits": edits,
            }));
            continue;
        }
        let figure = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{x:.1}"));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "  {:>6}  {:>6}  {:>8}  {:>8}  {:>7}  {:>5.3}  {name}",
            asset.haptic_len(),
            asset.total_len(),
            figure(found.rough_db),
            figure(found.sharp_hz),
            figure(found.hard_hz),
            found.mu,
        );
        if let Some(prompt) = prompt.filter(|prompt| prompt != name) {
            let _ = write!(text, ": {prompt:?}");
        }
        if edits > 0 {
            let _ = write!(text, ", edited {edits} ×");
        }
        text.push('\n');
    }
    let printed = if args.json {
        console.json(&json!({ "textures": Value::from(rows) }))
    } else {
        console.text(&text)
    };
    printed.map_err(one)
}
