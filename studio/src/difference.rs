//! Differences between two libraries. Textures are compared in pairs, so that neither library is in memory as a whole.

use crate::{
    collection::Collection,
    error::{ApiError, refused},
};
use asperity::library::{Difference, LoadedLibrary, diff};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Returns the output of `asperity diff --json` for two libraries.
///
/// # Errors
/// As the command.
pub(crate) fn difference(old: &Collection, now: &Collection) -> Result<String, ApiError> {
    let (before, after) = (places(old), places(now));
    let gone = |name: &&str| !after.contains_key(name);
    let removed = before.keys().copied().filter(gone).map(str::to_owned);
    let new = |name: &&str| !before.contains_key(name);
    let added = after.keys().copied().filter(new).map(str::to_owned);
    let mut all = Difference {
        added: added.collect(),
        removed: removed.collect(),
        ..Difference::default()
    };
    let both: Vec<(&str, usize, usize)> = before
        .iter()
        .filter_map(|(name, from)| Some((*name, *from, *after.get(name)?)))
        .collect();
    let compared: Vec<Result<Difference, ApiError>> = both
        .par_iter()
        .map(|&(name, from, to)| compared(name, old.asset(from)?, now.asset(to)?))
        .collect();
    for pair in compared {
        let pair = pair?;
        all.same += pair.same;
        all.changed.extend(pair.changed);
    }
    // Plain structures of numbers and strings always serialise.
    let json = serde_json::to_value(&all).unwrap_or_default();
    Ok(format!("{json:#}\n"))
}

/// Places by name. Of two with one name, as a folder may have them, the last counts.
fn places(collection: &Collection) -> BTreeMap<&str, usize> {
    let names = collection.names().enumerate();
    names.map(|(at, name)| (name, at)).collect()
}

/// Compares the versions of a texture.
fn compared(name: &str, old: Vec<u8>, now: Vec<u8>) -> Result<Difference, ApiError> {
    let alone = |bytes: Vec<u8>| LoadedLibrary {
        shown: String::new(),
        textures: vec![(name.to_owned(), bytes)],
        is_library: true,
        has_scene: false,
    };
    diff(&alone(old), &alone(now)).map_err(|fault| refused(&fault))
}
