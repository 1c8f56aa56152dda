//! Constants: `TensorProto` to [`Constant`], which becomes a [`Tensor`] when a step reads it.

use std::sync::OnceLock;

use bytes::Bytes;
use thiserror::Error;

use crate::{ElementType, OnnxError, Tensor, op::layout, proto::TensorProto};

/// Most elements of a constant. The file must hold them all, so this only bounds the shape.
const LIMIT: usize = 1 << 31;

/// Why a `TensorProto` is refused.
#[derive(Debug, Error)]
#[error("{field}: {reason}")]
pub(crate) struct ConstantError {
    pub(crate) field: &'static str,
    pub(crate) reason: String,
}

impl ConstantError {
    fn new(field: &'static str, reason: String) -> Self {
        Self { field, reason }
    }

    /// The error of the initializer with this name.
    pub(crate) fn of(self, name: &str) -> OnnxError {
        OnnxError::Initializer {
            name: name.to_owned(),
            field: self.field,
            reason: self.reason,
        }
    }
}

/// A checked constant. Its bytes stay in the file until a step asks for its elements, which for
/// the weights of a product never happens.
#[derive(Debug)]
pub(crate) struct Constant {
    element_type: ElementType,
    shape: Vec<usize>,
    /// Little-endian elements, as many as the shape says; `None` if the tensor was there at once.
    raw: Option<Bytes>,
    tensor: OnceLock<Tensor>,
}

impl Constant {
    pub(crate) fn element_type(&self) -> ElementType {
        self.element_type
    }

    pub(crate) fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// The bytes in the file, if the constant has this type and lies there in one piece.
    pub(crate) fn stored(&self, element_type: ElementType) -> Option<&Bytes> {
        let raw = self.raw.as_ref();
        raw.filter(|_| self.element_type == element_type)
    }

    /// The constant with its elements. Bytes of 8-bit types are shared with the file, others are
    /// copied once.
    pub(crate) fn tensor(&self) -> &Tensor {
        self.tensor.get_or_init(|| self.decoded())
    }

    pub(crate) fn into_tensor(mut self) -> Tensor {
        match self.tensor.take() {
            Some(tensor) => tensor,
            None => self.decoded(),
        }
    }

    /// Returns true while no step has asked for the elements.
    #[cfg(test)]
    pub(crate) fn is_untouched(&self) -> bool {
        self.tensor.get().is_none()
    }

    fn decoded(&self) -> Tensor {
        let raw = self.raw.clone().unwrap_or_default();
        from_raw(self.element_type, self.shape.clone(), raw)
    }
}

impl From<Tensor> for Constant {
    fn from(tensor: Tensor) -> Self {
        Self {
            element_type: tensor.element_type(),
            shape: tensor.shape().to_vec(),
            raw: None,
            tensor: tensor.into(),
        }
    }
}

/// Reads and checks a constant.
pub(crate) fn read(proto: &TensorProto) -> Result<Constant, ConstantError> {
    if proto.data_location != 0 {
        let reason = "data in another file are not supported; save the model as one file";
        return Err(ConstantError::new("data_location", reason.to_owned()));
    }
    let Some(element_type) = ElementType::from_onnx_code(proto.data_type) else {
        let reason = format!(
            "type {} is not supported (float32, int64, int32, int8, uint8, bool are)",
            proto.data_type
        );
        return Err(ConstantError::new("data_type", reason));
    };
    let shape = proto
        .dims
        .iter()
        .map(|&size| usize::try_from(size))
        .collect::<Result<Vec<_>, _>>()
        .ok()
        .filter(|shape| layout::size(shape, LIMIT).is_ok())
        .ok_or_else(|| ConstantError::new("dims", format!("{:?} is no shape", proto.dims)))?;
    let size = shape.iter().product();
    let Some(raw) = &proto.raw_data else {
        return Ok(from_list(element_type, shape, size, proto)?.into());
    };
    if Some(raw.len()) != size.checked_mul(element_type.size()) {
        let reason = format!(
            "{} bytes, expected {size} × {} for {shape:?}",
            raw.len(),
            element_type.size()
        );
        return Err(ConstantError::new("raw_data", reason));
    }
    Ok(Constant {
        element_type,
        shape,
        raw: Some(raw.clone()),
        tensor: OnceLock::new(),
    })
}

/// The tensor of bytes that are as many as its shape says.
fn from_raw(element_type: ElementType, shape: Vec<usize>, raw: Bytes) -> Tensor {
    let words = raw.as_chunks::<4>().0.iter();
    match element_type {
        ElementType::F32 => Tensor::F32 {
            shape,
            data: words.map(|word| f32::from_le_bytes(*word)).collect(),
        },
        ElementType::I32 => Tensor::I32 {
            shape,
            data: words.map(|word| i32::from_le_bytes(*word)).collect(),
        },
        ElementType::I64 => {
            let words = raw.as_chunks::<8>().0.iter();
            Tensor::I64 {
                shape,
                data: words.map(|word| i64::from_le_bytes(*word)).collect(),
            }
        }
        ElementType::Bool => Tensor::Bool {
            shape,
            data: raw.iter().map(|&byte| byte != 0).collect(),
        },
        ElementType::I8 => Tensor::I8 { shape, data: raw },
        ElementType::U8 => Tensor::U8 { shape, data: raw },
    }
}

fn from_list(
    element_type: ElementType,
    shape: Vec<usize>,
    size: usize,
    proto: &TensorProto,
) -> Result<Tensor, ConstantError> {
    let (field, length) = match element_type {
        ElementType::F32 => ("float_data", proto.float_data.len()),
        ElementType::I64 => ("int64_data", proto.int64_data.len()),
        _ => ("int32_data", proto.int32_data.len()),
    };
    if length != size {
        let reason = format!("{length} elements, expected {size} for {shape:?}");
        return Err(ConstantError::new(field, reason));
    }
    let out_of_range = |_| ConstantError::new(field, format!("a value is outside {element_type}"));
    let list = &proto.int32_data;
    Ok(match element_type {
        ElementType::F32 => Tensor::F32 {
            shape,
            data: proto.float_data.clone(),
        },
        ElementType::I64 => Tensor::I64 {
            shape,
            data: proto.int64_data.clone(),
        },
        ElementType::I32 => Tensor::I32 {
            shape,
            data: list.clone(),
        },
        ElementType::Bool => Tensor::Bool {
            shape,
            data: list.iter().map(|&value| value != 0).collect(),
        },
        ElementType::I8 => {
            let values: Result<Vec<i8>, _> =
                list.iter().map(|&value| i8::try_from(value)).collect();
            let data = values
                .map_err(out_of_range)?
                .into_iter()
                .map(|value| value as u8)
                .collect();
            Tensor::I8 { shape, data }
        }
        ElementType::U8 => {
            let values: Result<Vec<u8>, _> =
                list.iter().map(|&value| u8::try_from(value)).collect();
            Tensor::U8 {
                shape,
                data: values.map_err(out_of_range)?.into(),
            }
        }
    })
}

/// Writes a constant, its elements as `raw_data`.
pub(crate) fn write(name: &str, tensor: &Tensor) -> TensorProto {
    let raw = match tensor {
        Tensor::F32 { data, .. } => data.iter().flat_map(|x| x.to_le_bytes()).collect(),
        Tensor::I64 { data, .. } => data.iter().flat_map(|x| x.to_le_bytes()).collect(),
        Tensor::I32 { data, .. } => data.iter().flat_map(|x| x.to_le_bytes()).collect(),
        Tensor::Bool { data, .. } => data.iter().map(|&x| u8::from(x)).collect(),
        Tensor::I8 { data, .. } | Tensor::U8 { data, .. } => data.clone(),
    };
    TensorProto {
        dims: tensor.shape().iter().map(|&size| size as i64).collect(),
        data_type: tensor.element_type().onnx_code(),
        name: name.to_owned(),
        raw_data: Some(raw),
        ..TensorProto::default()
    }
}
