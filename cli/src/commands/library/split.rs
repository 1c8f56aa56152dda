//! `asperity split`.

use crate::cli::Split;
use asperity::{
    emit::{lower::LowerError, sections::renamed},
    library::{LoadedLibrary, split},
};
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{FileNames, display, write_folder_beside},
    shown::counted,
};
use serde_json::{Value, json};

pub(crate) fn run(args: &Split, console: Console) -> Result<(), Failures> {
    let shelf = LoadedLibrary::library(&args.file)?;
    let (files, changed) = match args.into {
        Some(count) => (parts(&shelf, count as usize)?, Vec::new()),
        None => assets(&shelf)?,
    };
    let listed: Vec<(String, &[u8])> = files
        .iter()
        .map(|(name, bytes)| (name.clone(), bytes.as_slice()))
        .collect();
    write_folder_beside(std::slice::from_ref(&args.file), &args.output, &listed).map_err(one)?;
    if args.json {
        let files: Vec<Value> = files
            .iter()
            .map(|(file, bytes)| json!({ "file": file, "bytes": bytes.len() }))
            .collect();
        let report = json!({
            "output": display(&args.output).to_string(),
            "files": files,
            "warnings": changed,
        });
        return console.json(&report).map_err(one);
    }
    console.warn_of_many(&changed);
    let count = counted(files.len(), "file", "files");
    let report = format!("{}: wrote {count}\n", display(&args.output));
    console.report(&report).map_err(one)
}

/// Names of files and their bytes.
type Files = Vec<(String, Vec<u8>)>;

/// Returns one asset per texture, named as in the index, and the names that are not valid file names.
fn assets(shelf: &LoadedLibrary) -> Result<(Files, Vec<String>), Failures> {
    let names: Vec<&str> = shelf
        .textures
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    let mut files = Vec::with_capacity(names.len());
    let FileNames {
        files: own,
        changed,
    } = FileNames::of(&names, "asp");
    for (file, (name, bytes)) in own.into_iter().zip(&shelf.textures) {
        let own = Asset::parse(bytes).is_ok_and(|asset| asset.name() == name);
        let bytes = if own {
            bytes.clone()
        } else {
            renamed(bytes, name).map_err(|e| one(LowerError::from(e)))?
        };
        files.push((file, bytes));
    }
    Ok((files, changed))
}

/// As many libraries, numbered.
fn parts(shelf: &LoadedLibrary, count: usize) -> Result<Files, Failures> {
    let digits = count.to_string().len();
    let parts = split(shelf, count).map_err(one)?.into_iter().enumerate();
    let named = parts.map(|(part, bytes)| (format!("part-{:0digits$}.aspl", part + 1), bytes));
    Ok(named.collect())
}
