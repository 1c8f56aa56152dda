//! Both sides of a product, ordered as its tiles read them.

use super::{Matrix, padded, tile_rows};

/// Columns of a panel.
pub(super) const COLUMNS: usize = 16;
/// Panels that are expanded together: a row of them is a cache line of int8 weights.
pub(super) const PANELS: usize = 4;
/// Rows of b in a panel: four panels of 96 × 16 f32 are 24 KiB, which the first-level cache holds.
pub(super) const DEPTH: usize = 96;

type Panel = [[f32; COLUMNS]; DEPTH];

/// A row of a group of panels of int8 weights.
type Line = [u8; PANELS * COLUMNS];

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

/// A slice of int8 weights, group by group: read row by row, as they lie in memory, which is
/// what processors fetch ahead.
pub(super) struct Staged {
    /// [`DEPTH`] lines a group.
    lines: Vec<Line>,
}

impl Staged {
    /// Room for a slice; none where `b` is not quantised.
    #[inline(always)]
    pub(super) fn new(n: usize, b: &Matrix<'_>) -> Self {
        let groups = match b {
            Matrix::Quantized { .. } => n.div_ceil(PANELS * COLUMNS),
            _ => 0,
        };
        Self {
            lines: vec![[0; PANELS * COLUMNS]; groups * DEPTH],
        }
    }

    /// Takes `depth` rows of `b` from row `start` on.
    #[inline(always)]
    pub(super) fn take(&mut self, n: usize, b: &Matrix<'_>, start: usize, depth: usize) {
        let Matrix::Quantized { weights, .. } = b else {
            return;
        };
        let rows = weights[start * n..][..depth * n].chunks_exact(n);
        for (inner, row) in rows.enumerate() {
            let (whole, rest) = row.as_chunks();
            let mut lines = self.lines[inner..].iter_mut().step_by(DEPTH);
            for (part, line) in whole.iter().zip(lines.by_ref()) {
                *line = *part;
            }
            if let Some(line) = lines.next() {
                line[..rest.len()].copy_from_slice(rest);
            }
        }
    }

    /// The rows of the group that begins at a column.
    #[inline(always)]
    fn group(&self, column: usize, depth: usize) -> &[Line] {
        &self.lines[column / (PANELS * COLUMNS) * DEPTH..][..depth]
    }
}

/// Copies or expands `depth` rows of up to four panels of b, from row `start` and column `group`
/// on; columns beyond the last stay what they were: never stored.
#[inline(always)]
#[allow(
    clippy::too_many_arguments,
    reason = "sizes, source and destination of a copy"
)]
pub(super) fn right(
    k: usize,
    n: usize,
    b: &Matrix<'_>,
    staged: &Staged,
    start: usize,
    group: usize,
    depth: usize,
    panels: &mut [Panel],
) {
    let end = n.min(group + PANELS * COLUMNS);
    match *b {
        Matrix::Rows(b) => {
            for inner in 0..depth {
                let row = &b[(start + inner) * n..][group..end];
                for (part, panel) in row.chunks(COLUMNS).zip(&mut *panels) {
                    transfer(part.len(), part, &mut panel[inner]);
                }
            }
        }
        Matrix::Columns(b) => {
            for column in group..end {
                let offset = column - group;
                let panel = &mut panels[offset / COLUMNS];
                let values = &b[column * k + start..][..depth];
                for (slots, value) in panel.iter_mut().zip(values) {
                    slots[offset % COLUMNS] = *value;
                }
            }
        }
        Matrix::Quantized { scale, zero, .. } => {
            let lines = staged.group(group, depth);
            let columns = (group..end).step_by(COLUMNS);
            for (index, (column, panel)) in columns.zip(panels).enumerate() {
                let part = column..end.min(column + COLUMNS);
                let rows = lines.iter().map(|line| &line.as_chunks().0[index]);
                expand(rows, &scale[part.clone()], &zero[part], panel);
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

/// Copies `width` elements; a full row in one move rather than by a call.
#[inline(always)]
pub(super) fn transfer(width: usize, from: &[f32], to: &mut [f32]) {
    match (
        from.first_chunk::<COLUMNS>(),
        to.first_chunk_mut::<COLUMNS>(),
    ) {
        (Some(from), Some(to)) if width == COLUMNS => *to = *from,
        _ => to[..width].copy_from_slice(&from[..width]),
    }
}
