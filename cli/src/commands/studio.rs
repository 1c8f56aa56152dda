//! `asperity studio`.

use crate::cli::Studio as Arguments;
use asperity::{learned::inference::Backend, sources::prompt::PromptCompiler};
use asperity_console::{Console, on_interrupt};
use asperity_io::{
    diagnostic::{Failure, Failures, one, texts},
    output::display,
    shown::{counted, size},
};
use asperity_studio::{Collection, Limits, LoadPrompts, Module, Server, Studio, export, show};
use std::path::Path;

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let collection = args
        .collection
        .as_deref()
        .map(Collection::open)
        .transpose()?;
    match (&args.export, collection) {
        (Some(folder), Some(collection)) => {
            let module = args.compiler.as_deref().map(Module::open).transpose();
            write(collection, module.map_err(one)?, folder, console)
        }
        (_, collection) => serve(args, collection, console),
    }
}

fn serve(
    args: &Arguments,
    collection: Option<Collection>,
    console: Console,
) -> Result<(), Failures> {
    let studio = Studio::new(collection, Some(prompts));
    let server = Server::bind(args.port, studio, Limits::default()).map_err(one)?;
    let stopper = server.stopper();
    on_interrupt(move || stopper.stop()).map_err(one)?;
    let url = server.url();
    console.text(&format!("{url}\n")).map_err(one)?;
    let failed = move |error| {
        let (cause, remedy) = texts(&error);
        console.warn(&format!("{cause}; {remedy}"));
    };
    let _redirect = (!args.no_open).then(|| show(&url, failed));
    server.run();
    Ok(())
}

fn prompts() -> Result<PromptCompiler, Failure> {
    Ok(PromptCompiler::embedded(&Backend::Portable)?)
}

fn write(
    collection: Collection,
    module: Option<Module>,
    folder: &Path,
    console: Console,
) -> Result<(), Failures> {
    let bar = console.rated_bar(collection.textures(), "textures");
    let written = export(
        collection,
        module.map(|module| (module, prompts as LoadPrompts)),
        folder,
        || bar.inc(1),
    );
    bar.finish_and_clear();
    let written = written.map_err(one)?;
    let report = format!(
        "{folder}: {textures} in {files}, {size}\nAny web server can serve it; to try it here, run \
         `python3 -m http.server -b 127.0.0.1 -d {folder} 8000` and open http://127.0.0.1:8000/\n",
        folder = display(folder),
        textures = counted(written.textures, "texture", "textures"),
        files = counted(written.files, "file", "files"),
        size = size(written.bytes),
    );
    console.report(&report).map_err(one)
}
