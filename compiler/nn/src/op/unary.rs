//! Functions of one f32: Relu, Sigmoid, Tanh, Exp, Log, Sqrt, Erf, Neg, Clip.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    kernel::math,
    op::{Inputs, Operator, Types},
};

/// Which function.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Unary {
    Relu,
    Sigmoid,
    Tanh,
    Exp,
    Log,
    Sqrt,
    Erf,
    Neg,
}

impl Operator for Unary {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        match self {
            Self::Neg => inputs.number(0),
            _ => inputs.f32(0),
        }
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let mut tensor = inputs.tensor(0)?.clone();
        match (&mut tensor, self) {
            (Tensor::I64 { data, .. }, Self::Neg) => apply(data, i64::wrapping_neg),
            (Tensor::I32 { data, .. }, Self::Neg) => apply(data, i32::wrapping_neg),
            (Tensor::F32 { data, .. }, function) => match function {
                Self::Relu => apply(data, |x| if x < 0.0 { 0.0 } else { x }),
                Self::Sigmoid => apply(data, math::sigmoid),
                Self::Tanh => apply(data, math::tanh),
                Self::Exp => math::exp_all(data),
                Self::Log => apply(data, math::log),
                Self::Sqrt => apply(data, math::sqrt),
                Self::Erf => math::erf_all(data),
                Self::Neg => apply(data, |x| -x),
            },
            _ => return Err(OpError::Input(0)),
        }
        Ok(tensor)
    }
}

fn apply<T: Copy>(data: &mut [T], function: impl Fn(T) -> T) {
    for x in data {
        *x = function(*x);
    }
}

/// x clamped to min..=max; either bound may be left out.
#[derive(Debug)]
pub(crate) struct Clip;

impl Operator for Clip {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        for bound in 1..3 {
            if inputs.is_given(bound) {
                inputs.f32(bound)?;
            }
        }
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let bound = |index, default| match inputs.given(index) {
            None => Ok(default),
            Some(tensor) => match inputs.f32(index)? {
                [bound] => Ok(*bound),
                _ => Err(OpError::shape("a bound is one number", &[tensor.shape()])),
            },
        };
        let (low, high) = (bound(1, f32::NEG_INFINITY)?, bound(2, f32::INFINITY)?);
        let mut data = inputs.f32(0)?.to_vec();
        // The order that ONNX states: if the bounds cross, the upper one wins.
        apply(&mut data, |x| {
            let x = if x < low { low } else { x };
            if x > high { high } else { x }
        });
        Ok(Tensor::f32(inputs.shape(0)?, data))
    }
}
