//! Tensors: row-major numbers with a shape.

use std::fmt;

use bytes::Bytes;

/// Type of a tensor's elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ElementType {
    /// IEEE 754 binary32.
    F32,
    /// 64-bit integer: token ids, shapes, axes.
    I64,
    /// 32-bit integer.
    I32,
    /// 8-bit integer: quantised weights.
    I8,
    /// 8-bit unsigned integer.
    U8,
    /// Truth value.
    Bool,
}

impl ElementType {
    /// Code in `TensorProto.DataType`.
    #[must_use]
    pub const fn onnx_code(self) -> i32 {
        match self {
            Self::F32 => 1,
            Self::U8 => 2,
            Self::I8 => 3,
            Self::I32 => 6,
            Self::I64 => 7,
            Self::Bool => 9,
        }
    }

    /// The type with a code; `None` if it is not supported.
    #[must_use]
    pub const fn from_onnx_code(code: i32) -> Option<Self> {
        match code {
            1 => Some(Self::F32),
            2 => Some(Self::U8),
            3 => Some(Self::I8),
            6 => Some(Self::I32),
            7 => Some(Self::I64),
            9 => Some(Self::Bool),
            _ => None,
        }
    }

    /// Bytes of one element in `raw_data`.
    #[must_use]
    pub const fn size(self) -> usize {
        match self {
            Self::F32 | Self::I32 => 4,
            Self::I64 => 8,
            Self::I8 | Self::U8 | Self::Bool => 1,
        }
    }
}

impl fmt::Display for ElementType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::F32 => "float32",
            Self::I64 => "int64",
            Self::I32 => "int32",
            Self::I8 => "int8",
            Self::U8 => "uint8",
            Self::Bool => "bool",
        })
    }
}

/// A dense row-major tensor.
///
/// `data.len()` is the product of `shape`, 1 for a scalar; a session refuses any other.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Tensor {
    /// [`ElementType::F32`].
    F32 {
        /// Dimensions.
        shape: Vec<usize>,
        /// Elements.
        data: Vec<f32>,
    },
    /// [`ElementType::I64`].
    I64 {
        /// Dimensions.
        shape: Vec<usize>,
        /// Elements.
        data: Vec<i64>,
    },
    /// [`ElementType::I32`].
    I32 {
        /// Dimensions.
        shape: Vec<usize>,
        /// Elements.
        data: Vec<i32>,
    },
    /// [`ElementType::I8`]: bytes in two's complement, which may be shared with the file.
    I8 {
        /// Dimensions.
        shape: Vec<usize>,
        /// Elements.
        data: Bytes,
    },
    /// [`ElementType::U8`].
    U8 {
        /// Dimensions.
        shape: Vec<usize>,
        /// Elements.
        data: Bytes,
    },
    /// [`ElementType::Bool`].
    Bool {
        /// Dimensions.
        shape: Vec<usize>,
        /// Elements.
        data: Vec<bool>,
    },
}

impl Tensor {
    /// A tensor of f32; a session refuses it unless `data` has the length that `shape` says.
    #[must_use]
    pub fn f32(shape: &[usize], data: Vec<f32>) -> Self {
        Self::F32 {
            shape: shape.to_vec(),
            data,
        }
    }

    /// A tensor of i64; a session refuses it unless `data` has the length that `shape` says.
    #[must_use]
    pub fn i64(shape: &[usize], data: Vec<i64>) -> Self {
        Self::I64 {
            shape: shape.to_vec(),
            data,
        }
    }

    /// Type of the elements.
    #[must_use]
    pub const fn element_type(&self) -> ElementType {
        match self {
            Self::F32 { .. } => ElementType::F32,
            Self::I64 { .. } => ElementType::I64,
            Self::I32 { .. } => ElementType::I32,
            Self::I8 { .. } => ElementType::I8,
            Self::U8 { .. } => ElementType::U8,
            Self::Bool { .. } => ElementType::Bool,
        }
    }

    /// Dimensions.
    #[must_use]
    pub fn shape(&self) -> &[usize] {
        match self {
            Self::F32 { shape, .. }
            | Self::I64 { shape, .. }
            | Self::I32 { shape, .. }
            | Self::I8 { shape, .. }
            | Self::U8 { shape, .. }
            | Self::Bool { shape, .. } => shape,
        }
    }

    /// Number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::F32 { data, .. } => data.len(),
            Self::I64 { data, .. } => data.len(),
            Self::I32 { data, .. } => data.len(),
            Self::I8 { data, .. } | Self::U8 { data, .. } => data.len(),
            Self::Bool { data, .. } => data.len(),
        }
    }

    /// Returns true if the tensor has no elements.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The elements of an f32 tensor.
    #[must_use]
    pub fn as_f32(&self) -> Option<&[f32]> {
        f32::elements(self)
    }

    /// Returns true if the number of elements is the product of the shape.
    #[must_use]
    pub fn is_consistent(&self) -> bool {
        self.shape()
            .iter()
            .try_fold(1_usize, |product, &size| product.checked_mul(size))
            == Some(self.len())
    }

    /// The same elements under another shape of the same size.
    pub(crate) fn with_shape(&self, shape: Vec<usize>) -> Self {
        let mut tensor = self.clone();
        match &mut tensor {
            Self::F32 { shape: old, .. }
            | Self::I64 { shape: old, .. }
            | Self::I32 { shape: old, .. }
            | Self::I8 { shape: old, .. }
            | Self::U8 { shape: old, .. }
            | Self::Bool { shape: old, .. } => *old = shape,
        }
        tensor
    }
}

/// A Rust type that is the element of one kind of tensor.
pub(crate) trait Element: Copy + Default {
    /// The elements, if the tensor has this type.
    fn elements(tensor: &Tensor) -> Option<&[Self]>;
    /// A tensor of this type.
    fn tensor(shape: Vec<usize>, data: Vec<Self>) -> Tensor;
}

macro_rules! element {
    ($type:ty, $variant:ident) => {
        impl Element for $type {
            fn elements(tensor: &Tensor) -> Option<&[Self]> {
                match tensor {
                    Tensor::$variant { data, .. } => Some(data),
                    _ => None,
                }
            }
            fn tensor(shape: Vec<usize>, data: Vec<Self>) -> Tensor {
                Tensor::$variant { shape, data }
            }
        }
    };
}
element!(f32, F32);
element!(i64, I64);
element!(i32, I32);
element!(bool, Bool);

/// Elements of both 8-bit types, signed ones in two's complement. A new tensor is unsigned.
impl Element for u8 {
    fn elements(tensor: &Tensor) -> Option<&[Self]> {
        match tensor {
            Tensor::I8 { data, .. } | Tensor::U8 { data, .. } => Some(data),
            _ => None,
        }
    }
    fn tensor(shape: Vec<usize>, data: Vec<Self>) -> Tensor {
        Tensor::U8 {
            shape,
            data: data.into(),
        }
    }
}

/// Runs `$body`, which maps elements of any type to `(shape, elements)`, and makes a tensor of
/// the type of `$tensor` from them.
macro_rules! same_type {
    ($tensor:expr, $data:ident => $body:expr) => {
        match $tensor {
            $crate::Tensor::F32 { data: $data, .. } => {
                let (shape, data) = $body;
                $crate::Tensor::F32 { shape, data }
            }
            $crate::Tensor::I64 { data: $data, .. } => {
                let (shape, data) = $body;
                $crate::Tensor::I64 { shape, data }
            }
            $crate::Tensor::I32 { data: $data, .. } => {
                let (shape, data) = $body;
                $crate::Tensor::I32 { shape, data }
            }
            $crate::Tensor::Bool { data: $data, .. } => {
                let (shape, data) = $body;
                $crate::Tensor::Bool { shape, data }
            }
            $crate::Tensor::I8 { data: $data, .. } => {
                let (shape, data) = $body;
                let data = bytes::Bytes::from(data);
                $crate::Tensor::I8 { shape, data }
            }
            $crate::Tensor::U8 { data: $data, .. } => {
                let (shape, data) = $body;
                let data = bytes::Bytes::from(data);
                $crate::Tensor::U8 { shape, data }
            }
        }
    };
}
pub(crate) use same_type;
