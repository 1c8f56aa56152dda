//! SURF: the wall and the gains.

use crate::{
    error::{FormatError, in_range},
    limits,
    wire::Reader,
};

/// The virtual wall `F = k·δ − b·ḋ` and the gains from accelerations to forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coupling {
    /// Wall stiffness k, N/m, > 0.
    pub stiffness_n_m: f32,
    /// Rendered wall damping b, N·s/m, ≥ 0.
    pub damping_n_s_m: f32,
    /// `g_vib` in F_vib = g_vib · y · F_max, s²/m, ≥ 0.
    pub vib_s2_m: f32,
    /// `m_eff` in F_tap = m_eff · a_tap, kg, ≥ 0.
    pub effective_mass_kg: f32,
    /// F_max that `vib_s2_m` is relative to, N, > 0.
    pub f_max_n: f32,
}

impl Coupling {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let coupling = Self {
            stiffness_n_m: reader.f32("surface.stiffness_n_m")?,
            damping_n_s_m: reader.f32("surface.damping_n_s_m")?,
            vib_s2_m: reader.f32("surface.vib_s2_m")?,
            effective_mass_kg: reader.f32("surface.effective_mass_kg")?,
            f_max_n: reader.f32("surface.f_max_n")?,
        };
        reader.finish("surface")?;
        let tiny = f32::MIN_POSITIVE;
        for (field, value, range, rule) in [
            (
                "surface.stiffness_n_m",
                coupling.stiffness_n_m,
                (tiny, limits::MAX_STIFFNESS_N_M),
                "above 0, at most 1e5 N/m",
            ),
            (
                "surface.damping_n_s_m",
                coupling.damping_n_s_m,
                (0.0, limits::MAX_DAMPING_N_S_M),
                "0 to 1000 N·s/m",
            ),
            (
                "surface.vib_s2_m",
                coupling.vib_s2_m,
                (0.0, limits::MAX_VIB_GAIN_S2_M),
                "0 to 1000 s²/m",
            ),
            (
                "surface.effective_mass_kg",
                coupling.effective_mass_kg,
                (0.0, limits::MAX_EFFECTIVE_MASS_KG),
                "0 to 100 kg",
            ),
            (
                "surface.f_max_n",
                coupling.f_max_n,
                (tiny, limits::MAX_DEVICE_FORCE_N),
                "above 0, at most 1e4 N",
            ),
        ] {
            in_range(field, 0, value, range, rule)?;
        }
        Ok(coupling)
    }
}
