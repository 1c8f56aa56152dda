//! Materials as reduced by `--fidelity auto`.

use asperity::passes::reduce::{self, BUDGET_DB};
use asperity_kernels::workload::Orders;

/// A material after `--fidelity auto`.
#[derive(Debug, Clone)]
pub struct ReducedMaterial {
    /// The reduction, and its error.
    pub report: reduce::Report,
    /// Orders of the whole texture and of the reduced one.
    pub orders: (Orders, Orders),
    /// Instructions a tick of the default kernel on both.
    pub instructions: Option<(f64, f64)>,
    /// Bytes of both assets.
    pub bytes: Option<(usize, usize)>,
}

impl ReducedMaterial {
    /// Instructions on the reduced texture divided by those on the whole one.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.instructions.map(|(full, kept)| kept / full)
    }

    /// Returns true if the error is within the budget.
    #[must_use]
    pub fn is_within_budget(&self) -> bool {
        self.report.p95_db <= BUDGET_DB.0 && self.report.worst_db <= BUDGET_DB.1
    }
}
