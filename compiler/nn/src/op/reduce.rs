//! ReduceMean, ReduceSum, ReduceL2: elements are added in row-major order.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    kernel::math,
    op::{Inputs, Operator, Types, attributes::Attributes, layout},
};

/// Which reduction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reduction {
    Mean,
    Sum,
    L2,
}

/// A reduction over axes; over all of them if none are given.
#[derive(Debug)]
pub(crate) struct Reduce {
    reduction: Reduction,
    /// The axes from the attribute; without it they are input 1.
    axes: Option<Vec<i64>>,
    keep: bool,
    nothing_without_axes: bool,
}

impl Reduce {
    pub(crate) fn parse(
        reduction: Reduction,
        attributes: &mut Attributes<'_>,
        opset: i64,
    ) -> Result<(std::ops::RangeInclusive<usize>, Box<dyn Operator>), NodeRefusal> {
        // The axes are an input from opset 13 on for ReduceSum, from 18 on for the others.
        let as_input = opset >= if reduction == Reduction::Sum { 13 } else { 18 };
        let operator = Self {
            reduction,
            axes: if as_input {
                None
            } else {
                attributes.ints("axes")?.map(<[i64]>::to_vec)
            },
            keep: attributes.flag("keepdims", true)?,
            nothing_without_axes: as_input && attributes.flag("noop_with_empty_axes", false)?,
        };
        Ok((1..=if as_input { 2 } else { 1 }, Box::new(operator)))
    }
}

impl Operator for Reduce {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        if inputs.is_given(1) {
            inputs.index(1)?;
        }
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?;
        let axes = match &self.axes {
            Some(axes) => axes.clone(),
            None if inputs.given(1).is_some() => inputs.integers(1)?,
            None => Vec::new(),
        };
        if axes.is_empty() && self.nothing_without_axes {
            return Ok(inputs.tensor(0)?.clone());
        }
        let mut reduced = vec![axes.is_empty(); shape.len()];
        for value in axes {
            reduced[layout::axis(value, shape.len())?] = true;
        }
        let kept: Vec<usize> = shape
            .iter()
            .zip(&reduced)
            .map(|(&size, &reduced)| if reduced { 1 } else { size })
            .collect();
        let mut data = vec![0.0; inputs.size(&kept)?];
        let source = inputs.f32(0)?;
        let (from, to) = (
            layout::strides(shape),
            layout::broadcast_strides(&kept, shape),
        );
        let walk = layout::Walk::new(shape, [&from, &to]);
        let square = self.reduction == Reduction::L2;
        walk.rows(&mut |[from, to]| {
            let mut slot = to as usize;
            for &x in &source[from as usize..from as usize + walk.row] {
                data[slot] += if square { x * x } else { x };
                slot += walk.step[1] as usize;
            }
        });
        let count = source.len().checked_div(data.len()).unwrap_or(0) as f32;
        for x in &mut data {
            *x = match self.reduction {
                Reduction::Sum => *x,
                Reduction::Mean => *x / count,
                Reduction::L2 => math::sqrt(*x),
            };
        }
        let shape = if self.keep {
            kept
        } else {
            shape
                .iter()
                .zip(&reduced)
                .filter(|(_, reduced)| !**reduced)
                .map(|(&size, _)| size)
                .collect()
        };
        Ok(Tensor::F32 { shape, data })
    }
}
