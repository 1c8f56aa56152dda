//! CumSum.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{Inputs, Operator, Types, attributes::Attributes, layout},
};

/// Running sum along the axis that input 1 names.
///
/// The order is ascending, or descending if `reverse`. Each sum includes its own element, unless
/// `exclusive`.
#[derive(Debug)]
pub(crate) struct CumSum {
    exclusive: bool,
    reverse: bool,
}

impl CumSum {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            exclusive: attributes.flag("exclusive", false)?,
            reverse: attributes.flag("reverse", false)?,
        })
    }

    fn apply<T: Copy + Default>(
        &self,
        shape: &[usize],
        axis: usize,
        data: &mut [T],
        add: impl Fn(T, T) -> T,
    ) {
        let count = shape[axis];
        let (outer, inner) = layout::around(shape, axis);
        for block in 0..outer {
            for column in 0..inner {
                let mut total = T::default();
                for step in 0..count {
                    let i = if self.reverse { count - 1 - step } else { step };
                    let x = &mut data[(block * count + i) * inner + column];
                    let before = total;
                    total = add(total, *x);
                    *x = if self.exclusive { before } else { total };
                }
            }
        }
    }
}

impl Operator for CumSum {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.number(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?;
        let axis = layout::axis(inputs.integer(1)?, shape.len())?;
        let mut tensor = inputs.tensor(0)?.clone();
        match &mut tensor {
            Tensor::F32 { data, .. } => self.apply(shape, axis, data, |x, y| x + y),
            Tensor::I64 { data, .. } => self.apply(shape, axis, data, i64::wrapping_add),
            Tensor::I32 { data, .. } => self.apply(shape, axis, data, i32::wrapping_add),
            _ => return Err(OpError::Input(0)),
        }
        Ok(tensor)
    }
}
