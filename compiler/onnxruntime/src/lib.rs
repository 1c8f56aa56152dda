//! ONNX Runtime as a back end: the library is found at run time, never linked, never downloaded.
//!
//! [`discover`] looks for the library; [`OnnxRuntime`] is a [`Session`](asperity_nn::Session) on it.
//! It is faster than the portable engine and has every operator, but its last bits depend on the
//! processor: results agree to 1e-5, not to the bit. Graph optimisation stays at level 1 (basic).
//! Higher levels fuse quantised weights into kernels whose results differ by 5e-3. One thread is
//! used unless the caller asks for more.
//!
//! The crate's `unsafe` opens a library and asks it for its functions. Every file is probed before
//! anything relies on it.

mod candidates;
mod discover;
mod error;
#[cfg_attr(target_family = "wasm", path = "no_library.rs")]
mod library;
#[cfg_attr(target_family = "wasm", path = "no_session.rs")]
mod session;

pub use discover::{Attempt, Discovery, NotFound, Source, discover};
pub use error::LoadError;
pub use session::OnnxRuntime;
