//! Arguments that several functions take.

use crate::error::Failure;
use asperity::reduce;
use pyo3::{exceptions::PyTypeError, prelude::*, pybacked::PyBackedBytes};
use std::path::PathBuf;

/// An asset or a library: its bytes, or where they are.
pub(crate) enum Origin {
    /// In memory.
    Bytes(PyBackedBytes),
    /// A file.
    Path(PathBuf),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Origin {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(bytes) = value.extract() {
            return Ok(Self::Bytes(bytes));
        }
        value.extract().map(Self::Path).map_err(|_| {
            let found = value.get_type();
            PyTypeError::new_err(format!("origin: neither a path nor bytes, but {found}"))
        })
    }
}

/// One texture of a library.
#[derive(FromPyObject)]
pub(crate) enum Choice {
    /// By its place; from the end where negative.
    Index(isize),
    /// By its name.
    Name(String),
}

/// A fidelity: `"full"`, `"auto"`, or an order as a number or text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fidelity(pub(crate) reduce::Fidelity);

impl Fidelity {
    pub(crate) const AUTO: Self = Self(reduce::Fidelity::Auto);
    pub(crate) const FULL: Self = Self(reduce::Fidelity::Full);
}

impl<'a, 'py> FromPyObject<'a, 'py> for Fidelity {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let text = value.str()?.to_string();
        text.parse().map(Self).map_err(|rule: String| {
            let message = format!("fidelity = {text:?}: not {rule}");
            Failure::usage(message, "leave it out, or give an order, e.g. fidelity=8").into()
        })
    }
}

/// A seed: a whole number from 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seed(pub(crate) u64);

impl<'a, 'py> FromPyObject<'a, 'py> for Seed {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        value.extract().map(Self).map_err(|_| {
            let message = match value.repr() {
                Ok(repr) => format!("seed = {repr}: not a whole number from 0 to 2^64 - 1"),
                Err(_) => "seed: not a whole number".to_owned(),
            };
            Failure::usage(message, "leave it out, or give one, e.g. seed=1").into()
        })
    }
}
