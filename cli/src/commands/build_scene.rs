//! `asperity build` of a scene.

use super::{
    library::build::{Prepared, previews},
    timings,
};
use crate::cli::Build;
use asperity::{
    library::BuildFile,
    pipeline::{Clock, Pass, Pipeline},
    scene::{self, Budget, Description},
    sources::Registry,
};
use asperity_console::Console;
use asperity_io::{
    clock::now,
    diagnostic::{Failures, Fault, one},
    output::display,
    shown::counted,
};

pub(crate) fn run(args: &Build, build: BuildFile, console: Console) -> Result<(), Failures> {
    if args.shard.is_some() {
        let what = "--shard applies only to libraries, but the manifest has a [[surface]]";
        let remedy = "leave it out, or remove the surfaces";
        return Err(one(Fault::new(what, remedy).usage()));
    }
    let BuildFile { text, reach, .. } = build;
    let mut description =
        Description::within(&args.scene, &text, reach.clone(), &Registry::default())?;
    previews(args, &mut description.manifest);
    if args.check {
        let file = args.scene.display();
        let textures = counted(description.worn().len(), "texture", "textures");
        let report = format!("{file}: a scene with {textures}, no faults found\n");
        return console.report(&report).map_err(one);
    }
    let budget = Budget {
        target: args.target,
        share: args.share / 100.0,
        bytes: args.budget_bytes,
    };
    let mut build = Prepared::new(args, &description.manifest, &reach, console)?;
    let bar = build
        .console
        .rated_bar(description.worn().len(), "textures");
    let open = || build.setup.prompt_compiler();
    let built = scene::build(&description, &budget, &build.request(), &open, &|| {
        bar.inc(1)
    });
    bar.finish_and_clear();
    let built = built?;
    let mut pipeline = Pipeline::timed(Clock(now));
    pipeline.merge(&built.timings);
    pipeline
        .run(Pass::Write, || {
            build.outputs.fill(build.library, &built.bytes)?;
            build.outputs.commit()
        })
        .map_err(one)?;
    let console = build.console;
    let warnings = build.pins.told(args, built.warnings, console);
    let printed = if args.reporting.json {
        // Plain structures of numbers and strings always serialise.
        let mut json = serde_json::to_value(&built.report).unwrap_or_default();
        json["warnings"] = warnings.into();
        console.json(&json.to_string())
    } else {
        console.report(&format!("{}\n{}", display(build.output), built.report))
    };
    printed.map_err(one)?;
    timings::print(args.reporting.timings, &pipeline, console);
    Ok(())
}
