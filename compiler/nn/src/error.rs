//! Why a model is refused, and why an operator stops.

use thiserror::Error;

use crate::ElementType;

/// Why a model was refused at load.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OnnxError {
    /// Not protobuf, or cut off.
    #[error("not an ONNX file, or cut off: {0}")]
    Decode(#[from] prost::DecodeError),
    /// A required part of the file is missing, or is of a kind that is not supported.
    #[error("{field}: {reason}")]
    Model {
        /// Field of `ModelProto` or `GraphProto`.
        field: &'static str,
        /// Fault of the field.
        reason: String,
    },
    /// A constant whose data do not match its type or shape.
    #[error("initializer `{name}`, {field}: {reason}")]
    Initializer {
        /// Its name.
        name: String,
        /// Field of `TensorProto`.
        field: &'static str,
        /// Fault of the field.
        reason: String,
    },
    /// An input or output whose declaration cannot be used.
    #[error("{direction} `{name}`: {reason}")]
    Port {
        /// `input` or `output`.
        direction: &'static str,
        /// Its name.
        name: String,
        /// Fault of the declaration.
        reason: String,
    },
    /// A node that cannot be run.
    #[error("node `{node}` ({op_type}): {reason}")]
    Node {
        /// Name of the node, or of its output when it has none.
        node: String,
        /// Its operator.
        op_type: String,
        /// Fault of the node.
        reason: NodeRefusal,
    },
}

/// A fault of a node.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NodeRefusal {
    /// The operator is not supported.
    #[error("operator not supported; export with opset {min} to {max} and standard operators", min = crate::MIN_OPSET, max = crate::MAX_OPSET)]
    Operator,
    /// Too few or too many inputs, or a required input that is left out.
    #[error("{found} inputs, expected {expected}")]
    Inputs {
        /// Inputs given.
        found: usize,
        /// Inputs expected.
        expected: String,
    },
    /// The node must have exactly one output.
    #[error("{0} outputs, expected 1")]
    Outputs(usize),
    /// An input that no earlier node, constant or graph input provides.
    #[error(
        "input {index} `{name}` is no input, initializer or output of an earlier node: missing, a cycle, or nodes out of order"
    )]
    UnknownInput {
        /// Position.
        index: usize,
        /// Name.
        name: String,
    },
    /// An output name that another value has.
    #[error("output `{0}` is already the name of another value")]
    DuplicateOutput(String),
    /// A wrong attribute.
    #[error("attribute `{name}`: {reason}")]
    Attribute {
        /// Its name.
        name: String,
        /// Fault of the attribute.
        reason: String,
    },
    /// An input of a type that the operator does not take.
    #[error("input {index} is {found}, expected {expected}")]
    Type {
        /// Position.
        index: usize,
        /// Its type; `None` when it was left out.
        found: TypeFound,
        /// Types the operator takes.
        expected: &'static str,
    },
    /// A node whose inputs are all constants fails, so every run would fail.
    #[error("{0}")]
    Constant(#[from] OpError),
}

/// An element type, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TypeFound(pub Option<ElementType>);

impl std::fmt::Display for TypeFound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(element_type) => element_type.fmt(f),
            None => f.write_str("left out"),
        }
    }
}

/// Why an operator stops in a run.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum OpError {
    /// Shapes that do not match.
    #[error("{rule}; shapes: {shapes:?}")]
    Shape {
        /// The rule that the operator sets.
        rule: &'static str,
        /// The shapes it was given.
        shapes: Vec<Vec<usize>>,
    },
    /// An axis or index outside its range.
    #[error("{what} {value} is outside {low}..={high}")]
    Range {
        /// Which value.
        what: &'static str,
        /// The value found.
        value: i64,
        /// Smallest allowed.
        low: i64,
        /// Largest allowed.
        high: i64,
    },
    /// A value that is not valid in its place.
    #[error("{what}: {value}")]
    Value {
        /// Which value, and what it should be.
        what: &'static str,
        /// The value found.
        value: i64,
    },
    /// A result of more elements than a tensor may have.
    #[error("a result of shape {shape:?} is over the limit of {limit} elements")]
    TooLarge {
        /// Its shape, as far as it is known.
        shape: Vec<usize>,
        /// The limit.
        limit: usize,
    },
    /// An input of another type than at load. Types are checked at load, so this cannot happen.
    #[error("input {0} is missing or of another type than the model said")]
    Input(usize),
}

impl OpError {
    /// A [`OpError::Shape`].
    pub(crate) fn shape(rule: &'static str, shapes: &[&[usize]]) -> Self {
        Self::Shape {
            rule,
            shapes: shapes.iter().map(|shape| shape.to_vec()).collect(),
        }
    }
}
