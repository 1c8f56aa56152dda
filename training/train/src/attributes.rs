//! Objective attributes of an instance, as the compiler defines them for a texture.

use asperity::{
    level::nyquist_rms,
    lsf,
    spectrum::{ArmaModel, trace_centroid_hz},
};
use asperity_corpus::{Instance, SAMPLE_RATE_HZ, TAP_RATE_HZ};

/// Attributes that can be read from an instance; friction is not among them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Attributes {
    /// Mean over the bins of the level above 40 Hz, dB re 1 (m/s²)².
    pub(crate) rough_db: f64,
    /// Mean over the bins of the spectral centroid above 40 Hz, Hz.
    pub(crate) sharp_hz: f64,
    /// Spectral centroid of the fastest trace, Hz.
    pub(crate) hard_hz: f64,
}

/// The attributes of an instance; zero where something is silent.
pub(crate) fn of(instance: &Instance) -> Attributes {
    let vibrations: Vec<_> = instance
        .lsf_rad
        .iter()
        .zip(instance.level_db)
        .filter_map(|(lsf_rad, level_db)| {
            let lsf_rad = lsf_rad.map(f64::from);
            let level = libm::exp10(f64::from(level_db) / 20.0);
            let model = ArmaModel {
                sample_rate_hz: SAMPLE_RATE_HZ,
                a: lsf::to_polynomial(&lsf_rad),
                b: vec![1.0, 1.0],
                level_m_s2: level / nyquist_rms(&lsf_rad),
            };
            model.vibration()
        })
        .collect();
    let count = vibrations.len().max(1) as f64;
    let fastest = instance.taps_m_s2[instance.taps_m_s2.len() - 1].map(f64::from);
    Attributes {
        rough_db: vibrations
            .iter()
            .map(|v| 10.0 * libm::log10(v.power))
            .sum::<f64>()
            / count,
        sharp_hz: vibrations.iter().map(|v| v.centroid_hz).sum::<f64>() / count,
        hard_hz: trace_centroid_hz(&fastest, TAP_RATE_HZ).unwrap_or_default(),
    }
}
