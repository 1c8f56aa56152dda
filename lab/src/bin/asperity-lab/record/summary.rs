//! Summary of a recording, as text and as JSON.

use std::path::Path;

use asperity::sources::recording;
use asperity_console::Console;
use asperity_io::output::display;
use asperity_io::shown::counted;
use asperity_lab::capture::Part;
use asperity_recording::check::Severity;
use serde_json::{Value, json};

use super::screen;
use super::session_monitor::{End, Recorded};

/// A recording in its folder.
pub(super) struct Summary<'s> {
    pub(super) folder: &'s Path,
    pub(super) device: &'s str,
    pub(super) sensor: &'s str,
    pub(super) recorded: &'s Recorded,
    pub(super) part: &'s Part,
    /// True if the folder was written.
    pub(super) is_kept: bool,
}

fn end(end: End) -> &'static str {
    match end {
        End::Covered => "everything was visited",
        End::Asked => "asked to",
        End::Over => "time is over",
        End::Full => "an import keeps no more",
        End::Lost => "device or sensor has gone",
        End::Rounding => "the processor no longer rounded to nearest",
    }
}

impl Summary<'_> {
    /// Tells what is wrong with it, as `record-check` would.
    pub(super) fn warn(&self, console: Console) {
        let Recorded { counts, lost, .. } = self.recorded;
        let mut warnings = Vec::new();
        if counts.bad_lines > 0 {
            warnings.push(format!(
                "{} from the sensor",
                counted(counts.bad_lines, "invalid line", "invalid lines")
            ));
        }
        if self.part.misdated > 0 {
            warnings.push(format!(
                "{} left out, because the time stamp was damaged on the way",
                counted(self.part.misdated as u64, "sample was", "samples were")
            ));
        }
        if counts.missing > 0 {
            warnings.push(format!(
                "{} from the sensor",
                counted(counts.missing, "missing value", "missing values")
            ));
        }
        if *lost != (0, 0) {
            warnings.push(format!(
                "{} and {} were lost because they were read too slowly",
                counted(lost.0, "tick", "ticks"),
                counted(lost.1, "sample", "samples")
            ));
        }
        if self.part.is_cut {
            warnings.push("everything after a gap of 0.9 s was left out".into());
        }
        match self.is_kept.then(|| recording::check(self.folder)) {
            Some(Ok((_, checked, _))) => {
                let found = checked.at_least(Severity::Warning);
                warnings.extend(found.map(ToString::to_string));
            }
            Some(Err(error)) => warnings.push(error.to_string()),
            None => {}
        }
        for warning in warnings {
            console.warn(&warning);
        }
    }

    pub(super) fn json(&self) -> Value {
        let Recorded {
            take,
            counts,
            lost,
            missed,
            ..
        } = self.recorded;
        let exploration = take.exploration();
        let coverage = exploration.coverage();
        let (covered, cells) = coverage.covered();
        let (touches, samples) = self.part.rows();
        json!({
            "folder": self.is_kept.then(|| self.folder.display().to_string()), "device": self.device,
            "sensor": self.sensor, "end": end(self.recorded.end),
            "seconds": self.part.seconds, "touches": touches, "samples": samples,
            "sensor_rate_hz": self.part.rate_hz, "missed": missed,
            "covered": covered, "cells": cells, "cell_seconds": coverage.rows(),
            "taps": exploration.taps(), "air_s": exploration.air_s(),
            "bad_lines": counts.bad_lines, "missing_values": counts.missing,
            "misdated_samples": self.part.misdated,
            "lost_ticks": lost.0, "lost_samples": lost.1,
        })
    }

    pub(super) fn text(&self) -> String {
        let exploration = self.recorded.take.exploration();
        let (covered, cells) = exploration.coverage().covered();
        let (touches, samples) = self.part.rows();
        let taps: Vec<String> = exploration.taps().iter().map(u32::to_string).collect();
        format!(
            "{}\nrecording  {}, {:.1} s\ndevice     {}, {touches} positions, {}\nsensor     {}, {samples} samples at {:.1} Hz\ncovered    {covered} of {cells} cells; taps {}; {:.0} s in the air\nend        {}\n",
            screen::grid(exploration),
            if self.is_kept {
                display(self.folder).to_string()
            } else {
                "not kept".into()
            },
            self.part.seconds,
            self.device,
            counted(self.recorded.missed, "missed period", "missed periods"),
            self.sensor,
            self.part.rate_hz,
            taps.join(" "),
            exploration.air_s(),
            end(self.recorded.end)
        )
    }
}
