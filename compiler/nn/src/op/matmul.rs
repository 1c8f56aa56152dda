//! MatMul, Gemm, and MatMul with int8 weights that are expanded inside the product.

use bytes::Bytes;

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    kernel::product::{Matrix, product},
    op::{Inputs, Operator, Types, attributes::Attributes, layout},
};

/// The matrix product of the last two axes; the others broadcast.
#[derive(Debug)]
pub(crate) struct MatMul;

impl Operator for MatMul {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.f32(1)?;
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let (a_shape, b_shape) = (inputs.shape(0)?, inputs.shape(1)?);
        let refusal = || {
            OpError::shape(
                "last axis of a must match the one before last of b",
                &[a_shape, b_shape],
            )
        };
        // A vector counts as a row on the left and a column on the right; the axis that is added
        // for it is removed again.
        let (a_lead, m, k) = match a_shape {
            [] => return Err(refusal()),
            [k] => (&[][..], 1, *k),
            [lead @ .., m, k] => (lead, *m, *k),
        };
        let (b_lead, b_rows, n) = match b_shape {
            [] => return Err(refusal()),
            [k] => (&[][..], *k, 1),
            [lead @ .., k, n] => (lead, *k, *n),
        };
        if b_rows != k {
            return Err(refusal());
        }
        let (a, b) = (inputs.f32(0)?, inputs.f32(1)?);
        let lead = layout::broadcast(a_lead, b_lead)?;
        let mut shape = lead.clone();
        if a_shape.len() > 1 {
            shape.push(m);
        }
        if b_shape.len() > 1 {
            shape.push(n);
        }
        let mut data = vec![0.0; inputs.size(&shape)?];
        if b_lead.is_empty() {
            // All products share one right-hand matrix: their rows become rows of one product.
            let rows = data.len().checked_div(n).unwrap_or(0);
            product(rows, k, n, a, &Matrix::Rows(b), &mut data);
            return Ok(Tensor::F32 { shape, data });
        }
        let strides = [
            layout::broadcast_strides(a_lead, &lead),
            layout::broadcast_strides(b_lead, &lead),
        ];
        let walk = layout::Walk::new(&lead, [&strides[0], &strides[1]]);
        if m * n == 0 {
            return Ok(Tensor::F32 { shape, data });
        }
        let mut results = data.chunks_exact_mut(m * n);
        walk.rows(&mut |[a_start, b_start]| {
            for i in 0..walk.row {
                let a_start = (a_start as usize + i * walk.step[0] as usize) * m * k;
                let b_start = (b_start as usize + i * walk.step[1] as usize) * k * n;
                let Some(out) = results.next() else { return };
                let b = Matrix::Rows(&b[b_start..b_start + k * n]);
                product(m, k, n, &a[a_start..a_start + m * k], &b, out);
            }
        });
        Ok(Tensor::F32 { shape, data })
    }

    fn as_matmul(&self) -> Option<&MatMul> {
        Some(self)
    }
}

/// α·op(A)·op(B) + β·C on matrices, where op transposes if the attributes say so.
#[derive(Debug)]
pub(crate) struct Gemm {
    alpha: f32,
    beta: f32,
    transpose_a: bool,
    transpose_b: bool,
}

impl Gemm {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            alpha: attributes.float("alpha")?.unwrap_or(1.0),
            beta: attributes.float("beta")?.unwrap_or(1.0),
            transpose_a: attributes.flag("transA", false)?,
            transpose_b: attributes.flag("transB", false)?,
        })
    }
}

impl Operator for Gemm {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        if inputs.is_given(2) {
            inputs.f32(2)?;
        }
        inputs.f32(1)?;
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let (a_shape, b_shape) = (inputs.shape(0)?, inputs.shape(1)?);
        let refusal = || OpError::shape("columns of A must match rows of B", &[a_shape, b_shape]);
        let (&[a0, a1], &[b0, b1]) = (a_shape, b_shape) else {
            return Err(refusal());
        };
        let (m, k) = if self.transpose_a { (a1, a0) } else { (a0, a1) };
        let (b_rows, n) = if self.transpose_b { (b1, b0) } else { (b0, b1) };
        if b_rows != k {
            return Err(refusal());
        }
        let shape = vec![m, n];
        let mut data = vec![0.0; inputs.size(&shape)?];
        let (a, b) = (inputs.f32(0)?, inputs.f32(1)?);
        let turned;
        let a = if self.transpose_a {
            turned = layout::copy(a, 0, &[m, k], &[1, m as isize]);
            &turned
        } else {
            a
        };
        let b = if self.transpose_b {
            Matrix::Columns(b)
        } else {
            Matrix::Rows(b)
        };
        product(m, k, n, a, &b, &mut data);
        if self.alpha != 1.0 {
            for x in &mut data {
                *x *= self.alpha;
            }
        }
        if let Some(c) = inputs.given(2) {
            let fits = layout::broadcast(c.shape(), &shape)? == shape;
            if !fits {
                return Err(OpError::shape(
                    "C must broadcast to A·B",
                    &[c.shape(), &shape],
                ));
            }
            let c = (c.shape(), inputs.f32(2)?);
            data = if self.beta == 1.0 {
                layout::zip(&shape, (&shape, &data), c, |x, c| x + c)
            } else {
                layout::zip(&shape, (&shape, &data), c, |x, c| x + self.beta * c)
            };
        }
        Ok(Tensor::F32 { shape, data })
    }
}

/// `MatMul` whose right-hand side is `DequantizeLinear` of constants.
///
/// The weights stay int8 in memory. The product expands each where it needs it, by the same
/// formula.
#[derive(Debug)]
pub(crate) struct QuantizedMatMul {
    /// Rows.
    pub(crate) k: usize,
    /// Columns.
    pub(crate) n: usize,
    /// [k, n] in two's complement.
    pub(crate) weights: Bytes,
    /// One a column.
    pub(crate) scale: Vec<f32>,
    /// One a column.
    pub(crate) zero: Vec<f32>,
}

impl Operator for QuantizedMatMul {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.f32(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let a_shape = inputs.shape(0)?;
        let [lead @ .., k] = a_shape else {
            return Err(OpError::shape(
                "a scalar has no product with a matrix",
                &[a_shape],
            ));
        };
        if *k != self.k {
            let weights = [self.k, self.n];
            return Err(OpError::shape(
                "columns of a must match rows of the weights",
                &[a_shape, &weights],
            ));
        }
        let mut shape = lead.to_vec();
        shape.push(self.n);
        let mut data = vec![0.0; inputs.size(&shape)?];
        let weights = Matrix::Quantized {
            weights: &self.weights,
            scale: &self.scale,
            zero: &self.zero,
        };
        let rows = data.len().checked_div(self.n).unwrap_or(0);
        product(rows, self.k, self.n, inputs.f32(0)?, &weights, &mut data);
        Ok(Tensor::F32 { shape, data })
    }
}
