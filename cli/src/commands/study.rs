//! `asperity study`.

use super::studio::prompts;
use crate::cli::{CheckStudy, RunStudy, SimulateStudy};
use asperity_console::{Console, on_interrupt};
use asperity_io::{
    diagnostic::{Failures, one, texts},
    output::display,
    shown::counted,
};
use asperity_studio::{Limits, Server, Study, StudyHost, show};
use std::path::Path;

pub(crate) fn check(args: &CheckStudy, console: Console) -> Result<(), Failures> {
    let outline = open(&args.study, console)?.outline();
    if args.json {
        let json = serde_json::json!(outline);
        return console.json(&json).map_err(one);
    }
    let mut parts = vec![counted(outline.ratings, "rating", "ratings")];
    if outline.forms > 0 {
        parts.push(counted(outline.forms, "form", "forms"));
    }
    if outline.prompts > 0 {
        parts.push(counted(outline.prompts, "prompt", "prompts"));
    }
    let balanced = outline.balanced_after.map_or_else(String::new, |count| {
        format!(
            "The orders are balanced after every {}.\n",
            counted(count, "participant", "participants")
        )
    });
    let report = format!(
        "{}: {}\nA participant: {} in about {:.0} min\n{balanced}",
        outline.title,
        counted(outline.textures, "texture", "textures"),
        parts.join(", "),
        outline.minutes.ceil(),
    );
    console.text(&report).map_err(one)
}

pub(crate) fn run(args: &RunStudy, console: Console) -> Result<(), Failures> {
    let study = open(&args.study, console)?;
    let said = move |text: &str| console.aside(&format!("{text}\n"));
    let host = StudyHost::open(study, &args.output, None, said).map_err(one)?;
    let server = Server::bind(args.port, host, Limits::default()).map_err(one)?;
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

pub(crate) fn simulate(args: &SimulateStudy, console: Console) -> Result<(), Failures> {
    let study = open(&args.study, console)?;
    let participants = args.participants as usize;
    let bar = console.bar(participants, "participants");
    let simulated = study.simulate(participants, args.seed, &args.output, || bar.inc(1));
    bar.finish_and_clear();
    simulated.map_err(one)?;
    let people = counted(
        participants,
        "simulated participant",
        "simulated participants",
    );
    console
        .report(&format!("{}: {people}\n", display(&args.output)))
        .map_err(one)
}

/// A study with its textures, which are compiled.
fn open(path: &Path, console: Console) -> Result<Study, Failures> {
    let activity = console.activity();
    let study = Study::open(path, prompts, || activity.tick());
    activity.finish_and_clear();
    study
}
