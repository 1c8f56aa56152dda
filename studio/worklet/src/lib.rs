//! The runtime in an `AudioWorklet`: pointer events in, sound out.
//!
//! ```text
//! pointer events ─► hand ─► position, 16 kHz ─► runtime ─► acceleration ─► upsampler ─► frames, 48 kHz
//! ```
//!
//! [`hand`] follows the pointer as a hand would, [`press`] what gives way under it, [`session`] is the runtime as `asperity render --rate
//! 16000` sets it up, [`upsample`] triples the rate, and [`engine`] is all of them. What is rendered
//! for the recorded positions are the bits of the command. Gain, limiter and equaliser belong to the page.
//! [`spectrum`] says what the models promise at a speed and a force, for the page's plots, and
//! [`row`] prints ticks for its tables.
//!
//! For `wasm32-unknown-unknown` the crate is a module with raw exports, which `exports.rs` lists;
//! `studio/build-worklet` builds it and `studio/page/worklet.js` drives it.
//! Elsewhere it is an ordinary library, for its tests.
//!
//! What must stay absent: allocation, imports of the module, a clock: time is an argument.
#![cfg_attr(not(test), no_std)]

pub mod clock;
pub mod engine;
#[cfg(target_arch = "wasm32")]
mod exports;
pub mod hand;
pub mod press;
pub mod row;
pub mod session;
pub mod spectrum;
pub mod status;
pub mod upsample;
