//! A clip as a mono WAV of 16 bits at 44.1 kHz.

use super::clip::{Clip, Take};
use crate::views::listen::SOUND_HZ;
use asperity_texture::signal::resample::resample;

/// A clip as 16-bit samples; strokes and taps each have their scale.
pub(super) fn samples(clip: &Clip) -> Vec<i16> {
    let mut samples = vec![0; (clip.end_s() * f64::from(SOUND_HZ)).ceil() as usize];
    let mut add = |take: &Take, scale: f64| {
        let from = (take.start_s * f64::from(SOUND_HZ)).round() as usize;
        let raised = resample(&take.signal_m_s2, clip.rate_hz, SOUND_HZ);
        for (sample, x) in samples.iter_mut().skip(from).zip(raised) {
            *sample = (x / scale * f64::from(i16::MAX)).round() as i16;
        }
    };
    for take in &clip.strokes {
        add(take, clip.scale.stroke_m_s2);
    }
    for take in &clip.taps {
        add(take, clip.scale.tap_m_s2);
    }
    samples
}

/// Returns the samples as played, in full scales.
pub(super) fn played(samples: &[i16], rate_hz: u32) -> Vec<f64> {
    let full: Vec<f64> = samples
        .iter()
        .map(|x| f64::from(*x) / f64::from(i16::MAX))
        .collect();
    resample(&full, SOUND_HZ, rate_hz)
}
