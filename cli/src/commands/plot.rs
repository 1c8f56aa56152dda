//! `asperity plot`.

use super::input::Chosen;
use crate::cli::Plot;
use asperity::views::plot;
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::size,
};
use serde_json::json;

pub(crate) fn run(args: &Plot, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file]);
    let picture = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let chosen = Chosen::open(&args.file, args.texture.clone())?;
    let asset = chosen.asset()?;
    let png = plot::of_asset(&asset).map_err(one)?;
    outputs.fill(picture, &png).map_err(one)?;
    outputs.commit().map_err(one)?;
    let path = display(&args.output);
    if args.json {
        let report = json!({
            "output": path.to_string(),
            "name": asset.name(),
            "bytes": png.len(),
        });
        console.json(&report).map_err(one)
    } else {
        let report = format!("{path}: {}\n", size(png.len() as u64));
        console.report(&report).map_err(one)
    }
}
