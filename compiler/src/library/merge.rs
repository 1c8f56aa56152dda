//! Parts of a library become the library.

use super::loaded_library::LoadedLibrary;
use crate::emit::pack::{NamedAsset, encode};
use asperity_io::diagnostic::{Failures, Fault, one};
use std::collections::BTreeMap;

/// The library of all textures of these libraries: the bytes that one build gives. A texture may be
/// in several of them if it is the same everywhere.
///
/// # Errors
/// A [`Fault`] for every name that means different textures.
pub fn merge(parts: &[LoadedLibrary]) -> Result<Vec<u8>, Failures> {
    let mut all: BTreeMap<&str, (&str, &[u8])> = BTreeMap::new();
    let mut failures: Failures = Vec::new();
    for part in parts {
        for (name, bytes) in &part.textures {
            let (first, kept) = all.entry(name).or_insert((&part.shown, bytes));
            if kept != bytes {
                let what = format!(
                    "{name:?} is in both {first} and {}, but with different contents",
                    part.shown
                );
                let remedy = "rename one of them with `asperity rename`, or build all shards with one version and model";
                failures.push(Box::new(Fault::new(what, remedy)));
            }
        }
    }
    if !failures.is_empty() {
        return Err(failures);
    }
    let named: Vec<NamedAsset<'_>> = all
        .into_iter()
        .map(|(name, (_, bytes))| NamedAsset { name, bytes })
        .collect();
    encode(&named).map_err(one)
}
