//! `asperity build` of a scene.

use super::{inference, timings};
use crate::cli::Build;
use asperity::{
    driver::{Compiled, Failure},
    pipeline::{Pass, Pipeline, Request},
    prompt::{Author, Options, PromptError},
    scene::{self, Budget, Description, Origin, Prompter},
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Diagnostic, Failures, one},
    input::Reach,
    output::{Outputs, display},
};
use thiserror::Error;

/// Why the options do not go together.
#[derive(Debug, Error)]
#[error("{0} is for libraries, and this manifest has a [[surface]]")]
struct ForLibraries(&'static str);

impl Diagnostic for ForLibraries {
    fn remedy(&self) -> String {
        "leave it out, or remove the surfaces".into()
    }

    fn is_usage(&self) -> bool {
        true
    }
}

pub(crate) fn run(
    args: &Build,
    text: &str,
    reach: &Reach,
    console: Console,
) -> Result<(), Failures> {
    for (given, option) in [
        (args.shard.is_some(), "--shard"),
        (args.cache.is_some(), "--cache"),
        (args.locked, "--locked"),
    ] {
        if given {
            return Err(one(ForLibraries(option)));
        }
    }
    let description = Description::within(&args.scene, text, reach).map_err(one)?;
    let Some(output) = &args.output else {
        // Without an output, --check was given.
        let (file, count) = (args.scene.display(), description.textures.len());
        let report = format!("{file}: a scene of {count} textures, no fault\n");
        return console.report(&report).map_err(one);
    };
    let mut inputs = vec![args.scene.clone()];
    inputs.extend(description.sources.iter().cloned());
    inputs.extend(inference::files(&args.inference));
    let mut outputs = Outputs::beside(&inputs);
    let library = outputs.open(output).map_err(one)?;
    let console = console.beside(&outputs);
    let prompts = |texture: &scene::TextureEntry| matches!(texture.origin, Origin::Prompt(..));
    let author = description
        .textures
        .iter()
        .any(prompts)
        .then(|| inference::author(&args.inference))
        .transpose()?;
    let budget = Budget {
        target: args.target,
        share: args.share / 100.0,
        bytes: args.budget_bytes,
    };
    let mut pipeline = Pipeline::default();
    let mut warnings = Vec::new();
    let prompter: &mut Prompter<'_> = &mut |prompt, seed| match &author {
        Some(author) => match whole(author, prompt, seed) {
            Ok(authored) => {
                pipeline.merge(&authored.timings);
                let told = authored.warnings.into_iter();
                warnings.extend(told.map(|warning| format!("{prompt:?}: {warning}")));
                Ok(authored.texture)
            }
            Err(error) => Err(error),
        },
        None => Err(PromptError::Empty.into()),
    };
    let built = scene::build(&description, &budget, prompter).map_err(one)?;
    pipeline.merge(&built.timings);
    pipeline
        .run(Pass::Write, || {
            outputs.fill(library, &built.bytes)?;
            outputs.commit()
        })
        .map_err(one)?;
    let unused = built.report.unused.iter();
    warnings.extend(unused.map(|name| format!("no surface wears {name:?}; it was left out")));
    console.warnings(&warnings, args.json);
    let printed = if args.json {
        // Plain structures of numbers and strings always serialise.
        let mut json = serde_json::to_value(&built.report).unwrap_or_default();
        json["warnings"] = warnings.into();
        console.json(&json.to_string())
    } else {
        console.report(&format!("{}\n{}", display(output), built.report))
    };
    printed.map_err(one)?;
    timings::print(args.timings, &pipeline, console);
    Ok(())
}

/// A prompt's texture with everything the decoder gave.
fn whole(author: &Author, prompt: &str, seed: u64) -> Result<Compiled, Failure> {
    let options = Options {
        seed,
        request: Request::default(),
    };
    author.author(prompt, &options)
}
