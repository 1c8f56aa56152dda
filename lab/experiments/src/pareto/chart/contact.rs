//! What each part of a contact law costs, and what is lost without it.

use super::labels::Labels;
use crate::pareto::contact::ContactSummary;
use asperity_plot::{Axis, Canvas, Key, Marker, Panel, PlotError, Rect, Stroke, ink};

const SIZE: (u32, u32) = (1600, 900);
/// Errors below this are drawn there, %.
const LEAST: f64 = 0.01;
const MEDIAN: Key = Key::Point(Marker::Circle, 9.0, Some(ink::BLUE), None);
const SPREAD: Stroke = Stroke::new(ink::BLUE, 3.0);
/// The smallest difference of force that a hand notices, %.
const NOTICED: f64 = 7.0;
const NOTICEABLE: Stroke = Stroke::new(ink::VERMILION, 2.5).dashed();

/// The chart; `None` where nothing was counted.
pub(super) fn draw(designs: &[ContactSummary]) -> Result<Option<Vec<u8>>, PlotError> {
    let saved = |design: &ContactSummary| Some(design.whole? - design.instructions?);
    let points: Option<Vec<_>> = (designs.iter().skip(1))
        .map(|design| {
            let (press, drag) = (design.press?, design.drag?);
            let larger = if press.median > drag.median {
                press
            } else {
                drag
            };
            let percent = |share: f64| (100.0 * share).max(LEAST);
            Some((
                design.name,
                saved(design)?,
                percent(larger.median),
                percent(larger.p95),
            ))
        })
        .collect();
    let Some(points) = points else {
        return Ok(None);
    };
    let mut canvas = Canvas::new(SIZE.0, SIZE.1)?;
    let panel = Panel::new(
        Rect::new(0.0, 0.0, SIZE.0 as f32, SIZE.1 as f32),
        Axis::covering(
            "Instructions a tick saved",
            points.iter().map(|p| p.1).chain([0.0]),
        ),
        Axis::log("Force lost (% RMS)", LEAST, 200.0),
    )
    .title("Contact laws with a part left out")
    .with_legend(1);
    panel.draw_frame(&mut canvas);
    panel.horizontal_line(&mut canvas, NOTICED, NOTICEABLE);
    let places = points.iter().map(|&(_, x, y, _)| panel.position(x, y));
    let mut labels = Labels::new(panel.area(), places);
    for &(_, x, median, p95) in &points {
        panel.line(&mut canvas, [(x, median), (x, p95)], SPREAD);
        let (low, high) = (panel.position(x, median), panel.position(x, p95));
        labels.reserve_line(&[low, high]);
        panel.keyed(&mut canvas, [(x, median)], MEDIAN);
    }
    for &(name, x, y, _) in &points {
        labels.set(&mut canvas, name, panel.position(x, y));
    }
    let keys = [
        (MEDIAN, "median of the materials that have the part"),
        (Key::Line(SPREAD), "to the 95th percentile"),
        (Key::Line(NOTICEABLE), "noticed, 7 %"),
    ];
    panel.legend(&mut canvas, &keys);
    canvas.png().map(Some)
}
