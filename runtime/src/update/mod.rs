//! The model that follows speed and force, made a slice a tick.
//!
//! [`model`](crate::model) says what a model is; this is the only place that knows that making one
//! is cut into slices. Why: on a Cortex-M4F a model of order 20 costs some 3,000 instructions, and
//! the hand does not notice a lag of 10 ms. A query is taken at the end of a tick, with the first
//! slice of location; the next three to five ticks begin with a slice each of location, mixture and
//! conversion, because few other values have to be put aside at the edges of a tick. The last of
//! them puts the new model to work. Then the work rests until the next query, which comes as late
//! as possible while every change is still heard within [`LAG_SAMPLES`](cycle::LAG_SAMPLES).
//!
//! Between models the line spectrum follows its target as a one-pole of 5 ms, which keeps the
//! recursion bounded when speed or force jump; the level is the target's.

pub(crate) mod clock;
pub(crate) mod cost;
pub(crate) mod cycle;
pub(crate) mod follower;
pub(crate) mod following;
pub(crate) mod onset;
pub(crate) mod plan;
pub(crate) mod slices;

#[cfg(test)]
mod tests;
