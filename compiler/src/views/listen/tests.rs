//! Sound of the built-in texture.

use super::*;
use crate::{emit::lower::lower, sources::builtin};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::TextureModel;

fn heard(
    texture: &TextureModel,
    session: &Gesture,
    rate_hz: Option<f32>,
) -> Result<(RenderedSound, Vec<f64>), Fault> {
    let bytes = lower(texture, None).unwrap().bytes;
    let asset = Asset::parse(&bytes).unwrap();
    let heard = listen(&asset, session, rate_hz, 1)?;
    let mut reader = hound::WavReader::new(heard.wav.as_slice()).unwrap();
    let spec = reader.spec();
    assert_eq!(
        (spec.channels, spec.sample_rate, spec.bits_per_sample),
        (1, SOUND_HZ, 16)
    );
    let full = f64::from(i16::MAX);
    let samples = reader
        .samples::<i16>()
        .map(|s| f64::from(s.unwrap()) / full)
        .collect();
    Ok((heard, samples))
}

fn rms(samples: &[f64]) -> f64 {
    (samples.iter().map(|x| x * x).sum::<f64>() / samples.len() as f64).sqrt()
}

/// The middle of the `n`th of the usual strokes.
fn stroke(samples: &[f64], n: usize) -> &[f64] {
    let at = |s: f32| (s * SOUND_HZ as f32) as usize;
    let begin = n as f32 * (STROKE_S.0 + PAUSE_S);
    &samples[at(begin + 0.2)..at(begin + 0.8)]
}

#[test]
fn faster_strokes_are_louder_and_the_loudest_sample_is_one_db_below_full_scale() {
    let (heard, samples) = heard(&builtin::texture(), &Gesture::usual(), None).unwrap();
    assert_eq!((heard.strokes.count, heard.taps.count), (6, 3));
    assert!(rms(stroke(&samples, 2)) > 1.1 * rms(stroke(&samples, 0)));
    let peak = samples.iter().fold(0.0f64, |peak, x| peak.max(x.abs()));
    assert!((peak - 0.891).abs() < 1e-3, "{peak}");
    let pause = (1.1 * SOUND_HZ as f32) as usize;
    assert!(
        rms(&samples[pause..pause + 4000]) < 1e-3,
        "silence between strokes"
    );
    assert!(heard.warnings.is_empty(), "{:?}", heard.warnings);
}

#[test]
fn the_gain_leads_from_the_samples_back_to_the_acceleration() {
    let session = Gesture::asked(Some(100.0), Some(1.0), false);
    let quiet = builtin::texture();
    let mut loud = quiet.clone();
    for vertex in &mut loud.grid.vertices {
        vertex.sigma_m_s2 *= 2.0;
    }
    let level = |texture| {
        let (heard, samples) = heard(texture, &session, None).unwrap();
        rms(&samples) / heard.strokes.gain_per_m_s2
    };
    let ratio = level(&loud) / level(&quiet);
    assert!((ratio - 2.0).abs() < 0.02, "{ratio}");
}

#[test]
fn taps_alone_are_as_many_as_the_texture_has_speeds_for() {
    let (heard, samples) =
        heard(&builtin::texture(), &Gesture::asked(None, None, true), None).unwrap();
    assert_eq!((heard.strokes.count, heard.taps.count), (0, 3));
    let third = samples.len() / 3;
    let loudest = |part: &[f64]| part.iter().fold(0.0f64, |peak, x| peak.max(x.abs()));
    assert!(
        loudest(&samples[2 * third..]) > loudest(&samples[..third]),
        "the fastest is the loudest"
    );
}

#[test]
fn a_texture_without_taps_is_said_to_have_none() {
    let mut texture = builtin::texture();
    texture.taps.traces.clear();
    let refused = heard(&texture, &Gesture::asked(None, None, true), None).unwrap_err();
    assert!(refused.what.ends_with("has no taps") && refused.usage);
    let (heard, _) = heard(&texture, &Gesture::usual(), None).unwrap();
    assert_eq!(heard.taps.count, 0);
    assert!(
        heard.warnings[0].contains("no taps"),
        "{:?}",
        heard.warnings
    );
}

#[test]
fn the_rate_of_the_loop_has_to_suit_the_texture() {
    let session = Gesture::asked(Some(500.0), None, false);
    let refused = heard(&builtin::texture(), &session, Some(1234.5)).unwrap_err();
    assert!(refused.remedy.contains("1 to 20 times"), "{refused}");
    let (heard, _) = heard(&builtin::texture(), &session, Some(5000.0)).unwrap();
    assert!((heard.seconds - 3.25).abs() < 0.01);
    assert!(
        heard.warnings[0].contains("known up to"),
        "{:?}",
        heard.warnings
    );
}
