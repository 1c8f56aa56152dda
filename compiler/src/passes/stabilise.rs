//! Moves the models of a texture towards white noise.
//!
//! Each model is stable by itself and its gain is bounded, but models of opposite spectra that
//! take turns faster than they ring can still drive each other up. Models that resemble each
//! other cannot, and white noise has no memory at all.
//!
//! ```
//! use asperity::{sources::builtin, signal::lsf, passes::stabilise::stabilise};
//!
//! let white = stabilise(&builtin::texture(), 1.0);
//! let polynomial = lsf::to_polynomial(&white.grid.vertices[0].lsf_rad);
//! assert!(polynomial[1..].iter().all(|a| a.abs() < 1e-9)); // A(z) = 1
//! ```

use asperity_texture::{
    model::TextureModel,
    signal::{level::nyquist_rms, lsf},
};

/// The texture with every model moved `fraction` (0..=1) of the way to white noise. The level
/// of every model is kept, for which the numerator has to be 1 + z⁻¹.
#[must_use]
pub fn stabilise(texture: &TextureModel, fraction: f64) -> TextureModel {
    let mut stabilised = texture.clone();
    for vertex in &mut stabilised.grid.vertices {
        let lsf_rad = lsf::towards_white_noise(&vertex.lsf_rad, fraction);
        vertex.sigma_m_s2 *= nyquist_rms(&vertex.lsf_rad) / nyquist_rms(&lsf_rad);
        vertex.lsf_rad = lsf_rad;
    }
    stabilised
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;

    #[test]
    fn all_the_way_is_white_noise_at_the_same_level() {
        let texture = builtin::texture();
        let white = stabilise(&texture, 1.0);
        for (before, after) in texture.grid.vertices.iter().zip(&white.grid.vertices) {
            let level =
                |v: &asperity_texture::model::GridVertex| v.sigma_m_s2 * nyquist_rms(&v.lsf_rad);
            assert!((level(before) - level(after)).abs() <= 1e-9 * level(before));
            let polynomial = lsf::to_polynomial(&after.lsf_rad);
            assert!(polynomial[1..].iter().all(|a| a.abs() < 1e-9));
        }
    }

    #[test]
    fn no_fraction_of_the_way_changes_nothing() {
        let texture = builtin::texture();
        assert_eq!(stabilise(&texture, 0.0), texture);
    }
}
