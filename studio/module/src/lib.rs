//! The studio's compiler as a WebAssembly module: it answers the requests of the page as the server does, with the same
//! bytes, and imports nothing.
//!
//! For `wasm32-unknown-unknown` the crate is a module with raw exports, which `exports.rs` lists;
//! `studio/build-module` builds it, `studio/page/offline/worker.js` drives it in a worker. Elsewhere it is
//! empty.

#[cfg(target_arch = "wasm32")]
mod exports;
