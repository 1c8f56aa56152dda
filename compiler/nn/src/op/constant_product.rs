//! A product whose right-hand side is a constant: its weights are read where the file has them.

use bytes::Bytes;

use super::matmul::Product;
use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    kernel::product::{Matrix, product},
    op::{Inputs, Operator, Types},
};

/// The weights of a product, as the file stores them.
#[derive(Debug)]
pub(crate) enum Weights {
    /// Little-endian float32.
    F32(Bytes),
    /// int8 in two's complement, which the product expands by the formula of `DequantizeLinear`.
    Quantized {
        weights: Bytes,
        /// Scale per column.
        scale: Vec<f32>,
        /// Zero point per column.
        zero: Vec<f32>,
    },
}

impl Weights {
    fn matrix(&self) -> Matrix<'_> {
        match self {
            Self::F32(bytes) => Matrix::Stored(bytes.as_chunks().0),
            Self::Quantized {
                weights,
                scale,
                zero,
            } => Matrix::Quantized {
                weights,
                scale,
                zero,
            },
        }
    }
}

/// `MatMul` or `Gemm` with constant weights [k, n]. Input 0 is the left-hand side, input 1 the C
/// of a `Gemm`.
#[derive(Debug)]
pub(crate) struct ConstantProduct {
    pub(crate) product: Product,
    /// Rows.
    pub(crate) k: usize,
    /// Columns.
    pub(crate) n: usize,
    pub(crate) weights: Weights,
}

impl Operator for ConstantProduct {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let a_shape = inputs.shape(0)?;
        let refusal = || OpError::shape(self.rule(), &[a_shape, &[self.k, self.n]]);
        let lead = match (self.product, a_shape) {
            (Product::MatMul, [lead @ .., k]) if *k == self.k => lead,
            (Product::Gemm(_), [m, k]) if *k == self.k => std::slice::from_ref(m),
            _ => return Err(refusal()),
        };
        let mut shape = lead.to_vec();
        shape.push(self.n);
        let mut data = vec![0.0; inputs.size(&shape)?];
        let rows = data.len().checked_div(self.n).unwrap_or(0);
        let weights = self.weights.matrix();
        product(rows, self.k, self.n, inputs.f32(0)?, &weights, &mut data);
        if let Product::Gemm(gemm) = self.product {
            data = gemm.finish(inputs, 1, &shape, data)?;
        }
        Ok(Tensor::F32 { shape, data })
    }
}

impl ConstantProduct {
    fn rule(&self) -> &'static str {
        match self.product {
            Product::MatMul => "last axis of a must match the one before last of b",
            Product::Gemm(_) => "columns of A must match rows of B",
        }
    }
}
