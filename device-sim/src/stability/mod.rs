//! Where methods fail: a table of scenarios with the figure of ours and of others.
//!
//! Every row states a figure that must not exceed a limit. Ours comes from the runtime
//! itself; the others ([`methods`]) follow the paper, the reference renderer or the textbook
//! as published descriptions have them. Everything is seeded and runs in virtual time.
//!
//! | file | tries |
//! |---|---|
//! | [`grid`] | queries on edges, on the border and beyond |
//! | [`mixing`] | mixtures of models, parameters that change every sample |
//! | [`coefficients`] | poles near the circle, coefficients in 16 bits |
//! | [`friction`] | rest, ramps, reversal, closed paths |
//! | [`wall`] | stiff walls, delay, lost samples, counts, grips |
//! | [`tap`] | bouncing, grazing, sliding, taps in close succession |
//! | [`change`] | another texture in mid-stroke |
//! | [`fault`] | NaN, stuck samples |
//!
//! [`observer`] measures energy; [`sheet`] draws the map of stable walls and the worst
//! waveforms; [`markdown`] prints the tables of the documentation.

pub mod change;
pub mod coefficients;
mod error;
pub mod fault;
pub mod friction;
pub mod grid;
pub mod markdown;
pub mod material;
pub mod methods;
pub mod mixing;
pub mod observer;
mod random;
pub mod row;
pub mod sheet;
mod table;
pub mod tap;
pub mod wall;

pub use error::StabilityError;
pub use material::Material;
pub use row::{Other, Row, Verdict, Words};
pub use table::{StabilityOptions, Table, run};
