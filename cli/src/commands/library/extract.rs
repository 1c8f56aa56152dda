//! `asperity extract`.

use crate::{cli::Extract, commands::input::Chosen};
use asperity::emit::{lower::LowerError, sections::renamed};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::size,
};

pub(crate) fn run(args: &Extract, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file]);
    let output = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let chosen = Chosen::open(&args.file, Some(args.texture.clone()))?;
    let asset = chosen.asset()?;
    let name = chosen.textures.chosen_name(Some(&args.texture));
    let name = name.map_err(one)?;
    // The name in the index counts.
    let name = name.as_deref().unwrap_or(asset.name());
    let extracted = if name == asset.name() {
        chosen.bytes.clone()
    } else {
        renamed(&chosen.bytes, name).map_err(|e| one(LowerError::from(e)))?
    };
    outputs.fill(output, &extracted).map_err(one)?;
    outputs.commit().map_err(one)?;
    let report = format!(
        "{}: {name:?}, {}\n",
        display(&args.output),
        size(extracted.len() as u64)
    );
    console.report(&report).map_err(one)
}
