//! `asperity merge`.

use crate::cli::Merge;
use asperity::library::{LoadedLibrary, merge};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::{counted, size},
};

pub(crate) fn run(args: &Merge, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside(&args.files);
    let library = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let mut parts = Vec::with_capacity(args.files.len());
    for file in &args.files {
        let part = LoadedLibrary::open(file).map_err(one)?;
        part.refuse_scene().map_err(one)?;
        parts.push(part);
    }
    let bytes = merge(&parts)?;
    outputs.fill(library, &bytes).map_err(one)?;
    outputs.commit().map_err(one)?;
    let to = display(&args.output);
    let files = counted(parts.len(), "file", "files");
    let report = format!("{to}: merged {files}, {}\n", size(bytes.len() as u64));
    console.report(&report).map_err(one)
}
