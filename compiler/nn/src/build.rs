//! Writing ONNX: IR version 8, operator set 17.
//!
//! Values are named in the order in which they are made, and each node has the name of its
//! output. [`GraphBuilder::finish`] reads the model back and checks it before it returns the
//! bytes.

use prost::Message as _;

use crate::{
    Dim, ElementType, OnnxError, Port, Portable, Tensor,
    load::{constant, ports},
    proto::{AttributeProto, AttributeType, GraphProto, ModelProto, NodeProto, OperatorSetIdProto},
};

/// A value of a graph under construction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Value(String);

impl Value {
    /// Its name in the graph.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.0
    }
}

/// Value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    /// An integer.
    Int(i64),
    /// A number.
    Float(f32),
    /// Integers.
    Ints(Vec<i64>),
    /// A tensor.
    Tensor(Tensor),
}

/// Builds one graph, node by node, in the order in which they run.
#[derive(Debug, Clone)]
pub struct GraphBuilder {
    graph: GraphProto,
    counter: usize,
}

impl GraphBuilder {
    /// An empty graph.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self {
            graph: GraphProto {
                name: name.to_owned(),
                ..GraphProto::default()
            },
            counter: 0,
        }
    }

    /// Adds an input.
    pub fn input(&mut self, name: &str, element_type: ElementType, dims: &[Dim]) -> Value {
        self.graph.input.push(port(name, element_type, dims));
        Value(name.to_owned())
    }

    /// Names a value as an output.
    pub fn output(&mut self, name: &str, value: &Value, element_type: ElementType, dims: &[Dim]) {
        // An output has the name of its value, so it gets a node of its own.
        self.push("Identity", &[Some(value)], &[], name.to_owned());
        self.graph.output.push(port(name, element_type, dims));
    }

    /// Adds a constant.
    pub fn constant(&mut self, name: &str, tensor: Tensor) -> Value {
        self.graph.initializer.push(constant::write(name, &tensor));
        Value(name.to_owned())
    }

    /// Adds a constant list of integers under a name of its own.
    pub fn integers(&mut self, values: &[i64]) -> Value {
        let name = self.fresh("integers");
        self.constant(&name, Tensor::i64(&[values.len()], values.to_vec()))
    }

    /// Adds a constant number under a name of its own.
    pub fn scalar(&mut self, value: f32) -> Value {
        let name = self.fresh("scalar");
        self.constant(&name, Tensor::f32(&[], vec![value]))
    }

    /// Adds a node with one output; an input of `None` is left out.
    pub fn node(
        &mut self,
        op_type: &str,
        inputs: &[Option<&Value>],
        attributes: &[(&str, Attribute)],
    ) -> Value {
        let output = self.fresh(op_type);
        self.push(op_type, inputs, attributes, output.clone());
        Value(output)
    }

    /// x·W + b for weights [in, out].
    pub fn gemm(&mut self, x: &Value, weights: &Value, bias: &Value) -> Value {
        self.node("Gemm", &[Some(x), Some(weights), Some(bias)], &[])
    }

    /// a + b, broadcast.
    pub fn add(&mut self, a: &Value, b: &Value) -> Value {
        self.node("Add", &[Some(a), Some(b)], &[])
    }

    /// a − b, broadcast.
    pub fn sub(&mut self, a: &Value, b: &Value) -> Value {
        self.node("Sub", &[Some(a), Some(b)], &[])
    }

    /// a · b, broadcast.
    pub fn mul(&mut self, a: &Value, b: &Value) -> Value {
        self.node("Mul", &[Some(a), Some(b)], &[])
    }

    /// a / b, broadcast.
    pub fn div(&mut self, a: &Value, b: &Value) -> Value {
        self.node("Div", &[Some(a), Some(b)], &[])
    }

    /// A function of one tensor without attributes: `Relu`, `Tanh`, `Exp`, …
    pub fn unary(&mut self, op_type: &str, x: &Value) -> Value {
        self.node(op_type, &[Some(x)], &[])
    }

    /// max(x, 0).
    pub fn relu(&mut self, x: &Value) -> Value {
        self.unary("Relu", x)
    }

    /// Softmax along an axis.
    pub fn softmax(&mut self, x: &Value, axis: i64) -> Value {
        self.node("Softmax", &[Some(x)], &[("axis", Attribute::Int(axis))])
    }

    /// x clamped to low..=high.
    pub fn clip(&mut self, x: &Value, low: f32, high: f32) -> Value {
        let (low, high) = (self.scalar(low), self.scalar(high));
        self.node("Clip", &[Some(x), Some(&low), Some(&high)], &[])
    }

    /// The same elements in another shape: 0 keeps an axis, −1 takes the size that remains.
    pub fn reshape(&mut self, x: &Value, shape: &[i64]) -> Value {
        let shape = self.integers(shape);
        self.node("Reshape", &[Some(x), Some(&shape)], &[])
    }

    /// Elements `start..end` along an axis.
    pub fn slice(&mut self, x: &Value, axis: i64, start: i64, end: i64) -> Value {
        let (start, end, axis) = (
            self.integers(&[start]),
            self.integers(&[end]),
            self.integers(&[axis]),
        );
        self.node(
            "Slice",
            &[Some(x), Some(&start), Some(&end), Some(&axis)],
            &[],
        )
    }

    /// Concatenates tensors along an axis.
    pub fn concat(&mut self, parts: &[&Value], axis: i64) -> Value {
        let inputs: Vec<_> = parts.iter().map(|part| Some(*part)).collect();
        self.node("Concat", &inputs, &[("axis", Attribute::Int(axis))])
    }

    /// Adds axes of size 1.
    pub fn unsqueeze(&mut self, x: &Value, axes: &[i64]) -> Value {
        let axes = self.integers(axes);
        self.node("Unsqueeze", &[Some(x), Some(&axes)], &[])
    }

    /// Sums along axes, which stay with size 1 if `keep`.
    pub fn reduce_sum(&mut self, x: &Value, axes: &[i64], keep: bool) -> Value {
        let axes = self.integers(axes);
        let keep = ("keepdims", Attribute::Int(i64::from(keep)));
        self.node("ReduceSum", &[Some(x), Some(&axes)], &[keep])
    }

    /// The graph so far as a model, without checks.
    #[must_use]
    pub fn to_model(&self) -> ModelProto {
        ModelProto {
            ir_version: Some(8),
            producer_name: "asperity".to_owned(),
            producer_version: env!("CARGO_PKG_VERSION").to_owned(),
            graph: Some(self.graph.clone()),
            opset_import: vec![OperatorSetIdProto {
                domain: String::new(),
                version: Some(17),
            }],
        }
    }

    /// The bytes of the model: the same graph gives the same bytes.
    ///
    /// # Errors
    /// [`OnnxError`] when the graph would not load again: a name given twice, a type that an
    /// operator does not take, an unknown operator or attribute.
    pub fn finish(&self) -> Result<Vec<u8>, OnnxError> {
        let bytes = self.to_model().encode_to_vec();
        Portable::from_bytes(&bytes)?;
        Ok(bytes)
    }

    fn fresh(&mut self, stem: &str) -> String {
        self.counter += 1;
        format!("{stem}_{}", self.counter)
    }

    fn push(
        &mut self,
        op_type: &str,
        inputs: &[Option<&Value>],
        attributes: &[(&str, Attribute)],
        output: String,
    ) {
        let name = |value: &Option<&Value>| value.map_or_else(String::new, |value| value.0.clone());
        self.graph.node.push(NodeProto {
            input: inputs.iter().map(name).collect(),
            output: vec![output.clone()],
            name: output,
            op_type: op_type.to_owned(),
            domain: String::new(),
            attribute: attributes
                .iter()
                .map(|(name, value)| attribute(name, value))
                .collect(),
        });
    }
}

fn port(name: &str, element_type: ElementType, dims: &[Dim]) -> crate::proto::ValueInfoProto {
    ports::write(&Port {
        name: name.to_owned(),
        element_type,
        dims: Some(dims.to_vec()),
    })
}

fn attribute(name: &str, value: &Attribute) -> AttributeProto {
    let mut proto = AttributeProto {
        name: name.to_owned(),
        ..AttributeProto::default()
    };
    proto.set_type(match value {
        Attribute::Int(_) => AttributeType::Int,
        Attribute::Float(_) => AttributeType::Float,
        Attribute::Ints(_) => AttributeType::Ints,
        Attribute::Tensor(_) => AttributeType::Tensor,
    });
    match value {
        Attribute::Int(value) => proto.i = Some(*value),
        Attribute::Float(value) => proto.f = Some(*value),
        Attribute::Ints(values) => proto.ints.clone_from(values),
        Attribute::Tensor(value) => proto.t = Some(constant::write("", value)),
    }
    proto
}
