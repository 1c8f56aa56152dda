//! MatMul and Gemm.

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

    fn as_product(&self) -> Option<Product> {
        Some(Product::MatMul)
    }
}

/// A product a·b, each factor as it lies in memory. Load fuses it with a constant b.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Product {
    /// As [`MatMul`].
    MatMul,
    /// As [`Gemm`].
    Gemm(Gemm),
}

/// α·op(A)·op(B) + β·C on matrices, where op transposes if the attributes say so.
#[derive(Debug, Clone, Copy)]
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
        let data = self.finish(inputs, 2, &shape, data)?;
        Ok(Tensor::F32 { shape, data })
    }

    fn as_product(&self) -> Option<Product> {
        let turned = self.transpose_a || self.transpose_b;
        (!turned).then_some(Product::Gemm(*self))
    }
}

impl Gemm {
    /// α·data + β·C, where C is input `index`.
    pub(crate) fn finish(
        &self,
        inputs: &Inputs<'_>,
        index: usize,
        shape: &[usize],
        mut data: Vec<f32>,
    ) -> Result<Vec<f32>, OpError> {
        if self.alpha != 1.0 {
            for x in &mut data {
                *x *= self.alpha;
            }
        }
        if let Some(c) = inputs.given(index) {
            let fits = layout::broadcast(c.shape(), shape)? == shape;
            if !fits {
                return Err(OpError::shape(
                    "C must broadcast to A·B",
                    &[c.shape(), shape],
                ));
            }
            let c = (c.shape(), inputs.f32(index)?);
            data = if self.beta == 1.0 {
                layout::zip(shape, (shape, &data), c, |x, c| x + c)
            } else {
                layout::zip(shape, (shape, &data), c, |x, c| x + self.beta * c)
            };
        }
        Ok(data)
    }
}
