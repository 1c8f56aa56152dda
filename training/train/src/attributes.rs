//! Objective attributes of an instance, as the compiler defines them for a texture.

use asperity::{
    learned::description::{GridDescription, ModelDescription},
    model::attributes::Meter,
    signal::spectrum::trace_centroid_hz,
};
use asperity_corpus::{Corpus, Instance, TAP_RATE_HZ, TAPS};

/// Layout shared by all instances of a corpus: positions of bins and traces.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    grid: GridDescription,
    /// Impact speeds of the traces.
    pub(crate) speeds_m_s: [f64; TAPS],
}

impl Layout {
    /// The layout of a corpus.
    pub(crate) fn of(corpus: &Corpus) -> Self {
        Self {
            grid: corpus.grid.description(),
            speeds_m_s: corpus.tap_speeds_m_s,
        }
    }

    /// The layout of a model with these impact speeds.
    pub(crate) fn of_model(description: &ModelDescription, speeds_m_s: [f64; TAPS]) -> Self {
        Self {
            grid: description.grid.clone(),
            speeds_m_s,
        }
    }
}

/// Attributes that can be read from an instance; friction is not among them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Attributes {
    /// Level above 40 Hz at 100 mm/s and 1 N, dB re 1 (m/s²)².
    pub(crate) rough_db: f64,
    /// Spectral centroid of the same, Hz.
    pub(crate) sharp_hz: f64,
    /// Spectral centroid of the fastest trace, Hz.
    pub(crate) hard_hz: f64,
}

/// The attributes of an instance; zero where something is silent.
pub(crate) fn of(instance: &Instance, layout: &Layout) -> Attributes {
    let vibration = Meter::default().vibration(&instance.grid(&layout.grid));
    let fastest = instance.taps_m_s2[TAPS - 1].map(f64::from);
    Attributes {
        rough_db: vibration.map_or(0.0, |v| 10.0 * libm::log10(v.power)),
        sharp_hz: vibration.map_or(0.0, |v| v.centroid_hz),
        hard_hz: trace_centroid_hz(&fastest, TAP_RATE_HZ).unwrap_or_default(),
    }
}
