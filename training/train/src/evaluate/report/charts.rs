//! Pictures of parts 3 and 4.

use super::bars::{self, Bar, Chart, Group};
use crate::evaluate::{
    held_out::{Folds, HeldOut, Predictor},
    probes::{Attribute, ChangeKind, Probing},
    statistics::Share,
};
use asperity::learned::description::CertaintyCurve;
use asperity_plot::{
    Axis, Canvas, Color, Key, Margins, Marker, Panel, PlotError, Rect, Stroke, ink, legend, size,
};

const WIDTH: f32 = 2400.0;
const HEIGHT: f32 = 1100.0;

/// Errors beside the mean texture's, and certainty.
pub(super) fn held_out(part: &HeldOut) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(WIDTH as u32, HEIGHT as u32)?;
    let series: [(&str, Color); 3] = [
        ("text", ink::BLUE),
        ("nearest, rated", ink::ORANGE),
        ("own latent", ink::LIGHT),
    ];
    let groups = [(&part.materials, 0.0, 'a'), (&part.families, 930.0, 'b')];
    for (folds, left, letter) in groups {
        let groups = relative(folds);
        let most = groups.iter().flat_map(|g| &g.bars).map(|bar| bar.high);
        let most = most.fold(1.2, f64::max).min(3.0);
        let chart = Chart {
            letter,
            title: if letter == 'a' {
                "Single materials held out"
            } else {
                "Families held out"
            },
            axis: Axis::new("Error over that of the mean texture", 0.0, 1.02 * most),
            series: &series,
            mark: 1.0,
        };
        bars::draw(
            &mut canvas,
            Rect::new(left, 0.0, 930.0, HEIGHT),
            &chart,
            &groups,
        );
    }
    certainty(
        &mut canvas,
        Rect::new(1860.0, 0.0, WIDTH - 1860.0, HEIGHT),
        part,
    );
    canvas.png()
}

fn relative(folds: &Folds) -> Vec<Group> {
    let groups = folds.metrics.iter().map(|metric| {
        let below = metric.errors[Predictor::Mean as usize]
            .mean
            .max(f64::MIN_POSITIVE);
        let shown = [Predictor::Text, Predictor::NearestRated, Predictor::Own];
        let bars = shown.map(|predictor| {
            let spread = metric.errors[predictor as usize];
            Bar {
                value: spread.mean / below,
                low: (spread.mean - spread.deviation).max(0.0) / below,
                high: (spread.mean + spread.deviation) / below,
            }
        });
        Group {
            name: metric.name.clone(),
            bars: bars.to_vec(),
        }
    });
    groups.collect()
}

fn certainty(canvas: &mut Canvas, rect: Rect, part: &HeldOut) {
    let panel = Panel::new(
        rect,
        Axis::new("Similarity to training captions", 0.0, 1.0),
        Axis::new("Share within tolerance", 0.0, 1.0),
    )
    .letter('c')
    .title("Certainty")
    .margins(Margins {
        top: 122.0,
        ..Margins::default()
    });
    panel.draw_frame(canvas);
    let curves: [(&CertaintyCurve, Stroke); 2] = [
        (
            &part.certainty_both,
            Stroke::new(ink::LIGHT, size::LINE).dashed(),
        ),
        (&part.certainty, Stroke::new(ink::BLUE, 2.0 * size::LINE)),
    ];
    let area = panel.area();
    let names = [
        (Key::Line(curves[1].1), "families held out"),
        (Key::Line(curves[0].1), "both"),
    ];
    legend(canvas, (area.x, area.y - 26.0), rect.right(), &names);
    for (curve, stroke) in curves {
        let knots = || {
            curve
                .similarity
                .iter()
                .copied()
                .zip(curve.certainty.iter().copied())
        };
        // As the compiler reads it: from nothing at 0 to the first knot, flat above the last.
        let last = curve.certainty.last().map(|&y| (1.0, y));
        let line: Vec<(f64, f64)> = [(0.0, 0.0)]
            .into_iter()
            .chain(knots())
            .chain(last)
            .collect();
        panel.line(canvas, line, stroke);
        panel.points(
            canvas,
            knots(),
            Marker::Circle,
            7.0,
            Some(stroke.color),
            None,
        );
    }
}

/// Shares of right directions and pairs.
pub(super) fn probes(part: &Probing) -> Result<Vec<u8>, PlotError> {
    let mut canvas = Canvas::new(WIDTH as u32, 700)?;
    let bar = |share: Share| Bar {
        value: share.share,
        low: share.low,
        high: share.high,
    };
    let directions: Vec<Group> = [
        ("negation", ChangeKind::Negation),
        ("less, more", ChangeKind::Comparative),
        ("degree", ChangeKind::Degree),
    ]
    .into_iter()
    .map(|(name, kind)| Group {
        name: name.into(),
        bars: vec![bar(part.right(|d| d.kind == kind))],
    })
    .collect();
    let pairs: Vec<Group> = Attribute::ALL
        .iter()
        .zip(&part.pairs)
        .map(|(attribute, ranked)| Group {
            name: attribute.name().into(),
            bars: vec![
                bar(ranked.model),
                bar(ranked.material.right),
                bar(ranked.phrase.right),
            ],
        })
        .collect();
    let half = 0.5 * WIDTH;
    let mut chart = Chart {
        letter: 'a',
        title: "Changed prompts that move the right way",
        axis: Axis::new("Share, 95 % interval", 0.0, 1.0),
        series: &[("decoded texture", ink::BLUE)],
        mark: 0.5,
    };
    bars::draw(
        &mut canvas,
        Rect::new(0.0, 0.0, half, 700.0),
        &chart,
        &directions,
    );
    chart.letter = 'b';
    chart.title = "Pairs in the right order";
    chart.series = &[
        ("decoded texture", ink::BLUE),
        ("nearest material", ink::ORANGE),
        ("nearest phrase", ink::LIGHT),
    ];
    bars::draw(
        &mut canvas,
        Rect::new(half, 0.0, half, 700.0),
        &chart,
        &pairs,
    );
    canvas.png()
}
