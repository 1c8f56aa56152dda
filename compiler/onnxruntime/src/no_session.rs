//! Where no library can be opened, no network runs on ONNX Runtime either.

use std::{convert::Infallible, path::Path};

use asperity_nn::{Port, RunError, Session, Tensor};

use crate::{
    discover::{Discovery, NotFound, find},
    error::LoadError,
};

/// A network that ONNX Runtime runs, of which there is none here.
#[derive(Debug)]
pub struct OnnxRuntime(Infallible);

impl OnnxRuntime {
    /// Loads nothing.
    ///
    /// # Errors
    /// [`LoadError`], for there is no library.
    pub fn from_bytes(_bytes: &[u8]) -> Result<Self, LoadError> {
        Ok(Self(none()?))
    }

    /// Loads nothing.
    ///
    /// # Errors
    /// As [`from_bytes`](Self::from_bytes).
    pub fn with_threads(bytes: &[u8], _threads: usize) -> Result<Self, LoadError> {
        Self::from_bytes(bytes)
    }

    /// Loads nothing.
    ///
    /// # Errors
    /// As [`from_bytes`](Self::from_bytes).
    pub fn from_file(_file: &Path, _threads: usize) -> Result<Self, LoadError> {
        Self::from_bytes(&[])
    }

    /// The library that this process uses.
    ///
    /// # Errors
    /// [`NotFound`] lists what was tried.
    pub fn library() -> Result<&'static Discovery, NotFound> {
        match none()? {}
    }
}

/// The library that is found, of which there is none.
fn none() -> Result<Infallible, NotFound> {
    let (_, opened) = find()?;
    Ok(opened.never)
}

impl Session for OnnxRuntime {
    fn inputs(&self) -> &[Port] {
        match self.0 {}
    }

    fn outputs(&self) -> &[Port] {
        match self.0 {}
    }

    fn run(&self, _inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
        match self.0 {}
    }
}
