//! Expand.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{Inputs, Operator, Types, layout},
    tensor::same_type,
};

/// Repetition to the shape that input 0 and the shape in input 1 broadcast to.
#[derive(Debug)]
pub(crate) struct Expand;

impl Operator for Expand {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let tensor = inputs.tensor(0)?;
        let wanted = sizes(&inputs.integers(1)?)?;
        let shape = layout::broadcast(tensor.shape(), &wanted)?;
        inputs.size(&shape)?;
        let strides = layout::broadcast_strides(tensor.shape(), &shape);
        Ok(same_type!(tensor, data => {
            let data = layout::copy(data, 0, &shape, &strides);
            (shape, data)
        }))
    }
}

/// A shape from integers, none of which may be negative.
pub(crate) fn sizes(values: &[i64]) -> Result<Vec<usize>, OpError> {
    let size = |&value: &i64| {
        usize::try_from(value).map_err(|_| OpError::Value {
            what: "size in a shape",
            value,
        })
    };
    values.iter().map(size).collect()
}
