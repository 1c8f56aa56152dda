//! Cast and DequantizeLinear.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{
        Inputs, Operator, Types,
        attributes::{Attributes, refusal},
        layout,
    },
};

/// Conversion to another type. From f32 to an integer it drops the fraction and saturates.
#[derive(Debug)]
pub(crate) struct Cast {
    to: ElementType,
}

impl Cast {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        let code = attributes.int("to")?.unwrap_or(0);
        // The attribute matters only for 8-bit floats.
        attributes.int("saturate")?;
        let to = i32::try_from(code)
            .ok()
            .and_then(ElementType::from_onnx_code);
        match to {
            Some(
                to @ (ElementType::F32 | ElementType::I64 | ElementType::I32 | ElementType::Bool),
            ) => Ok(Self { to }),
            _ => Err(refusal(
                "to",
                format!(
                    "type {code}; only float32 (1), int32 (6), int64 (7), bool (9) are supported"
                ),
            )),
        }
    }

    /// Converts `$from` to every other type by `as`; `$zero` becomes false as bool.
    fn apply<T: Copy + PartialEq + Default>(
        &self,
        shape: Vec<usize>,
        data: &[T],
        to_f32: impl Fn(T) -> f32,
        to_i64: impl Fn(T) -> i64,
        to_i32: impl Fn(T) -> i32,
    ) -> Tensor {
        let data = data.iter().copied();
        match self.to {
            ElementType::I64 => Tensor::I64 {
                shape,
                data: data.map(to_i64).collect(),
            },
            ElementType::I32 => Tensor::I32 {
                shape,
                data: data.map(to_i32).collect(),
            },
            ElementType::Bool => Tensor::Bool {
                shape,
                data: data.map(|x| x != T::default()).collect(),
            },
            _ => Tensor::F32 {
                shape,
                data: data.map(to_f32).collect(),
            },
        }
    }
}

impl Operator for Cast {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.any(0)?;
        Ok(self.to)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?.to_vec();
        Ok(match inputs.tensor(0)? {
            Tensor::F32 { data, .. } => self.apply(shape, data, |x| x, |x| x as i64, |x| x as i32),
            Tensor::I64 { data, .. } => self.apply(shape, data, |x| x as f32, |x| x, |x| x as i32),
            Tensor::I32 { data, .. } => self.apply(shape, data, |x| x as f32, i64::from, |x| x),
            Tensor::U8 { data, .. } => self.apply(shape, data, f32::from, i64::from, i32::from),
            Tensor::Bool { data, .. } => self.apply(
                shape,
                data,
                |x| f32::from(u8::from(x)),
                i64::from,
                i32::from,
            ),
            Tensor::I8 { data, .. } => {
                let signed = |x: u8| x as i8;
                self.apply(
                    shape,
                    data,
                    |x| f32::from(signed(x)),
                    |x| i64::from(signed(x)),
                    |x| i32::from(signed(x)),
                )
            }
        })
    }
}

/// (q − zero) · scale, with one scale and zero point for the tensor or one for each index of an
/// axis.
#[derive(Debug)]
pub(crate) struct DequantizeLinear {
    /// The axis; used only if there is more than one scale.
    pub(crate) axis: i64,
}

impl DequantizeLinear {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        match attributes.int("block_size")?.unwrap_or(0) {
            0 => {}
            other => {
                return Err(refusal(
                    "block_size",
                    format!("{other}, only 0 is supported"),
                ));
            }
        }
        Ok(Self {
            axis: attributes.int("axis")?.unwrap_or(1),
        })
    }
}

impl Operator for DequantizeLinear {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        let quantized = inputs.one_of(0, &[ElementType::I8, ElementType::U8], "int8 or uint8")?;
        if inputs.is_given(2) {
            inputs.same(2, quantized)?;
        }
        inputs.f32(1)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shape = inputs.shape(0)?;
        inputs.size(shape)?;
        let scale = inputs.f32(1)?;
        let zero = match inputs.given(2) {
            Some(zero) => numbers(zero),
            None => vec![0.0; scale.len()],
        };
        if zero.len() != scale.len() {
            return Err(OpError::shape(
                "one zero point a scale",
                &[&[scale.len()], &[zero.len()]],
            ));
        }
        let mut data = numbers(inputs.tensor(0)?);
        if let ([scale], [zero]) = (scale, &zero[..]) {
            for x in &mut data {
                *x = (*x - zero) * scale;
            }
            return Ok(Tensor::f32(shape, data));
        }
        let axis = layout::axis(self.axis, shape.len())?;
        if scale.len() != shape[axis] {
            return Err(OpError::shape(
                "one scale an index of the axis",
                &[shape, &[scale.len()]],
            ));
        }
        let inner = layout::around(shape, axis).1;
        if inner > 0 {
            let pairs = scale.iter().zip(&zero).cycle();
            for (block, (scale, zero)) in data.chunks_exact_mut(inner).zip(pairs) {
                for x in block {
                    *x = (*x - zero) * scale;
                }
            }
        }
        Ok(Tensor::f32(shape, data))
    }

    fn as_dequantize(&self) -> Option<&DequantizeLinear> {
        Some(self)
    }
}

/// 8-bit integers as f32, which is exact; empty for another type.
pub(crate) fn numbers(tensor: &Tensor) -> Vec<f32> {
    match tensor {
        Tensor::I8 { data, .. } => data.iter().map(|&x| f32::from(x as i8)).collect(),
        Tensor::U8 { data, .. } => data.iter().map(|&x| f32::from(x)).collect(),
        _ => Vec::new(),
    }
}
