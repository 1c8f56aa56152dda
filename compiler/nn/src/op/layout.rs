//! Shapes: sizes, axes, strides, and numpy's broadcasting.

use crate::OpError;

/// Number of elements, unless it is over `limit`.
///
/// For the limit, axes of size 0 count as 1, so that the product of any subset of the axes is
/// within it too.
pub(crate) fn size(shape: &[usize], limit: usize) -> Result<usize, OpError> {
    let bound = shape
        .iter()
        .try_fold(1_usize, |product, &size| product.checked_mul(size.max(1)));
    if bound.is_none_or(|bound| bound > limit) {
        return Err(OpError::TooLarge {
            shape: shape.to_vec(),
            limit,
        });
    }
    Ok(shape.iter().product())
}

/// An axis that may count from the end.
pub(crate) fn axis(value: i64, rank: usize) -> Result<usize, OpError> {
    let rank = rank as i64;
    let axis = if value < 0 { value + rank } else { value };
    if (0..rank).contains(&axis) {
        return Ok(axis as usize);
    }
    Err(OpError::Range {
        what: "axis",
        value,
        low: -rank,
        high: rank - 1,
    })
}

/// Elements from one index to the next along each axis, row-major.
pub(crate) fn strides(shape: &[usize]) -> Vec<isize> {
    let mut strides = vec![0; shape.len()];
    let mut stride = 1_isize;
    for (slot, &size) in strides.iter_mut().zip(shape).rev() {
        *slot = stride;
        stride = stride.saturating_mul(size as isize);
    }
    strides
}

/// Product of the sizes before and after an axis.
pub(crate) fn around(shape: &[usize], axis: usize) -> (usize, usize) {
    (
        shape[..axis].iter().product(),
        shape[axis + 1..].iter().product(),
    )
}

/// The shape that two shapes broadcast to: they are aligned at the last axis, and a size of 1
/// repeats.
pub(crate) fn broadcast(a: &[usize], b: &[usize]) -> Result<Vec<usize>, OpError> {
    let rank = a.len().max(b.len());
    let at = |shape: &[usize], axis: usize| match (axis + shape.len()).checked_sub(rank) {
        Some(axis) => shape[axis],
        None => 1,
    };
    (0..rank)
        .map(|axis| match (at(a, axis), at(b, axis)) {
            (x, y) if x == y || y == 1 => Ok(x),
            (1, y) => Ok(y),
            _ => Err(OpError::shape("shapes do not broadcast", &[a, b])),
        })
        .collect()
}

/// Strides of a tensor seen under a shape that it broadcasts to: 0 where it repeats.
pub(crate) fn broadcast_strides(shape: &[usize], to: &[usize]) -> Vec<isize> {
    let mut result = vec![0; to.len()];
    let lead = to.len() - shape.len();
    for ((slot, &size), stride) in result[lead..].iter_mut().zip(shape).zip(strides(shape)) {
        *slot = if size == 1 { 0 } else { stride };
    }
    result
}

/// Visits a shape row by row, with the start of each row under each of the `N` stride lists.
///
/// Axes that are contiguous under all lists are merged, so rows are as long as possible.
pub(crate) struct Walk<const N: usize> {
    /// Elements of a row.
    pub(crate) row: usize,
    /// From one element of a row to the next, per list.
    pub(crate) step: [isize; N],
    outer: Vec<(usize, [isize; N])>,
}

impl<const N: usize> Walk<N> {
    pub(crate) fn new(shape: &[usize], strides: [&[isize]; N]) -> Self {
        let mut axes: Vec<(usize, [isize; N])> = Vec::with_capacity(shape.len());
        for (axis, &size) in shape.iter().enumerate() {
            if size == 1 {
                continue;
            }
            let inner = strides.map(|strides| strides[axis]);
            match axes.last_mut() {
                Some((outer_size, outer))
                    if (0..N).all(|list| outer[list] == inner[list] * size as isize) =>
                {
                    *outer_size *= size;
                    *outer = inner;
                }
                _ => axes.push((size, inner)),
            }
        }
        let (row, step) = axes.pop().unwrap_or((1, [0; N]));
        Self {
            row,
            step,
            outer: axes,
        }
    }

    pub(crate) fn rows(&self, row: &mut dyn FnMut([isize; N])) {
        if self.row == 0 || self.outer.iter().any(|&(size, _)| size == 0) {
            return;
        }
        let mut index = vec![0; self.outer.len()];
        let mut offsets = [0_isize; N];
        loop {
            row(offsets);
            let mut axis = self.outer.len();
            loop {
                if axis == 0 {
                    return;
                }
                axis -= 1;
                let (size, steps) = &self.outer[axis];
                index[axis] += 1;
                for (offset, step) in offsets.iter_mut().zip(steps) {
                    *offset += step;
                }
                if index[axis] < *size {
                    break;
                }
                for (offset, step) in offsets.iter_mut().zip(steps) {
                    *offset -= step * *size as isize;
                }
                index[axis] = 0;
            }
        }
    }
}

/// Copies a strided view in row-major order.
pub(crate) fn copy<T: Copy>(
    data: &[T],
    start: usize,
    shape: &[usize],
    strides: &[isize],
) -> Vec<T> {
    let walk = Walk::new(shape, [strides]);
    let mut result = Vec::with_capacity(shape.iter().product());
    walk.rows(&mut |[offset]| {
        let first = start.wrapping_add_signed(offset);
        match walk.step {
            [1] => result.extend_from_slice(&data[first..first + walk.row]),
            [step] => result
                .extend((0..walk.row).map(|i| data[first.wrapping_add_signed(i as isize * step)])),
        }
    });
    result
}

/// Applies `function` to two tensors element by element. `shape` is the shape that they broadcast
/// to.
pub(crate) fn zip<A: Copy, B: Copy, O>(
    shape: &[usize],
    (a_shape, a): (&[usize], &[A]),
    (b_shape, b): (&[usize], &[B]),
    function: impl Fn(A, B) -> O,
) -> Vec<O> {
    let strides = [
        broadcast_strides(a_shape, shape),
        broadcast_strides(b_shape, shape),
    ];
    let walk = Walk::new(shape, [&strides[0], &strides[1]]);
    let mut result = Vec::with_capacity(shape.iter().product());
    walk.rows(&mut |[a_start, b_start]| {
        let (a, b) = (&a[a_start as usize..], &b[b_start as usize..]);
        match walk.step {
            [1, 1] => result.extend(
                a[..walk.row]
                    .iter()
                    .zip(&b[..walk.row])
                    .map(|(&x, &y)| function(x, y)),
            ),
            [1, 0] => result.extend(a[..walk.row].iter().map(|&x| function(x, b[0]))),
            [0, 1] => result.extend(b[..walk.row].iter().map(|&y| function(a[0], y))),
            [a_step, b_step] => result.extend(
                (0..walk.row).map(|i| function(a[i * a_step as usize], b[i * b_step as usize])),
            ),
        }
    });
    result
}
