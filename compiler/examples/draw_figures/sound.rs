//! Three seconds of sound of a texture: a slow stroke, a fast one, three taps.

use asperity::{
    emit::lower,
    model::TextureModel,
    views::listen::{Gesture, Stroke, listen},
};
use asperity_formats::Asset;
use std::{error::Error, io::Cursor};

/// Decimation factor: a texture at 1 kHz holds nothing above 500 Hz.
const KEPT: u32 = 4;

/// The sound as a mono WAV file of 16 bits at 11,025 Hz.
pub(crate) fn wav(texture: &TextureModel) -> Result<Vec<u8>, Box<dyn Error>> {
    let lowered = lower::lower(texture, None)?;
    let asset = Asset::parse(&lowered.bytes)?;
    let strokes = [60.0, 180.0].map(|speed_mm_s| Stroke {
        speed_mm_s,
        force_n: 1.0,
        time_s: 0.42,
    });
    let gesture = Gesture {
        strokes: strokes.into(),
        taps: true,
    };
    let heard = listen(&asset, &gesture, None, 0)?;
    let mut reader = hound::WavReader::new(Cursor::new(heard.wav))?;
    let mut spec = reader.spec();
    spec.sample_rate /= KEPT;
    let mut bytes = Vec::new();
    let mut writer = hound::WavWriter::new(Cursor::new(&mut bytes), spec)?;
    for sample in reader.samples::<i16>().step_by(KEPT as usize) {
        writer.write_sample(sample?)?;
    }
    writer.finalize()?;
    Ok(bytes)
}
