//! Constants: `TensorProto` to [`Tensor`].

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

/// Reads a constant. Bytes of 8-bit types are shared with the file, others are copied.
pub(crate) fn read(proto: &TensorProto) -> Result<Tensor, ConstantError> {
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
    match &proto.raw_data {
        Some(raw) => from_raw(element_type, shape, size, raw),
        None => from_list(element_type, shape, size, proto),
    }
}

fn from_raw(
    element_type: ElementType,
    shape: Vec<usize>,
    size: usize,
    raw: &Bytes,
) -> Result<Tensor, ConstantError> {
    if Some(raw.len()) != size.checked_mul(element_type.size()) {
        let reason = format!(
            "{} bytes, expected {size} × {} for {shape:?}",
            raw.len(),
            element_type.size()
        );
        return Err(ConstantError::new("raw_data", reason));
    }
    let words = raw.as_chunks::<4>().0.iter();
    Ok(match element_type {
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
        ElementType::I8 => Tensor::I8 {
            shape,
            data: raw.clone(),
        },
        ElementType::U8 => Tensor::U8 {
            shape,
            data: raw.clone(),
        },
    })
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
