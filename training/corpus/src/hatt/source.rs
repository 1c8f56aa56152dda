//! Reads a folder: parses every file and converts every model that vibrates.

use super::{
    ar::{self, Sounding},
    interpolation::OwnGrid,
};
use crate::{SAMPLE_RATE_HZ, error::HattCorpusError};
use asperity::sources::hatt;
use asperity_io::diagnostic::Fault;
use rayon::prelude::*;
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

/// A material as its file states it, in the models of the corpus.
#[derive(Debug)]
pub(super) struct Source {
    pub file: PathBuf,
    pub bytes: Vec<u8>,
    pub name: String,
    pub mu: f64,
    pub own: OwnGrid,
}

/// All materials of a folder, in order of file name.
pub(super) fn read(folder: &Path) -> Result<Vec<Source>, HattCorpusError> {
    let files = hatt::files(folder)?;
    let results: Vec<_> = files.par_iter().map(|file| read_file(file)).collect();
    // Report the first fault in order of file name, whatever the thread count.
    let sources = results.into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut first_with: HashMap<&str, &Path> = HashMap::new();
    for source in &sources {
        if let Some(other) = first_with.insert(&source.name, &source.file) {
            let what = format!("material {:?} is also in {}", source.name, other.display());
            let fault = Fault::new(what, "keep one of the two files");
            return Err(fault.at(&source.file).into());
        }
    }
    Ok(sources)
}

fn read_file(file: &Path) -> Result<Source, HattCorpusError> {
    let bytes = hatt::bytes(file)?;
    let material = hatt::parse(file, &bytes)?;
    if material.sample_rate_hz != SAMPLE_RATE_HZ {
        return Err(HattCorpusError::SampleRate {
            file: file.to_owned(),
            found: material.sample_rate_hz,
        });
    }
    let models = material
        .models
        .iter()
        .enumerate()
        .map(
            |(index, model)| -> Result<Option<Sounding>, HattCorpusError> {
                if !ar::sounds(model) {
                    return Ok(None);
                }
                let converted = ar::convert(model);
                converted.map(Some).ok_or(HattCorpusError::Unconvertible {
                    file: file.to_owned(),
                    model: index + 1,
                })
            },
        )
        .collect::<Result<_, _>>()?;
    let own = OwnGrid {
        models,
        places: material
            .models
            .iter()
            .map(|m| (m.speed_mm_s, m.force_n))
            .collect(),
        triangles: material.triangles,
        corner: (material.max_speed_mm_s, material.max_force_n),
    };
    if own.samples().next().is_none() {
        return Err(HattCorpusError::Silent {
            file: file.to_owned(),
        });
    }
    Ok(Source {
        file: file.to_owned(),
        bytes,
        name: material.name,
        mu: material.mu,
        own,
    })
}
