//! From a folder to what its sensors say of a surface.

use super::error::RecordingFailure;
use crate::pipeline::{Pass, Pipeline};
use asperity_recording::{
    RecordingError,
    check::{self, Checked},
    description::Quantity,
    friction::{self, Friction},
    grid::{self, GridFit},
    impact::{self, Impact, SpeedSource, Transient},
    reader::{self, Recording},
    resonance::{self, FreeAir},
    segments::{self, Segments},
    timeline::Timeline,
};
use std::path::Path;

/// Least time of strokes, s, and stretches.
const LEAST_STROKES: (f64, usize) = (3.0, 8);

/// Analysis of the sensor data.
#[derive(Debug)]
pub struct Analysis {
    /// The files.
    pub recording: Recording,
    /// The verdicts.
    pub checked: Checked,
    /// Motion and load.
    pub timeline: Timeline,
    /// Taps in free air and the resonances that they show, which were compensated.
    pub free_air: FreeAir,
    /// The stretches of its strokes.
    pub strokes: Segments,
    /// The grid.
    pub fit: GridFit,
    /// Friction, if forces along the surface were recorded.
    pub friction: Option<Friction>,
    /// All impacts.
    pub impacts: Vec<Impact>,
    /// Where their speeds come from.
    pub speed_source: SpeedSource,
    /// Transients by speed.
    pub transients: Vec<Transient>,
}

/// Reads and checks a recording.
///
/// # Errors
/// [`RecordingError`] for files that cannot be read or aligned.
pub fn check(folder: &Path) -> Result<(Recording, Checked, Timeline), RecordingError> {
    let recording = reader::load(folder)?;
    let (checked, timeline) = check::check(&recording)?;
    Ok((recording, checked, timeline))
}

/// Takes a recording through all steps, each a pass of `pipeline`. With `force`, faults do not stop it.
///
/// # Errors
/// [`RecordingFailure`] for a recording that cannot be read, is faulty, or too short.
pub fn analyse(
    folder: &Path,
    force: bool,
    pipeline: &mut Pipeline,
) -> Result<Analysis, RecordingFailure> {
    let mut recording = pipeline.run(Pass::Read, || reader::load(folder))?;
    let (checked, mut timeline) = pipeline.run(Pass::Check, || check::check(&recording))?;
    let faults: Vec<_> = checked.stopping().collect();
    if let (Some(first), false) = (faults.first(), force) {
        return Err(RecordingFailure::Faulty {
            folder: folder.to_owned(),
            count: faults.len(),
            first: format!("{} {}: {}", first.file, first.channel, first.what),
            remedy: first.remedy.clone(),
        });
    }
    let late_s = recording
        .channels
        .iter()
        .find(|c| c.quantity == Quantity::Acceleration)
        .map_or(0.0, |c| checked.late_of(&c.file));
    let free_air = pipeline.run(Pass::Resonance, || {
        let free_air = resonance::find(&recording, &timeline, late_s);
        resonance::compensate(&mut recording, &mut timeline, late_s, &free_air);
        free_air
    });
    let strokes = pipeline.run(Pass::Segments, || {
        segments::segments(&timeline, &segments::vibration(&timeline))
    });
    let (least_s, least) = LEAST_STROKES;
    let too_few = || RecordingFailure::TooFewStrokes {
        folder: folder.to_owned(),
        found_s: strokes.covered_s(),
        segments: strokes.segments.len(),
        least_s,
    };
    if strokes.covered_s() < least_s || strokes.segments.len() < least {
        return Err(too_few());
    }
    let fit = pipeline
        .run(Pass::Grid, || grid::fit(&strokes))
        .ok_or_else(too_few)?;
    let friction = pipeline.run(Pass::Friction, || friction::friction(&timeline));
    let (impacts, transients) = pipeline.run(Pass::Taps, || {
        let impacts = impact::impacts(&recording, &timeline, late_s);
        let transients = impact::transients(&impacts);
        (impacts, transients)
    });
    Ok(Analysis {
        speed_source: SpeedSource::new(&timeline, &impacts),
        recording,
        checked,
        timeline,
        free_air,
        strokes,
        fit,
        friction,
        impacts,
        transients,
    })
}
