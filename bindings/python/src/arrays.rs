//! Grid and taps as NumPy arrays.

use crate::records::{of_fields, value};
use asperity::views::inspect::Document;
use numpy::{Element, IntoPyArray as _, PyArrayMethods as _};
use pyo3::{IntoPyObjectExt as _, prelude::*};

/// An array of rows of `columns` elements each.
pub(crate) fn table<'py, T: Element>(
    py: Python<'py>,
    elements: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let rows = elements.len() / columns.max(1);
    let table = elements.into_pyarray(py).reshape([rows, columns])?;
    Ok(table.into_any())
}

/// An array of one dimension.
pub(crate) fn list<T: Element>(py: Python<'_>, elements: Vec<T>) -> Bound<'_, PyAny> {
    elements.into_pyarray(py).into_any()
}

/// The record `Grid` of a texture.
pub(crate) fn grid<'py>(py: Python<'py>, document: &Document) -> PyResult<Bound<'py, PyAny>> {
    let ar = &document.ar;
    let vertices = || ar.vertices.iter();
    let kinds = value(py, &vertices().map(|v| v.kind).collect::<Vec<_>>())?;
    let kind = py.import("numpy")?.call_method1("array", (kinds, "str"))?;
    let ma_order = vertices().find_map(|v| Some(v.ma_lsf_rad.as_ref()?.len()));
    let ma_lsf_rad = match ma_order {
        None => py.None().into_bound(py),
        Some(order) => {
            let all = vertices().flat_map(|v| v.ma_lsf_rad.iter().flatten());
            table(py, all.copied().collect::<Vec<f64>>(), order)?
        }
    };
    let lsf_rad: Vec<f64> = vertices().flat_map(|v| &v.lsf_rad).copied().collect();
    let triangles: Vec<i64> = ar.triangles.iter().flatten().map(|&v| v as i64).collect();
    of_fields(
        py,
        "Grid",
        [
            ("order", ar.order.into_bound_py_any(py)?),
            ("sample_rate_hz", ar.sample_rate_hz.into_bound_py_any(py)?),
            ("numerator", value(py, &ar.numerator)?),
            (
                "speed_mm_s",
                list(py, vertices().map(|v| v.speed_mm_s).collect()),
            ),
            ("force_n", list(py, vertices().map(|v| v.force_n).collect())),
            ("kind", kind),
            ("lsf_rad", table(py, lsf_rad, ar.order)?),
            ("ma_lsf_rad", ma_lsf_rad),
            ("gain", list(py, vertices().map(|v| v.gain).collect())),
            (
                "sigma_m_s2",
                list(py, vertices().map(|v| v.sigma_m_s2).collect()),
            ),
            ("triangles", table(py, triangles, 3)?),
            ("max_speed_mm_s", ar.max_speed_mm_s.into_bound_py_any(py)?),
            ("max_force_n", ar.max_force_n.into_bound_py_any(py)?),
        ],
    )
}

/// The record `Taps` of a texture.
pub(crate) fn taps<'py>(py: Python<'py>, document: &Document) -> PyResult<Bound<'py, PyAny>> {
    let taps = &document.taps;
    let samples = taps.traces_m_s2.first().map_or(0, Vec::len);
    let traces: Vec<f64> = taps.traces_m_s2.iter().flatten().copied().collect();
    of_fields(
        py,
        "Taps",
        [
            ("sample_rate_hz", taps.sample_rate_hz.into_bound_py_any(py)?),
            ("speeds_m_s", list(py, taps.speeds_m_s.clone())),
            ("traces_m_s2", table(py, traces, samples)?),
        ],
    )
}
