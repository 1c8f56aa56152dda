//! Files that are dropped on the page: ours as they are, those of other tools as `asperity import` takes them.

use crate::{
    collection::Collection,
    error::{ApiError, refused},
    http::Status,
    prompts::Loaded,
    recipe::{Opened, Operation},
    texture::{Making, Texture, damaged, hash},
};
use asperity::{
    driver,
    emit::textures::Textures,
    passes::reduce::Fidelity,
    pipeline::{Clock, Request},
    sources::{
        Source, Tools,
        import::Imported,
        surface::{Options, Surface},
    },
    views::preview::SIZE,
};
use asperity_io::{
    clock::now,
    input::{Format, InputError, InputProblem},
    shown::shell_word,
};
use std::path::{Path, PathBuf};

/// Leading bytes that tell what a file is, as for commands.
const TELLING: usize = 64 << 10;
/// File types that can be opened.
const WANTED: &str = "an asset, a library, a HaTT material, a model, AHAP, .haptic, HJIF, a picture of heights or normals, or a list of prompts (.csv)";

/// The content of a file.
pub(crate) enum FileContent {
    Texture(Box<Texture>),
    /// A library with several textures.
    Library(Box<Collection>),
}

/// Opens the bytes of a file. Its name tells what damaged ones were meant to be, and is repeated in errors; nothing of
/// that name is looked for on a disk.
///
/// # Errors
/// As the command that reads such a file.
pub(crate) fn open(file: &str, bytes: Vec<u8>) -> Result<FileContent, ApiError> {
    let path = Path::new(file);
    let format = Format::of(&bytes[..bytes.len().min(TELLING)]);
    let ending = path.extension().unwrap_or_default();
    let ours = ["asp", "aspl"]
        .iter()
        .any(|own| ending.eq_ignore_ascii_case(own));
    match (format, Imported::of(path, format)) {
        (Some(Format::Asset | Format::Library), _) => textures(file, bytes),
        (None, _) if ours => textures(file, bytes),
        (_, Some(imported)) => {
            import(imported, file, &bytes).map(|texture| FileContent::Texture(Box::new(texture)))
        }
        (Some(format), None) => {
            let wanted = WANTED.into();
            let problem = InputProblem::OtherFormat { format, wanted };
            let file = path.to_owned();
            Err(refused(&InputError { file, problem }))
        }
        (None, None) => Err(ApiError::new(
            Status::Unprocessable,
            format!("{file}: unknown format; must be {WANTED}"),
            "give another file, or convert this one to one of these",
        )),
    }
}

/// An asset, or a library of one or more.
fn textures(file: &str, bytes: Vec<u8>) -> Result<FileContent, ApiError> {
    let id = hash(&bytes);
    let path = Path::new(file);
    let mut textures = Textures::from_bytes(path, bytes).map_err(|e| refused(&e))?;
    if textures.names().is_some_and(|names| names.len() != 1) {
        let library = Collection::dropped(textures, id)?;
        return Ok(FileContent::Library(Box::new(library)));
    }
    let indexed = textures.chosen_name(None).map_err(|e| refused(&e))?;
    let asset = textures.choose(None).map_err(|e| refused(&e))?;
    let making = Making {
        indexed,
        ..Making::default()
    };
    let path = file.to_owned();
    let texture = Texture::new(asset, making, |_| Operation::File(Opened { path, id }));
    let texture = texture.map_err(|e| refused(&textures.error(None, e.into())))?;
    Ok(FileContent::Texture(Box::new(texture)))
}

/// A file of another tool.
fn import(kind: Imported, file: &str, bytes: &[u8]) -> Result<Texture, ApiError> {
    let source = kind.source(PathBuf::from(file));
    let tools = Tools {
        given: Some((Path::new(file), bytes)),
        ..Tools::default()
    };
    let command = (kind.name(), String::new());
    compiled(
        &*source,
        &kind.request(),
        tools,
        (file, hash(bytes)),
        command,
    )
}

/// A picture of heights or normals, with what was stated of it, as `asperity import surface`.
///
/// # Errors
/// As the command.
pub(crate) fn surface(
    file: &str,
    bytes: &[u8],
    stated: Stated<'_>,
    loaded: &Loaded,
) -> Result<Texture, ApiError> {
    let (options, words) = surface_options(stated)?;
    let source = Surface {
        path: PathBuf::from(file),
        options,
    };
    let tools = Tools {
        given: Some((Path::new(file), bytes)),
        ..Tools::of(&loaded.compiler)
    };
    imported(&source, tools, (file, hash(bytes)), ("surface", words))
}

/// What a person states of pictures: the options of `asperity import surface`, by their keys.
pub(crate) type Stated<'a> = &'a [(&'static str, String)];

/// The options, and how a command line states them.
///
/// # Errors
/// As the command.
pub(crate) fn surface_options(stated: Stated<'_>) -> Result<(Options, String), ApiError> {
    let options = Options::stated(stated).map_err(|failure| refused(&*failure))?;
    let words = stated
        .iter()
        .map(|(key, value)| format!(" --{} {}", key.replace('_', "-"), shell_word(value)));
    Ok((options, words.collect()))
}

/// The texture of a source that stands for a file or a folder, by its name and what distinguishes it; `command` is the
/// kind of `asperity import`, with the rest of its line.
pub(crate) fn imported(
    source: &dyn Source,
    tools: Tools<'_>,
    file: (&str, String),
    command: (&str, String),
) -> Result<Texture, ApiError> {
    let request = Request {
        fidelity: Fidelity::Auto,
        preview_px: Some(SIZE),
        ..Request::default()
    };
    compiled(source, &request, tools, file, command)
}

fn compiled(
    source: &dyn Source,
    request: &Request,
    tools: Tools<'_>,
    (path, id): (&str, String),
    (kind, options): (&str, String),
) -> Result<Texture, ApiError> {
    let tools = Tools {
        clock: Clock(now),
        ..tools
    };
    let compiled =
        driver::compile(source, request, &tools).map_err(|failure| refused(failure.as_ref()))?;
    let making = Making {
        made: Some(compiled.json()),
        ..Making::default()
    };
    let opened = Opened {
        path: path.to_owned(),
        id,
    };
    let operation = |_: &str| Operation::Import {
        kind: kind.to_owned(),
        file: opened,
        options,
    };
    Texture::new(compiled.lowered.bytes, making, operation).map_err(damaged)
}

/// Returns true for a picture, which shows heights or normals.
pub(crate) fn is_picture(bytes: &[u8]) -> bool {
    let format = Format::of(&bytes[..bytes.len().min(TELLING)]);
    matches!(format, Some(Format::Png | Format::Tiff | Format::Jpeg))
}
