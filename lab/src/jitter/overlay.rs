//! Runs over each other: the percentiles of one stage.

use super::chart::{curve, period_stroke, us};
use asperity_host::{latency::Run, servo::Stage};
use asperity_plot::{Axis, Canvas, Key, Panel, PlotError, Rect, Stroke, size};
use hdrhistogram::Histogram;

const SIZE: (f32, f32) = (2000.0, 1200.0);
/// Longest name in the legend, letters.
const LONGEST: usize = 44;

/// Draws the percentiles of a stage of every run as PNG, with the shortest period that a run
/// states.
///
/// # Errors
/// [`PlotError`].
pub fn draw(runs: &[(String, Run)], stage: Stage) -> Result<Vec<u8>, PlotError> {
    let histograms: Vec<_> = runs.iter().map(|(_, run)| run.raw(stage)).collect();
    let names: Vec<String> = runs.iter().map(|(name, _)| shortened(name)).collect();
    let strokes = (0..runs.len()).map(|index| Stroke::category(index, 1.4 * size::LINE));
    let strokes: Vec<Stroke> = strokes.collect();
    let lines = strokes.iter().map(|stroke| Key::Line(*stroke));
    let mut keys: Vec<(Key, &str)> = lines.zip(names.iter().map(String::as_str)).collect();
    let periods = runs.iter().map(|(_, run)| run.facts.period_ns);
    let period_ns = periods.filter(|period_ns| *period_ns > 0).min();
    if period_ns.is_some() {
        keys.push((Key::Line(period_stroke()), "a period"));
    }
    let most = histograms.iter().map(Histogram::len).max().unwrap_or(0);
    let least_ns = histograms.iter().map(Histogram::min).min().unwrap_or(0);
    let largest_ns = histograms.iter().map(Histogram::max).max().unwrap_or(0);
    let mut panel = Panel::new(
        Rect::new(0.0, 0.0, SIZE.0, SIZE.1),
        Axis::percentiles("Percentile of the ticks (%)", most.max(10)),
        Axis::log(
            "Latency (µs)",
            0.5 * us(least_ns),
            2.0 * us(largest_ns.max(period_ns.unwrap_or(0))),
        ),
    )
    .title(format!("Latency of {}", name_of(stage)));
    panel.margins.right = 48.0;
    let mut canvas = Canvas::new(SIZE.0 as u32, SIZE.1 as u32)?;
    let panel = panel
        .clone()
        .with_legend(panel.legend_lines(&canvas, &keys));
    panel.draw_frame(&mut canvas);
    if let Some(period_ns) = period_ns {
        panel.horizontal_line(&mut canvas, us(period_ns), period_stroke());
    }
    for (histogram, stroke) in histograms.iter().zip(strokes) {
        panel.line(&mut canvas, curve(histogram), stroke);
    }
    panel.legend(&mut canvas, &keys);
    canvas.png()
}

const fn name_of(stage: Stage) -> &'static str {
    match stage {
        Stage::WakeUp => "the wake-up",
        Stage::Read => "reading",
        Stage::Compute => "computing",
        Stage::Write => "writing",
        Stage::Total => "due to written",
        Stage::Interval => "the interval between wake-ups",
    }
}

/// The end of a name, which tells paths apart.
fn shortened(name: &str) -> String {
    let letters = name.chars().count();
    if letters <= LONGEST {
        return name.to_owned();
    }
    let end: String = name.chars().skip(letters - LONGEST + 1).collect();
    format!("…{end}")
}
