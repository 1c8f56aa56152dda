//! The worst cases as waveforms, of our method and of others in the same scenario.

use asperity_plot::{Axis, Canvas, Key, Panel, Rect, Stroke, ink, size};

use super::layout::{WIDTH_PX, heading};
use crate::signal::rms;
use crate::stability::error::StabilityError;
use crate::stability::friction::{self, Law};
use crate::stability::material::Material;
use crate::stability::table::StabilityOptions;
use crate::stability::wall::{self, Bench};
use crate::stability::{fault, mixing, tap};

const HEADING_PX: f32 = 130.0;
const ROW_PX: f32 = 620.0;

/// A named curve.
type Curve<'a> = (&'a str, Stroke, Vec<(f64, f64)>);

/// Draws the sheet.
///
/// # Errors
/// [`StabilityError`].
pub fn waveforms(options: &StabilityOptions) -> Result<Vec<u8>, StabilityError> {
    let mut canvas = Canvas::new(WIDTH_PX as u32, (HEADING_PX + 3.0 * ROW_PX) as u32)?;
    heading(
        &mut canvas,
        "Where methods fail: the worst cases",
        &format!(
            "Virtual time, seed {}; ours is the runtime itself",
            options.seed
        ),
    );
    let place = |index: usize| {
        let (column, row) = (index % 2, index / 2);
        Rect::new(
            0.5 * WIDTH_PX * column as f32,
            HEADING_PX + ROW_PX * row as f32,
            0.5 * WIDTH_PX,
            ROW_PX,
        )
    };
    dropped(&mut canvas, place(0))?;
    rest(&mut canvas, place(1), options.seed);
    ramp(&mut canvas, place(2));
    alternation(&mut canvas, place(3), options.seed)?;
    bounces(&mut canvas, place(4))?;
    jump(&mut canvas, place(5), options.seed)?;
    Ok(canvas.png()?)
}

/// Told apart in grey by width and dots.
const OURS: Stroke = Stroke::new(ink::BLUE, 1.8 * size::LINE);
const PAPER: Stroke = Stroke::new(ink::VERMILION, size::LINE);
const REFERENCE: Stroke = Stroke::new(ink::ORANGE, 1.4 * size::LINE).dotted();

/// A panel with its curves, the last on top.
fn draw(
    canvas: &mut Canvas,
    outer: Rect,
    letter: char,
    title: &str,
    axes: (Axis, Axis),
    curves: &[Curve<'_>],
) {
    let mut panel = Panel::new(outer, axes.0, axes.1)
        .letter(letter)
        .title(title)
        .with_legend(1);
    panel.margins.right = 48.0;
    panel.draw_frame(canvas);
    for (_, stroke, points) in curves {
        panel.line(canvas, points.iter().copied(), *stroke);
    }
    let entries: Vec<_> = curves
        .iter()
        .map(|(name, stroke, _)| (Key::Line(*stroke), *name))
        .collect();
    panel.legend(canvas, &entries);
}

fn dropped(canvas: &mut Canvas, outer: Rect) -> Result<(), StabilityError> {
    let silent = Material::silent(wall::REPORTED.0, wall::REPORTED.1)?;
    let bench = Bench::viscous(0.1, 1);
    let height = |lowered| {
        wall::dropped(&bench, &silent, lowered).map(|z| {
            let ms = z.iter().take(1500).enumerate();
            ms.map(|(n, z)| (n as f64, 1e3 * z)).collect::<Vec<_>>()
        })
    };
    draw(
        canvas,
        outer,
        'a',
        "45 g dropped on a wall with 0.5 N, b = 0.1 N·s/m, 1 tick late",
        (
            Axis::new("Time (ms)", 0.0, 1500.0),
            Axis::new("Height (mm)", -20.0, 40.0),
        ),
        &[
            ("500 N/m as given", PAPER, height(false)?),
            ("ours, lowered to 67 N/m", OURS, height(true)?),
        ],
    );
    Ok(())
}

/// The three laws with their strokes, the paper's first.
fn laws() -> [(&'static str, Stroke, Law); 3] {
    let [ours, paper, reference] = friction::laws(0.7, 0);
    [
        (paper.0, PAPER, paper.1),
        (reference.0, REFERENCE, reference.1),
        (ours.0, OURS, ours.1),
    ]
}

fn rest(canvas: &mut Canvas, outer: Rect, seed: u64) {
    let curves = laws().map(|(name, stroke, mut law)| {
        let points: Vec<_> = friction::stroke_and_rest(seed, 700)
            .enumerate()
            .map(|(n, x)| (n as f64, law(x, 1.0)))
            .collect();
        (name, stroke, points)
    });
    draw(
        canvas,
        outer,
        'b',
        "Friction after a stroke of 200 ms: rest with noise of ±1 count, 1 N",
        (
            Axis::new("Time (ms)", 0.0, 700.0),
            Axis::new("Friction (N)", -0.85, 0.85),
        ),
        &curves,
    );
}

fn ramp(canvas: &mut Canvas, outer: Rect) {
    let (accel, top) = (0.01, 12e-3);
    let curves = laws().map(|(name, stroke, mut law)| {
        let speeds = friction::ramp(accel, top);
        let force = friction::forces(&mut law, speeds.len(), 1.0, |n| speeds[n]);
        let points: Vec<_> = speeds
            .iter()
            .zip(force)
            .skip(friction::SETTLE)
            .map(|(v, f)| (1e3 * v, f))
            .collect();
        (name, stroke, points)
    });
    draw(
        canvas,
        outer,
        'c',
        "Friction in a ramp of 10 mm/s² through zero, 1 N, μ = 0.7",
        (
            Axis::new("Speed (mm/s)", -12.0, 12.0),
            Axis::new("Friction (N)", -0.85, 0.85),
        ),
        &curves,
    );
}

fn alternation(canvas: &mut Canvas, outer: Rect, seed: u64) -> Result<(), StabilityError> {
    let (ours, direct) = mixing::worst_pair(&Material::built_in()?, seed);
    let level = |signal: Vec<f64>| -> Vec<(f64, f64)> {
        signal
            .chunks_exact(mixing::BLOCK)
            .enumerate()
            .map(|(n, block)| {
                let db = 20.0 * rms(block).max(1e-12).log10();
                ((n * mixing::BLOCK) as f64, db)
            })
            .collect()
    };
    draw(
        canvas,
        outer,
        'd',
        "Two vertices take turns, at random every sample",
        (
            Axis::new("Time since they take turns (ms)", 0.0, 1000.0),
            Axis::new("Level of 20 ms (dB re 1 m/s²)", -20.0, 200.0),
        ),
        &[
            ("direct form at once", PAPER, level(direct)),
            ("ours", OURS, level(ours)),
        ],
    );
    Ok(())
}

fn bounces(canvas: &mut Canvas, outer: Rect) -> Result<(), StabilityError> {
    let material = Material::built_in()?;
    let span = 90..260;
    let height: Vec<_> = span
        .clone()
        .map(|n| (n as f64, 1e3 * tap::bouncing(n)[2]))
        .collect();
    let force: Vec<_> = tap::tap_forces(&material, span.end, tap::bouncing)
        .into_iter()
        .enumerate()
        .skip(span.start)
        .map(|(n, f)| (n as f64, f))
        .collect();
    let entries: Vec<_> = tap::entries(span.end, tap::bouncing)
        .into_iter()
        .flat_map(|n| [(n as f64, -0.75), (n as f64, -0.6), (f64::NAN, f64::NAN)])
        .collect();
    draw(
        canvas,
        outer,
        'e',
        "A tap at 0.2 m/s that bounces",
        (
            Axis::new("Time (ms)", 90.0, 260.0),
            Axis::new("Height (mm), tap force (N)", -0.8, 2.2),
        ),
        &[
            ("height", Stroke::new(ink::GREY, size::LINE), height),
            ("every entry would tap", PAPER, entries),
            ("our one tap (N)", OURS, force),
        ],
    );
    Ok(())
}

fn jump(canvas: &mut Canvas, outer: Rect, seed: u64) -> Result<(), StabilityError> {
    let material = Material::built_in()?;
    let normal = |forces: Vec<[f64; 3]>| -> Vec<(f64, f64)> {
        forces
            .into_iter()
            .enumerate()
            .map(|(n, f)| (n as f64, f[2]))
            .collect()
    };
    draw(
        canvas,
        outer,
        'f',
        "A depth of 50 mm for 10 ms in a stroke",
        (
            Axis::new("Time (ms)", 280.0, 340.0),
            Axis::new("Normal force (N)", 0.0, 27.0),
        ),
        &[
            ("no limits", PAPER, normal(fault::trusting(fault::deep))),
            (
                "ours",
                OURS,
                normal(fault::ours(&material, fault::deep, seed)),
            ),
        ],
    );
    Ok(())
}
