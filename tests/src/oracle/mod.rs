//! The tick and the attributes of a texture in f64, written from the documents.

mod attributes;
mod bank;
mod contact;
mod direction;
mod excitation;
mod interpolator;
mod motion;
mod surface;
mod texture;
mod tick;

pub use attributes::{Attributes, attributes, loudest_n, stroke_n};
pub use bank::{Bank, impulse_response};
pub use contact::{Contact, Forces};
pub use direction::DirectionFactors;
pub use excitation::Excitation;
pub use interpolator::Interpolator;
pub use motion::Butterworth2;
pub use surface::distance_and_normal;
pub use texture::{Model, Texture, Vertex, polynomial};
pub use tick::{Oracle, Tick};

/// Three components along the world's axes.
pub type Vector = [f64; 3];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub(crate) fn plus(a: Vector, b: Vector, times: f64) -> Vector {
    std::array::from_fn(|i| a[i] + b[i] * times)
}

pub(crate) fn times(a: Vector, factor: f64) -> Vector {
    a.map(|a| a * factor)
}
