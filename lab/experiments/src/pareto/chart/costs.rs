//! The axis of costs.

use crate::pareto::measure::Results;
use crate::pareto::summary::VariantSummary;
use asperity_plot::Axis;

/// Cost of a design: instructions, or bytes where none were counted.
pub(super) struct Costs {
    counted: bool,
}

impl Costs {
    pub(super) fn of(results: &Results) -> Self {
        Self {
            counted: results.summaries.iter().all(|s| s.instructions.is_some()),
        }
    }

    pub(super) fn value(&self, summary: &VariantSummary) -> f64 {
        let value = if self.counted {
            summary.instructions
        } else {
            summary.bytes.map(|b| b as f64)
        };
        value.unwrap_or(f64::NAN)
    }

    /// An axis that covers the costs of some designs.
    pub(super) fn axis<'a>(&self, designs: impl IntoIterator<Item = &'a VariantSummary>) -> Axis {
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
