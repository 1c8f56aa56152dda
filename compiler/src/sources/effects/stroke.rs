//! The model of a stroke: what the continuous effects of a file sound like together.

use crate::interchange::{
    playback::Track,
    third_octave::{Shape, density},
};
use asperity_texture::{
    model::{GridVertex, VertexKind},
    signal::{level, levinson, lsf, resample::resample},
};
use std::f64::consts::PI;

/// Rate at which effects are played, and that of the model, Hz.
const PLAY_HZ: u32 = 4000;
pub(super) const MODEL_HZ: u32 = 1000;
/// Order of the model.
pub(super) const ORDER: usize = 20;
/// Longest part that is looked at, s.
const LONGEST_S: usize = 30;
/// Blocks in which an effect sounds or not, s, and the part of the loudest that sounds.
const BLOCK_S: f64 = 0.02;
const SOUNDS: f64 = 0.1;
/// Least width over which a spectrum is averaged, Hz, and relative to the frequency. A surface has
/// no line as narrow as a tone.
const LEAST_WIDTH_HZ: f64 = 6.0;
const WIDTH: f64 = 0.15;
/// Floor of the spectrum, relative to its peak.
const FLOOR: f64 = 1e-4;

/// The model of a track at a speed and a force; silent and white where the track has no tone and no
/// curve. Its values times `full_scale_m_s2` are accelerations.
pub(super) fn vertex(
    track: &Track,
    speed_mm_s: f64,
    force_n: f64,
    full_scale_m_s2: f64,
) -> GridVertex {
    let (lsf_rad, rms) = model(&track.continuous(PLAY_HZ));
    let sigma_m_s2 = full_scale_m_s2 * rms / level::nyquist_rms(&lsf_rad);
    GridVertex {
        speed_mm_s,
        force_n,
        kind: VertexKind::Interior,
        lsf_rad,
        ma_lsf_rad: None,
        gain: 1.0,
        sigma_m_s2,
    }
}

/// Line spectral frequencies, and the RMS where the signal sounds.
fn model(played: &[f64]) -> (Vec<f64>, f64) {
    let signal = sounding(&resample(played, PLAY_HZ, MODEL_HZ));
    let white = lsf::towards_white_noise(&[0.0; ORDER], 1.0);
    let energy: f64 = signal.iter().map(|x| x * x).sum();
    if energy <= 0.0 {
        return (white, 0.0);
    }
    let rate = f64::from(MODEL_HZ);
    let density = density(&signal, rate, 0.5 * rate, Shape::Steady);
    let smooth: Vec<f64> = (0..density.len())
        .map(|hz| {
            let half = 0.5 * LEAST_WIDTH_HZ.max(WIDTH * hz as f64);
            let low = (hz as f64 - half).max(0.0) as usize;
            let high = ((hz as f64 + half) as usize).min(density.len() - 1);
            density[low..=high].iter().sum::<f64>() / (high + 1 - low) as f64
        })
        .collect();
    let floor = FLOOR * smooth.iter().fold(0.0f64, |a, &b| a.max(b));
    let (monic, _) = levinson::all_pole(ORDER, |omega| {
        let hz = omega / PI * 0.5 * rate;
        let at = smooth[(hz.round() as usize).min(smooth.len() - 1)].max(floor);
        // The zero at half the rate is the numerator's.
        at / (2.0 + 2.0 * libm::cos(omega)).max(0.02)
    });
    // Levinson's recursion gives a stable polynomial for a positive spectrum.
    let lsf_rad = lsf::from_polynomial(&monic).unwrap_or(white);
    (lsf_rad, (energy / signal.len() as f64).sqrt())
}

/// The blocks of a signal that sound, one after the other.
fn sounding(signal: &[f64]) -> Vec<f64> {
    let block = (BLOCK_S * f64::from(MODEL_HZ)) as usize;
    let rms = |part: &[f64]| (part.iter().map(|x| x * x).sum::<f64>() / part.len() as f64).sqrt();
    let loudest = signal.chunks(block).map(rms).fold(0.0, f64::max);
    let loud = |part: &&[f64]| rms(part) > SOUNDS * loudest;
    let parts = signal.chunks(block).filter(loud).flatten().copied();
    parts.take(LONGEST_S * MODEL_HZ as usize).collect()
}
