//! `asperity inspect`.

use super::input::Chosen;
use crate::cli::Inspect;
use asperity::{
    emit::{raise::attributes, textures::Textures},
    model::attributes::{Attributes, Meter},
    views::inspect::{self, Document, LibraryDocument, SurfaceDocument},
};
use asperity_console::Console;
use asperity_formats::{Asset, library};
use asperity_io::{
    diagnostic::{Failures, one},
    shown::counted,
};
use serde::Serialize;
use std::fmt::Write as _;

pub(crate) fn run(args: &Inspect, console: Console) -> Result<(), Failures> {
    let mut textures = Textures::open(&args.file).map_err(one)?;
    match textures.names() {
        Some(names) if args.texture.is_none() => {
            whole_library(args, &mut textures, &names, console)
        }
        _ => one_texture(args, textures, console),
    }
}

fn one_texture(args: &Inspect, textures: Textures, console: Console) -> Result<(), Failures> {
    let name = textures.chosen_name(args.texture.as_deref());
    let name = name.map_err(one)?;
    let chosen = Chosen::of(textures, args.texture.clone())?;
    let asset = chosen.asset()?;
    let document = match name {
        Some(name) => Document::named(&asset, name),
        None => Document::of(&asset),
    };
    if args.json {
        print_json(&document, console)
    } else {
        console.text(&inspect::text(&document, &asset)).map_err(one)
    }
}

fn whole_library(
    args: &Inspect,
    textures: &mut Textures,
    names: &[String],
    console: Console,
) -> Result<(), Failures> {
    let rows = if args.json {
        // Each is checked before any is printed, and made when it is: together they take gigabytes.
        textures.each(|| (), |(), _, _| ()).map_err(one)?;
        Vec::new()
    } else {
        let found = textures.each(Meter::default, |meter, name, asset| {
            row(name, asset, &attributes(asset, meter))
        });
        found.map_err(one)?
    };
    let surfaces: Vec<SurfaceDocument> = textures
        .surfaces()
        .map_err(one)?
        .iter()
        .map(|surface| SurfaceDocument::of(surface, names))
        .collect();
    if args.json {
        let empty = inspect::json(&LibraryDocument {
            format_version: textures.library_version().unwrap_or(library::VERSION),
            textures: Vec::new(),
            surfaces,
        });
        return print_library(textures, names.len(), &empty, console);
    }
    let mut text = format!(
        "{}: a library of {}, all checksums verified\n",
        textures.shown(),
        counted(names.len(), "texture", "textures")
    );
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  index  haptic B  total B  order  vertices  rough dB  sharp Hz      μ  name"
    );
    for (index, row) in rows.iter().enumerate() {
        let _ = writeln!(text, "  {index:>5}  {row}");
    }
    if !surfaces.is_empty() {
        let count = counted(surfaces.len(), "surface", "surfaces");
        let _ = writeln!(text, "  a scene with {count}");
    }
    for (index, surface) in surfaces.iter().enumerate() {
        let _ = writeln!(text, "  {index:>5}  {surface}");
    }
    console.text(&text).map_err(one)
}

/// Prints the JSON of a library around that of its textures, some of which are in memory at a time.
fn print_library(
    textures: &mut Textures,
    count: usize,
    empty: &str,
    console: Console,
) -> Result<(), Failures> {
    const TEXTURES: &str = "\"textures\":[";
    let (head, tail) = empty.split_once(TEXTURES).unwrap_or((empty, ""));
    console
        .json_part(&format!("{head}{TEXTURES}"))
        .map_err(one)?;
    let mut from = 0;
    while from < count {
        let found = textures.each_from(from, Meter::default, |meter, name, asset| {
            inspect::json(&Document::measured(asset, name.to_owned(), meter))
        });
        let found = found.map_err(one)?;
        let before = if from == 0 { "" } else { "," };
        from += found.len();
        let part = format!("{before}{}", found.join(","));
        console.json_part(&part).map_err(one)?;
    }
    console.json_part(&format!("{tail}\n")).map_err(one)
}

/// The figures of one texture of a library.
fn row(name: &str, asset: &Asset<'_>, found: &Attributes) -> String {
    let figure = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |x| format!("{x:.1}"));
    format!(
        "{:>8}  {:>7}  {:>5}  {:>8}  {:>8}  {:>8}  {:>5.3}  {name}",
        asset.haptic_len(),
        asset.total_len(),
        asset.grid().ar_order(),
        asset.grid().vertices().len(),
        figure(found.rough_db),
        figure(found.sharp_hz),
        found.mu,
    )
}

fn print_json(document: &impl Serialize, console: Console) -> Result<(), Failures> {
    console.json(&inspect::json(document)).map_err(one)
}
