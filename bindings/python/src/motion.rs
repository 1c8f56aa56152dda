//! Trajectories as NumPy has them.

use crate::error::Failure;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Rows of an array of shape (N, 3). Doubles are rounded once; floats are taken as they are.
pub(crate) fn positions(given: &Bound<'_, PyAny>) -> PyResult<Vec<[f32; 3]>> {
    let array = Array::of(given)?;
    if !"fiu".contains(array.kind.as_str()) || array.shape.len() != 2 || array.shape[1] != 3 {
        let remedy = "give numbers, one row x, y, z a tick: an array of shape (N, 3)";
        return Err(array.refused("positions_m", remedy));
    }
    if array.dtype == "float32" {
        let rows: PyReadonlyArray2<'_, f32> = array.contiguous("float32")?.extract()?;
        return Ok(rows.as_slice()?.as_chunks::<3>().0.to_vec());
    }
    let rows: PyReadonlyArray2<'_, f64> = array.contiguous("float64")?.extract()?;
    let rows = rows.as_slice()?.as_chunks::<3>().0;
    Ok(rows.iter().map(|row| row.map(|x| x as f32)).collect())
}

/// Whole numbers, one a tick.
pub(crate) fn elapsed_ticks(given: &Bound<'_, PyAny>, ticks: usize) -> PyResult<Vec<u32>> {
    let array = Array::of(given)?;
    let remedy = format!("give whole numbers from 0, one a tick: an array of shape ({ticks},)");
    if !"iu".contains(array.kind.as_str()) || array.shape != [ticks] {
        return Err(array.refused("elapsed_ticks", remedy));
    }
    let numbers: PyReadonlyArray1<'_, i64> = array.contiguous("int64")?.extract()?;
    let number = |(index, &number): (usize, &i64)| {
        u32::try_from(number).map_err(|_| {
            Failure::usage(format!("elapsed_ticks[{index}] = {number}"), &*remedy).into()
        })
    };
    numbers.as_slice()?.iter().enumerate().map(number).collect()
}

/// An array with its type and shape.
struct Array<'py> {
    array: Bound<'py, PyAny>,
    dtype: String,
    kind: String,
    shape: Vec<usize>,
}

impl<'py> Array<'py> {
    fn of(given: &Bound<'py, PyAny>) -> PyResult<Self> {
        let array = given
            .py()
            .import("numpy")?
            .call_method1("asarray", (given,))?;
        let dtype = array.getattr("dtype")?;
        Ok(Self {
            dtype: dtype.str()?.to_string(),
            kind: dtype.getattr("kind")?.extract()?,
            shape: array.getattr("shape")?.extract()?,
            array,
        })
    }

    /// The elements side by side, of this type and in native byte order.
    fn contiguous(&self, dtype: &str) -> PyResult<Bound<'py, PyAny>> {
        let numpy = self.array.py().import("numpy")?;
        numpy.call_method1("ascontiguousarray", (&self.array, dtype))
    }

    fn refused(&self, argument: &str, remedy: impl Into<String>) -> PyErr {
        let message = format!("{argument}: {} of shape {:?}", self.dtype, self.shape);
        Failure::usage(message, remedy).into()
    }
}
