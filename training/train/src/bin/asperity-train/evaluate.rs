//! `asperity-train evaluate`.

use crate::{
    console::{self, is_interrupted},
    setup,
};
use asperity::learned::{
    inference::{Backend, BackendName, not_installed},
    text::TextEncoderChoice,
};
use asperity_io::diagnostic::Failure;
use asperity_train::{
    Config,
    evaluate::{CorpusSource, Options, Part, Watch, evaluate},
    on_threads,
};
use clap::Args;
use indicatif::ProgressBar;
use std::{num::NonZeroUsize, path::PathBuf};

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  asperity-train evaluate --model model -o report
  asperity-train evaluate --model model --parts 1,2,7 -o report
  asperity-train evaluate --model hatt-model --corpus hatt:HaTT/Models -o hatt-report
  asperity-train evaluate --model model --parts 3 --folds 3 --fold-epochs 40 -o quick

Finished parts and folds are kept in DIR/cache: after an interrupt, the same command goes on.")]
pub(crate) struct Evaluate {
    /// The model folder, as `fit` wrote it
    #[arg(long, value_name = "DIR")]
    model: PathBuf,
    /// The corpus it was trained on: `reference`, `reference:DIR` or `hatt:DIR`
    #[arg(long, default_value = "reference", value_name = "CORPUS")]
    corpus: CorpusSource,
    /// 1 clustering, 2 retrieval, 3 held-out materials, 4 words, 5 midpoints, 7 names,
    /// 8 completion
    #[arg(long, value_delimiter = ',', default_value = "1,2,3,4,5,7,8")]
    parts: Vec<Part>,
    /// Recipe of the folds instead of the model's own: `paper`, `reference`, `hatt`, or a TOML
    /// file
    #[arg(long, value_name = "NAME|FILE")]
    config: Option<String>,
    /// Folds of the cross-validation, instead of the recipe's
    #[arg(long)]
    folds: Option<usize>,
    /// Epochs of a fold's first stage, instead of the recipe's
    #[arg(long, value_name = "EPOCHS")]
    fold_epochs: Option<usize>,
    /// Folder of the report, made if need be
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// `minilm`, embedded, or `clip:DIR` with an export of CLIP's text tower
    #[arg(long, default_value = "minilm", value_name = "minilm|clip:DIR")]
    text_encoder: TextEncoderChoice,
    /// Where networks run: `portable`, or `onnxruntime` where it is installed
    #[arg(long, default_value_t, value_name = "portable|onnxruntime")]
    backend: BackendName,
    /// Threads; as many as there are cores if left out. The report does not depend on it
    #[arg(long)]
    threads: Option<NonZeroUsize>,
    /// No progress bar
    #[arg(short, long)]
    quiet: bool,
    /// Print the report as JSON instead of its headline
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Evaluate) -> Result<(), Failure> {
    let fold_config = args.config.as_deref().map(Config::find).transpose();
    let options = Options {
        model: &args.model,
        corpus: args.corpus.clone(),
        parts: args.parts.iter().copied().collect(),
        fold_config: fold_config?,
        folds: args.folds,
        fold_epochs: args.fold_epochs,
        report: &args.output,
    };
    console::listen()?;
    let backend = Backend::open(args.backend).map_err(not_installed)?;
    let encoder = setup::text_encoder(&args.text_encoder, &backend)?;
    let threads = setup::threads(args.threads);
    let mut bar = Bar(console::bar(args.quiet, 1));
    let report = on_threads(threads, || {
        evaluate(&options, encoder.as_ref(), &backend, &mut bar)
    });
    bar.0.finish_and_clear();
    let report = report??;
    let text = if args.json {
        report.json()?
    } else {
        format!("{}: report.md, report.json\n", args.output.display())
    };
    Ok(console::print(&text)?)
}

/// A bar for each stage.
struct Bar(ProgressBar);

impl Watch for Bar {
    fn begin(&mut self, what: &str, steps: usize) {
        self.0.set_prefix(what.to_owned());
        self.0.set_length(steps as u64);
        self.0.set_position(0);
        self.0.reset_eta();
    }

    fn done(&mut self, steps: usize) {
        self.0.set_position(steps as u64);
    }

    fn interrupted(&self) -> bool {
        is_interrupted()
    }
}
