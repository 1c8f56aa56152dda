//! `asperity render`.

use crate::cli::Render;
use asperity::{
    emit::textures::Textures,
    views::render::{self, RenderError},
};
use asperity_console::Console;
use asperity_formats::{Asset, Library};
use asperity_io::{
    diagnostic::{Failures, one},
    input::{self, InputError, InputKind},
    output::{Outputs, display},
    shown::counted,
};
use serde_json::json;
use std::io::BufWriter;

/// Target of the trajectory: the surfaces of a scene, or a plane with a single texture.
enum RenderTarget<'a> {
    Scene(Library<'a>),
    Texture(Box<Asset<'a>>),
}

pub(crate) fn run(args: &Render, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file, &args.trajectory]);
    let table = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut textures = Textures::open(&args.file).map_err(one)?;
    let wanted = args.texture.as_deref();
    let scene = match wanted {
        None => textures.scene_library().map_err(one)?,
        Some(_) => None,
    };
    let is_scene = scene.is_some();
    let bytes = match scene {
        Some(bytes) => bytes,
        None => textures.choose(wanted).map_err(one)?,
    };
    let target = if is_scene {
        Library::parse(&bytes).map(RenderTarget::Scene)
    } else {
        Asset::parse(&bytes).map(|asset| RenderTarget::Texture(Box::new(asset)))
    };
    let target = target.map_err(|e| one(textures.error(wanted, e.into())))?;
    let trajectory =
        input::open_as(&args.trajectory, InputKind::Trajectory).map_err(|problem| {
            one(InputError {
                file: args.trajectory.clone(),
                problem,
            })
        })?;
    let output = outputs.file(table);
    let (file, input) = (&args.trajectory, trajectory);
    let rows = BufWriter::new(&mut *output);
    let rendered = match &target {
        RenderTarget::Scene(library) => {
            render::render_scene(library, args.rate, file, input, rows, args.seed)
        }
        RenderTarget::Texture(asset) => {
            render::render(asset, args.rate, file, input, rows, args.seed)
        }
    };
    let report = rendered.map_err(|error| match error {
        RenderError::Write(source) => one(output.error("cannot write it", source)),
        other => one(other),
    })?;
    outputs.commit().map_err(one)?;
    if args.json {
        return console
            .json(&json!({
                "output": display(&args.output).to_string(),
                "ticks": report.ticks,
                "contact_ticks": report.contact_ticks,
                "taps": report.taps,
                "peak_force_n": report.peak_force_n,
            }))
            .map_err(one);
    }
    let report = format!(
        "{}: {}, {} of them in contact; {}; peak force {:.3} N\n",
        display(&args.output),
        counted(report.ticks, "tick", "ticks"),
        report.contact_ticks,
        counted(report.taps, "tap", "taps"),
        report.peak_force_n
    );
    console.report(&report).map_err(one)
}
