//! Gather and GatherND: elements selected by index. Negative indices count from the end.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{
        Inputs, Operator, Types,
        attributes::{Attributes, refusal},
        layout,
    },
    tensor::same_type,
};

fn position(value: i64, size: usize) -> Result<usize, OpError> {
    let size = size as i64;
    let position = if value < 0 {
        value.wrapping_add(size)
    } else {
        value
    };
    if (0..size).contains(&position) {
        return Ok(position as usize);
    }
    Err(OpError::Range {
        what: "index",
        value,
        low: -size,
        high: size - 1,
    })
}

/// Runs of `length` elements from `starts`, one after the other.
fn collect<T: Copy>(data: &[T], starts: &[usize], length: usize) -> Vec<T> {
    let mut result = Vec::with_capacity(starts.len() * length);
    for &start in starts {
        result.extend_from_slice(&data[start..start + length]);
    }
    result
}

/// Slices along one axis, by a tensor of indices.
#[derive(Debug)]
pub(crate) struct Gather {
    axis: i64,
}

impl Gather {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        Ok(Self {
            axis: attributes.int("axis")?.unwrap_or(0),
        })
    }
}

impl Operator for Gather {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let (table, indices) = (inputs.tensor(0)?, inputs.integers(1)?);
        let table_shape = table.shape();
        let axis = layout::axis(self.axis, table_shape.len())?;
        let count = table_shape[axis];
        let (outer, inner) = layout::around(table_shape, axis);
        let mut shape = table_shape[..axis].to_vec();
        shape.extend_from_slice(inputs.shape(1)?);
        shape.extend_from_slice(&table_shape[axis + 1..]);
        inputs.size(&shape)?;
        let rows = indices
            .iter()
            .map(|&value| position(value, count))
            .collect::<Result<Vec<_>, _>>()?;
        let starts: Vec<usize> = (0..outer)
            .flat_map(|block| rows.iter().map(move |row| (block * count + row) * inner))
            .collect();
        Ok(same_type!(table, data => (shape, collect(data, &starts, inner))))
    }
}

/// Slices by index vectors: the last axis of the indices.
#[derive(Debug)]
pub(crate) struct GatherNd;

impl GatherNd {
    pub(crate) fn parse(attributes: &mut Attributes<'_>) -> Result<Self, NodeRefusal> {
        match attributes.int("batch_dims")?.unwrap_or(0) {
            0 => Ok(Self),
            other => Err(refusal(
                "batch_dims",
                format!("{other}, only 0 is supported"),
            )),
        }
    }
}

impl Operator for GatherNd {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.index(1)?;
        inputs.any(0)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let (table, indices) = (inputs.tensor(0)?, inputs.integers(1)?);
        let (table_shape, indices_shape) = (table.shape(), inputs.shape(1)?);
        let rule = "the last axis of the indices must have 1 to rank-of-data entries";
        let refusal = || OpError::shape(rule, &[table_shape, indices_shape]);
        let [lead @ .., depth] = indices_shape else {
            return Err(refusal());
        };
        if *depth == 0 || *depth > table_shape.len() {
            return Err(refusal());
        }
        let mut shape = lead.to_vec();
        shape.extend_from_slice(&table_shape[*depth..]);
        inputs.size(&shape)?;
        let length: usize = table_shape[*depth..].iter().product();
        let mut starts = Vec::with_capacity(indices.len() / depth);
        for vector in indices.chunks_exact(*depth) {
            let mut start = 0;
            for (&value, &size) in vector.iter().zip(table_shape) {
                start = start * size + position(value, size)?;
            }
            starts.push(start * length);
        }
        Ok(same_type!(table, data => (shape, collect(data, &starts, length))))
    }
}
