//! ArgMax.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{Inputs, Operator, Types, attributes::Attributes, layout},
    tensor::Element,
};

/// Index of the largest element along an axis; among equal ones the first or the last, as the
/// attribute says.
#[derive(Debug)]
pub(crate) struct ArgMax {
    axis: i64,
    keep: bool,
    last: bool,
}

impl ArgMax {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            axis: attributes.int("axis")?.unwrap_or(0),
            keep: attributes.flag("keepdims", true)?,
            last: attributes.flag("select_last_index", false)?,
        })
    }

    fn apply<T: Element + PartialOrd>(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let mut shape = inputs.shape(0)?.to_vec();
        let axis = layout::axis(self.axis, shape.len())?;
        let count = shape[axis];
        let (outer, inner) = layout::around(&shape, axis);
        if count == 0 {
            return Err(OpError::shape(
                "no largest element along an empty axis",
                &[&shape],
            ));
        }
        let data = inputs.elements::<T>(0)?;
        let mut result = Vec::with_capacity(outer * inner);
        for block in 0..outer {
            for column in 0..inner {
                let at = |i: usize| data[(block * count + i) * inner + column];
                let largest = (1..count).fold(0, |best, i| {
                    let better = at(i) > at(best) || (self.last && at(i) == at(best));
                    if better { i } else { best }
                });
                result.push(largest as i64);
            }
        }
        if self.keep {
            shape[axis] = 1;
        } else {
            shape.remove(axis);
        }
        Ok(Tensor::I64 {
            shape,
            data: result,
        })
    }
}

impl Operator for ArgMax {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.number(0)?;
        Ok(ElementType::I64)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        match inputs.tensor(0)?.element_type() {
            ElementType::F32 => self.apply::<f32>(inputs),
            ElementType::I64 => self.apply::<i64>(inputs),
            _ => self.apply::<i32>(inputs),
        }
    }
}
