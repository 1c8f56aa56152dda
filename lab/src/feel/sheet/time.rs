//! The axis of time that most panels share.

use asperity_plot::{Axis, Margins};

use crate::feel::recording::Recording;

/// Margins of every panel over time, so that equal times stand above each other.
pub(super) const TIME_MARGINS: Margins = Margins {
    left: 120.0,
    right: 170.0,
    top: 50.0,
    bottom: 14.0,
};

/// The shared axis of time; only the lowest panel numbers its ticks.
pub(super) fn time_axis(recording: &Recording, numbered: bool) -> Axis {
    let axis = Axis::new("", 0.0, recording.duration_s()).ticks_about(12);
    if numbered {
        Axis {
            label: "Time (s)".into(),
            ..axis
        }
    } else {
        axis.unnumbered()
    }
}
