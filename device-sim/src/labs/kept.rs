//! What `--fidelity auto` keeps of a material.

use asperity::reduce::{self, BUDGET_DB};
use asperity_kernels::workload::Orders;

/// What `--fidelity auto` makes of one material.
#[derive(Debug, Clone)]
pub struct Kept {
    /// What was dropped, and what that costs.
    pub report: reduce::Report,
    /// Orders of the whole texture and of what is kept.
    pub orders: (Orders, Orders),
    /// Instructions of the default kernel on both.
    pub instructions: Option<(f64, f64)>,
    /// Bytes of both.
    pub bytes: Option<(usize, usize)>,
}

impl Kept {
    /// Instructions of what is kept over those of the whole texture.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.instructions.map(|(full, kept)| kept / full)
    }

    /// Whether it is within the budget.
    #[must_use]
    pub fn is_within_budget(&self) -> bool {
        self.report.p95_db <= BUDGET_DB.0 && self.report.worst_db <= BUDGET_DB.1
    }
}
