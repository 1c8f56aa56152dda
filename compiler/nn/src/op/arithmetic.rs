//! Add, Sub, Mul, Div and Pow, with numpy's broadcasting.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    kernel::math,
    op::{Inputs, Operator, Types, layout},
    tensor::Element,
};

/// Which arithmetic.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Binary {
    Add,
    Sub,
    Mul,
    Div,
}

/// a ∘ b on f32, i64 or i32. Integers wrap; a division by the integer 0 is an error.
#[derive(Debug)]
pub(crate) struct Arithmetic(pub(crate) Binary);

impl Operator for Arithmetic {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        let element_type = inputs.number(0)?;
        inputs.same(1, element_type)?;
        Ok(element_type)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        match (inputs.tensor(0)?.element_type(), self.0) {
            (ElementType::F32, Binary::Add) => apply(inputs, |x: f32, y: f32| x + y),
            (ElementType::F32, Binary::Sub) => apply(inputs, |x: f32, y: f32| x - y),
            (ElementType::F32, Binary::Mul) => apply(inputs, |x: f32, y: f32| x * y),
            (ElementType::F32, Binary::Div) => apply(inputs, |x: f32, y: f32| x / y),
            (ElementType::I64, kind) => {
                refuse_zero(kind, inputs.elements::<i64>(1)?.contains(&0))?;
                let function: &dyn Fn(i64, i64) -> i64 = match kind {
                    Binary::Add => &i64::wrapping_add,
                    Binary::Sub => &i64::wrapping_sub,
                    Binary::Mul => &i64::wrapping_mul,
                    Binary::Div => &i64::wrapping_div,
                };
                apply(inputs, function)
            }
            (_, kind) => {
                refuse_zero(kind, inputs.elements::<i32>(1)?.contains(&0))?;
                let function: &dyn Fn(i32, i32) -> i32 = match kind {
                    Binary::Add => &i32::wrapping_add,
                    Binary::Sub => &i32::wrapping_sub,
                    Binary::Mul => &i32::wrapping_mul,
                    Binary::Div => &i32::wrapping_div,
                };
                apply(inputs, function)
            }
        }
    }
}

fn refuse_zero(kind: Binary, zero: bool) -> Result<(), OpError> {
    if zero && matches!(kind, Binary::Div) {
        return Err(OpError::Value {
            what: "division of integers by",
            value: 0,
        });
    }
    Ok(())
}

fn apply<T: Element>(inputs: &Inputs<'_>, function: impl Fn(T, T) -> T) -> Result<Tensor, OpError> {
    let (a_shape, b_shape) = (inputs.shape(0)?, inputs.shape(1)?);
    let shape = layout::broadcast(a_shape, b_shape)?;
    inputs.size(&shape)?;
    let (a, b) = (inputs.elements::<T>(0)?, inputs.elements::<T>(1)?);
    let data = layout::zip(&shape, (a_shape, a), (b_shape, b), function);
    Ok(T::tensor(shape, data))
}

/// aᵇ on f32, with an exponent of f32, i64 or i32.
#[derive(Debug)]
pub(crate) struct Power;

impl Operator for Power {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.number(1)?;
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let converted: Vec<f32>;
        let exponent = match inputs.tensor(1)? {
            Tensor::F32 { data, .. } => data,
            _ => {
                converted = inputs
                    .integers(1)?
                    .iter()
                    .map(|&value| value as f32)
                    .collect();
                &converted
            }
        };
        let (a_shape, b_shape) = (inputs.shape(0)?, inputs.shape(1)?);
        let shape = layout::broadcast(a_shape, b_shape)?;
        inputs.size(&shape)?;
        let data = layout::zip(
            &shape,
            (a_shape, inputs.f32(0)?),
            (b_shape, exponent),
            math::pow,
        );
        Ok(Tensor::F32 { shape, data })
    }
}
