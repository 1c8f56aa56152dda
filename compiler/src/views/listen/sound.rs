//! Accelerations as samples of a sound.

use super::{Part, SOUND_HZ};
use std::io::Cursor;

/// Level of the loudest sample, of full scale: −1 dB.
const CEILING: f64 = 0.891;

/// A part with the gain that takes its loudest sample to the ceiling.
pub(super) fn part(count: usize, signal: &[f64]) -> Part {
    let peak_m_s2 = signal.iter().fold(0.0f64, |peak, x| peak.max(x.abs()));
    let audible = count > 0 && peak_m_s2 > 0.0;
    Part {
        count,
        peak_m_s2,
        gain_per_m_s2: if audible { CEILING / peak_m_s2 } else { 0.0 },
    }
}

/// The parts one after the other, each with its gain, as 16-bit samples.
pub(super) fn levelled(parts: &[(&[f64], &Part)]) -> Vec<i16> {
    let scaled = |(signal, part): &(&[f64], &Part)| -> Vec<i16> {
        let full = part.gain_per_m_s2 * f64::from(i16::MAX);
        signal.iter().map(|x| (x * full).round() as i16).collect()
    };
    parts.iter().flat_map(scaled).collect()
}

/// The samples as a WAV file.
pub(crate) fn wav(samples: &[i16]) -> Result<Vec<u8>, hound::Error> {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: SOUND_HZ,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut bytes = Vec::new();
    let mut writer = hound::WavWriter::new(Cursor::new(&mut bytes), spec)?;
    for sample in samples {
        writer.write_sample(*sample)?;
    }
    writer.finalize()?;
    Ok(bytes)
}
