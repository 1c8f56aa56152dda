//! `asperity render`.

use crate::failure::{Failures, one};
use crate::{cli::Render, console};
use asperity::{
    input::{self, InputError},
    output::{AtomicFile, OutputError},
    render::{self, RenderError},
    source::Source,
};
use asperity_formats::{Asset, Library};
use std::io::BufWriter;

/// What the trajectory goes over: the surfaces of a scene, or a plane with one texture.
enum Felt<'a> {
    Scene(Library<'a>),
    Texture(Box<Asset<'a>>),
}

pub(crate) fn run(args: &Render) -> Result<(), Failures> {
    let mut source = Source::open(&args.file).map_err(one)?;
    let wanted = args.texture.as_deref();
    let scene = match wanted {
        None => source.scene_library().map_err(one)?,
        Some(_) => None,
    };
    let is_scene = scene.is_some();
    let bytes = match scene {
        Some(bytes) => bytes,
        None => source.choose(wanted).map_err(one)?,
    };
    let felt = if is_scene {
        Library::parse(&bytes).map(Felt::Scene)
    } else {
        Asset::parse(&bytes).map(|asset| Felt::Texture(Box::new(asset)))
    };
    let felt = felt.map_err(|e| one(source.error(wanted, e.into())))?;
    let trajectory = input::open(&args.trajectory).map_err(|problem| {
        one(InputError {
            file: args.trajectory.clone(),
            problem,
        })
    })?;
    let mut output = AtomicFile::create(&args.output).map_err(one)?;
    let (file, input) = (&args.trajectory, trajectory);
    let rows = BufWriter::new(&mut output);
    let report = match &felt {
        Felt::Scene(library) => {
            render::render_scene(library, args.rate, file, input, rows, args.seed)
        }
        Felt::Texture(asset) => render::render(asset, args.rate, file, input, rows, args.seed),
    }
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
