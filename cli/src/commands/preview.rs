//! `asperity preview`.

use super::{diffusion, input::Chosen};
use crate::cli::Preview;
use asperity::{
    emit::raise::raise,
    views::{
        diffusion::{Request, files, prompt_of},
        preview::{self, SIZE},
    },
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::size,
};
use serde_json::json;

pub(crate) fn run(args: &Preview, console: Console) -> Result<(), Failures> {
    let mut inputs = vec![args.file.clone()];
    inputs.extend(args.diffusion.iter().flat_map(|folder| files(folder)));
    let mut outputs = Outputs::beside(inputs);
    let color = outputs.open(&args.output).map_err(one)?;
    let height = outputs.open_if(args.height.as_deref()).map_err(one)?;
    let normal = outputs.open_if(args.normal.as_deref()).map_err(one)?;
    let console = console.beside(&outputs);
    let chosen = Chosen::open(&args.file, args.texture.clone())?;
    let asset = chosen.asset()?;
    let anew = args.redraw || args.size.is_some() || height.is_some() || normal.is_some();
    let stored = asset.preview_png();
    let ((width, height_px), bytes, how) = match (&args.diffusion, stored.filter(|_| !anew)) {
        (Some(folder), _) => {
            let texture = raise(&asset);
            let prompt = args.prompt.clone();
            let request = Request {
                negative: args.negative.clone(),
                steps: args.steps.into(),
                guidance: args.guidance,
                method: args.scheduler,
                tile: args.tile,
                ..Request::new(
                    prompt.unwrap_or_else(|| prompt_of(&texture)),
                    args.seed.unwrap_or(texture.provenance.seed),
                )
            };
            let backend = args.diffusion_backend;
            let drawn = diffusion::drawn(folder, backend, request, args.size, console)?;
            let png = drawn.png().map_err(one)?;
            outputs.fill(color, &png).map_err(one)?;
            let size_px = drawn.size_px();
            ((size_px, size_px), png.len(), drawn.note)
        }
        (None, Some(png)) => {
            // Read before it is passed on, so that what is no picture is not written as one.
            let stored = preview::stored(png).map_err(one)?;
            outputs.fill(color, png).map_err(one)?;
            let pixels = (stored.width, stored.height);
            (pixels, png.len(), "as stored in the asset".to_owned())
        }
        (None, None) => {
            let size_px = args.size.unwrap_or(SIZE);
            let encoded = |error| one(preview::not_encoded(error));
            let picture = preview::draw(&raise(&asset), size_px).map_err(one)?;
            let png = picture.png().map_err(encoded)?;
            outputs.fill(color, &png).map_err(one)?;
            if let Some(file) = height {
                let map = picture.height_png().map_err(encoded)?;
                outputs.fill(file, &map).map_err(one)?;
            }
            if let Some(file) = normal {
                let map = picture.normal_png().map_err(encoded)?;
                outputs.fill(file, &map).map_err(one)?;
            }
            let why = if stored.is_some() {
                ""
            } else {
                ", because the asset has no picture"
            };
            ((size_px, size_px), png.len(), format!("newly drawn{why}"))
        }
    };
    outputs.commit().map_err(one)?;
    let path = display(&args.output);
    if args.json {
        let report = json!({
            "output": path.to_string(),
            "width_px": width,
            "height_px": height_px,
            "bytes": bytes,
            "picture": how,
        });
        return console.json(&report).map_err(one);
    }
    let bytes = size(bytes as u64);
    let report = format!("{path}: {width} × {height_px} pixels, {bytes}, {how}\n");
    console.report(&report).map_err(one)
}
