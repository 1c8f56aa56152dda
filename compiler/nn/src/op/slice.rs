//! Slice.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{Inputs, Operator, Types, layout},
    tensor::same_type,
};

/// Elements from `starts` to before `ends` along `axes` in `steps`.
///
/// Without `axes` all axes are meant; without `steps` the step is 1. As in Python, negative bounds
/// count from the end, and bounds are clamped to the tensor.
#[derive(Debug)]
pub(crate) struct Slice;

impl Operator for Slice {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.index(2)?;
        for optional in 3..5 {
            if inputs.is_given(optional) {
                inputs.index(optional)?;
            }
        }
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let tensor = inputs.tensor(0)?;
        let (starts, ends) = (inputs.integers(1)?, inputs.integers(2)?);
        let axes = match inputs.given(3) {
            Some(_) => inputs.integers(3)?,
            None => (0..starts.len() as i64).collect(),
        };
        let steps = match inputs.given(4) {
            Some(_) => inputs.integers(4)?,
            None => vec![1; starts.len()],
        };
        if [ends.len(), axes.len(), steps.len()] != [starts.len(); 3] {
            let sizes = [
                &[starts.len()][..],
                &[ends.len()],
                &[axes.len()],
                &[steps.len()],
            ];
            return Err(OpError::shape(
                "starts, ends, axes and steps must be equally many",
                &sizes,
            ));
        }
        let mut shape = tensor.shape().to_vec();
        let mut strides = layout::strides(&shape);
        let mut seen = vec![false; shape.len()];
        let mut offset = 0_usize;
        for (((start, end), axis), step) in starts.into_iter().zip(ends).zip(axes).zip(steps) {
            let value = axis;
            let axis = layout::axis(axis, shape.len())?;
            if std::mem::replace(&mut seen[axis], true) {
                return Err(OpError::Value {
                    what: "axis given twice",
                    value,
                });
            }
            let (first, count) = range(start, end, step, shape[axis])?;
            offset = offset.wrapping_add_signed(first as isize * strides[axis]);
            shape[axis] = count;
            // With fewer than two elements the step is never taken, whatever its size.
            strides[axis] = if count > 1 {
                strides[axis] * step as isize
            } else {
                0
            };
        }
        inputs.size(&shape)?;
        Ok(same_type!(tensor, data => {
            let data = layout::copy(data, offset, &shape, &strides);
            (shape, data)
        }))
    }
}

/// First index and number of elements of `start..end` in steps, on an axis of `size`.
fn range(start: i64, end: i64, step: i64, size: usize) -> Result<(usize, usize), OpError> {
    let size = size as i64;
    if step == 0 {
        return Err(OpError::Value {
            what: "step",
            value: 0,
        });
    }
    let from_end = |bound: i64| {
        if bound < 0 {
            bound.saturating_add(size)
        } else {
            bound
        }
    };
    let (low, high) = if step > 0 { (0, size) } else { (-1, size - 1) };
    let (start, end) = (
        from_end(start).clamp(low, high),
        from_end(end).clamp(low, high),
    );
    let distance = if step > 0 { end - start } else { start - end };
    if distance <= 0 {
        return Ok((0, 0));
    }
    // distance ≥ 1, so this is ⌈distance / |step|⌉ without overflow.
    let count = (distance as u64 - 1) / step.unsigned_abs() + 1;
    Ok((start as usize, count as usize))
}
