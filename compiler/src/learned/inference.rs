//! Where networks run: the portable engine, or ONNX Runtime where it is installed.
//!
//! ```
//! use asperity::learned::inference::{Backend, BackendName};
//!
//! let name: BackendName = "portable".parse()?;
//! assert_eq!(Backend::open(name).expect("an engine that is always there"), Backend::Portable);
//! # Ok::<(), String>(())
//! ```

use asperity_io::diagnostic::Fault;
use asperity_nn::{Bytes, Portable, Session};
use asperity_onnxruntime::{NotFound, OnnxRuntime};
use std::{borrow::Cow, fmt, num::NonZero, path::Path, str::FromStr, thread};

/// Inference back end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Backend {
    /// The project's own engine, which gives the same bits on every machine.
    #[default]
    Portable,
    /// ONNX Runtime, if it is found at run time. It is faster, and equal within 1e-5, not to the bit.
    OnnxRuntime,
}

/// The name of a back end, as a user gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BackendName {
    /// `portable`
    #[default]
    Portable,
    /// `onnxruntime`
    OnnxRuntime,
}

impl FromStr for BackendName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "portable" => Ok(Self::Portable),
            "onnxruntime" => Ok(Self::OnnxRuntime),
            _ => Err("`portable` or `onnxruntime`".into()),
        }
    }
}

impl fmt::Display for BackendName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Portable => "portable",
            Self::OnnxRuntime => "onnxruntime",
        })
    }
}

/// Returns the fault of a command whose option asks for ONNX Runtime, which is not installed.
pub fn not_installed(error: NotFound) -> Fault {
    let remedy = format!(
        "{}, or leave --backend out for the portable engine",
        error.remedy()
    );
    Fault::new(error, remedy)
}

impl Backend {
    /// The back end of a name.
    ///
    /// # Errors
    /// [`NotFound`] when ONNX Runtime is asked for and not installed.
    pub fn open(name: BackendName) -> Result<Self, NotFound> {
        match name {
            BackendName::Portable => Ok(Self::Portable),
            BackendName::OnnxRuntime => {
                OnnxRuntime::library()?;
                Ok(Self::OnnxRuntime)
            }
        }
    }

    /// Loads a network.
    ///
    /// # Errors
    /// What the back end says of it.
    pub fn session(&self, bytes: Cow<'static, [u8]>) -> Result<Box<dyn Session>, String> {
        match self {
            Self::Portable => {
                let shared = match bytes {
                    Cow::Borrowed(bytes) => Bytes::from_static(bytes),
                    Cow::Owned(bytes) => Bytes::from(bytes),
                };
                let session = Portable::from_shared(shared).map_err(|error| error.to_string())?;
                Ok(Box::new(session))
            }
            Self::OnnxRuntime => {
                let session = OnnxRuntime::from_bytes(&bytes).map_err(|error| error.to_string())?;
                Ok(Box::new(session))
            }
        }
    }

    /// Loads a large network, whose weights may lie in files beside it. ONNX Runtime reads them
    /// itself, whatever their size, and runs them on all processors.
    ///
    /// # Errors
    /// What the back end says of it.
    pub fn session_of_file(&self, file: &Path) -> Result<Box<dyn Session>, String> {
        match self {
            Self::Portable => {
                let bytes = std::fs::read(file).map_err(|error| error.to_string())?;
                self.session(bytes.into())
            }
            Self::OnnxRuntime => {
                let threads = thread::available_parallelism().map_or(1, NonZero::get);
                let session = OnnxRuntime::from_file(file, threads);
                Ok(Box::new(session.map_err(|error| error.to_string())?))
            }
        }
    }
}
