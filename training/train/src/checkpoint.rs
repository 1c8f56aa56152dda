//! A run on disk, between two epochs.
//!
//! Every epoch draws from streams of its own, so parameters, the optimiser's moments and
//! the history are the whole state: a run that is resumed ends as one that was not
//! interrupted.

use crate::{
    captions::Captions,
    config::{Config, Evaluation, Friction},
    error::FitError,
    progress::EpochLoss,
    vae::State,
    weights::{self, Read, Table},
};
use asperity_corpus::Corpus;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Numbers of a row of the history.
const TERMS: usize = 9;

/// Stands in an identity for what the first stage does not depend on.
const FIXED: (Friction, Evaluation) = (
    Friction {
        top_k: 1,
        temperature: 1.0,
    },
    Evaluation { folds: 2 },
);

/// Identity of a checkpoint's run: only an identical run can resume it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Identity {
    /// Corpus and its checksum.
    corpus: String,
    /// Materials trained on.
    materials: Vec<usize>,
    /// Text encoder.
    encoder: String,
    /// The configuration, but for what comes after the first stage.
    config: Config,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Note {
    identity: Identity,
    steps: u64,
}

impl Identity {
    pub(crate) fn new(
        corpus: &Corpus,
        materials: &[usize],
        captions: &Captions,
        config: &Config,
    ) -> Self {
        let config = Config {
            text_stage: None,
            friction: FIXED.0,
            evaluation: FIXED.1,
            ..config.clone()
        };
        Self {
            corpus: format!("{} {:08x}", corpus.name, corpus.crc32),
            materials: materials.to_vec(),
            encoder: format!("{} {}", captions.encoder, captions.width),
            config,
        }
    }
}

/// Writes the state, all or nothing.
pub(crate) fn save(path: &Path, identity: &Identity, state: &State) -> Result<(), FitError> {
    let fail = |message: String| FitError::Checkpoint {
        path: path.to_owned(),
        message,
    };
    let mut tables = weights::tables("value", &state.parameters);
    let moments = state.adam.first.iter().zip(&state.adam.second);
    for (parameter, (first, second)) in state.parameters.iter().zip(moments) {
        for (kind, values) in [("first", first), ("second", second)] {
            let table = Table::new(values, parameter.columns);
            tables.push((format!("{kind}.{}", parameter.name), table));
        }
    }
    let history: Vec<f32> = state.history.iter().flat_map(terms).collect();
    tables.push(("history".into(), Table::new(&history, TERMS)));
    let note = serde_json::to_string(&Note {
        identity: identity.clone(),
        steps: state.adam.steps,
    });
    let note = note.map_err(|e| fail(e.to_string()))?;
    let bytes = weights::write(&tables, &note).map_err(fail)?;
    Ok(asperity_io::output::write_atomic(path, &bytes)?)
}

/// Brings a fresh state of the same run to where the file left off.
pub(crate) fn load(path: &Path, identity: &Identity, state: &mut State) -> Result<(), FitError> {
    let fail = |message: String| FitError::Checkpoint {
        path: path.to_owned(),
        message,
    };
    let bytes = std::fs::read(path).map_err(|e| fail(e.to_string()))?;
    let mut read = Read::new(&bytes).map_err(fail)?;
    let note: Note = serde_json::from_str(&read.note).map_err(|e| fail(e.to_string()))?;
    if let Some(field) = difference(&note.identity, identity) {
        return Err(fail(format!("belongs to a run with another {field}")));
    }
    let moments = state.adam.first.iter_mut().zip(&mut state.adam.second);
    for (parameter, (first, second)) in state.parameters.iter_mut().zip(moments) {
        let count = parameter.values.len();
        let mut take = |kind: &str| read.take(&format!("{kind}.{}", parameter.name), count);
        *first = take("first").map_err(fail)?;
        *second = take("second").map_err(fail)?;
        parameter.values = take("value").map_err(fail)?;
    }
    let history = read.take_any("history").map_err(fail)?;
    state.history = history.as_chunks::<TERMS>().0.iter().map(loss).collect();
    state.adam.steps = note.steps;
    Ok(())
}

fn difference(old: &Identity, new: &Identity) -> Option<&'static str> {
    [
        ("corpus", old.corpus != new.corpus),
        ("choice of materials", old.materials != new.materials),
        ("text encoder", old.encoder != new.encoder),
        ("configuration", old.config != new.config),
    ]
    .into_iter()
    .find_map(|(field, differs)| differs.then_some(field))
}

fn terms(loss: &EpochLoss) -> [f32; TERMS] {
    [
        loss.total,
        loss.ar,
        loss.excitation,
        loss.taps,
        loss.kl,
        loss.contrastive,
        loss.alignment,
        loss.compactness,
        loss.friction,
    ]
}

fn loss(terms: &[f32; TERMS]) -> EpochLoss {
    let [
        total,
        ar,
        excitation,
        taps,
        kl,
        contrastive,
        alignment,
        compactness,
        friction,
    ] = terms;
    EpochLoss {
        total: *total,
        ar: *ar,
        excitation: *excitation,
        taps: *taps,
        kl: *kl,
        contrastive: *contrastive,
        alignment: *alignment,
        compactness: *compactness,
        friction: *friction,
    }
}
