//! Where no library can be opened: in WebAssembly.

use std::{convert::Infallible, ffi::OsStr};

use thiserror::Error;

/// Why a file is not an ONNX Runtime that we can use.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("WebAssembly opens no libraries")]
pub(crate) struct Refusal;

/// An opened library, of which there is none.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) version: String,
    pub(crate) never: Infallible,
}

/// Opens nothing.
pub(crate) fn open(_name: &OsStr) -> Result<Opened, Refusal> {
    Err(Refusal)
}
