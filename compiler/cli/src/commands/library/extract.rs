//! `asperity extract`.

use crate::cli::Extract;
use asperity::emit::{lower::LowerError, sections::renamed, textures::Textures};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::size,
};

pub(crate) fn run(args: &Extract, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file]);
    let output = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut textures = Textures::open(&args.file).map_err(one)?;
    let wanted = Some(args.texture.as_str());
    let name = textures.chosen_name(wanted).map_err(one)?;
    let bytes = textures.choose(wanted).map_err(one)?;
    let asset = Asset::parse(&bytes).map_err(|e| one(textures.error(wanted, e.into())))?;
    // The name in the index counts.
    let name = name.as_deref().unwrap_or(asset.name());
    let extracted = if name == asset.name() {
        bytes.clone()
    } else {
        renamed(&bytes, name).map_err(|e| one(LowerError::from(e)))?
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
