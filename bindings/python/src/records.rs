//! Values as the records that are Python.

use pyo3::{
    prelude::*,
    types::{IntoPyDict as _, PyDict},
};
use serde::Serialize;

/// The Python value of whatever serialises: numbers to the bit, maps as dicts.
pub(crate) fn value<'py>(py: Python<'py>, of: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    // Plain structures of numbers and strings always serialise.
    parsed(py, &serde_json::to_string(of).unwrap_or_default())
}

/// The Python value of a JSON text.
pub(crate) fn parsed<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (json,))
}

/// A record whose fields are those of a structure.
pub(crate) fn record<'py>(
    py: Python<'py>,
    class: &str,
    of: &impl Serialize,
) -> PyResult<Bound<'py, PyAny>> {
    with_fields(py, class, value(py, of)?.cast::<PyDict>()?)
}

/// A record of these fields.
pub(crate) fn of_fields<'py, const N: usize>(
    py: Python<'py>,
    class: &str,
    fields: [(&str, Bound<'py, PyAny>); N],
) -> PyResult<Bound<'py, PyAny>> {
    with_fields(py, class, &fields.into_py_dict(py)?)
}

/// A record of the fields in a dict.
pub(crate) fn with_fields<'py>(
    py: Python<'py>,
    class: &str,
    fields: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyAny>> {
    let class = py.import("asperity")?.getattr(class)?;
    class.call((), Some(fields))
}
