//! Our captions for HaTT's materials; only the names are HaTT's.

use crate::{Caption, CorpusError, generator::Physical, reference};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Name of the file in error messages.
const FILE: &str = "training/corpora/hatt/captions.toml";
/// The committed file.
pub(super) const EMBEDDED: &str = include_str!("../../../corpora/hatt/captions.toml");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    material: Vec<Captioned>,
}

/// Our description of a material.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Captioned {
    /// Name as HaTT writes it.
    pub name: String,
    /// Family, one that [`super::tap::loss_factor`] knows.
    pub family: String,
    /// Material of the reference corpus that the name means.
    pub reference: String,
    /// Our estimate of hardness, 0–100.
    pub hard: f64,
    /// Captions to train on.
    pub training: Vec<Caption>,
    /// Captions never trained on.
    pub held_out: Vec<String>,
}

/// Returns the physical parameters in the reference corpus of the material that each HaTT name means.
///
/// # Errors
/// [`CorpusError::Syntax`], [`CorpusError::Faults`] for a `reference` that no material has.
pub fn physical_by_name() -> Result<BTreeMap<String, Physical>, CorpusError> {
    let known = reference::physical()?;
    let mut found = BTreeMap::new();
    for (name, captioned) in all()? {
        let Some(physical) = known.get(&captioned.reference) else {
            let what = format!(
                "{FILE}: {name}: reference = {:?} is no material",
                captioned.reference
            );
            return Err(CorpusError::Faults { faults: vec![what] });
        };
        found.insert(name, *physical);
    }
    Ok(found)
}

/// All captioned materials by name.
///
/// # Errors
/// [`CorpusError::Syntax`], [`CorpusError::Faults`].
pub(super) fn all() -> Result<BTreeMap<String, Captioned>, CorpusError> {
    let file: File = toml::from_str(EMBEDDED).map_err(|error| CorpusError::Syntax {
        file: FILE.into(),
        message: error.to_string(),
    })?;
    let mut by_name = BTreeMap::new();
    let mut faults = Vec::new();
    for entry in file.material {
        let mut fault = |what: String| faults.push(format!("{FILE}: {}: {what}", entry.name));
        if !(0.0..=100.0).contains(&entry.hard) {
            fault(format!("hard = {} is not in 0..=100", entry.hard));
        }
        if super::tap::loss_factor(&entry.family).is_none() {
            fault(format!("family = {:?} has no loss factor", entry.family));
        }
        if entry.training.is_empty() || entry.held_out.is_empty() {
            fault("no training or no held_out caption".into());
        }
        if by_name.contains_key(&entry.name) {
            fault("name appears twice".into());
        }
        by_name.insert(entry.name.clone(), entry);
    }
    if faults.is_empty() {
        Ok(by_name)
    } else {
        Err(CorpusError::Faults { faults })
    }
}
