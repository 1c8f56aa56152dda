//! The corpus that a model was trained on, made again, and what it has not seen of it.

use super::{CorpusSource, EvaluateError, subject::Subject};
use crate::config::{Config, CorpusChoice};
use asperity_corpus::{
    Corpus, CorpusError, Instance, hatt,
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

/// As many instances of every material again, drawn as the others were, seen by nobody.
pub(super) fn unseen(source: &CorpusSource, config: &Config) -> Result<Corpus, CorpusError> {
    let (corpus, _) = match source {
        // Another seed draws others of the same kind.
        CorpusSource::Reference(_) => source.load(config, !config.seed, 0)?,
        CorpusSource::Hatt(_) => source.load(config, config.seed, config.corpus.instances)?,
    };
    Ok(corpus)
}

impl CorpusSource {
    /// The corpus of a configuration, instances drawn by a seed from a number on, with the lexicon.
    ///
    /// # Errors
    /// [`CorpusError`].
    pub fn load(
        &self,
        config: &Config,
        seed: u64,
        first_instance: usize,
    ) -> Result<(Corpus, Vec<LexiconEntry>), CorpusError> {
        let CorpusChoice {
            instances,
            constants,
            ..
        } = config.corpus;
        let reference = |folder, instances| {
            reference::load(&ReferenceOptions {
                folder,
                instances,
                seed,
                constants,
            })
        };
        match self {
            Self::Reference(folder) => reference(folder.clone(), instances),
            Self::Hatt(folder) => {
                let corpus = hatt::load(&hatt::HattOptions {
                    folder: folder.clone(),
                    instances,
                    first_instance,
                    seed,
                })?;
                // The everyday lexicon belongs to no corpus.
                Ok((corpus, reference(None, 1)?.1))
            }
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
