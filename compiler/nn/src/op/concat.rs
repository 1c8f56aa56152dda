//! Concat.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{
        Inputs, Operator, Types,
        attributes::{Attributes, refusal},
        layout,
    },
    tensor::{Element, same_type},
};

/// Concatenation of tensors along an axis.
#[derive(Debug)]
pub(crate) struct Concat {
    axis: i64,
}

impl Concat {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        match attributes.int("axis")? {
            Some(axis) => Ok(Self { axis }),
            None => Err(refusal("axis", "missing".to_owned())),
        }
    }
}

impl Operator for Concat {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        let element_type = inputs.any(0)?;
        for index in 1..inputs.0.len() {
            inputs.same(index, element_type)?;
        }
        Ok(element_type)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let first = inputs.tensor(0)?;
        let mut shape = first.shape().to_vec();
        let axis = layout::axis(self.axis, shape.len())?;
        let mut parts = Vec::with_capacity(inputs.values.len());
        shape[axis] = 0;
        for index in 0..inputs.values.len() {
            let part = inputs.tensor(index)?;
            let size = part.shape().get(axis).copied();
            let mut expected = shape.clone();
            expected[axis] = size.unwrap_or(0);
            if part.shape() != expected {
                let shapes = [first.shape(), part.shape()];
                return Err(OpError::shape(
                    "shapes must agree but for the axis",
                    &shapes,
                ));
            }
            shape[axis] = shape[axis].saturating_add(expected[axis]);
            parts.push(part);
        }
        let size = inputs.size(&shape)?;
        let outer = layout::around(&shape, axis).0;
        Ok(same_type!(first, data => (shape, join(data, &parts, outer, axis, size)?)))
    }
}

/// Joins the blocks of the parts in turn; `first` only determines the type.
fn join<T: Element>(
    _first: &[T],
    parts: &[&Tensor],
    outer: usize,
    axis: usize,
    size: usize,
) -> Result<Vec<T>, OpError> {
    let mut result = Vec::with_capacity(size);
    for block in 0..outer {
        for (index, part) in parts.iter().enumerate() {
            let data = T::elements(part).ok_or(OpError::Input(index))?;
            let length: usize = part.shape()[axis..].iter().product();
            result.extend_from_slice(&data[block * length..(block + 1) * length]);
        }
    }
    Ok(result)
}
