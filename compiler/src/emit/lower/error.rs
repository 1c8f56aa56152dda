//! Why a texture cannot become an asset.

use asperity_formats::EncodeError;
use asperity_io::diagnostic::Diagnostic;
use asperity_texture::model::mesh::MeshError;
use thiserror::Error;

/// Why a texture cannot become an asset.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LowerError {
    /// The triangles do not tile the grid.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A line spectral frequency is not in (0, π).
    #[error("vertex {vertex}: {field}[{index}] = {value} rad is not in (0, π)")]
    Frequency {
        /// Index of the vertex.
        vertex: usize,
        /// `lsf_rad` or `ma_lsf_rad`.
        field: &'static str,
        /// Index of the frequency.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Neighbouring LSFs lie closer than an asset can hold.
    #[error("vertex {vertex}: neighbouring LSFs {gap_rad} rad apart, {least_rad} rad at least")]
    Gap {
        /// Index of the vertex.
        vertex: usize,
        /// Smallest gap found, rad.
        gap_rad: f64,
        /// Smallest gap allowed, rad.
        least_rad: f64,
    },
    /// There is more of something than the format can count.
    #[error("{what}: {found}, an asset holds {limit}")]
    TooMany {
        /// Name of the counted item.
        what: &'static str,
        /// Count found.
        found: usize,
        /// Maximum count.
        limit: usize,
    },
    /// The format refused the parts.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

impl Diagnostic for LowerError {
    fn remedy(&self) -> String {
        match self {
            Self::Mesh(_) => {
                "triangulate the vertices so that they tile the rectangle from (0, 0)".into()
            }
            Self::Frequency { .. } => "give ascending frequencies inside (0, π)".into(),
            Self::Gap { .. } => "widen the resonance of this model, or lower its order".into(),
            Self::TooMany { .. } => "reduce the source, or split it".into(),
            Self::Encode(_) => "correct the value in the source".into(),
        }
    }
}
