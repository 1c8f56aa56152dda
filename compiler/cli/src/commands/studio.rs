//! `asperity studio`.

use crate::cli::Studio as Arguments;
use asperity::{inference::Backend, prompt::PromptCompiler};
use asperity_console::{Console, on_interrupt};
use asperity_io::diagnostic::{Failures, one, texts};
use asperity_studio::{Collection, Limits, Server, Studio, show};

pub(crate) fn run(args: &Arguments, console: Console) -> Result<(), Failures> {
    let collection = args
        .collection
        .as_deref()
        .map(Collection::open)
        .transpose()?;
    let studio = Studio::new(
        collection,
        Some(|| Ok(PromptCompiler::embedded(&Backend::Portable)?)),
    );
    let server = Server::bind(args.port, studio, Limits::default()).map_err(one)?;
    let stopper = server.stopper();
    on_interrupt(move || stopper.stop()).map_err(one)?;
    let url = server.url();
    console.text(&format!("{url}\n")).map_err(one)?;
    if !args.no_open {
        show(&url, move |error| {
            let (cause, remedy) = texts(&error);
            console.warn(&format!("{cause}; {remedy}"));
        });
    }
    server.run();
    Ok(())
}
