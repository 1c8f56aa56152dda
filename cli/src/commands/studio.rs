//! `asperity studio`.

use crate::cli::Studio as Arguments;
use asperity::{
    learned::inference::Backend, library::user_folder, sources::prompt::PromptCompiler,
};
use asperity_console::{Console, on_interrupt};
use asperity_io::{
    diagnostic::{Failure, Failures, one, texts},
    output::display,
    shown::{counted, size},
};
use asperity_studio::{
    BindError, Collection, Limits, LoadPrompts, Module, Project, Server, Studio, export, show,
};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// Port of a studio that is given none.
const USUAL_PORT: u16 = 8417;

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let (projects, collections): (Vec<_>, Vec<_>) = args
        .collection
        .iter()
        .partition(|path| Project::is_one(path));
    let named = projects.first().copied().or(args.project.as_ref());
    let collection = collections
        .first()
        .map(|path| Collection::open(path))
        .transpose()?;
    match (&args.export, collection) {
        (Some(folder), Some(collection)) => {
            let module = args.compiler.as_deref().map(Module::open).transpose();
            write(collection, module.map_err(one)?, folder, console)
        }
        (_, collection) => serve(args, collection, named.map(PathBuf::as_path), console),
    }
}

fn serve(
    args: &Arguments,
    collection: Option<Collection>,
    named: Option<&Path>,
    console: Console,
) -> Result<(), Failures> {
    let mut studio = Studio::new(collection, Some(prompts));
    if let Some(project) = project(named, console)? {
        studio = studio.with_project(project);
    }
    let server = bind(args.port, studio, console).map_err(one)?;
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

/// The project that is asked for, or else the user's own, without which the studio keeps nothing.
fn project(named: Option<&Path>, console: Console) -> Result<Option<Project>, Failures> {
    if let Some(folder) = named {
        return Project::open(folder).map(Some).map_err(one);
    }
    let own = user_folder(
        "XDG_DATA_HOME",
        ".local/share",
        "Library/Application Support",
    );
    let opened = own.map(|folder| Project::open(&folder.join("studio")));
    let project = opened.transpose().unwrap_or_else(|fault| {
        console.warn(&format!(
            "{fault}; what is made is not kept: {}",
            fault.remedy
        ));
        None
    });
    Ok(project)
}

/// A server on the port that is asked for. What a browser keeps of a page is kept by its port, so there is a usual one.
fn bind(port: Option<u16>, studio: Studio, console: Console) -> Result<Server, BindError> {
    let studio = Arc::new(studio);
    let limits = Limits::default();
    if let Some(port) = port {
        return Server::bind(port, studio, limits);
    }
    Server::bind(USUAL_PORT, Arc::clone(&studio), limits).or_else(|_| {
        console.warn(&format!(
            "port {USUAL_PORT} is taken, as by another studio: on another one, the browser does not know its settings of the page"
        ));
        Server::bind(0, studio, limits)
    })
}

pub(super) fn prompts() -> Result<PromptCompiler, Failure> {
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
