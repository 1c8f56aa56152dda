//! `asperity compile`.

use super::{
    diffusion,
    one_texture::{Job, RequestedOutputs, request},
};
use crate::cli::Compile;
use asperity::{
    learned::inference::BackendName,
    pipeline::Request,
    sources::{
        Tools,
        latents::{LatentEditor, Scale, explain},
        prompt::{self, CompiledPrompt, Picture, Prompt},
    },
    views::{
        diffusion::{Request as PictureRequest, files, framed},
        preview,
    },
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{display, is_standard_output},
    shown::shell_word,
};
use std::path::Path;

pub(crate) fn run(args: &Compile, console: Console) -> Result<(), Failures> {
    // Before half a second of loading.
    prompt::check(&args.prompt).map_err(one)?;
    let mut inputs = args.inference.setup().files();
    inputs.extend(args.diffusion.iter().flat_map(|folder| files(folder)));
    let requested = RequestedOutputs {
        emit_model: args.emit_model.as_deref(),
        plot: args.plot.as_deref(),
        ..RequestedOutputs::of(&args.output, args.reporting)
    };
    let job = Job::open(requested, &inputs, console)?;
    let prompt_compiler = args.inference.setup().prompt_compiler()?;
    let request = Request {
        name: args.name.clone(),
        ..request(args.fidelity, args.rate, &args.preview)
    };
    let picture = match &args.diffusion {
        Some(folder) => {
            let drawn = diffusion::drawn(
                folder,
                BackendName::OnnxRuntime,
                PictureRequest::new(framed(args.prompt.trim()), args.seed),
                Some(args.preview.preview_size.unwrap_or(preview::SIZE)),
                job.console,
            )?;
            Some(Picture {
                png: drawn.compact_png().map_err(one)?,
                made: drawn.note,
            })
        }
        None => None,
    };
    let source = Prompt {
        text: args.prompt.clone(),
        seed: args.seed,
        picture,
    };
    let compiled = job.compile(&source, &request, &Tools::of(&prompt_compiler))?;
    let mut json = compiled.json();
    let scale = Scale::of(prompt_compiler.model().description());
    let summary = compiled.found::<CompiledPrompt>();
    let summary = summary.map(|found| found.summary(&compiled, &scale));
    let mut text = format!("{}\n{}", display(&args.output), summary.unwrap_or_default());
    if let Some(Picture { made, .. }) = &source.picture {
        json["preview"] = made.as_str().into();
        text += &format!("  preview      {made}\n");
    }
    let mut words = String::new();
    if args.explain {
        let explanation =
            explain(&LatentEditor::new(&prompt_compiler), &args.prompt).map_err(one)?;
        explanation.add_to(&mut json);
        words = explanation.text();
    }
    if !is_standard_output(&args.output) {
        text += &next(&args.output);
    }
    job.finish(&compiled, json, &text, &words)
}

/// Returns suggested follow-up commands for an asset.
fn next(asset: &Path) -> String {
    let quoted = |path: &Path| shell_word(&display(path).to_string()).into_owned();
    let beside = |extension: &str| quoted(&asset.with_extension(extension));
    let asset = quoted(asset);
    format!(
        "  try          asperity plot {asset} -o {}\n               asperity listen {asset} -o {}\n               \
         asperity edit {asset} --rougher 20 -o {}\n",
        beside("png"),
        beside("wav"),
        beside("rougher.asp"),
    )
}
