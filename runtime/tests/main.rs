//! Tests of the runtime, by law and against the f64 oracle of `asperity-tests`: a single binary, so
//! that it is linked once. A new file needs its line here; `.ci/check-tests` fails without it.

#![allow(
    clippy::disallowed_methods,
    reason = "the same bits everywhere are the tick's concern, not that of what judges it"
)]

// The whole tick: against the oracle, and by law.
mod laws_force;
mod laws_friction;
mod laws_lsf;
mod laws_queries;
mod oracle_filter;
mod oracle_tick;

// Its stages, and what it tells.
mod flags_and_counters;
mod force_stages;
mod motion_stages;

// What is loaded and configured.
mod config_ranges;
mod contact_laws;
mod directions;
mod fixed_ranges;
mod loading;

// From one texture or surface to another.
mod exchange;
mod scene_model;
mod scene_steps;
mod scenes;
mod texture_swaps;

// Location and arithmetic.
mod exact_arithmetic;
mod fixed_point_rounding;
mod locations;
mod math;
mod weight_search;
