//! The pictures of a comparison, each as SVG and PNG.

mod factors;
mod fidelity;
mod front;
mod held_out;
mod labels;
mod rows;

use super::pareto::{Results, Summary};
use super::table::HeldOut;
use asperity_plot::{Axis, Canvas, Color, PlotError, Stroke, ink};

/// One picture.
pub struct Picture {
    /// Scalable.
    pub svg: String,
    /// Pixels.
    pub png: Vec<u8>,
}

/// Every picture by the name of its file: `front`, `factors`, `held-out`, `fidelity`.
///
/// # Errors
/// [`PlotError`] of the encoder.
pub fn all(
    results: &Results,
    held_out: &[HeldOut],
) -> Result<Vec<(&'static str, Picture)>, PlotError> {
    Ok(vec![
        ("front", front::draw(results)?),
        ("factors", factors::draw(results)?),
        ("held-out", held_out::draw(held_out)?),
        ("fidelity", fidelity::draw(results)?),
    ])
}

fn finished(canvas: &Canvas) -> Result<Picture, PlotError> {
    Ok(Picture {
        svg: canvas.svg().unwrap_or_default(),
        png: canvas.png()?,
    })
}

/// Errors are drawn within this range, dB; what lies outside stands on its edge.
const ERROR_RANGE_DB: (f64, f64) = (0.002, 20.0);
/// The line of the perceptual budget.
const BUDGET: Stroke = Stroke::new(ink::VERMILION, 2.5).dashed();

/// What a design costs: instructions, or bytes where none were counted.
struct Costs {
    counted: bool,
}

impl Costs {
    fn of(results: &Results) -> Self {
        Self {
            counted: results.summaries.iter().all(|s| s.instructions.is_some()),
        }
    }

    fn value(&self, summary: &Summary) -> f64 {
        let value = if self.counted {
            summary.instructions
        } else {
            summary.bytes.map(|b| b as f64)
        };
        value.unwrap_or(f64::NAN)
    }

    /// Around some designs.
    fn axis<'a>(&self, designs: impl IntoIterator<Item = &'a Summary>) -> Axis {
        let values: Vec<f64> = designs
            .into_iter()
            .map(|s| self.value(s))
            .filter(|v| v.is_finite())
            .collect();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let label = if self.counted {
            "Executed instructions a tick: mixing, conversion, synthesis"
        } else {
            "Bytes of an asset, median"
        };
        Axis::log(label, 0.75 * least, 1.6 * most)
    }
}

/// The larger of the errors at rest and in motion that 95 % keep, dB.
fn larger_error(summary: &Summary) -> f64 {
    let p95 = |spread: Option<super::statistics::Spread>| spread.map_or(f64::INFINITY, |s| s.p95);
    within(p95(summary.distortion_db).max(p95(summary.moving_level_db)))
}

fn within(error_db: f64) -> f64 {
    error_db.clamp(ERROR_RANGE_DB.0, ERROR_RANGE_DB.1)
}

fn error_axis(label: &str) -> Axis {
    Axis::log(label, ERROR_RANGE_DB.0, 1.3 * ERROR_RANGE_DB.1)
}

/// Colour of a factor's points.
fn color(index: usize) -> Color {
    const MORE: [Color; 2] = [Color::rgb(120, 94, 40), Color::rgb(60, 60, 150)];
    match index {
        0..6 => ink::category(index),
        _ => MORE[index % 2],
    }
}
