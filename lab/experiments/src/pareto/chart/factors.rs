//! A panel for each factor: its variants among all others.

use super::costs::Costs;
use super::errors::{BUDGET, error_axis, within};
use super::labels::Labels;
use super::mark::{DEFAULT, UNSTABLE, mark, of_factor};
use crate::pareto::measure::Results;
use crate::pareto::summary::VariantSummary;
use asperity::passes::reduce::BUDGET_DB;
use asperity_kernels::design::Factor;
use asperity_plot::{Canvas, Key, Marker, Panel, PlotError, Rect, ink, legend};

const SIZE: (f32, f32) = (2200.0, 2780.0);
/// Height of the legend, which holds for every panel.
const LEGEND: f32 = 60.0;
const OTHER: Key = Key::Point(Marker::Circle, 5.0, Some(ink::LIGHT), None);
const COLUMNS: usize = 2;

/// The error by which the variants of a factor differ.
#[derive(Clone, Copy)]
enum Measure {
    Rest,
    Motion,
}

impl Measure {
    fn of(factor: Factor) -> Self {
        match factor {
            Factor::Update | Factor::Structure => Self::Motion,
            _ => Self::Rest,
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Rest => "Distortion at rest, p95 (dB)",
            Self::Motion => "Block level in motion, p95 (dB)",
        }
    }

    fn value(self, summary: &VariantSummary) -> f64 {
        match self {
            Self::Rest => summary.distortion_db.map_or(f64::INFINITY, |s| s.p95),
            Self::Motion => summary.moving_level_db.map_or(f64::INFINITY, |s| s.p95),
        }
    }
}

pub(super) fn draw(results: &Results) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(SIZE.0 as u32, SIZE.1 as u32)?;
    let costs = Costs::of(results);
    let (width, height) = (SIZE.0 / COLUMNS as f32, (SIZE.1 - LEGEND) / 4.0);
    let keys = [
        (DEFAULT, "default"),
        (of_factor(0), "a panel's own designs, in its colour"),
        (UNSTABLE, "not stable everywhere"),
        (OTHER, "designs of other panels"),
        (Key::Line(BUDGET), "budget, 0.5 dB"),
    ];
    legend(&mut canvas, (120.0, 40.0), SIZE.0, &keys);
    for (index, factor) in Factor::VARIED.into_iter().enumerate() {
        let (row, column) = (index / COLUMNS, index % COLUMNS);
        let outer = Rect::new(
            column as f32 * width,
            LEGEND + row as f32 * height,
            width,
            height,
        );
        draw_factor(&mut canvas, results, &costs, (index, factor), outer);
    }
    canvas.png()
}

fn draw_factor(
    canvas: &mut Canvas,
    results: &Results,
    costs: &Costs,
    (index, factor): (usize, Factor),
    outer: Rect,
) {
    let measure = Measure::of(factor);
    let mine: Vec<&VariantSummary> = results
        .summaries
        .iter()
        .filter(|s| s.variant.factor == factor || s.variant.factor == Factor::Default)
        .collect();
    let mut x = costs.axis(mine.iter().copied());
    if index / COLUMNS < 3 {
        x.label = String::new();
    }
    let panel = Panel::new(outer, x, error_axis(measure.label()))
        .letter(char::from(b'a' + index as u8))
        .title(capitalised(factor.name()));
    panel.draw_frame(canvas);
    panel.horizontal_line(canvas, BUDGET_DB.0, BUDGET);
    let at = |summary: &VariantSummary| (costs.value(summary), within(measure.value(summary)));
    let others = results.summaries.iter().map(at);
    panel.keyed(canvas, others, OTHER);
    for summary in &mine {
        mark(canvas, &panel, at(summary), summary);
    }
    let points = mine.iter().map(|s| {
        let (x, y) = at(s);
        panel.position(x, y)
    });
    let mut labels = Labels::new(panel.area(), points.collect::<Vec<_>>());
    labels.reserve_line(&[
        panel.position(panel.x.min, BUDGET_DB.0),
        panel.position(panel.x.max, BUDGET_DB.0),
    ]);
    for summary in mine {
        let (x, y) = at(summary);
        let mut text = summary.variant.name.clone();
        if summary.unstable > 0.0 {
            text += &format!(" ({:.2} % unstable)", 100.0 * summary.unstable);
        }
        labels.set(canvas, &text, panel.position(x, y));
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
