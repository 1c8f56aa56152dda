//! The vibration as sound.

use std::io::Cursor;

use super::error::FeelError;
use super::recording::Recording;
use asperity::signal::resample::resample;

/// The sample rate that a sound's rate is chosen nearest to, Hz.
const RATE_HZ: f64 = 48_000.0;
/// Level of the loudest sample, relative to full scale: −1 dB.
const CEILING: f64 = 0.891;

/// A 16-bit mono WAV file.
#[derive(Debug, Clone, PartialEq)]
pub struct Sound {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// Its sample rate, Hz: the multiple of the servo rate nearest to 48 kHz.
    pub sample_rate_hz: u32,
    /// Fraction of full scale for 1 m/s², which the sound was normalised with; 0 for silence.
    pub gain_per_m_s2: f64,
}

/// The vibration before device gain as a band-limited sound, its loudest sample at −1 dB.
///
/// Taps are left out. They are forces along the normal, and so much louder that nothing else
/// would be heard.
///
/// # Errors
/// [`FeelError::Wav`] if the encoder fails.
pub fn encode(recording: &Recording) -> Result<Sound, FeelError> {
    let servo_rate_hz = recording.device.timing.servo_rate_hz;
    let factor = (RATE_HZ / servo_rate_hz).round().max(1.0);
    let sample_rate_hz = (servo_rate_hz * factor).round() as u32;
    let raised = resample(&recording.vibration_m_s2(), 1, factor as u32);
    let peak = super::statistics::peak(raised.iter().copied());
    let gain_per_m_s2 = if peak > 0.0 { CEILING / peak } else { 0.0 };

    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: sample_rate_hz,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut bytes = Vec::new();
    let mut writer = hound::WavWriter::new(Cursor::new(&mut bytes), spec)?;
    for value in raised {
        writer.write_sample((value * gain_per_m_s2 * f64::from(i16::MAX)).round() as i16)?;
    }
    writer.finalize()?;
    Ok(Sound {
        bytes,
        sample_rate_hz,
        gain_per_m_s2,
    })
}
