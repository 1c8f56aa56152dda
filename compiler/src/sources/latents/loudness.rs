//! Equal loudness: an option for those who want textures that differ in everything but strength.

use asperity_texture::model::{TextureModel, attributes};

/// Sets the vibration's gain so that the mean level of the vibration above 40 Hz is `level_db`,
/// dB re 1 N RMS of force. A silent texture keeps its gain. The ceiling may lower it again.
pub fn equal_loudness(texture: &mut TextureModel, level_db: f64) {
    let Some(rough_db) = attributes::of(texture).rough_db else {
        return;
    };
    let gains = &mut texture.gains;
    let largest = f64::from(asperity_formats::limits::MAX_VIB_GAIN_S2_M);
    let wanted = libm::exp10((level_db - rough_db) / 20.0) / gains.f_max_n;
    gains.vib_s2_m = wanted.min(largest);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;

    #[test]
    fn two_textures_of_different_levels_become_equally_loud() {
        let mut quiet = builtin::texture();
        let mut loud = quiet.clone();
        for vertex in &mut loud.grid.vertices {
            vertex.sigma_m_s2 *= 4.0;
        }
        for texture in [&mut quiet, &mut loud] {
            equal_loudness(texture, -20.0);
            let level_db = attributes::of(texture).rough_db.unwrap()
                + 20.0 * libm::log10(texture.gains.vib_s2_m * texture.gains.f_max_n);
            assert!((level_db + 20.0).abs() < 1e-9);
        }
        assert!((quiet.gains.vib_s2_m / loud.gains.vib_s2_m - 4.0).abs() < 1e-9);
    }
}
