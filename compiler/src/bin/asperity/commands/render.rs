//! `asperity render`.

use crate::failure::{Failures, one};
use crate::{cli::Render, console};
use asperity::{
    output::{AtomicFile, OutputError},
    render::{self, RenderError},
    source::Source,
};
use asperity_formats::Asset;
use std::{
    fs::File,
    io::{BufReader, BufWriter},
};

pub(crate) fn run(args: &Render) -> Result<(), Failures> {
    let mut source = Source::open(&args.file).map_err(one)?;
    let bytes = source.choose(args.texture.as_deref()).map_err(one)?;
    let asset =
        Asset::parse(&bytes).map_err(|e| one(source.error(args.texture.as_deref(), e.into())))?;
    let trajectory = File::open(&args.trajectory).map_err(|cause| {
        one(RenderError::Unreadable {
            file: args.trajectory.clone(),
            cause,
        })
    })?;
    let mut output = AtomicFile::create(&args.output).map_err(one)?;
    let report = render::render(
        &asset,
        &args.trajectory,
        BufReader::new(trajectory),
        BufWriter::new(&mut output),
        args.seed,
    )
    .map_err(|error| match error {
        RenderError::Write(source) => one(OutputError {
            path: args.output.clone(),
            doing: "cannot write it",
            source,
        }),
        other => one(other),
    })?;
    // A pipe or a terminal gets the table alone.
    let announce = !output.is_direct();
    output.commit().map_err(one)?;
    if announce {
        console::print(&format!(
            "{}: {} ticks, {} in contact, {} taps, {:.3} N at most\n",
            args.output.display(),
            report.ticks,
            report.contact_ticks,
            report.taps,
            report.peak_force_n
        ))?;
    }
    Ok(())
}
