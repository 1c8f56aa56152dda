//! Implementation of the commands.

use crate::{
    Failure, boxed,
    cli::{self, Cli, Command, Recipe},
    console::{self, Bar},
    setup,
};
use asperity::learned::{inference::{Backend, not_installed}, text::TextEncoder};
use asperity_corpus::{
    Corpus, hatt,
    reference::{self, LexiconEntry, ReferenceOptions},
};
use asperity_io::diagnostic::Diagnostic;
use asperity_train::{
    Captions, Checkpoints, Config, FitError, Metrics, Remembered, config::CorpusKind, export,
    fit_with_checkpoints, measure, on_threads,
};
use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// A wrong combination of options.
#[derive(Debug, Error)]
enum UsageError {
    #[error("corpus.kind = \"hatt\" without a folder")]
    NoHattFolder,
    #[error("corpus.kind = \"hatt\" and --corpus")]
    ReferenceFolder,
    #[error("--resume: no state in {}", .0.display())]
    NothingToResume(PathBuf),
    #[error("{}: holds the state of an interrupted run", .0.display())]
    WouldDiscard(PathBuf),
    #[error("--output {}: is no name of a folder", .0.display())]
    NoName(PathBuf),
}

impl Diagnostic for UsageError {
    fn remedy(&self) -> String {
        match self {
            Self::NoHattFolder => "give your folder of HaTT models with --hatt DIR".into(),
            Self::ReferenceFolder => "leave --corpus out, or choose another --config".into(),
            Self::NothingToResume(_) => "leave --resume out to start a new run".into(),
            Self::WouldDiscard(path) => format!(
                "go on with --resume, or start anew by removing {}",
                path.display()
            ),
            Self::NoName(_) => "give the path of the model folder".into(),
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
            console::print(text).map_err(boxed)
        }
    }
}

fn fit(args: &cli::Fit) -> Result<(), Failure> {
    let config = configuration(args)?;
    let state = state_folder(&args.output).map_err(boxed)?;
    let checkpoint = state.join("checkpoint.safetensors");
    match (args.resume, checkpoint.exists()) {
        (true, false) => return Err(boxed(UsageError::NothingToResume(state))),
        (false, true) => return Err(boxed(UsageError::WouldDiscard(state))),
        _ => {}
    }
    console::listen().map_err(boxed)?;
    let backend = Backend::open(args.backend).map_err(|error| boxed(not_installed(error)))?;
    let encoder = setup::text_encoder(&args.text_encoder, &backend)?;
    let threads = setup::threads(args.threads);
    let mut bar = Bar::new(args.quiet, config.optimiser.epochs);
    let checkpoints = Checkpoints {
        path: &checkpoint,
        every: args.checkpoint.into(),
        resume: args.resume,
    };
    let metrics = on_threads(threads, || {
        train(
            args,
            &config,
            encoder.as_ref(),
            &state,
            checkpoints,
            &mut bar,
        )
    });
    bar.clear();
    let metrics = metrics.map_err(boxed)??;
    if !args.keep_state {
        // The model is written: the state has served.
        let _ = fs::remove_file(&checkpoint);
        let _ = fs::remove_dir(&state);
    }
    report(args, &metrics)
}

fn train(
    args: &cli::Fit,
    config: &Config,
    encoder: &dyn TextEncoder,
    state: &Path,
    checkpoints: Checkpoints<'_>,
    bar: &mut Bar,
) -> Result<Metrics, Failure> {
    let (corpus, mut lexicon) = corpus(args, config)?;
    if config.text_stage.is_none() {
        // Nothing reads it, and it is two thirds of the texts.
        lexicon.clear();
    }
    let captions = captions(args, &corpus, &lexicon, encoder).map_err(boxed)?;
    let made = make_folder(state)?;
    let all: Vec<usize> = (0..corpus.materials.len()).collect();
    let trained = fit_with_checkpoints(&corpus, &all, &captions, config, checkpoints, bar);
    if made && trained.is_err() {
        // Goes only if nothing was saved into it.
        let _ = fs::remove_dir(state);
    }
    let trained = trained.map_err(boxed)?;
    let metrics = measure(&trained, &corpus, &captions);
    let files = export(&trained, &corpus, &captions, &metrics).map_err(boxed)?;
    files.write(&args.output).map_err(boxed)?;
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
    let mut config = Config::find(&args.config).map_err(boxed)?;
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
    config.validate().map_err(boxed)?;
    Ok(config)
}

fn corpus(args: &cli::Fit, config: &Config) -> Result<(Corpus, Vec<LexiconEntry>), Failure> {
    let mut options = ReferenceOptions {
        folder: args.corpus.clone(),
        instances: config.corpus.instances,
        seed: config.seed,
        constants: config.corpus.constants,
        ..ReferenceOptions::default()
    };
    if config.corpus.kind == CorpusKind::Reference {
        return reference::load(&options).map_err(boxed);
    }
    if args.corpus.is_some() {
        return Err(boxed(UsageError::ReferenceFolder));
    }
    let folder = args
        .hatt
        .clone()
        .ok_or(UsageError::NoHattFolder)
        .map_err(boxed)?;
    let corpus = hatt::load(&hatt::HattOptions {
        instances: config.corpus.instances,
        seed: config.seed,
        ..hatt::HattOptions::new(folder)
    });
    // The everyday lexicon belongs to no corpus.
    options.instances = 1;
    let (_, lexicon) = reference::load(&options).map_err(boxed)?;
    Ok((corpus.map_err(boxed)?, lexicon))
}

/// `DIR.training`, beside the model folder.
fn state_folder(output: &Path) -> Result<PathBuf, UsageError> {
    let name = output
        .file_name()
        .ok_or_else(|| UsageError::NoName(output.to_owned()))?;
    let mut name: OsString = name.to_owned();
    name.push(".training");
    Ok(output.with_file_name(name))
}

/// Creates the folder if it is missing. Returns true if it did.
fn make_folder(folder: &Path) -> Result<bool, Failure> {
    if folder.is_dir() {
        return Ok(false);
    }
    fs::create_dir(folder).map_err(|source| {
        boxed(FitError::from(asperity_io::output::OutputError {
            path: folder.to_owned(),
            doing: "cannot create the folder for the run's state",
            source,
        }))
    })?;
    Ok(true)
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
    console::print(&text).map_err(boxed)
}
