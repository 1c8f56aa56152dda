//! Ports: `ValueInfoProto` to [`Port`] and back.

use crate::{
    Dim, ElementType, OnnxError, Port,
    proto::{DimensionProto, TensorShapeProto, TensorTypeProto, TypeProto, ValueInfoProto},
};

/// Reads a port; `direction` is `input` or `output`, for messages.
pub(crate) fn read(direction: &'static str, info: &ValueInfoProto) -> Result<Port, OnnxError> {
    let refusal = |reason: String| OnnxError::Port {
        direction,
        name: info.name.clone(),
        reason,
    };
    let Some(tensor) = info
        .r#type
        .as_ref()
        .and_then(|info| info.tensor_type.as_ref())
    else {
        return Err(refusal("is no tensor, or has no type".to_owned()));
    };
    let Some(element_type) = ElementType::from_onnx_code(tensor.elem_type) else {
        return Err(refusal(format!(
            "element type {} is not supported",
            tensor.elem_type
        )));
    };
    let dims = match &tensor.shape {
        None => None,
        Some(shape) => Some(
            shape
                .dim
                .iter()
                .map(|dim| match (dim.dim_value, &dim.dim_param) {
                    (Some(size), _) => usize::try_from(size)
                        .map(Dim::Fixed)
                        .map_err(|_| refusal(format!("dimension {size} is negative"))),
                    (None, Some(name)) if !name.is_empty() => Ok(Dim::Named(name.clone())),
                    _ => Ok(Dim::Any),
                })
                .collect::<Result<Vec<_>, _>>()?,
        ),
    };
    Ok(Port {
        name: info.name.clone(),
        element_type,
        dims,
    })
}

/// Writes a port.
pub(crate) fn write(port: &Port) -> ValueInfoProto {
    let dim = |dim: &Dim| match dim {
        Dim::Fixed(size) => DimensionProto {
            dim_value: Some(*size as i64),
            dim_param: None,
        },
        Dim::Named(name) => DimensionProto {
            dim_value: None,
            dim_param: Some(name.clone()),
        },
        Dim::Any => DimensionProto::default(),
    };
    let tensor = TensorTypeProto {
        elem_type: port.element_type.onnx_code(),
        shape: port.dims.as_ref().map(|dims| TensorShapeProto {
            dim: dims.iter().map(dim).collect(),
        }),
    };
    ValueInfoProto {
        name: port.name.clone(),
        r#type: Some(TypeProto {
            tensor_type: Some(tensor),
        }),
    }
}
