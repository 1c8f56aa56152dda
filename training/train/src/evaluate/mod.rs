//! Evaluation of a trained model: a report of a model folder.
//!
//! Parts, each measured alone and kept when finished:
//! 1. `clustering`: materials in the latent, beside the paper's figures, and the information about its inputs that
//!    the latent retains;
//! 2. `retrieval`: materials found by captions never trained on;
//! 3. `held_out`: textures of materials never trained on, by k-fold cross-validation;
//! 4. `probes`: paraphrases, negations, and pairs that people rank;
//! 5. `midpoints`: latents halfway between two materials;
//! 7. `names`: materials found by their names, and by synonyms left out of training;
//! 8. `held_out`: taps completed from AR models, and AR models from taps.

mod cache;
mod clustering;
mod data;
mod error;
mod held_out;
mod midpoints;
mod names;
mod probes;
mod report;
mod retrieval;
mod signature;
mod subject;
#[cfg(test)]
mod tests;
mod texts;
mod watch;

pub use error::EvaluateError;
pub use report::Report;
pub use watch::Watch;

use crate::{attributes::Layout, captions::Captions, config::Config, statistics};
use asperity::learned::{inference::Backend, text::TextEncoder};
use asperity_corpus::{Corpus, reference::LexiconEntry};
use signature::Signature;
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    str::FromStr,
};
use subject::Subject;
use texts::Texts;

/// Where the corpus of a model comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CorpusSource {
    /// The reference corpus, embedded or of a folder.
    Reference(Option<PathBuf>),
    /// A folder of HaTT models.
    Hatt(PathBuf),
}

impl FromStr for CorpusSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once(':') {
            None if text == "reference" => Ok(Self::Reference(None)),
            Some(("reference", folder)) if !folder.is_empty() => {
                Ok(Self::Reference(Some(folder.into())))
            }
            Some(("hatt", folder)) if !folder.is_empty() => Ok(Self::Hatt(folder.into())),
            _ => Err("`reference`, `reference:DIR` or `hatt:DIR`".into()),
        }
    }
}

/// A part of the evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// 1
    Clustering,
    /// 2
    Retrieval,
    /// 3
    HeldOut,
    /// 4
    Probes,
    /// 5
    Midpoints,
    /// 7
    Names,
    /// 8
    Completion,
}

impl Part {
    /// All of them with their numbers, in their order.
    const ALL: [(u8, Self); 7] = [
        (1, Self::Clustering),
        (2, Self::Retrieval),
        (3, Self::HeldOut),
        (4, Self::Probes),
        (5, Self::Midpoints),
        (7, Self::Names),
        (8, Self::Completion),
    ];
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = text.parse().ok();
        let part = Self::ALL.iter().find(|(own, _)| Some(*own) == number);
        part.map(|(_, part)| *part)
            .ok_or_else(|| "1 to 5, 7 or 8".into())
    }
}

/// Options of an evaluation.
#[derive(Debug, Clone)]
pub struct Options<'a> {
    /// The model folder.
    pub model: &'a Path,
    /// The corpus it was trained on.
    pub corpus: CorpusSource,
    /// Which parts.
    pub parts: BTreeSet<Part>,
    /// Configuration of the folds; the model's own if `None`.
    pub fold_config: Option<Config>,
    /// Folds, instead of the configuration's.
    pub folds: Option<usize>,
    /// Epochs of a fold's first stage, instead of the configuration's.
    pub fold_epochs: Option<usize>,
    /// Folder of the report, made if need be.
    pub report: &'a Path,
}

/// Everything the parts look at.
struct Bench<'a> {
    subject: Subject,
    corpus: Corpus,
    captions: Captions,
    /// Material of every anchor.
    materials: Vec<usize>,
    /// Signatures of the anchors' materials themselves.
    signatures: Vec<Signature>,
    texts: Texts<'a>,
    config: Config,
}

/// Measures the parts asked for and writes the report: `report.md`, `report.json`,
/// pictures, and a cache by which an interrupted evaluation goes on. The same model and
/// options give the same report.
///
/// # Errors
/// [`EvaluateError`]; finished parts stay in the cache.
pub fn evaluate(
    options: &Options<'_>,
    encoder: &dyn TextEncoder,
    backend: &Backend,
    watch: &mut dyn Watch,
) -> Result<Report, EvaluateError> {
    let bench = set_up(options, encoder, backend, watch)?;
    let cache = cache::Cache::open(
        options.report,
        &format!(
            "{:08x} {:08x} {:08x}",
            bench.subject.crc32, bench.corpus.crc32, bench.texts.fingerprint
        ),
    )?;
    let asked = |part| options.parts.contains(&part);
    let mut report = Report::new(&bench);
    let (subject, materials) = (&bench.subject, &bench.materials);
    report.clustering = cache.part("clustering", "", asked(Part::Clustering), || {
        let unseen = data::unseen(&options.corpus, &bench.config)?;
        clustering::measure(
            subject,
            &bench.corpus,
            &unseen,
            materials,
            bench.config.seed,
            watch,
        )
    })?;
    report.retrieval = cache.part("retrieval", "", asked(Part::Retrieval), || {
        watch.begin("retrieval", 1);
        retrieval::measure(subject, &bench.corpus, &bench.captions, materials)
    })?;
    let config = options.fold_config.clone();
    let config = config.unwrap_or_else(|| bench.config.clone());
    let config = held_out::shortened(config, options.fold_epochs);
    config.validate()?;
    let inputs = held_out::Inputs {
        corpus: &bench.corpus,
        captions: &bench.captions,
        materials,
        signatures: &bench.signatures,
        folds: options.folds.unwrap_or(config.evaluation.folds),
        config: &config,
    };
    report.held_out = held_out::measure(&inputs, &cache, asked(Part::HeldOut), watch)?;
    let key = format!("{:08x}", cache::checksum(probes::sources()));
    report.probes = cache.part("probes", &key, asked(Part::Probes), || {
        let known = probes::Known {
            materials: &bench.signatures,
            lexicon: &bench.captions.lexicon,
        };
        probes::measure(subject, &known, &bench.texts, watch)
    })?;
    report.midpoints = cache.part("midpoints", &key, asked(Part::Midpoints), || {
        watch.begin("midpoints", 1);
        midpoints::measure(subject, &bench.signatures)
    })?;
    report.names = cache.part("names", "", asked(Part::Names), || {
        let (captions, config) = (&bench.captions, &bench.config);
        names::measure(subject, &bench.corpus, captions, materials, config, watch)
    })?;
    report.completion =
        held_out::completion::measure(&inputs, &cache, asked(Part::Completion), watch)?;
    report.write(options.report)?;
    Ok(report)
}

fn set_up<'a>(
    options: &Options<'_>,
    encoder: &'a dyn TextEncoder,
    backend: &Backend,
    watch: &mut dyn Watch,
) -> Result<Bench<'a>, EvaluateError> {
    let subject = Subject::open(options.model, backend)?;
    let text = &subject.description().text_encoder;
    let (model, given) = (
        format!("{}, {} numbers", text.name, text.width),
        format!("{}, {} numbers", encoder.name(), encoder.width()),
    );
    if model != given {
        return Err(EvaluateError::Mismatch {
            field: "text_encoder",
            model,
            given,
            remedy: "give the text encoder that the model was trained with with --text-encoder",
        });
    }
    let config = data::config_of(options.model)?;
    watch.begin("corpus", 1);
    let (corpus, lexicon) = options.corpus.load(&config, config.seed, 0)?;
    let materials = data::materials(&subject, &corpus)?;
    let texts = Texts::open(encoder, options.report)?;
    texts.learn(every_text(&corpus, &lexicon), watch)?;
    let captions = Captions::encode(&corpus, &lexicon, &texts.remembered)?;
    let layout = Layout::of(&corpus);
    let signatures = materials
        .iter()
        .map(|&m| &corpus.materials[m])
        .map(|m| Signature::of(&m.prototype, &layout, m.mu))
        .collect();
    Ok(Bench {
        subject,
        corpus,
        captions,
        materials,
        signatures,
        texts,
        config,
    })
}

fn every_text<'c>(
    corpus: &'c Corpus,
    lexicon: &'c [LexiconEntry],
) -> impl Iterator<Item = &'c str> {
    let materials = corpus.materials.iter().flat_map(|material| {
        let training = material
            .training
            .iter()
            .map(|caption| caption.text.as_str());
        let names = [&material.name].into_iter().chain(&material.synonyms);
        let others = names.chain(&material.held_out).map(String::as_str);
        training.chain(others)
    });
    materials.chain(lexicon.iter().map(|entry| entry.text.as_str()))
}
