//! `asperity rename`.

use crate::cli::Rename;
use asperity::{
    emit::textures::{Textures, TexturesProblem},
    library::{LoadedLibrary, check_name},
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, alone, one},
    output::{Outputs, display},
    shown::suggestion,
};

pub(crate) fn run(args: &Rename, console: Console) -> Result<(), Failures> {
    let name = &args.name;
    check_name(name).map_err(one)?;
    let mut outputs = Outputs::beside([&args.file]);
    let output = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut shelf = LoadedLibrary::open(&args.file).map_err(one)?;
    shelf.refuse_scene().map_err(one)?;
    let Some(index) = shelf.position(&args.texture) else {
        let count = shelf.textures.len();
        let wanted = args.texture.clone();
        let textures = Textures::open(&args.file).map_err(one)?;
        let names = shelf.textures.iter().map(|(name, _)| name.as_str());
        let problem = TexturesProblem::NoSuchTexture {
            suggestion: suggestion(&wanted, names),
            wanted,
            count,
        };
        return Err(one(textures.error(None, problem)));
    };
    let before = shelf.rename(index, name).map_err(alone)?;
    let bytes = shelf.encode().map_err(one)?;
    outputs.fill(output, &bytes).map_err(one)?;
    outputs.commit().map_err(one)?;
    let report = format!(
        "{}: renamed {before:?} to {name:?}\n",
        display(&args.output)
    );
    console.report(&report).map_err(one)
}
