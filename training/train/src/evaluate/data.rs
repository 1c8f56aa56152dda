//! The corpus that a model was trained on, made again, and what it has not seen of it.

use super::{CorpusSource, EvaluateError, subject::Subject};
use crate::config::Config;
use asperity_corpus::{
    Corpus, Instance, hatt,
    reference::{self, LexiconEntry, ReferenceOptions},
};
use std::path::Path;

/// Reads the model folder's configuration, which the compiler does not use.
pub(super) fn config_of(model: &Path) -> Result<Config, EvaluateError> {
    let path = model.join("config.toml");
    let text = std::fs::read_to_string(&path).map_err(|source| EvaluateError::Unreadable {
        path: path.clone(),
        source,
    })?;
    Ok(Config::parse(&path.display().to_string(), &text)?)
}

/// The corpus as [`fit`](crate::fit) saw it, with the lexicon.
pub(super) fn training(
    source: &CorpusSource,
    config: &Config,
) -> Result<(Corpus, Vec<LexiconEntry>), EvaluateError> {
    load(source, config, config.corpus.instances, config.seed, 0)
}

/// As many instances of every material again, drawn as the others were, seen by nobody.
pub(super) fn unseen(source: &CorpusSource, config: &Config) -> Result<Corpus, EvaluateError> {
    let count = config.corpus.instances;
    match source {
        // Another seed draws others of the same kind.
        CorpusSource::Reference(_) => Ok(load(source, config, count, !config.seed, 0)?.0),
        CorpusSource::Hatt(_) => Ok(load(source, config, count, config.seed, count)?.0),
    }
}

fn load(
    source: &CorpusSource,
    config: &Config,
    instances: usize,
    seed: u64,
    first_instance: usize,
) -> Result<(Corpus, Vec<LexiconEntry>), EvaluateError> {
    let mut options = ReferenceOptions {
        instances,
        seed,
        constants: config.corpus.constants,
        ..ReferenceOptions::default()
    };
    match source {
        CorpusSource::Reference(folder) => {
            options.folder.clone_from(folder);
            Ok(reference::load(&options)?)
        }
        CorpusSource::Hatt(folder) => {
            let corpus = hatt::load(&hatt::HattOptions {
                instances,
                seed,
                first_instance,
                ..hatt::HattOptions::new(folder)
            })?;
            options.instances = 1;
            // The everyday lexicon belongs to no corpus.
            let (_, lexicon) = reference::load(&options)?;
            Ok((corpus, lexicon))
        }
    }
}

/// The place in the corpus of every anchor, in the order of the anchors.
///
/// # Errors
/// [`EvaluateError::Mismatch`] for a corpus that the model was not trained on.
pub(super) fn materials(subject: &Subject, corpus: &Corpus) -> Result<Vec<usize>, EvaluateError> {
    let description = subject.description();
    let mismatch = |field, model: String, given: String| EvaluateError::Mismatch {
        field,
        model,
        given,
        remedy: "give the corpus that the model was trained on with --corpus",
    };
    let (model, given) = (&description.corpus, corpus);
    if model.name != given.name {
        return Err(mismatch(
            "corpus.name",
            model.name.clone(),
            given.name.clone(),
        ));
    }
    if model.crc32 != given.crc32 {
        return Err(mismatch(
            "corpus.crc32",
            format!("{:08x}", model.crc32),
            format!("{:08x}", given.crc32),
        ));
    }
    let find = |name: &str| corpus.materials.iter().position(|m| m.name == name);
    let places = description.anchors.iter().map(|anchor| {
        find(&anchor.name)
            .ok_or_else(|| mismatch("anchors", anchor.name.clone(), "no such material".into()))
    });
    places.collect()
}

/// Instances of the materials, with the index of the anchor each belongs to.
pub(super) fn labelled<'a>(
    corpus: &'a Corpus,
    materials: &[usize],
) -> (Vec<&'a Instance>, Vec<usize>) {
    let mut instances = Vec::new();
    let mut labels = Vec::new();
    for (label, &material) in materials.iter().enumerate() {
        for instance in &corpus.materials[material].instances {
            instances.push(instance);
            labels.push(label);
        }
    }
    (instances, labels)
}
