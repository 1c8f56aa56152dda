//! Where methods fail: a table of scenarios with the figures of our method and of others.
//!
//! The figure of a row must not exceed a limit. Ours is measured on the runtime itself. The
//! other methods ([`methods`]) follow published descriptions of the paper, of the reference
//! renderer or of the textbook. Everything is seeded and runs in virtual time.
//!
//! | file | tries |
//! |---|---|
//! | [`grid`] | queries on edges, on the border and beyond |
//! | [`mixing`] | mixtures of models, parameters that change every sample |
//! | [`coefficients`] | poles near the circle, coefficients in 16 bits |
//! | [`friction`] | rest, ramps, reversal, closed paths |
//! | [`wall`] | stiff walls, delay, lost samples, counts, grips |
//! | [`contact`] | materials that give way, part by part |
//! | [`tap`] | bouncing, grazing, sliding, taps in close succession |
//! | [`change`] | a change of the texture in the middle of a stroke |
//! | [`fault`] | NaN, infinity, positions that stick |
//!
//! [`observer`] measures energy; [`sheet`] draws the map of stable walls and the worst
//! waveforms; [`markdown`] prints the tables of the documentation.

pub mod change;
pub mod coefficients;
pub mod contact;
mod error;
pub mod fault;
mod filters;
pub mod friction;
pub mod grid;
pub mod markdown;
pub mod material;
pub mod methods;
pub mod mixing;
pub mod observer;
pub mod row;
pub mod sheet;
mod table;
pub mod tap;
pub mod wall;

use asperity_runtime::Config;
pub use error::StabilityError;
pub use material::Material;
pub use row::{Other, ScenarioResult, Verdict, Words};
pub use table::{StabilityOptions, Table, run};

/// The default configuration with a reach that no script leaves: a stroke of 20 s covers metres.
fn unbounded() -> Config {
    let mut config = Config::default();
    config.safety.reach_m = 1.0e4;
    config
}
