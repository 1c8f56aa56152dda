//! Exports import again with their level, their spectrum and their taps.

use super::*;
use crate::{
    driver::{self, Compiled, Failure},
    emit::{lower::lower, raise::raise},
    interchange::{self, ClipFormat, session},
    pipeline::Request,
    sources::{Tools, builtin},
};
use asperity_formats::Asset;
use asperity_texture::{model::mixture::Field, signal::spectrum::ArmaModel};
use std::{fs, path::Path};

pub(crate) fn options() -> Options {
    Options {
        speed_mm_s: 100.0,
        force_n: 1.0,
        full_scale_m_s2: 5.0,
        tap_full_scale_m_s2: 50.0,
        tap_speed_m_s: 0.3,
        mu: 0.5,
    }
}

/// Compiles a file under the name `back`.
pub(crate) fn import(
    file: &Path,
    kind: EffectsKind,
    options: &Options,
) -> Result<Compiled, Failure> {
    let request = Request {
        name: Some("back".into()),
        ..Request::default()
    };
    let effects = Effects {
        file: file.into(),
        kind,
        options: *options,
    };
    driver::compile(&effects, &request, &Tools::default())
}

/// Exports the built-in texture with known scales and imports it again.
fn there_and_back(format: ClipFormat, kind: EffectsKind) -> Compiled {
    let bytes = lower(&builtin::texture(), None).unwrap().bytes;
    let asset = Asset::parse(&bytes).unwrap();
    let scales = interchange::Options {
        session: session(Some(100.0), Some(1.0), Some(4.0), true),
        rate_hz: None,
        seed: 3,
        full_scale_m_s2: None,
        tap_full_scale_m_s2: None,
        size_px: 64,
    };
    let exported = interchange::export(&asset, format, &scales).unwrap();
    let scale = exported.scale.unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("grit.effect");
    fs::write(&file, &exported.bytes).unwrap();
    let back = Options {
        full_scale_m_s2: scale.stroke_m_s2,
        tap_full_scale_m_s2: scale.tap_m_s2,
        ..options()
    };
    let imported = import(&file, kind, &back).unwrap();
    assert!(imported.warnings.is_empty(), "{:?}", imported.warnings);
    imported
}

/// The model of a texture at the stroke.
fn at_the_stroke(imported: Option<&Compiled>) -> ArmaModel {
    let texture = match imported {
        Some(imported) => raise(&Asset::parse(&imported.lowered.bytes).unwrap()),
        None => builtin::texture(),
    };
    let field = Field::new(&texture.grid);
    field.model(&field.locate(100.0, 1.0).unwrap())
}

/// Level over 20 to 480 Hz, dB.
fn level_db(model: &ArmaModel) -> f64 {
    let sum: f64 = (20..480).map(|hz| model.power(f64::from(hz))).sum();
    10.0 * sum.log10()
}

/// Mean frequency over 20 to 480 Hz.
fn centroid_hz(model: &ArmaModel) -> f64 {
    let power = |hz: i32| model.power(f64::from(hz));
    let moment: f64 = (20..480).map(|hz| f64::from(hz) * power(hz)).sum();
    moment / (20..480).map(power).sum::<f64>()
}

#[test]
fn a_curve_comes_back_with_its_spectrum() {
    let back = at_the_stroke(Some(&there_and_back(ClipFormat::Hjif, EffectsKind::Hjif)));
    let source = at_the_stroke(None);
    let off_db = level_db(&back) - level_db(&source);
    assert!(off_db.abs() < 1.0, "{off_db} dB");
    let octaves: Vec<f64> = [50.0, 80.0, 110.0, 160.0, 220.0, 330.0]
        .iter()
        .map(|&hz| 10.0 * (back.power(hz) / source.power(hz)).log10())
        .collect();
    assert!(octaves.iter().all(|db| db.abs() < 5.0), "{octaves:?}");
}

#[test]
fn envelopes_come_back_with_level_and_mean_frequency() {
    let source = at_the_stroke(None);
    for (format, kind) in [
        (ClipFormat::Haptic, EffectsKind::Haptic),
        (ClipFormat::Ahap, EffectsKind::Ahap),
    ] {
        let back = at_the_stroke(Some(&there_and_back(format, kind)));
        let off_db = level_db(&back) - level_db(&source);
        assert!(off_db.abs() < 1.5, "{format:?}: {off_db} dB");
        let ratio = centroid_hz(&back) / centroid_hz(&source);
        assert!((0.8..1.25).contains(&ratio), "{format:?}: {ratio}");
    }
}

#[test]
fn taps_come_back_as_loud_as_they_were_and_slower_where_they_are_quieter() {
    for (format, kind) in [
        (ClipFormat::Haptic, EffectsKind::Haptic),
        (ClipFormat::Ahap, EffectsKind::Ahap),
        (ClipFormat::Hjif, EffectsKind::Hjif),
    ] {
        let imported = there_and_back(format, kind);
        let taps = &imported.whole.taps;
        assert_eq!(taps.traces.len(), 3, "{format:?}");
        let peaks: Vec<f64> = taps
            .traces
            .iter()
            .map(|t| {
                t.accel_m_s2
                    .iter()
                    .fold(0.0f64, |peak, x| peak.max(x.abs()))
            })
            .collect();
        assert!(peaks.is_sorted_by(|a, b| a < b), "{peaks:?}");
        assert!((taps.traces[2].speed_m_s - 0.3).abs() < 1e-9);
        assert!(!imported.whole.provenance.taps_synthetic);
    }
}

#[test]
fn a_file_without_transients_gets_synthesised_taps_and_one_without_a_stroke_is_silent() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        fs::write(&file, text).unwrap();
        file
    };
    let haptic = |points: &str| {
        format!(
            r#"{{"version":{{"major":1,"minor":0,"patch":0}},"signals":{{"continuous":
            {{"envelopes":{{"amplitude":[{points}]}}}}}}}}"#
        )
    };
    let humming = r#"{"time":0,"amplitude":0.5},{"time":1,"amplitude":0.5}"#;
    let file = write("hum.haptic", &haptic(humming));
    let hum = import(&file, EffectsKind::Haptic, &options()).unwrap();
    assert!(hum.whole.provenance.taps_synthetic && hum.warnings[0].contains("synthesised"));
    let click = r#"{"time":0,"amplitude":0,"emphasis":{"amplitude":1,"frequency":0.5}}"#;
    let file = write("click.haptic", &haptic(click));
    let click = import(&file, EffectsKind::Haptic, &options()).unwrap();
    assert!(
        click.warnings[0].contains("does not vibrate"),
        "{:?}",
        click.warnings
    );
    assert!(
        click
            .whole
            .grid
            .vertices
            .iter()
            .all(|v| v.sigma_m_s2 == 0.0)
    );
    let silence = r#"{"time":0,"amplitude":0},{"time":1,"amplitude":0}"#;
    let file = write("silence.haptic", &haptic(silence));
    let refused = import(&file, EffectsKind::Haptic, &options()).unwrap_err();
    assert!(
        refused.to_string().contains("no effect that sounds"),
        "{refused}"
    );
    let refused = import(Path::new("/nonexistent"), EffectsKind::Ahap, &options()).unwrap_err();
    assert!(refused.to_string().contains("cannot read"), "{refused}");
}
