//! The models that a kernel is made of, and the queries it answers.

use alloc::vec::Vec;

/// The numerator, which the excitation passes before the poles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numerator {
    /// 1.
    None,
    /// 1 + z⁻¹.
    Nyquist,
    /// A polynomial of its own, given by line spectral frequencies.
    Lsf,
}

/// A model that is mixed with others.
#[derive(Debug, Clone, Copy)]
pub struct Vertex<'a> {
    /// Line spectral frequencies of the poles, rad, ascending.
    pub lsf_rad: &'a [f64],
    /// Line spectral frequencies of the zeros, rad; empty unless the numerator is
    /// [`Numerator::Lsf`].
    pub ma_lsf_rad: &'a [f64],
    /// RMS of the excitation, m/s².
    pub level_m_s2: f64,
}

/// Models of equal orders.
#[derive(Debug, Clone, Copy)]
pub struct Texture<'a> {
    /// Ticks a second, Hz.
    pub sample_rate_hz: f64,
    /// The numerator of every vertex.
    pub numerator: Numerator,
    /// The models.
    pub vertices: &'a [Vertex<'a>],
}

/// A triangle, by its vertices, and the weights of a query in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarycentricPoint {
    /// Indices of the vertices.
    pub vertices: [usize; 3],
    /// Barycentric weights, not negative, of sum 1.
    pub weights: [f64; 3],
}

/// The filter that a kernel renders with, in f64.
#[derive(Debug, Clone, PartialEq)]
pub struct Filter {
    /// Coefficients of A(z), monic.
    pub a: Vec<f64>,
    /// Coefficients of B(z), monic.
    pub b: Vec<f64>,
    /// RMS of the excitation, m/s².
    pub level_m_s2: f64,
}
