//! `asperity export`.

use super::input::Chosen;
use crate::cli::Export;
use asperity::{
    emit::textures::Textures,
    interchange::{
        self, Carried, ClipFormat, Exported, Format, Language, Options, SourceOptions,
        export_source, header_beside, session,
    },
};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Failures, Fault, one},
    output::{FileNames, Outputs, display, write_folder_beside},
    shown::{counted, size},
};
use serde_json::{Value, json};
use std::{fmt::Write as _, path::Path};

pub(crate) fn run(args: &Export, console: Console) -> Result<(), Failures> {
    match args.to {
        Format::Source(language) => source(args, language, console),
        Format::Clip(format) => {
            let given = [
                ("--symbol", args.symbol.is_some()),
                ("--keep-preview", args.keep_preview),
            ];
            if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
                let what = format!("{option}: a {} file has none", args.to);
                let remedy = format!("give {option} with --to c-array or --to rust alone");
                return Err(one(Fault::new(what, remedy).usage()));
            }
            clips(args, format, console)
        }
    }
}

/// The bytes of an asset, a texture of a library, or a whole library, as source text.
fn source(args: &Export, language: Language, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file]);
    let file = outputs.open(&args.output).map_err(one)?;
    let header = header_beside(language, &args.output);
    let beside = outputs.open_if(header.as_deref()).map_err(one)?;
    let console = console.beside(&outputs);
    let mut textures = Textures::open(&args.file).map_err(one)?;
    let whole = match &args.texture {
        None => textures.library().map_err(one)?,
        Some(_) => None,
    };
    let (name, bytes) = match whole {
        Some(bytes) => (stem(&args.file), bytes),
        None => {
            let chosen = Chosen::of(textures, args.texture.clone())?;
            (chosen.asset()?.name().to_owned(), chosen.bytes)
        }
    };
    let header_name = header.as_deref().and_then(Path::file_name);
    let header_name = header_name.map(|name| name.to_string_lossy().into_owned());
    let options = SourceOptions {
        header: header_name.as_deref(),
        symbol: args.symbol.as_deref(),
        keep_preview: args.keep_preview,
    };
    let written = export_source(language, &name, &bytes, &options).map_err(one)?;
    outputs.fill(file, &written.text).map_err(one)?;
    if let (Some(file), Some(text)) = (beside, &written.header) {
        outputs.fill(file, text).map_err(one)?;
    }
    outputs.commit().map_err(one)?;
    let printed = if args.json {
        let mut json = written.json(language, &name);
        json["output"] = display(&args.output).to_string().into();
        console.json(&json)
    } else {
        let to = display(&args.output);
        let left_out = match written.left_out {
            0 => String::new(),
            previews => format!(", without {} of previews", size(previews as u64)),
        };
        console.report(&format!(
            "{to}: {name} as {}, {} of data in {}{left_out}\n",
            args.to,
            size(written.image_len as u64),
            written.symbol
        ))
    };
    printed.map_err(one)
}

/// Strokes and taps: of one texture to a file, of a library to a folder.
fn clips(args: &Export, format: ClipFormat, console: Console) -> Result<(), Failures> {
    let options = Options {
        session: session(args.speed, args.force, args.time, args.taps),
        rate_hz: args.rate,
        seed: args.seed,
        full_scale_m_s2: args.full_scale.map(f64::from),
        tap_full_scale_m_s2: args.tap_full_scale.map(f64::from),
        size_px: args.size,
    };
    let mut textures = Textures::open(&args.file).map_err(one)?;
    let names = textures.names().filter(|_| args.texture.is_none());
    if let Some(names) = names {
        return folder(args, format, &options, &mut textures, &names, console);
    }
    let mut outputs = Outputs::beside([&args.file]);
    let file = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let chosen = Chosen::of(textures, args.texture.clone())?;
    let asset = chosen.asset()?;
    let exported = interchange::export(&asset, format, &options).map_err(one)?;
    outputs.fill(file, &exported.bytes).map_err(one)?;
    outputs.commit().map_err(one)?;
    console.warnings(&exported.warnings, args.json);
    let printed = if args.json {
        let mut json = exported.json(asset.name());
        json["format"] = args.to.name().into();
        json["output"] = display(&args.output).to_string().into();
        console.json(&json)
    } else {
        console.report(&report(&display(&args.output).to_string(), &exported))
    };
    printed.map_err(one)
}

/// Every texture of a library to a file of its own.
fn folder(
    args: &Export,
    format: ClipFormat,
    options: &Options,
    textures: &mut Textures,
    names: &[String],
    console: Console,
) -> Result<(), Failures> {
    let listed: Vec<&str> = names.iter().map(String::as_str).collect();
    let FileNames { files, changed } = FileNames::of(&listed, format.name());
    let bar = console.bar(names.len(), "textures");
    let mut written = Vec::with_capacity(names.len());
    for (index, name) in names.iter().enumerate() {
        let bytes = textures.texture(index).map_err(one)?;
        let asset = Asset::parse(&bytes).map_err(|e| one(textures.error(Some(name), e.into())))?;
        written.push(interchange::export(&asset, format, options).map_err(one)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let files: Vec<(String, &[u8])> = files
        .into_iter()
        .zip(&written)
        .map(|(file, exported)| (file, exported.bytes.as_slice()))
        .collect();
    write_folder_beside(std::slice::from_ref(&args.file), &args.output, &files).map_err(one)?;
    let all = || names.iter().zip(&written).zip(&files);
    if !args.json {
        console.warn_of_many(&changed);
    }
    for ((name, exported), _) in all() {
        for warning in &exported.warnings {
            if !args.json {
                console.warn(&format!("{name}: {warning}"));
            }
        }
    }
    let printed = if args.json {
        let textures: Vec<Value> = all()
            .map(|((name, exported), (file, _))| {
                let mut json = exported.json(name);
                json["file"] = file.as_str().into();
                json
            })
            .collect();
        console.json(&json!({
            "format": args.to.name(),
            "output": display(&args.output).to_string(),
            "textures": textures,
        }))
    } else {
        let count = counted(files.len(), "file", "files");
        let mut text = format!("{}: wrote {count}\n", display(&args.output));
        for ((_, exported), (file, _)) in all() {
            text += &report(file, exported);
        }
        console.report(&text)
    };
    printed.map_err(one)
}

fn report(file: &str, exported: &Exported) -> String {
    let mut text = format!("{file}: {}", size(exported.bytes.len() as u64));
    if let Some(scale) = exported.scale {
        let has = |word: &str| exported.carried.iter().any(|c| c.part.starts_with(word));
        let mut said = Vec::new();
        for (word, part, m_s2) in [
            ("stroke", "strokes", scale.stroke_m_s2),
            ("tap", "taps", scale.tap_m_s2),
        ] {
            if has(word) {
                said.push(format!("{m_s2:.3} m/s² for {part}"));
            }
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "; full scale is {}", said.join(" and "));
    }
    text.push('\n');
    let widths = exported.carried.iter().map(|c| c.part.chars().count());
    let width = widths.max().unwrap_or(0);
    for Carried { part, loss } in &exported.carried {
        let _ = match loss {
            None => writeln!(text, "  {part:<width$}  silent"),
            Some(loss) if loss.worst_db < 0.005 => writeln!(text, "  {part:<width$}  no loss"),
            Some(loss) => writeln!(
                text,
                "  {part:<width$}  loses {:>5.2} dB RMS over third octaves, at most {:>5.2} dB at {:.0} Hz",
                loss.rms_db, loss.worst_db, loss.worst_hz
            ),
        };
    }
    text
}

/// The name of a file without its ending.
fn stem(file: &Path) -> String {
    file.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
