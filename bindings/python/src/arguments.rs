//! Arguments that several functions take.

use crate::error::Failure;
use asperity::{passes::reduce, views::preview};
use asperity_formats as formats;
use pyo3::{exceptions::PyTypeError, prelude::*, pybacked::PyBackedBytes};
use std::{fmt::Display, ops::RangeInclusive, path::PathBuf};

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

/// Selection of a texture of a library.
#[derive(FromPyObject)]
pub(crate) enum Choice {
    /// By index; negative from the end.
    Index(isize),
    /// By name.
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
            let message = format!(
                "seed = {}: not a whole number from 0 to 2^64 - 1",
                repr(value)
            );
            Failure::usage(message, "leave it out, or give one, e.g. seed=1").into()
        })
    }
}

/// A preview: `True` for the usual one, `False` for none, or its width and height in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Preview {
    /// Default size.
    Usual,
    /// None.
    None,
    /// Given size, px.
    Size(u32),
}

impl Preview {
    /// Its size where it has the usual one for what has no other.
    pub(crate) fn px(self) -> Option<u32> {
        self.px_or(Some(preview::SIZE))
    }

    /// Its size where the usual one is `own`.
    pub(crate) fn px_or(self, own: Option<u32>) -> Option<u32> {
        match self {
            Self::Usual => own,
            Self::None => None,
            Self::Size(px) => Some(px),
        }
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Preview {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(wanted) = value.extract() {
            return Ok(if wanted { Self::Usual } else { Self::None });
        }
        let sizes = preview::SIZES;
        match value.extract() {
            Ok(px) if sizes.contains(&px) => Ok(Self::Size(px)),
            _ => {
                let (least, most) = (sizes.start(), sizes.end());
                let message = format!("preview = {}: not True, False or a size", repr(value));
                let remedy = format!("give a size in pixels, {least} to {most}");
                Err(Failure::usage(message, remedy).into())
            }
        }
    }
}

/// A solid: `Plane`, `Sphere` or `Box` of the package, in metres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solid(pub(crate) formats::Solid);

impl<'a, 'py> FromPyObject<'a, 'py> for Solid {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let module = value.py().import("asperity._solids")?;
        let is = |class: &str| value.is_instance(&module.getattr(class)?);
        let wrong = |field: &str, found: String, wanted: &str| -> PyErr {
            let message = format!("solid{field} = {found}: not {wanted}");
            let remedy = "give e.g. asperity.Sphere((0, 0, 0), 0.05), in metres";
            Failure::usage(message, remedy).into()
        };
        let vector = |field: &str| -> PyResult<[f32; 3]> {
            let given = value.getattr(field)?;
            match given.extract::<[f64; 3]>() {
                Ok(vector) => Ok(vector.map(|x| x as f32)),
                Err(_) => Err(wrong(
                    &format!(".{field}"),
                    repr(given.as_borrowed()),
                    "3 numbers",
                )),
            }
        };
        Ok(Self(if is("Plane")? {
            formats::Solid::Plane {
                point_m: vector("point_m")?,
                normal: vector("normal")?,
            }
        } else if is("Sphere")? {
            let radius = value.getattr("radius_m")?;
            let number = |_| wrong(".radius_m", repr(radius.as_borrowed()), "a number");
            formats::Solid::Sphere {
                center_m: vector("center_m")?,
                radius_m: radius.extract::<f64>().map_err(number)? as f32,
            }
        } else if is("Box")? {
            formats::Solid::Box {
                center_m: vector("center_m")?,
                half_extents_m: vector("half_extents_m")?,
            }
        } else {
            return Err(wrong("", repr(value), "a Plane, Sphere or Box"));
        }))
    }
}

/// A number in its range.
pub(crate) fn within<T: PartialOrd + Display + Copy>(
    name: &str,
    value: T,
    range: &RangeInclusive<T>,
) -> Result<T, Failure> {
    if range.contains(&value) {
        return Ok(value);
    }
    let (least, most) = (range.start(), range.end());
    let message = format!("{name} = {value}: not from {least} to {most}");
    Err(Failure::usage(message, "give a number in this range"))
}

/// An argument as an error shows it.
fn repr(value: Borrowed<'_, '_, PyAny>) -> String {
    value
        .repr()
        .map_or_else(|_| "?".to_owned(), |repr| repr.to_string())
}
