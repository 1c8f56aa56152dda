//! A deterministic engine for the subset of ONNX that Asperity's models use, and a writer.
//!
//! Compiling the same prompt must give the same bytes on every machine. General engines choose
//! kernels by processor, and the last bits depend on that choice. This engine computes in plain
//! f32 in a fixed order: it sums every element of a matrix product in ascending order and uses no
//! fused multiply–add, no function of the platform and no threads. Wider instruction sets only
//! make it faster.
//!
//! * [`Portable`] loads a model and runs it; [`Session`] is the interface of every back end.
//! * [`build`] writes models; [`proto`] is the file format.
//! * Operator sets 13 to 22. Operators: Add Sub Mul Div Pow, Equal Less LessOrEqual Greater
//!   GreaterOrEqual Where, Relu Sigmoid Tanh Exp Log Sqrt Erf Neg Clip, MatMul Gemm,
//!   Softmax LayerNormalization, ReduceMean ReduceSum ReduceL2 ArgMax, Gather GatherND
//!   Slice Concat, Transpose Reshape Squeeze Unsqueeze Identity Expand, Shape Constant
//!   ConstantOfShape Range, Cast DequantizeLinear. Types: float32, int64, int32, int8, uint8, bool.
//!
//! What must stay absent: threads, `unsafe`, the platform's float functions, file access.

pub mod build;
mod error;
mod kernel;
mod load;
mod op;
mod portable;
pub mod proto;
mod session;
mod tensor;

pub use bytes::Bytes;
pub use error::{NodeRefusal, OnnxError, OpError, TypeFound};
pub use load::{MAX_OPSET, MIN_OPSET};
pub use portable::Portable;
pub use session::{Dim, Port, RunError, Session, check_inputs};
pub use tensor::{ElementType, Tensor};
