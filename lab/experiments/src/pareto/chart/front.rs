//! All designs in one panel, with the Pareto front.

use super::costs::Costs;
use super::errors::{BUDGET, error_axis, larger_error};
use super::labels::Labels;
use super::mark::{DEFAULT, UNSTABLE, mark, of_factor};
use crate::pareto::front::on_front;
use crate::pareto::measure::Results;
use crate::pareto::summary::VariantSummary;
use asperity::passes::reduce::BUDGET_DB;
use asperity_kernels::design::{Factor, Order};
use asperity_plot::{Canvas, Key, Panel, PlotError, Rect, Stroke, ink};

const SIZE: (u32, u32) = (2000, 1300);
const FRONT: Stroke = Stroke::new(ink::LIGHT, 3.0);

pub(super) fn draw(results: &Results) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(SIZE.0, SIZE.1)?;
    let costs = Costs::of(results);
    let panel = Panel::new(
        Rect::new(0.0, 0.0, SIZE.0 as f32, SIZE.1 as f32),
        costs.axis(&results.summaries),
        error_axis("p95 of the larger error, at rest or in motion (dB)"),
    )
    .title(format!(
        "Cost and error of every design over {} materials",
        results.materials.len()
    ))
    .with_legend(2);
    panel.draw_frame(&mut canvas);
    panel.horizontal_line(&mut canvas, BUDGET_DB.0, BUDGET);
    draw_legend(&mut canvas, &panel);

    let stable: Vec<&VariantSummary> = results
        .summaries
        .iter()
        .filter(|s| s.unstable == 0.0)
        .collect();
    let points: Vec<(f64, f64)> = stable
        .iter()
        .map(|s| (costs.value(s), larger_error(s)))
        .collect();
    let mut front: Vec<usize> = (0..points.len())
        .filter(|&i| on_front(&points, i))
        .collect();
    front.sort_by(|&a, &b| points[a].0.total_cmp(&points[b].0));
    let mut steps: Vec<(f64, f64)> = Vec::new();
    for &index in &front {
        if let Some(&(_, before)) = steps.last() {
            steps.push((points[index].0, before));
        }
        steps.push(points[index]);
    }
    panel.line(&mut canvas, steps.iter().copied(), FRONT);

    let every = results
        .summaries
        .iter()
        .map(|s| panel.position(costs.value(s), larger_error(s)));
    let mut labels = Labels::new(panel.area(), every.collect::<Vec<_>>());
    let at = |&(x, y): &(f64, f64)| panel.position(x, y);
    labels.reserve_line(&steps.iter().map(at).collect::<Vec<_>>());
    labels.reserve_line(&[
        panel.position(panel.x.min, BUDGET_DB.0),
        panel.position(panel.x.max, BUDGET_DB.0),
    ]);
    for summary in &results.summaries {
        let at = (costs.value(summary), larger_error(summary));
        mark(&mut canvas, &panel, at, summary);
    }
    let default = |s: &VariantSummary| s.variant.factor == Factor::Default;
    let named = |s: &VariantSummary| {
        default(s)
            || matches!(
                s.variant.factor,
                Factor::Cross | Factor::Structure | Factor::Level | Factor::Shape
            )
            || front.iter().any(|&i| std::ptr::eq(stable[i], s))
    };
    let mut order: Vec<&VariantSummary> = results.summaries.iter().filter(|s| named(s)).collect();
    // The most important names are placed first.
    order.sort_by_key(|s| (!default(s), s.variant.design.order != Order::Auto));
    for summary in order {
        let at = panel.position(costs.value(summary), larger_error(summary));
        let mut text = summary.variant.name.clone();
        if summary.unstable > 0.0 {
            text += &format!(" ({:.2} % unstable)", 100.0 * summary.unstable);
        }
        labels.set(&mut canvas, &text, at);
    }
    canvas.png()
}

fn draw_legend(canvas: &mut Canvas, panel: &Panel) {
    let factors = Factor::VARIED.iter().enumerate();
    let factors = factors.map(|(index, factor)| (of_factor(index), factor.name()));
    let others = [
        (UNSTABLE, "not stable everywhere"),
        (DEFAULT, "default"),
        (Key::Line(FRONT), "front"),
        (Key::Line(BUDGET), "budget, 0.5 dB"),
    ];
    let keys: Vec<_> = factors.chain(others).collect();
    panel.legend(canvas, &keys);
}
