//! Transpose, Reshape, Squeeze, Unsqueeze, Identity: the same elements in another shape or order.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{Inputs, Operator, Types, attributes::Attributes, layout},
    tensor::same_type,
};

/// Axes in another order; reversed if `perm` is not given.
#[derive(Debug)]
pub(crate) struct Transpose {
    perm: Option<Vec<i64>>,
}

impl Transpose {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            perm: attributes.ints("perm")?.map(<[i64]>::to_vec),
        })
    }
}

impl Operator for Transpose {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let tensor = inputs.tensor(0)?;
        let (shape, strides) = (tensor.shape(), layout::strides(tensor.shape()));
        let rank = shape.len();
        let order = match &self.perm {
            None => (0..rank).rev().collect(),
            Some(perm) => perm
                .iter()
                .map(|&axis| layout::axis(axis, rank))
                .collect::<Result<Vec<_>, _>>()?,
        };
        let mut seen = vec![false; rank];
        for &axis in &order {
            seen[axis] = true;
        }
        if order.len() != rank || seen.contains(&false) {
            return Err(OpError::shape(
                "perm must name every axis once",
                &[shape, &order],
            ));
        }
        let shape: Vec<usize> = order.iter().map(|&axis| tensor.shape()[axis]).collect();
        let strides: Vec<isize> = order.iter().map(|&axis| strides[axis]).collect();
        Ok(same_type!(tensor, data => {
            let data = layout::copy(data, 0, &shape, &strides);
            (shape, data)
        }))
    }
}

/// Another shape of the same size: −1 takes the size that remains; 0 keeps the axis, unless
/// `allowzero`.
#[derive(Debug)]
pub(crate) struct Reshape {
    zero_is_zero: bool,
}

impl Reshape {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            zero_is_zero: attributes.flag("allowzero", false)?,
        })
    }
}

impl Operator for Reshape {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let tensor = inputs.tensor(0)?;
        let wanted = inputs.integers(1)?;
        let mut shape = Vec::with_capacity(wanted.len());
        let mut rest = None;
        for (axis, &size) in wanted.iter().enumerate() {
            shape.push(match size {
                0 if !self.zero_is_zero => match tensor.shape().get(axis) {
                    Some(&size) => size,
                    None => {
                        return Err(OpError::shape(
                            "a size of 0 keeps an axis that the input does not have",
                            &[tensor.shape()],
                        ));
                    }
                },
                -1 if rest.is_none() => {
                    rest = Some(axis);
                    1
                }
                _ => usize::try_from(size).map_err(|_| OpError::Value {
                    what: "size in a shape",
                    value: size,
                })?,
            });
        }
        let known = inputs.size(&shape)?;
        if let Some(axis) = rest {
            shape[axis] = tensor.len().checked_div(known).unwrap_or(0);
        }
        if inputs.size(&shape)? != tensor.len() {
            return Err(OpError::shape(
                "sizes before and after must agree",
                &[tensor.shape(), &shape],
            ));
        }
        Ok(tensor.with_shape(shape))
    }
}

/// Removes the axes of size 1 that input 1 names, or all axes of size 1 if it is left out.
#[derive(Debug)]
pub(crate) struct Squeeze;

impl Operator for Squeeze {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        if inputs.is_given(1) {
            inputs.index(1)?;
        }
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let tensor = inputs.tensor(0)?;
        let shape = tensor.shape();
        let mut drop = vec![false; shape.len()];
        match inputs.given(1) {
            None => drop = shape.iter().map(|&size| size == 1).collect(),
            Some(_) => {
                for value in inputs.integers(1)? {
                    let axis = layout::axis(value, shape.len())?;
                    if shape[axis] != 1 {
                        return Err(OpError::shape(
                            "only axes of size 1 can go",
                            &[shape, &[axis]],
                        ));
                    }
                    drop[axis] = true;
                }
            }
        }
        let kept = shape
            .iter()
            .zip(drop)
            .filter(|(_, drop)| !drop)
            .map(|(&size, _)| size);
        Ok(tensor.with_shape(kept.collect()))
    }
}

/// Adds axes of size 1 at the positions in input 1, which count in the result.
#[derive(Debug)]
pub(crate) struct Unsqueeze;

impl Operator for Unsqueeze {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let tensor = inputs.tensor(0)?;
        let axes = inputs.integers(1)?;
        let rank = tensor.shape().len() + axes.len();
        let mut added = vec![false; rank];
        for value in axes {
            let axis = layout::axis(value, rank)?;
            if std::mem::replace(&mut added[axis], true) {
                return Err(OpError::Value {
                    what: "axis given twice",
                    value,
                });
            }
        }
        let mut old = tensor.shape().iter();
        let shape = added
            .iter()
            .filter_map(|&added| if added { Some(1) } else { old.next().copied() });
        Ok(tensor.with_shape(shape.collect()))
    }
}

/// The input, unchanged.
#[derive(Debug)]
pub(crate) struct Identity;

impl Operator for Identity {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        inputs.tensor(0).cloned()
    }
}
