//! Savings and costs of `--fidelity auto`, a point for each material.

use super::errors::BUDGET;
use crate::pareto::measure::Results;
use crate::pareto::reduced_material::ReducedMaterial;
use asperity::passes::reduce::BUDGET_DB;
use asperity_plot::{Axis, Canvas, Key, Marker, Panel, PlotError, Rect, Stroke, ink};

const SIZE: (u32, u32) = (2200, 860);

pub(super) fn draw(results: &Results) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(SIZE.0, SIZE.1)?;
    let half = SIZE.0 as f32 / 2.0;
    let count = results.kept.len() as f64;
    let materials = || Axis::new("Materials, sorted", 0.0, count + 1.0);
    let ranked = |value: &dyn Fn(&ReducedMaterial) -> Option<f64>| -> Vec<(f64, f64)> {
        let mut values: Vec<f64> = results.kept.iter().filter_map(value).collect();
        values.sort_by(f64::total_cmp);
        (1..).map(f64::from).zip(values).collect()
    };

    let saved = Panel::new(
        Rect::new(0.0, 0.0, half, SIZE.1 as f32),
        materials(),
        Axis::new("Kept of the whole texture (share)", 0.0, 1.05),
    )
    .letter('a')
    .title("What auto keeps")
    .with_legend(1);
    saved.draw_frame(&mut canvas);
    saved.horizontal_line(&mut canvas, 0.5, Stroke::new(ink::GREY, 2.0).dotted());
    let ratio = |full: usize, kept: usize| Some(kept as f64 / full.max(1) as f64);
    let series: [(&str, _, Vec<(f64, f64)>); 4] = [
        ("instructions", ink::BLUE, ranked(&|k| k.ratio())),
        (
            "poles and zeros",
            ink::VERMILION,
            ranked(&|k| {
                let (o, z) = (k.report.order, k.report.zeros);
                ratio(o.full + z.full, o.kept + z.kept)
            }),
        ),
        (
            "vertices",
            ink::GREEN,
            ranked(&|k| ratio(k.report.vertices.full, k.report.vertices.kept)),
        ),
        (
            "bytes",
            ink::PURPLE,
            ranked(&|k| k.bytes.and_then(|(full, kept)| ratio(full, kept))),
        ),
    ];
    let mut keys = Vec::new();
    for (index, (name, color, points)) in series.into_iter().enumerate() {
        if points.is_empty() {
            continue;
        }
        let marker = Marker::category(index);
        saved.points(&mut canvas, points, marker, 6.0, Some(color), None);
        keys.push((Key::Point(marker, 7.0, Some(color), None), name));
    }
    saved.legend(&mut canvas, &keys);

    let lost = Panel::new(
        Rect::new(half, 0.0, half, SIZE.1 as f32),
        materials(),
        Axis::new("Distortion over the grid (dB)", 0.0, 1.15),
    )
    .letter('b')
    .title("What that costs")
    .with_legend(1);
    lost.draw_frame(&mut canvas);
    lost.horizontal_line(&mut canvas, BUDGET_DB.0, BUDGET);
    lost.horizontal_line(&mut canvas, BUDGET_DB.1, BUDGET);
    let series = [
        (
            "95 % of the places",
            ink::BLUE,
            ranked(&|k| Some(k.report.p95_db)),
        ),
        (
            "worst place",
            ink::ORANGE,
            ranked(&|k| Some(k.report.worst_db)),
        ),
    ];
    let mut keys = Vec::new();
    for (index, (name, color, points)) in series.into_iter().enumerate() {
        let marker = Marker::category(index);
        lost.points(&mut canvas, points, marker, 6.0, Some(color), None);
        keys.push((Key::Point(marker, 7.0, Some(color), None), name));
    }
    keys.push((Key::Line(BUDGET), "budgets, 0.5 and 1 dB"));
    lost.legend(&mut canvas, &keys);
    canvas.png()
}
