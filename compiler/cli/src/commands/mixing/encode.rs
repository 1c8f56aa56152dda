//! `asperity encode`.

use super::{input::Input, output::Mixing};
use crate::cli::Encode;
use asperity::{
    edit::{LatentEditor, Part, encode},
    model::Provenance,
    pipeline::Request,
    raise::raise,
    reduce::Fidelity,
    sources::latents::FromLatents,
};
use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use serde_json::json;

pub(crate) fn run(args: &Encode, console: Console) -> Result<(), Failures> {
    let input = Input::of(&args.file);
    let mixing = Mixing::open(&args.mixed, &[&input], console)?;
    let input = input.read()?;
    let asset = input.asset()?;
    let texture = raise(&asset);
    let prompt_compiler = mixing.prompt_compiler()?;
    let editor = LatentEditor::new(&prompt_compiler);
    let part = args.part.unwrap_or_else(|| Part::recorded(&texture));
    let encoded = encode(&editor, &texture, part).map_err(one)?;
    // A recording is kept in full; what is decoded is as compact as a prompt's texture.
    let request = Request {
        fidelity: Fidelity::Auto,
        ..mixing.request(&editor, &asset)
    };
    let provenance = Provenance {
        prompt: texture.provenance.prompt.clone(),
        ..prompt_compiler.model().provenance("encode")
    };
    let mut source = FromLatents::encoded(texture, encoded.latents, part, provenance);
    source.name = mixing.name(asset.name());
    let compiled = mixing.compile(&editor, &source, &request)?;
    let mut distance = match encoded.distance_db {
        Some((p95, worst)) => format!("{p95:.1} dB at 95 % of the grid, {worst:.1} dB at worst"),
        None => "not measured".into(),
    };
    let silent = encoded.silent_places;
    if silent > 0 {
        distance += &format!("; at {silent} more only one of the two sounds");
    }
    let more = json!({
        "part": part.name(),
        "z": encoded.latents.slide.to_vec(),
        "distance_db": encoded.distance_db.map(|(p95, worst)| [p95, worst]),
        "silent_places": silent,
    });
    let lines = [("encoded", part.name().to_owned()), ("distance", distance)];
    mixing.finish(&editor, &compiled, more, &lines)
}
