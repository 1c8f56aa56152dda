//! The report of an import, for machines and for people.

use super::{Surveyed, grid::STROKE, source::RANGES_MM};
use crate::compiled::Compiled;
use asperity_surface::stroke::LEAST_SPREAD_OCTAVES;
use serde_json::{Value, json};

impl Surveyed {
    fn measured_to_hz(&self) -> f64 {
        STROKE.0 * self.survey.measured_to_per_mm
    }
}

/// The report for machines: the figures of every texture, and `surface`.
pub(super) fn json(found: &Surveyed, compiled: &Compiled) -> Value {
    let survey = &found.survey;
    let mut report = compiled.figures();
    report["surface"] = json!({
        "pixels": found.pixels,
        "points": found.points,
        "pitch_mm": found.pitch_mm,
        "rms_um": found.rms_um,
        "guessed_depth_mm": found.guessed_mm,
        "modulus_mpa": survey.modulus_mpa,
        "like": found.like,
        "nearest": found.nearest,
        "level_db": survey.level_db,
        "anisotropy_db": survey.anisotropy_db,
        "direction": survey.direction,
        "measured_to_per_mm": survey.measured_to_per_mm,
        "thrown_mm_s": survey.thrown_mm_s,
        "limited_mm_s": survey.limited_mm_s,
        "files": found.files,
        "notes": found.notes,
    });
    report
}

/// A few lines for people.
pub(super) fn text(found: &Surveyed, compiled: &Compiled) -> String {
    let survey = &found.survey;
    let [x, y] = found.pitch_mm;
    let mut lines = vec![
        compiled.line(),
        format!(
            "map: {:.1} × {:.1} mm, points {x:.3} mm apart, heights {:.2} µm RMS",
            x * found.points[0] as f64,
            y * found.points[1] as f64,
            found.rms_um
        ),
        format!(
            "strokes of 100 mm/s under 1 N: {:.1} dB re 1 m/s², lines no narrower than {LEAST_SPREAD_OCTAVES} octaves",
            survey.level_db
        ),
        match &survey.direction {
            Some(direction) => format!(
                "direction: {direction}; {:.1} dB from across to along",
                survey.anisotropy_db
            ),
            None => format!(
                "no direction: {:.1} dB between the loudest and the one at right angles",
                survey.anisotropy_db
            ),
        },
        format!(
            "beyond {:.1} periods a mm, {:.0} Hz at 100 mm/s, spectra follow a fitted power law",
            survey.measured_to_per_mm,
            found.measured_to_hz()
        ),
    ];
    lines.push(match (&found.like, found.nearest.first()) {
        (Some(like), _) => format!(
            "hardness ({:.3} MPa), taps, friction and wall: those of \"{like}\"",
            found.survey.modulus_mpa
        ),
        (None, Some(nearest)) => format!(
            "taps, friction and wall: those that go with such a vibration, as {}'s; something hard was assumed",
            nearest.name
        ),
        (None, None) => "something hard was assumed".into(),
    });
    lines.join("\n")
}

/// What the asset notes of its making.
pub(super) fn notes(found: &Surveyed) -> String {
    let rest = match &found.like {
        Some(like) => format!("Hardness, taps, friction and wall by the words \"{like}\"."),
        None => "Taps, friction and wall by the nearest materials of the learned model.".to_owned(),
    };
    let depth = match found.guessed_mm {
        Some(depth_mm) => format!(" Depth of {depth_mm:.4} mm guessed."),
        None => String::new(),
    };
    let extrapolated = found.measured_to_hz();
    format!(
        "Grid from a map of heights.{depth} Above {extrapolated:.0} Hz at 100 mm/s it is extrapolated. {rest} Gains and masses are unconfirmed defaults."
    )
}

/// What the user should know.
pub(super) fn warnings(found: &Surveyed) -> Vec<String> {
    let mut warnings = found.notes.clone();
    if found.rms_um <= 0.0 {
        warnings.push("the map is flat: nothing vibrates".to_owned());
    } else if let Some(depth_mm) = found.guessed_mm {
        let end = match RANGES_MM.0 < depth_mm && depth_mm < RANGES_MM.1 {
            true => "",
            false => ", the end of what is guessed",
        };
        warnings.push(format!(
            "no depth was stated, so heights and the level of {:.1} dB re 1 m/s² are a guess, {depth_mm:.4} mm from black to white{end}: state --depth-mm",
            found.survey.level_db
        ));
    }
    if let Some(speed_mm_s) = found.survey.limited_mm_s {
        warnings.push(format!(
            "from {speed_mm_s:.0} mm/s on, the vibration is lowered to what a texture can have, 20 dB re 1 m/s²: check the width and the depth"
        ));
    }
    if let Some(speed_mm_s) = found.survey.thrown_mm_s {
        warnings.push(format!(
            "strokes of {speed_mm_s:.0} mm/s or more under 0.4 N would throw a stylus off the surface, which the texture does not show"
        ));
    }
    warnings
}
