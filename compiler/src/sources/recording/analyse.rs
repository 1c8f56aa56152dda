//! From a folder to what its sensors say of a surface.

use crate::pipeline::{Pass, Pipeline};
use asperity_io::{diagnostic::Fault, shown::counted};
use asperity_recording::{
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
/// [`Fault`] for files that cannot be read or aligned.
pub fn check(folder: &Path) -> Result<(Recording, Checked, Timeline), Fault> {
    let recording = reader::load(folder)?;
    let (checked, timeline) = check::check(&recording)?;
    Ok((recording, checked, timeline))
}

/// Takes a recording through all steps, each a pass of `pipeline`. With `force`, faults do not stop it.
///
/// # Errors
/// [`Fault`] for a recording that cannot be read, is faulty, or too short.
pub fn analyse(folder: &Path, force: bool, pipeline: &mut Pipeline) -> Result<Analysis, Fault> {
    let mut recording = pipeline.run(Pass::Read, || reader::load(folder))?;
    let (checked, mut timeline) = pipeline.run(Pass::Check, || check::check(&recording))?;
    let faults: Vec<_> = checked.stopping().collect();
    if let (Some(first), false) = (faults.first(), force) {
        let count = counted(faults.len(), "fault", "faults");
        let what = format!(
            "{count}, the first: {} {}: {}",
            first.file, first.channel, first.what
        );
        let remedy = format!(
            "{}; `asperity record-check` lists every fault, and --force imports regardless",
            first.remedy
        );
        return Err(Fault::new(what, remedy).at(folder));
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
    let too_few = || {
        let what = format!(
            "{:.1} s of usable strokes in {}; at least {least_s} s are needed",
            strokes.covered_s(),
            counted(strokes.segments.len(), "segment", "segments")
        );
        let remedy = "stroke for half a minute at many speeds and forces: a segment is 0.1 s or more of contact in which speed and force change by no more than a factor of four; docs/recording.md explains how to record";
        Fault::new(what, remedy).at(folder)
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
