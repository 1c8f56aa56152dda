//! The map of stable walls: stiffness against physical damping for several delays, measured and
//! by the bound.

use asperity_plot::{
    Axis, Canvas, ColorMap, ColorScale, Key, Margins, Marker, Panel, Rect, Stroke, ink, legend,
    size,
};
use asperity_runtime::{Passivity, Wall};

use super::layout::{WIDTH_PX, heading};
use crate::stability::error::StabilityError;
use crate::stability::wall::{Bench, REPORTED, ROUNDING_J, law_j};

const HEIGHT_PX: f32 = 1010.0;
/// With the legend, which holds for every panel.
const HEADING_PX: f32 = 178.0;
/// Delays shown, ticks.
const DELAYS: [u32; 3] = [0, 1, 2];
/// Physical damping shown, N·s/m, and stiffness, N/m.
const DAMPING: (f64, f64) = (0.01, 2.0);
const STIFFNESS: (f64, f64) = (10.0, 4000.0);
/// Rendered damping of the second boundary, N·s/m.
const RENDERED_N_S_M: f64 = 0.2;
/// Edge of a measured cell, pixels.
const CELL_PX: usize = 16;

/// Draws the map.
///
/// # Errors
/// [`StabilityError::Plot`].
pub fn wall_map() -> Result<Vec<u8>, StabilityError> {
    let mut canvas = Canvas::new(WIDTH_PX as u32, HEIGHT_PX as u32)?;
    heading(
        &mut canvas,
        "Walls that give off energy, measured, and the bound",
        "Largest net energy to a hand that moves the stylus as it likes, 1–460 Hz below 0.65 m/s, \
         1 kHz, no friction; cells: rendered damping 0",
    );
    let keys = [
        (Key::Line(BOUND), "bound, rendered damping 0"),
        (Key::Line(DAMPED), "bound, rendered damping 0.2 N·s/m"),
        (MEASURED, "measured, rendered damping 0.2 N·s/m"),
        (Key::Line(OURS), "ours, asked for 500 N/m and 0.1 N·s/m"),
    ];
    legend(&mut canvas, (30.0, 150.0), WIDTH_PX, &keys);
    let scale = ColorScale::new(ColorMap::Viridis, -4.0, 3.0);
    let bar_px = 150.0;
    let width = (WIDTH_PX - bar_px) / DELAYS.len() as f32;
    for (index, delay) in DELAYS.into_iter().enumerate() {
        let last = index + 1 == DELAYS.len();
        let extra = if last { bar_px } else { 0.0 };
        let outer = Rect::new(
            index as f32 * width,
            HEADING_PX,
            width + extra,
            HEIGHT_PX - HEADING_PX,
        );
        let panel = panel(outer, index, delay, extra);
        cells(&mut canvas, &panel, delay, &scale);
        panel.draw_frame(&mut canvas);
        lines(&mut canvas, &panel, delay);
        if last {
            panel.colorbar(&mut canvas, &scale, "log₁₀ of energy given off (mJ)");
        }
    }
    Ok(canvas.png()?)
}

fn panel(outer: Rect, index: usize, delay: u32, extra: f32) -> Panel {
    let title = match delay {
        0 => "No delay".to_owned(),
        1 => "1 tick of delay".to_owned(),
        n => format!("{n} ticks of delay"),
    };
    let mut panel = Panel::new(
        outer,
        Axis::log("Physical damping (N·s/m)", DAMPING.0, DAMPING.1),
        Axis::log("Stiffness (N/m)", STIFFNESS.0, STIFFNESS.1),
    )
    .letter(char::from(b'a' + index as u8))
    .title(title)
    .without_grid();
    panel.margins = Margins {
        right: panel.margins.right + extra,
        ..panel.margins
    };
    panel
}

/// Colours cells by the net energy of undamped walls; passive ones stay white.
fn cells(canvas: &mut Canvas, panel: &Panel, delay: u32, scale: &ColorScale) {
    panel.field(canvas, CELL_PX, |damping, stiffness| {
        let wall = Wall::of(stiffness as f32, 0.0);
        let energy_j = law_j(&Bench::viscous(damping, delay), wall);
        (energy_j > ROUNDING_J).then(|| scale.color((1e3 * energy_j).log10()))
    });
}

const BOUND: Stroke = Stroke::new(ink::BLACK, size::LINE);
const DAMPED: Stroke = BOUND.dashed();
const OURS: Stroke = Stroke::new(ink::VERMILION, 2.0 * size::LINE);
const MEASURED: Key = Key::Point(
    Marker::Circle,
    7.0,
    Some(ink::PAPER),
    Some(Stroke::new(ink::BLACK, size::FRAME)),
);

/// Draws the bound without and with rendered damping, the boundary measured with it, and our
/// wall.
fn lines(canvas: &mut Canvas, panel: &Panel, delay: u32) {
    let per_stiffness = 1e-3 * (0.5 + f64::from(delay));
    let dampings =
        || (0..=200).map(|n| DAMPING.0 * (DAMPING.1 / DAMPING.0).powf(f64::from(n) / 200.0));
    for (stroke, rendered) in [(BOUND, 0.0), (DAMPED, RENDERED_N_S_M)] {
        let line = dampings()
            .filter(|b| *b > rendered)
            .map(|b| (b, (b - rendered) / per_stiffness));
        panel.line(canvas, line, stroke);
    }
    let ours_at = |b: f64| {
        let passivity: Passivity =
            Passivity::new(&Bench::viscous(b, delay).mechanics(), 3.3, 1000.0);
        let wall = passivity.bear(Wall::of(REPORTED.0 as f32, REPORTED.1 as f32));
        (b, f64::from(wall.stiffness.value()))
    };
    panel.line(canvas, dampings().map(ours_at), OURS);
    let measured = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0, 2560.0]
        .map(|stiffness| (least_damping(stiffness, delay), stiffness));
    panel.keyed(canvas, measured, MEASURED);
}

/// Least physical damping, N·s/m, with which a wall of the rendered damping above is passive,
/// by bisection.
fn least_damping(stiffness_n_m: f64, delay: u32) -> f64 {
    let wall = Wall::of(stiffness_n_m as f32, RENDERED_N_S_M as f32);
    let (mut active, mut passive) = (0.0, 20.0);
    for _ in 0..14 {
        let middle = 0.5 * (active + passive);
        if law_j(&Bench::viscous(middle, delay), wall) > ROUNDING_J {
            active = middle;
        } else {
            passive = middle;
        }
    }
    passive
}
