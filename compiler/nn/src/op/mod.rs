//! Operators, one file for each family. A node is read and checked once, at load.

mod argmax;
mod arithmetic;
mod attributes;
mod cast;
mod compare;
mod concat;
mod constant_product;
mod expand;
mod gather;
pub(crate) mod layout;
mod matmul;
mod normalize;
mod reduce;
mod reshape;
mod shape;
mod slice;
mod unary;

pub(crate) use cast::{DequantizeLinear, numbers};
pub(crate) use constant_product::{ConstantProduct, Weights};
pub(crate) use matmul::Product;

use crate::{
    ElementType, NodeRefusal, OpError, Tensor, error::TypeFound, proto::NodeProto, tensor::Element,
};
use attributes::Attributes;

/// Most elements of one tensor in a run: 256 MiB of f32, five times CLIP's largest tensor.
pub(crate) const RUN_LIMIT: usize = 1 << 26;
/// Most elements of a tensor that is computed at load.
pub(crate) const LOAD_LIMIT: usize = 1 << 20;

/// A node's operator with its attributes.
pub(crate) trait Operator: Send + Sync + std::fmt::Debug {
    /// Type of the result for inputs of these types; `None` stands for an input that is left out.
    /// Their number is what [`parse`] has checked.
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal>;

    /// The result.
    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError>;

    /// The product, if the operator is one that load fuses with constant weights.
    fn as_product(&self) -> Option<Product> {
        None
    }

    /// The operator, if it is a `DequantizeLinear`, which load fuses with a product.
    fn as_dequantize(&self) -> Option<&DequantizeLinear> {
        None
    }
}

/// Types of a node's inputs.
pub(crate) struct Types<'a>(pub(crate) &'a [Option<ElementType>]);

impl Types<'_> {
    /// Type of an input, if it is among `allowed`.
    fn one_of(
        &self,
        index: usize,
        allowed: &[ElementType],
        expected: &'static str,
    ) -> Result<ElementType, NodeRefusal> {
        let found = self.0.get(index).copied().flatten();
        match found {
            Some(element_type) if allowed.contains(&element_type) => Ok(element_type),
            _ => Err(NodeRefusal::Type {
                index,
                found: TypeFound(found),
                expected,
            }),
        }
    }

    fn any(&self, index: usize) -> Result<ElementType, NodeRefusal> {
        use ElementType::{Bool, F32, I8, I32, I64, U8};
        self.one_of(index, &[F32, I64, I32, I8, U8, Bool], "given")
    }

    fn f32(&self, index: usize) -> Result<ElementType, NodeRefusal> {
        self.one_of(index, &[ElementType::F32], "float32")
    }

    /// A number that operators compute with.
    fn number(&self, index: usize) -> Result<ElementType, NodeRefusal> {
        use ElementType::{F32, I32, I64};
        self.one_of(index, &[F32, I64, I32], "float32, int64 or int32")
    }

    /// A position, axis or size.
    fn index(&self, index: usize) -> Result<ElementType, NodeRefusal> {
        use ElementType::{I32, I64};
        self.one_of(index, &[I64, I32], "int64 or int32")
    }

    /// Returns true if an input is given.
    fn is_given(&self, index: usize) -> bool {
        self.0.get(index).copied().flatten().is_some()
    }

    /// Refuses an input that is given with another type than `wanted`.
    fn same(&self, index: usize, wanted: ElementType) -> Result<(), NodeRefusal> {
        match self.0.get(index).copied().flatten() {
            Some(found) if found == wanted => Ok(()),
            found => Err(NodeRefusal::Type {
                index,
                found: TypeFound(found),
                expected: "the type of the inputs before it",
            }),
        }
    }
}

/// A node's inputs in a run.
pub(crate) struct Inputs<'a> {
    /// The tensors; `None` for one left out.
    pub(crate) values: &'a [Option<&'a Tensor>],
    /// Most elements that the result may have.
    pub(crate) limit: usize,
}

impl<'a> Inputs<'a> {
    fn given(&self, index: usize) -> Option<&'a Tensor> {
        self.values.get(index).copied().flatten()
    }

    fn tensor(&self, index: usize) -> Result<&'a Tensor, OpError> {
        self.given(index).ok_or(OpError::Input(index))
    }

    fn shape(&self, index: usize) -> Result<&'a [usize], OpError> {
        Ok(self.tensor(index)?.shape())
    }

    fn elements<T: Element>(&self, index: usize) -> Result<&'a [T], OpError> {
        T::elements(self.tensor(index)?).ok_or(OpError::Input(index))
    }

    fn f32(&self, index: usize) -> Result<&'a [f32], OpError> {
        self.elements(index)
    }

    /// Integers of either width.
    fn integers(&self, index: usize) -> Result<Vec<i64>, OpError> {
        match self.tensor(index)? {
            Tensor::I64 { data, .. } => Ok(data.clone()),
            Tensor::I32 { data, .. } => Ok(data.iter().map(|&value| i64::from(value)).collect()),
            _ => Err(OpError::Input(index)),
        }
    }

    /// The one integer of an input.
    fn integer(&self, index: usize) -> Result<i64, OpError> {
        match self.integers(index)?[..] {
            [value] => Ok(value),
            _ => Err(OpError::shape("one number expected", &[self.shape(index)?])),
        }
    }

    /// Number of elements of a result, unless it is over the limit.
    fn size(&self, shape: &[usize]) -> Result<usize, OpError> {
        layout::size(shape, self.limit)
    }
}

/// Reads a node: looks its operator up, checks the number of inputs and every attribute.
pub(crate) fn parse(node: &NodeProto, opset: i64) -> Result<Box<dyn Operator>, NodeRefusal> {
    if !matches!(node.domain.as_str(), "" | "ai.onnx") {
        return Err(NodeRefusal::Operator);
    }
    let mut attributes = Attributes::new(node);
    let (inputs, operator) = lookup(node, &mut attributes, opset)?;
    attributes.finish()?;
    let (fewest, most) = (*inputs.start(), *inputs.end());
    let found = node.input.len();
    let left_out = node.input.iter().take(fewest).any(String::is_empty);
    if !inputs.contains(&found) || left_out {
        return Err(NodeRefusal::Inputs {
            found: node.input.iter().filter(|name| !name.is_empty()).count(),
            expected: match most {
                usize::MAX => format!("{fewest} or more"),
                _ if fewest == most => fewest.to_string(),
                _ => format!("{fewest} to {most}"),
            },
        });
    }
    Ok(operator)
}

type Lookup = (std::ops::RangeInclusive<usize>, Box<dyn Operator>);

fn lookup(
    node: &NodeProto,
    attributes: &mut Attributes<'_>,
    opset: i64,
) -> Result<Lookup, NodeRefusal> {
    use arithmetic::{Arithmetic, Binary, Power};
    use unary::Unary;
    fn unary(function: Unary) -> Lookup {
        (1..=1, Box::new(function))
    }
    fn arithmetic(kind: Binary) -> Lookup {
        (2..=2, Box::new(Arithmetic(kind)))
    }
    fn compare(kind: compare::Order) -> Lookup {
        (2..=2, Box::new(compare::Compare(kind)))
    }
    Ok(match node.op_type.as_str() {
        "Add" => arithmetic(Binary::Add),
        "Sub" => arithmetic(Binary::Sub),
        "Mul" => arithmetic(Binary::Mul),
        "Div" => arithmetic(Binary::Div),
        "Pow" => (2..=2, Box::new(Power)),
        "Equal" => compare(compare::Order::Equal),
        "Less" => compare(compare::Order::Less),
        "LessOrEqual" => compare(compare::Order::LessOrEqual),
        "Greater" => compare(compare::Order::Greater),
        "GreaterOrEqual" => compare(compare::Order::GreaterOrEqual),
        "Where" => (3..=3, Box::new(compare::Where)),
        "Relu" => unary(Unary::Relu),
        "Sigmoid" => unary(Unary::Sigmoid),
        "Tanh" => unary(Unary::Tanh),
        "Exp" => unary(Unary::Exp),
        "Log" => unary(Unary::Log),
        "Sqrt" => unary(Unary::Sqrt),
        "Erf" => unary(Unary::Erf),
        "Neg" => unary(Unary::Neg),
        "Clip" => (1..=3, Box::new(unary::Clip)),
        "MatMul" => (2..=2, Box::new(matmul::MatMul)),
        "Gemm" => (2..=3, Box::new(matmul::Gemm::parse(attributes)?)),
        "Softmax" => (1..=1, Box::new(normalize::Softmax::parse(attributes)?)),
        "LayerNormalization" => (
            2..=3,
            Box::new(normalize::LayerNormalization::parse(attributes)?),
        ),
        "ReduceMean" => reduce::Reduce::parse(reduce::Reduction::Mean, attributes, opset)?,
        "ReduceSum" => reduce::Reduce::parse(reduce::Reduction::Sum, attributes, opset)?,
        "ReduceL2" => reduce::Reduce::parse(reduce::Reduction::L2, attributes, opset)?,
        "ArgMax" => (1..=1, Box::new(argmax::ArgMax::parse(attributes)?)),
        "Gather" => (2..=2, Box::new(gather::Gather::parse(attributes)?)),
        "GatherND" => (2..=2, Box::new(gather::GatherNd::parse(attributes)?)),
        "Slice" => (3..=5, Box::new(slice::Slice)),
        "Concat" => (1..=usize::MAX, Box::new(concat::Concat::parse(attributes)?)),
        "Transpose" => (1..=1, Box::new(reshape::Transpose::parse(attributes)?)),
        "Reshape" => (2..=2, Box::new(reshape::Reshape::parse(attributes)?)),
        "Squeeze" => (1..=2, Box::new(reshape::Squeeze)),
        "Unsqueeze" => (2..=2, Box::new(reshape::Unsqueeze)),
        "Identity" => (1..=1, Box::new(reshape::Identity)),
        "Expand" => (2..=2, Box::new(expand::Expand)),
        "Shape" => (1..=1, Box::new(shape::Shape::parse(attributes)?)),
        "Constant" => (0..=0, Box::new(shape::Constant::parse(attributes)?)),
        "ConstantOfShape" => (1..=1, Box::new(shape::ConstantOfShape::parse(attributes)?)),
        "Range" => (3..=3, Box::new(shape::Range)),
        "Cast" => (1..=1, Box::new(cast::Cast::parse(attributes)?)),
        "DequantizeLinear" => (2..=3, Box::new(DequantizeLinear::parse(attributes)?)),
        _ => return Err(NodeRefusal::Operator),
    })
}
