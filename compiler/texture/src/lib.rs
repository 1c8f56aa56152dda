//! The model of a texture between its source and its bytes, and the mathematics of its parts.
//!
//! A texture is a grid of AR or ARMA models over speed and force, with taps, friction and a wall. The compiler builds
//! one from any source and lowers it to an asset; this crate knows no source, no file and no runtime.
//!
//! ```
//! use asperity_texture::{
//!     model::{GridVertex, ModelGrid, Numerator, VertexKind, mesh, mixture::Field},
//!     signal::lsf,
//! };
//!
//! // One resonance, at the corners of a grid of 200 mm/s and 2 N; it is louder in faster strokes.
//! let lsf_rad = lsf::from_polynomial(&[1.0, -1.2, 0.9]).expect("a stable model");
//! let corner = |speed_mm_s: f64, force_n: f64| GridVertex {
//!     speed_mm_s,
//!     force_n,
//!     kind: VertexKind::Edge,
//!     lsf_rad: lsf_rad.clone(),
//!     ma_lsf_rad: None,
//!     gain: 1.0,
//!     sigma_m_s2: 0.01 * speed_mm_s,
//! };
//! let grid = ModelGrid {
//!     sample_rate_hz: 1000.0,
//!     order: 2,
//!     numerator: Numerator::None,
//!     vertices: vec![corner(0.0, 0.0), corner(200.0, 0.0), corner(200.0, 2.0), corner(0.0, 2.0)],
//!     triangles: vec![[0, 1, 2], [0, 2, 3]],
//! };
//! assert_eq!(mesh::check(&grid), Ok(()));
//!
//! // Between its vertices the grid mixes their models, as the runtime does.
//! let field = Field::new(&grid);
//! let place = field.locate(100.0, 1.0).expect("a triangle");
//! assert!((field.model(&place).level_m_s2 - 1.0).abs() < 1e-9);
//! ```
//!
//! # What to read first
//!
//! [`model::TextureModel`] and the types in it, then [`signal::lsf`], on which mixtures rest.
//!
//! | module | holds |
//! |---|---|
//! | [`model`] | one texture in f64 and SI units |
//! | [`model::mesh`] | whether its triangles tile the grid |
//! | [`model::mixture`] | what it renders between its vertices |
//! | [`model::attributes`] | how it feels |
//! | [`signal`] | line spectral frequencies, Levinson's recursion, spectra, resampling, impacts, order statistics |
//!
//! `model` imports `signal`, which knows no texture.
#![forbid(unsafe_code)]

pub mod model;
pub mod signal;
