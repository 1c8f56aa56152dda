//! Shape, Constant, ConstantOfShape and Range: tensors made from shapes or from attributes.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{
        Inputs, Operator, Types,
        attributes::{Attributes, refusal},
        expand::sizes,
    },
    tensor::same_type,
};

/// The sizes of the axes `start..end`. Negative bounds count from the end; both are clamped to
/// the rank.
#[derive(Debug)]
pub(crate) struct Shape {
    start: i64,
    end: Option<i64>,
}

impl Shape {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            start: attributes.int("start")?.unwrap_or(0),
            end: attributes.int("end")?,
        })
    }
}

impl Operator for Shape {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.any(0)?;
        Ok(ElementType::I64)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?;
        let rank = shape.len() as i64;
        let cut = |bound: i64| {
            let bound = if bound < 0 {
                bound.saturating_add(rank)
            } else {
                bound
            };
            bound.clamp(0, rank) as usize
        };
        let (start, end) = (cut(self.start), self.end.map_or(shape.len(), cut));
        let sizes = shape.get(start..end).unwrap_or_default();
        Ok(Tensor::i64(
            &[sizes.len()],
            sizes.iter().map(|&size| size as i64).collect(),
        ))
    }
}

/// The value of an attribute.
#[derive(Debug)]
pub(crate) struct Constant {
    value: Tensor,
}

impl Constant {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        let candidates = [
            attributes.tensor("value")?,
            attributes
                .float("value_float")?
                .map(|value| Tensor::f32(&[], vec![value])),
            attributes
                .int("value_int")?
                .map(|value| Tensor::i64(&[], vec![value])),
            attributes
                .floats("value_floats")?
                .map(|values| Tensor::f32(&[values.len()], values.to_vec())),
            attributes
                .ints("value_ints")?
                .map(|values| Tensor::i64(&[values.len()], values.to_vec())),
        ];
        let mut given = candidates.into_iter().flatten();
        match (given.next(), given.next()) {
            (Some(value), None) => Ok(Self { value }),
            _ => Err(refusal("value", "exactly one value is expected".to_owned())),
        }
    }
}

impl Operator for Constant {
    fn output_type(&self, _: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        Ok(self.value.element_type())
    }

    fn run(&self, _: &Inputs<'_>) -> Result<Tensor, OpError> {
        Ok(self.value.clone())
    }
}

/// Repeats a value to the shape in input 0.
#[derive(Debug)]
pub(crate) struct ConstantOfShape {
    value: Tensor,
}

impl ConstantOfShape {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        let value = attributes
            .tensor("value")?
            .unwrap_or_else(|| Tensor::f32(&[1], vec![0.0]));
        if value.len() != 1 {
            return Err(refusal(
                "value",
                format!("{} elements, expected 1", value.len()),
            ));
        }
        Ok(Self { value })
    }
}

impl Operator for ConstantOfShape {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(0)?;
        Ok(self.value.element_type())
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = sizes(&inputs.integers(0)?)?;
        let size = inputs.size(&shape)?;
        Ok(same_type!(&self.value, data => (shape, vec![data[0]; size])))
    }
}

/// start, start + delta, … before limit; f32, i64 or i32.
#[derive(Debug)]
pub(crate) struct Range;

impl Operator for Range {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        let element_type = inputs.number(0)?;
        inputs.same(1, element_type)?;
        inputs.same(2, element_type)?;
        Ok(element_type)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let too_large = OpError::TooLarge {
            shape: Vec::new(),
            limit: inputs.limit,
        };
        if inputs.tensor(0)?.element_type() == ElementType::F32 {
            let scalar = |index| match inputs.f32(index)? {
                [value] => Ok(f64::from(*value)),
                _ => Err(OpError::shape(
                    "one number expected",
                    &[inputs.shape(index)?],
                )),
            };
            let (start, limit, delta) = (scalar(0)?, scalar(1)?, scalar(2)?);
            // A count of NaN becomes 0; an infinite one is over the limit.
            let count = libm::ceil((limit - start) / delta).max(0.0);
            if count > inputs.limit as f64 {
                return Err(too_large);
            }
            let data: Vec<f32> = (0..count as usize)
                .map(|i| (start + i as f64 * delta) as f32)
                .collect();
            return Ok(Tensor::f32(&[data.len()], data));
        }
        let (start, limit, delta) = (inputs.integer(0)?, inputs.integer(1)?, inputs.integer(2)?);
        if delta == 0 {
            return Err(OpError::Value {
                what: "delta",
                value: 0,
            });
        }
        // In 128 bits the difference of two 64-bit numbers cannot overflow.
        let distance = (i128::from(limit) - i128::from(start)) * i128::from(delta.signum());
        let step = i128::from(delta).abs();
        let count = if distance > 0 {
            (distance - 1) / step + 1
        } else {
            0
        };
        if count > inputs.limit as i128 {
            return Err(too_large);
        }
        let values = (0..count as i64).map(|i| start.wrapping_add(i.wrapping_mul(delta)));
        let shape = vec![count as usize];
        Ok(match inputs.tensor(0)? {
            Tensor::I32 { .. } => Tensor::I32 {
                shape,
                data: values.map(|value| value as i32).collect(),
            },
            _ => Tensor::I64 {
                shape,
                data: values.collect(),
            },
        })
    }
}
