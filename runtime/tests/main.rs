//! Laws of the tick and its agreement with the f64 oracle, one binary, so that they are linked once. A new file needs
//! its line here; `.ci/check-tests` fails without it.

#![allow(
    clippy::disallowed_methods,
    reason = "the same bits everywhere are the tick's concern, not that of what judges it"
)]

mod arithmetics;
mod config_ranges;
mod counts;
mod exchanges;
mod fixed_points;
mod fixed_ranges;
mod force_stages;
mod laws_force;
mod laws_friction;
mod laws_lsf;
mod laws_queries;
mod locations;
mod maths;
mod motion_stages;
mod oracle_filter;
mod oracle_tick;
mod scene_steps;
mod scenes;
mod searches;
mod slots;
mod swaps;
