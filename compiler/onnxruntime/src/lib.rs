//! ONNX Runtime as a back end: the library is found at run time, never linked, never downloaded.
//!
//! [`discover`] looks for it; [`OnnxRuntime`] is a [`Session`](asperity_nn::Session) over it. It is
//! faster than the portable engine and reads every operator, but its last bits follow the processor:
//! results agree to 1e-5, not to the bit. Graph optimisation stays at level 1 (basic), where quantised
//! weights are not fused into kernels that drift by 5e-3, and one thread is used unless more are asked for.
//!
//! The only crate of the workspace with `unsafe`: opening a library and asking it for its
//! functions. A file is probed before anything relies on it.

mod candidates;
mod discover;
mod library;
mod session;

pub use discover::{Attempt, Discovery, NotFound, Source, discover};
pub use session::{LoadError, OnnxRuntime};
