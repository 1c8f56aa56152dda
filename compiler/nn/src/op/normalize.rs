//! Softmax and LayerNormalization.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    kernel::{lanes, math},
    op::{
        Inputs, Operator, Types,
        attributes::{Attributes, refusal},
        layout,
    },
};

/// exp(x − max) over its sum, along one axis.
#[derive(Debug)]
pub(crate) struct Softmax {
    axis: i64,
}

impl Softmax {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            axis: attributes.int("axis")?.unwrap_or(-1),
        })
    }
}

impl Operator for Softmax {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?;
        let axis = layout::axis(self.axis, shape.len())?;
        let (count, inner) = (shape[axis], layout::around(shape, axis).1);
        let mut data = inputs.f32(0)?.to_vec();
        if data.is_empty() {
            return Ok(Tensor::f32(shape, data));
        }
        // Each line along the axis is gathered, normalised and written back.
        let mut line = vec![0.0; count];
        for block in data.chunks_exact_mut(count * inner) {
            if inner == 1 {
                softmax(block);
                continue;
            }
            for start in 0..inner {
                for (slot, x) in line.iter_mut().zip(block[start..].iter().step_by(inner)) {
                    *slot = *x;
                }
                softmax(&mut line);
                for (slot, x) in block[start..].iter_mut().step_by(inner).zip(&line) {
                    *slot = *x;
                }
            }
        }
        Ok(Tensor::f32(shape, data))
    }
}

fn softmax(line: &mut [f32]) {
    let highest = line.iter().fold(
        f32::NEG_INFINITY,
        |high, &x| if x > high { x } else { high },
    );
    for x in &mut *line {
        *x -= highest;
    }
    math::exp_all(line);
    let total = lanes::sum(line);
    for x in line {
        *x /= total;
    }
}

/// (x − mean) / √(variance + ε) · scale + bias, over the axes from `axis` on.
#[derive(Debug)]
pub(crate) struct LayerNormalization {
    axis: i64,
    epsilon: f32,
}

impl LayerNormalization {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        let stash = attributes.int("stash_type")?.unwrap_or(1);
        if stash != 1 {
            return Err(refusal(
                "stash_type",
                format!("{stash}, expected 1 (float32)"),
            ));
        }
        Ok(Self {
            axis: attributes.int("axis")?.unwrap_or(-1),
            epsilon: attributes.float("epsilon")?.unwrap_or(1e-5),
        })
    }
}

impl Operator for LayerNormalization {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.f32(1)?;
        if inputs.is_given(2) {
            inputs.f32(2)?;
        }
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?;
        let axis = layout::axis(self.axis, shape.len())?;
        let group: usize = shape[axis..].iter().product();
        let scale = inputs.f32(1)?;
        let zeros;
        let bias = match inputs.given(2) {
            Some(_) => inputs.f32(2)?,
            None => {
                zeros = vec![0.0; scale.len()];
                &zeros
            }
        };
        if scale.len() != group || bias.len() != group {
            let shapes = [shape, &[scale.len()], &[bias.len()]];
            return Err(OpError::shape(
                "scale and bias must have the size of the axes",
                &shapes,
            ));
        }
        let mut data = inputs.f32(0)?.to_vec();
        if group > 0 {
            for row in data.chunks_exact_mut(group) {
                self.row(row, scale, bias);
            }
        }
        Ok(Tensor::f32(shape, data))
    }
}

impl LayerNormalization {
    fn row(&self, row: &mut [f32], scale: &[f32], bias: &[f32]) {
        let count = row.len() as f32;
        let mean = lanes::sum(row) / count;
        for x in &mut *row {
            *x -= mean;
        }
        let variance = lanes::sum_of_squares(row) / count;
        let inverse = 1.0 / math::sqrt(variance + self.epsilon);
        for ((x, scale), bias) in row.iter_mut().zip(scale).zip(bias) {
            *x = *x * inverse * scale + bias;
        }
    }
}
