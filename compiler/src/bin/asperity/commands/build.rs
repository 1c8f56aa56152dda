//! `asperity build`.

use super::inference;
use crate::{
    cli::Build,
    console,
    failure::{Failures, one},
};
use asperity::{
    diagnostic::Diagnostic,
    model::TextureModel,
    pipeline::{Pipeline, Timings},
    prompt::{Author, Options},
    reduce::Fidelity,
    scene::{self, Budget, Description, Origin, Prompter},
};

pub(crate) fn run(args: &Build, quiet: bool) -> Result<(), Failures> {
    let description = Description::read(&args.scene).map_err(one)?;
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
    let prompter: &mut Prompter<'_> = &mut |prompt, seed| match &author {
        Some(author) => {
            let (texture, timings) = whole(author, prompt, seed)?;
            pipeline.merge(&timings);
            Ok(texture)
        }
        None => Err(Box::new(asperity::prompt::PromptError::Empty)),
    };
    let built = scene::build(&description, &budget, prompter).map_err(one)?;
    pipeline.merge(&built.timings);
    pipeline
        .write(&[(&args.output, &built.bytes)])
        .map_err(one)?;
    if !quiet {
        for name in &built.report.unused {
            eprintln!("warning: no surface wears {name:?}; it was left out");
        }
    }
    if args.json {
        // Plain structures of numbers and strings always serialise.
        let json = serde_json::to_string(&built.report).unwrap_or_default();
        console::print(&format!("{json}\n"))?;
    } else {
        console::print(&format!("{}\n{}", args.output.display(), built.report))?;
    }
    console::print_timings(args.timings, pipeline.timings());
    Ok(())
}

/// A prompt's texture with everything the decoder gave.
fn whole(
    author: &Author,
    prompt: &str,
    seed: u64,
) -> Result<(TextureModel, Timings), Box<dyn Diagnostic>> {
    let options = Options {
        seed,
        fidelity: Fidelity::Full,
        rate_hz: None,
        preview: false,
    };
    match author.author(prompt, &options) {
        Ok(authored) => Ok((authored.texture, authored.timings)),
        Err(error) => Err(Box::new(error)),
    }
}
