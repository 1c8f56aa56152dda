//! `asperity studio`.

use crate::cli::Studio as Arguments;
use asperity::{inference::Backend, prompt::PromptCompiler};
use asperity_console::{Console, on_interrupt};
use asperity_io::diagnostic::{Failures, one, texts};
use asperity_studio::{Collection, Limits, Server, Studio, has_display, open_in_browser};
use std::thread;

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
    if !args.no_open && has_display() {
        // On a thread, for it may last as long as the browser does. Where none can be started, the address is printed.
        let _ = thread::Builder::new()
            .name("browser".into())
            .spawn(move || {
                if let Err(error) = open_in_browser(&url) {
                    let (cause, remedy) = texts(&error);
                    console.warn(&format!("{cause}; {remedy}"));
                }
            });
    }
    server.run();
    Ok(())
}
