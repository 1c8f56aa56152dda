//! All that a command writes.

use super::{
    atomic::AtomicFile,
    error::{OpenError, OutputError},
    identity::Identity,
    stream::is_standard_output,
    unfinished::unfinished,
};
use std::path::{Path, PathBuf};

/// The files that a command writes: all of them, or none.
///
/// Every command opens its outputs here, before its work. What would destroy an input, another
/// output or a protected file is refused then.
///
/// ```no_run
/// use asperity::output::Outputs;
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
}

#[derive(Debug)]
struct Opened {
    path: PathBuf,
    identity: Identity,
    file: AtomicFile,
}

/// One of the [`Outputs`] that gave it.
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
        for other in &self.opened {
            if other.identity.is(&identity) {
                return Err(fail("another output"));
            }
            if other.identity.differs_in_case_from(&identity) {
                return Err(OpenError::Case {
                    output: path.to_owned(),
                    other: other.path.clone(),
                });
            }
        }
        self.opened.push(Opened {
            path: path.to_owned(),
            identity,
            file: AtomicFile::create(path)?,
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

    /// Whether one of them goes to standard output, which then has no room for a report.
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
