//! Where networks run: the portable engine, or ONNX Runtime where it is installed.

use asperity_nn::{Portable, Session};
use std::{borrow::Cow, fmt, str::FromStr, sync::Arc};

/// A back end.
#[derive(Debug, Clone, Default)]
pub enum Backend {
    /// Our engine: the same bits on every machine.
    #[default]
    Portable,
    /// ONNX Runtime, found at run time; faster, equal within 1e-5, not to the bit.
    OnnxRuntime(Arc<asperity_onnxruntime::Runtime>),
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
