//! Both factors of a product, packed in the order in which its tiles read them.

use std::ops::Range;

use super::{Matrix, number::Number, tile_rows};

/// Columns of a panel.
pub(super) const COLUMNS: usize = 16;
/// Panels that are expanded together. One row of them is a cache line of int8 weights.
pub(super) const PANELS: usize = 4;
/// Rows of b in a panel. Four panels of 96 × 16 f32 take 24 KiB, which the first-level cache holds.
pub(super) const DEPTH: usize = 96;

type Panel = [[f32; COLUMNS]; DEPTH];

/// Orders `a` as tiles read it: by slice of k, then block of rows, then k, then row.
#[inline(always)]
pub(super) fn left(m: usize, k: usize, a: &[f32], left: &mut [f32]) {
    let mut rest = left;
    for start in (0..k).step_by(DEPTH) {
        let end = k.min(start + DEPTH);
        let mut row = 0;
        while row < m {
            let rows = tile_rows(m - row);
            let (block, after) = rest.split_at_mut(rows * (end - start));
            rest = after;
            for i in 0..rows.min(m - row) {
                let values = &a[(row + i) * k..][start..end];
                for (slot, value) in block[i..].iter_mut().step_by(rows).zip(values) {
                    *slot = *value;
                }
            }
            row += rows;
        }
    }
}

/// The right-hand side, provided panel by panel.
pub(super) struct Right<'a> {
    k: usize,
    n: usize,
    b: &'a Matrix<'a>,
    /// A slice of int8 weights, group by group: [`DEPTH`] lines of [`PANELS`] parts each.
    staged: Vec<[u8; COLUMNS]>,
}

impl<'a> Right<'a> {
    #[inline(always)]
    pub(super) fn new(k: usize, n: usize, b: &'a Matrix<'a>) -> Self {
        let groups = match b {
            Matrix::Quantized { .. } => n.div_ceil(PANELS * COLUMNS),
            _ => 0,
        };
        let staged = vec![[0; COLUMNS]; groups * DEPTH * PANELS];
        Self { k, n, b, staged }
    }

    /// Stages `depth` rows of int8 weights from row `start` on. It reads them in the order in which
    /// they lie in memory, so that the processor prefetches them.
    #[inline(always)]
    pub(super) fn stage(&mut self, start: usize, depth: usize) {
        let Matrix::Quantized { weights, .. } = self.b else {
            return;
        };
        let (lines, _) = self.staged.as_chunks_mut::<PANELS>();
        let rows = weights[start * self.n..][..depth * self.n].chunks_exact(self.n);
        for (inner, row) in rows.enumerate() {
            let (parts, rest) = row.as_chunks();
            let (whole, parts) = parts.as_chunks::<PANELS>();
            let mut lines = lines[inner..].iter_mut().step_by(DEPTH);
            for (whole, line) in whole.iter().zip(lines.by_ref()) {
                *line = *whole;
            }
            if let Some(line) = lines.next() {
                line[..parts.len()].copy_from_slice(parts);
                if !rest.is_empty() {
                    line[parts.len()][..rest.len()].copy_from_slice(rest);
                }
            }
        }
    }

    /// Copies or expands `depth` rows of up to four panels, from row `start` and column `group` on.
    ///
    /// Columns beyond the last keep old values, which are never stored to the result. Rows of int8
    /// weights must have been staged.
    #[inline(always)]
    pub(super) fn panels(&self, start: usize, group: usize, depth: usize, panels: &mut [Panel]) {
        let end = self.n.min(group + PANELS * COLUMNS);
        match *self.b {
            Matrix::Rows(b) => rows(&b[start * self.n..], self.n, group..end, depth, panels),
            Matrix::Stored(b) => rows(&b[start * self.n..], self.n, group..end, depth, panels),
            Matrix::Columns(b) => {
                for column in group..end {
                    let offset = column - group;
                    let panel = &mut panels[offset / COLUMNS];
                    let values = &b[column * self.k + start..][..depth];
                    for (slots, value) in panel.iter_mut().zip(values) {
                        slots[offset % COLUMNS] = *value;
                    }
                }
            }
            Matrix::Quantized { scale, zero, .. } => {
                let (lines, _) = self.staged.as_chunks::<PANELS>();
                let lines = &lines[group / (PANELS * COLUMNS) * DEPTH..][..depth];
                let columns = (group..end).step_by(COLUMNS);
                for (index, (column, panel)) in columns.zip(panels).enumerate() {
                    let part = column..end.min(column + COLUMNS);
                    let rows = lines.iter().map(|line| &line[index]);
                    expand(rows, &scale[part.clone()], &zero[part], panel);
                }
            }
        }
    }
}

/// Copies the same columns of `depth` rows of n elements into panels.
#[inline(always)]
fn rows<T: Number>(b: &[T], n: usize, columns: Range<usize>, depth: usize, panels: &mut [Panel]) {
    for inner in 0..depth {
        let row = &b[inner * n..][columns.clone()];
        for (part, panel) in row.chunks(COLUMNS).zip(&mut *panels) {
            let slots = &mut panel[inner];
            match part.first_chunk::<COLUMNS>() {
                Some(whole) => *slots = whole.map(Number::f32),
                None => {
                    for (slot, x) in slots.iter_mut().zip(part) {
                        *slot = x.f32();
                    }
                }
            }
        }
    }
}

/// (q − zero) · scale for the rows of a panel, whose scales stay in registers.
#[inline(always)]
fn expand<'a>(
    rows: impl Iterator<Item = &'a [u8; COLUMNS]>,
    scale: &[f32],
    zero: &[f32],
    panel: &mut Panel,
) {
    let (mut scales, mut zeros) = ([0.0; COLUMNS], [0.0; COLUMNS]);
    transfer(scale.len(), scale, &mut scales);
    transfer(zero.len(), zero, &mut zeros);
    for (row, slots) in rows.zip(panel) {
        // In steps of whole rows, so that the compiler makes lanes of each.
        let mut values = row.map(|q| f32::from(q as i8));
        for (x, zero) in values.iter_mut().zip(zeros) {
            *x -= zero;
        }
        for (x, scale) in values.iter_mut().zip(scales) {
            *x *= scale;
        }
        *slots = values;
    }
}

/// Copies `width` elements, a full row at once.
#[inline(always)]
#[allow(
    clippy::manual_memcpy,
    reason = "of a copy of slices and the move the compiler makes one call"
)]
pub(super) fn transfer(width: usize, from: &[f32], to: &mut [f32]) {
    if width == COLUMNS
        && let (Some(from), Some(to)) = (from.first_chunk(), to.first_chunk_mut::<COLUMNS>())
    {
        *to = *from;
        return;
    }
    for column in 0..width {
        to[column] = from[column];
    }
}
