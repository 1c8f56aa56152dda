//! All that a command writes.

use super::{
    atomic::AtomicFile,
    error::{OpenError, OutputError},
    identity::Identity,
    stream::is_standard_output,
    unfinished::unfinished,
};
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

/// The files that a command writes: all of them, or none.
///
/// Every command opens its outputs here, before its work. What would destroy an input, another
/// output or a protected file is refused then.
///
/// ```no_run
/// use asperity_io::output::Outputs;
/// use std::path::Path;
///
/// let mut outputs = Outputs::beside([Path::new("in.xml")]);
/// let asset = outputs.open(Path::new("out.asp"))?;
/// outputs.fill(asset, b"...")?;
/// outputs.commit()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Outputs {
    inputs: Vec<Identity>,
    opened: Vec<Opened>,
    /// Which of them a place or a file is, so that many outputs take no longer each than few.
    places: HashMap<(PathBuf, String), usize>,
    files: HashMap<u64, Vec<usize>>,
}

#[derive(Debug)]
struct Opened {
    path: PathBuf,
    identity: Identity,
    file: AtomicFile,
}

/// Handle of an output, valid for the [`Outputs`] that returned it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutputId(usize);

impl Outputs {
    /// No output yet, of a command that reads these files; `-` is standard input.
    pub fn beside<P: AsRef<Path>>(inputs: impl IntoIterator<Item = P>) -> Self {
        Self {
            inputs: inputs
                .into_iter()
                .map(|path| Identity::of_input(path.as_ref()))
                .collect(),
            opened: Vec::new(),
            places: HashMap::new(),
            files: HashMap::new(),
        }
    }

    /// Opens an output; `-` is standard output.
    ///
    /// # Errors
    /// [`OpenError`] for an output that is an input or another output, by whatever path or link
    /// it is reached, for a second one to standard output, and where it cannot be written.
    pub fn open(&mut self, path: &Path) -> Result<OutputId, OpenError> {
        let identity = Identity::of_output(path);
        let fail = |other| OpenError::Same {
            output: path.to_owned(),
            other,
        };
        if self.inputs.iter().any(|input| input.is(&identity)) {
            return Err(fail("an input"));
        }
        if is_standard_output(path) {
            if self.to_standard_output() {
                return Err(OpenError::TwoToStandardOutput);
            }
        } else if identity.is(&Identity::standard_output()) {
            return Err(fail("standard output"));
        }
        let place = identity.caseless();
        if let Some(&other) = place.as_ref().and_then(|place| self.places.get(place)) {
            let other = &self.opened[other];
            if other.identity.is(&identity) {
                return Err(fail("another output"));
            }
            return Err(OpenError::Case {
                output: path.to_owned(),
                other: other.path.clone(),
            });
        }
        let there = identity.hashed();
        let alike = there.and_then(|hash| self.files.get(&hash));
        let is_same = |&other: &usize| self.opened[other].identity.is(&identity);
        if alike.is_some_and(|alike| alike.iter().any(is_same)) {
            return Err(fail("another output"));
        }
        let file = AtomicFile::create(path)?;
        let own = self.opened.len();
        if let Some(place) = place {
            self.places.insert(place, own);
        }
        if let Some(hash) = there {
            self.files.entry(hash).or_default().push(own);
        }
        self.opened.push(Opened {
            path: path.to_owned(),
            identity,
            file,
        });
        Ok(OutputId(self.opened.len() - 1))
    }

    /// Opens an output that a user may not want.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_if(&mut self, path: Option<&Path>) -> Result<Option<OutputId>, OpenError> {
        path.map(|path| self.open(path)).transpose()
    }

    /// Returns true if an output goes to standard output, which then has no room for a report.
    #[must_use]
    pub fn to_standard_output(&self) -> bool {
        self.opened
            .iter()
            .any(|output| output.file.is_standard_output())
    }

    /// An output, to be written to.
    ///
    /// # Panics
    /// If other outputs gave the id.
    pub fn file(&mut self, id: OutputId) -> &mut AtomicFile {
        &mut self.opened[id.0].file
    }

    /// Writes all of `bytes` to an output.
    ///
    /// # Errors
    /// [`OutputError`] with the output.
    pub fn fill(&mut self, id: OutputId, bytes: &[u8]) -> Result<(), OutputError> {
        self.file(id).fill(bytes)
    }

    /// Makes all that was written the targets: first what goes to pipes and devices, then the
    /// files.
    ///
    /// # Errors
    /// [`OutputError`]. Every file is then as it was, unless it was the renaming that failed.
    pub fn commit(mut self) -> Result<(), OutputError> {
        for output in &mut self.opened {
            output.file.release()?;
        }
        // Under the lock: an interrupt waits until every file has its name.
        let mut list = unfinished();
        let renamed = self
            .opened
            .iter_mut()
            .try_for_each(|output| output.file.rename(&mut list));
        drop(list);
        renamed
    }
}
