//! WAV: 8 to 32 bit and float, any number of channels. Full scale is 1.

use super::{EachRow, Header};
use crate::{
    error::{Problem, RecordingError},
    file,
};
use hound::{SampleFormat, WavReader};
use std::{fs::File, io::BufReader, path::Path};

fn open(path: &Path) -> Result<WavReader<BufReader<File>>, RecordingError> {
    WavReader::new(BufReader::new(file::open(path)?)).map_err(damaged(path))
}

fn damaged(path: &Path) -> impl Fn(hound::Error) -> RecordingError + '_ {
    move |error| match error {
        hound::Error::IoError(error) => RecordingError::of(path, Problem::Unreadable(error)),
        other => RecordingError::of(path, Problem::Format(other.to_string())),
    }
}

pub(super) fn header(path: &Path) -> Result<Header, RecordingError> {
    let spec = open(path)?.spec();
    Ok(Header {
        columns: (0..spec.channels)
            .map(|channel| channel.to_string())
            .collect(),
        named: false,
        rate_hz: Some(f64::from(spec.sample_rate)),
        full_scale: spec.sample_format == SampleFormat::Int,
    })
}

pub(super) fn rows(path: &Path, each: &mut EachRow<'_>) -> Result<(), RecordingError> {
    let mut reader = open(path)?;
    let spec = reader.spec();
    let width = usize::from(spec.channels);
    match spec.sample_format {
        SampleFormat::Float => {
            let samples = reader.samples::<f32>().map(|sample| sample.map(f64::from));
            frames(path, width, samples, each)
        }
        SampleFormat::Int => {
            let full = libm::ldexp(1.0, i32::from(spec.bits_per_sample) - 1);
            let samples = reader
                .samples::<i32>()
                .map(|sample| sample.map(|x| f64::from(x) / full));
            frames(path, width, samples, each)
        }
    }
}

fn frames(
    path: &Path,
    width: usize,
    samples: impl Iterator<Item = hound::Result<f64>>,
    each: &mut EachRow<'_>,
) -> Result<(), RecordingError> {
    let mut row = Vec::with_capacity(width);
    let mut frame = 0;
    for sample in samples {
        row.push(sample.map_err(damaged(path))?);
        if row.len() == width {
            frame += 1;
            if !each(frame, &row)? {
                return Ok(());
            }
            row.clear();
        }
    }
    Ok(())
}
