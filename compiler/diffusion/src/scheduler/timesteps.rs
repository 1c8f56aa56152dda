//! Which of the trained steps are taken.

use super::config::{Config, Spacing};
use crate::error::Problem;

/// `steps` of the trained steps, descending. They are whole but for [`Spacing::Linspace`], which the
/// caller rounds if it must.
pub(super) fn timesteps(
    config: &Config,
    default: Spacing,
    steps: usize,
) -> Result<Vec<f64>, Problem> {
    let trained = config.trained_steps();
    let spacing = config.spacing.unwrap_or(default);
    let stride = trained / steps.max(1);
    let last = match spacing {
        Spacing::Leading => stride * steps.saturating_sub(1) + config.steps_offset,
        Spacing::Linspace | Spacing::Trailing => trained - 1,
    };
    if steps == 0 || stride == 0 || last >= trained {
        // With a stride of 2 or more, an offset below it stays inside.
        let most = match spacing {
            Spacing::Leading => trained / (config.steps_offset + 1),
            Spacing::Linspace | Spacing::Trailing => trained,
        };
        return Err(Problem::Steps { steps, most });
    }
    let taken = (0..steps).rev();
    Ok(match spacing {
        Spacing::Leading => taken
            .map(|n| (n * stride + config.steps_offset) as f64)
            .collect(),
        Spacing::Linspace if steps == 1 => vec![last as f64],
        Spacing::Linspace => taken
            .map(|n| last as f64 * n as f64 / (steps - 1) as f64)
            .collect(),
        Spacing::Trailing => taken
            .map(|n| (trained as f64 * (n + 1) as f64 / steps as f64).round_ties_even() - 1.0)
            .collect(),
    })
}
