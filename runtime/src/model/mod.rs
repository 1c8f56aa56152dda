//! The model at a speed and a force: pure functions of the grid, without time.
//!
//! ```text
//! (speed, force) → barycentric weights → mixed LSFs and level → coefficients of the filter
//! ```
//!
//! | file | the paper's | computes |
//! |---|---|---|
//! | `edge` | edge models | the nearest query in the grid |
//! | `barycentric` | f–v grid | triangle and weights |
//! | `mixture` | interpolation of parameters | mixed −2 cos ω and level |
//! | `lsf_to_ar` | LSF → AR | line spectrum to coefficients, with `partial_products` and `assembly` |
//! | `magnitude_range` | | how much rounding a model bears, for the check at load |
//! | `filter` | a_k(F_n, v_t), σ(F_n, v_t) | the whole way in one function |
//!
//! [`update`](crate::update) does the same work in slices, one a tick.

pub(crate) mod assembly;
pub(crate) mod barycentric;
pub(crate) mod edge;
pub(crate) mod filter;
pub(crate) mod lsf_to_ar;
pub(crate) mod magnitude_range;
pub(crate) mod mixture;
pub(crate) mod orders;
pub(crate) mod partial_products;
pub(crate) mod row;
pub(crate) mod scratch;
pub(crate) mod section_pair;
