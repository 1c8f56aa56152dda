//! Implementation of the commands.

use crate::{
    cli::{self, Cli, Command, Recipe},
    console::{self, Bar},
    setup,
};
use asperity::learned::{
    inference::{Backend, not_installed},
    text::TextEncoder,
};
use asperity_corpus::{Corpus, reference::LexiconEntry};
use asperity_io::diagnostic::{Diagnostic, Failure};
use asperity_train::{
    Captions, Config, FitError, Metrics, ModelFiles, Remembered, config::CorpusKind,
    evaluate::CorpusSource, export, fit_on, measure, on_threads,
};
use thiserror::Error;

/// A wrong combination of options.
#[derive(Debug, Error)]
enum UsageError {
    #[error("corpus.kind = \"hatt\" without a folder")]
    NoHattFolder,
    #[error("corpus.kind = \"hatt\" and --corpus")]
    ReferenceFolder,
}

impl Diagnostic for UsageError {
    fn remedy(&self) -> String {
        match self {
            Self::NoHattFolder => "give your folder of HaTT models with --hatt DIR".into(),
            Self::ReferenceFolder => "leave --corpus out, or choose another --config".into(),
        }
    }

    fn is_usage(&self) -> bool {
        true
    }
}

pub(crate) fn run(cli: Cli) -> Result<(), Failure> {
    match cli.command {
        Command::Fit(args) => fit(&args),
        Command::Evaluate(args) => crate::evaluate::run(&args),
        Command::Config(args) => {
            let text = match args.name {
                Recipe::Paper => asperity_train::config::PAPER,
                Recipe::Reference => asperity_train::config::REFERENCE,
                Recipe::Hatt => asperity_train::config::HATT,
            };
            Ok(console::print(text)?)
        }
    }
}

fn fit(args: &cli::Fit) -> Result<(), Failure> {
    let config = configuration(args)?;
    ModelFiles::check(&args.output)?;
    console::listen()?;
    let backend = Backend::open(args.backend).map_err(not_installed)?;
    let encoder = setup::text_encoder(&args.text_encoder, &backend)?;
    let threads = setup::threads(args.threads);
    let mut bar = Bar::new(args.quiet, config.optimiser.epochs);
    let metrics = on_threads(threads, || train(args, &config, encoder.as_ref(), &mut bar));
    bar.clear();
    report(args, &metrics??)
}

fn train(
    args: &cli::Fit,
    config: &Config,
    encoder: &dyn TextEncoder,
    bar: &mut Bar,
) -> Result<Metrics, Failure> {
    let (corpus, mut lexicon) = source(args, config)?.load(config, config.seed, 0)?;
    if config.text_stage.is_none() {
        // Nothing reads it, and it is two thirds of the texts.
        lexicon.clear();
    }
    let captions = captions(args, &corpus, &lexicon, encoder)?;
    let all: Vec<usize> = (0..corpus.materials.len()).collect();
    let trained = fit_on(&corpus, &all, &captions, config, bar)?;
    let metrics = measure(&trained, &corpus, &captions);
    let files = export(&trained, &corpus, &captions, &metrics)?;
    files.write(&args.output)?;
    Ok(metrics)
}

/// Encodes the texts, but for those that a file already holds.
fn captions(
    args: &cli::Fit,
    corpus: &Corpus,
    lexicon: &[LexiconEntry],
    encoder: &dyn TextEncoder,
) -> Result<Captions, FitError> {
    let Some(path) = &args.vectors else {
        return Captions::encode(corpus, lexicon, encoder);
    };
    let remembered = if path.exists() {
        Remembered::load(encoder, path)?
    } else {
        Remembered::new(encoder)
    };
    let captions = Captions::encode(corpus, lexicon, &remembered)?;
    remembered.save(path)?;
    Ok(captions)
}

fn configuration(args: &cli::Fit) -> Result<Config, Failure> {
    let mut config = Config::find(&args.config)?;
    if args.hatt.is_some() {
        config.corpus.kind = CorpusKind::Hatt;
    }
    if let Some(constants) = args.constants {
        config.corpus.constants = constants.into();
    }
    if let Some(seed) = args.seed {
        config.seed = seed;
    }
    if let Some(epochs) = args.epochs {
        config.optimiser.epochs = epochs;
    }
    config.validate()?;
    Ok(config)
}

fn source(args: &cli::Fit, config: &Config) -> Result<CorpusSource, UsageError> {
    match (config.corpus.kind, &args.corpus, &args.hatt) {
        (CorpusKind::Reference, folder, _) => Ok(CorpusSource::Reference(folder.clone())),
        (CorpusKind::Hatt, Some(_), _) => Err(UsageError::ReferenceFolder),
        (CorpusKind::Hatt, None, None) => Err(UsageError::NoHattFolder),
        (CorpusKind::Hatt, None, Some(folder)) => Ok(CorpusSource::Hatt(folder.clone())),
    }
}

fn report(args: &cli::Fit, metrics: &Metrics) -> Result<(), Failure> {
    let text = if args.json {
        match serde_json::to_string_pretty(metrics) {
            Ok(json) => json + "\n",
            Err(_) => String::new(),
        }
    } else {
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        format!(
            "{}: loss {:.4}; explained: LSFs {}, excitation {}, taps {}; {} active units; \
             found by captions: training {}, held out {} (first), {} (first five)\n",
            args.output.display(),
            metrics.loss.total,
            percent(metrics.lsf_explained),
            percent(metrics.excitation_explained),
            percent(metrics.taps_explained),
            metrics.active_units,
            percent(metrics.training.top_1),
            percent(metrics.held_out.top_1),
            percent(metrics.held_out.top_5),
        )
    };
    Ok(console::print(&text)?)
}
