//! `asperity rename`.

use crate::cli::Rename;
use asperity::{
    edit::EditError,
    library::{LibraryFault, LoadedLibrary, NamedAsset, encode, renamed},
    textures::{Textures, TexturesProblem},
};
use asperity_console::Console;
use asperity_formats::limits::MAX_NAME_BYTES;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::suggestion,
};

pub(crate) fn run(args: &Rename, console: Console) -> Result<(), Failures> {
    let name = &args.name;
    if name.is_empty() || name.len() > MAX_NAME_BYTES || name.chars().any(char::is_control) {
        return Err(one(LibraryFault::Name(name.clone())));
    }
    let mut outputs = Outputs::beside([&args.file]);
    let output = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut shelf = LoadedLibrary::open(&args.file).map_err(one)?;
    if shelf.has_scene {
        return Err(one(LibraryFault::Scene(shelf.shown)));
    }
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
    let mut others = shelf.textures.iter().enumerate();
    if others.any(|(other, (taken, _))| other != index && taken == name) {
        return Err(one(LibraryFault::Taken {
            file: shelf.shown,
            name: name.clone(),
        }));
    }
    let bytes = renamed(&shelf.textures[index].1, name).map_err(|e| one(EditError::from(e)))?;
    let before = std::mem::replace(&mut shelf.textures[index], (name.clone(), bytes)).0;
    let bytes = if shelf.is_library {
        let named: Vec<NamedAsset<'_>> = shelf
            .textures
            .iter()
            .map(|(name, bytes)| NamedAsset { name, bytes })
            .collect();
        encode(&named).map_err(one)?
    } else {
        shelf.textures.swap_remove(index).1
    };
    outputs.fill(output, &bytes).map_err(one)?;
    outputs.commit().map_err(one)?;
    let report = format!(
        "{}: renamed {before:?} to {name:?}\n",
        display(&args.output)
    );
    console.report(&report).map_err(one)
}
