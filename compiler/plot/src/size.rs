//! Sizes of type and lines in pixels, for a sheet of about 2400 px width.

/// Names of pictures.
pub const HEADING: f32 = 48.0;
/// Titles of panels.
pub const TITLE: f32 = 29.0;
/// Axis labels.
pub const LABEL: f32 = 25.0;
/// Tick labels and annotations.
pub const TICK: f32 = 22.0;
/// From one line of a legend to the next, and what a legend adds to a panel's top margin.
pub const LEGEND_ROW: f32 = 30.0;
/// Data lines.
pub const LINE: f32 = 2.5;
/// Frames and tick marks.
pub const FRAME: f32 = 1.5;
