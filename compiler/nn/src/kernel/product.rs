//! The matrix product.
//!
//! out[i][j] = ((0 + a[i][0]·b[0][j]) + a[i][1]·b[1][j]) + …: every element is summed in
//! ascending k, and each product is rounded before it is added. Tiles, panels and lanes divide
//! rows and columns only. Where a sum over k is interrupted, its value is stored and loaded again,
//! which does not change it.

mod number;
mod pack;
mod row;

use multiversion::multiversion;
use pack::{COLUMNS, DEPTH, PANELS, Right};

/// The right-hand side, k × n.
pub(crate) enum Matrix<'a> {
    /// Row-major.
    Rows(&'a [f32]),
    /// Row-major, little-endian, as a file has it.
    Stored(&'a [[u8; 4]]),
    /// Column-major; the transpose is row-major.
    Columns(&'a [f32]),
    /// Row-major int8 in two's complement; an element is (q − zero[j]) · scale[j].
    Quantized {
        weights: &'a [u8],
        scale: &'a [f32],
        zero: &'a [f32],
    },
}

/// `out` (m × n, all zero before) becomes `a` (m × k) · `b` (k × n), all row-major.
///
/// # Panics
/// If a slice is shorter than its sizes say. Callers have checked the shapes.
pub(crate) fn product(m: usize, k: usize, n: usize, a: &[f32], b: &Matrix<'_>, out: &mut [f32]) {
    if m == 0 || n == 0 || k == 0 {
        return;
    }
    match b {
        Matrix::Rows(b) if m == 1 => row::product(n, &a[..k], &b[..k * n], &mut out[..n]),
        Matrix::Stored(b) if m == 1 => row::stored(n, &a[..k], &b[..k * n], &mut out[..n]),
        Matrix::Quantized {
            weights,
            scale,
            zero,
        } if m == 1 => {
            let (scale, zero) = (&scale[..n], &zero[..n]);
            row::quantized(n, &a[..k], &weights[..k * n], scale, zero, &mut out[..n]);
        }
        _ => dispatched(m, k, n, a, b, out),
    }
}

// `multiversion` leaves out processors whose clock AVX-512 slows down.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
fn dispatched(m: usize, k: usize, n: usize, a: &[f32], b: &Matrix<'_>, out: &mut [f32]) {
    tiled(m, k, n, a, b, out);
}

#[inline(always)]
fn tiled(m: usize, k: usize, n: usize, a: &[f32], b: &Matrix<'_>, out: &mut [f32]) {
    let mut left = vec![0.0; padded(m) * k];
    pack::left(m, k, a, &mut left);
    let mut panels = vec![[0.0; COLUMNS]; PANELS.min(n.div_ceil(COLUMNS)) * DEPTH];
    let (panels, _) = panels.as_chunks_mut();
    let mut right = Right::new(k, n, b);
    // Slices of k are the outer loop: the rows of b that a slice needs lie together in memory.
    for start in (0..k).step_by(DEPTH) {
        let depth = DEPTH.min(k - start);
        right.stage(start, depth);
        for group in (0..n).step_by(PANELS * COLUMNS) {
            let columns = (group..n).step_by(COLUMNS).take(PANELS);
            right.panels(start, group, depth, panels);
            for (column, panel) in columns.zip(&*panels) {
                let mut left = &left[start * padded(m)..][..depth * padded(m)];
                let width = COLUMNS.min(n - column);
                let mut row = 0;
                while row < m {
                    let rows = tile_rows(m - row);
                    let (block, rest) = left.split_at(rows * depth);
                    left = rest;
                    let out = &mut out[row * n + column..];
                    let here = rows.min(m - row);
                    match rows {
                        4 => tile::<4>(block, &panel[..depth], out, n, here, width),
                        3 => tile::<3>(block, &panel[..depth], out, n, here, width),
                        _ => tile::<1>(block, &panel[..depth], out, n, here, width),
                    }
                    row += rows;
                }
            }
        }
    }
}

/// Rows of the next tile when `left` rows remain. 4 × 16 sums fill half of 16 registers of 8 lanes.
///
/// Two rows make a tile of three, padded with zeros: the compiler does not vectorise a tile of two.
#[inline(always)]
fn tile_rows(left: usize) -> usize {
    match left {
        1 => 1,
        2 | 3 => 3,
        _ => 4,
    }
}

/// Rows of all tiles of m rows, padding included.
#[inline(always)]
fn padded(m: usize) -> usize {
    if m % 4 == 2 { m + 1 } else { m }
}

/// Adds the product of an R × depth tile and a depth × 16 panel to `out`: to the first `rows` of
/// R rows, which lie `n` apart, and to `width` columns of them.
#[inline(always)]
fn tile<const R: usize>(
    block: &[f32],
    panel: &[[f32; COLUMNS]],
    out: &mut [f32],
    n: usize,
    rows: usize,
    width: usize,
) {
    let mut sums = [[0.0_f32; COLUMNS]; R];
    for (i, sums) in sums.iter_mut().enumerate().take(rows) {
        pack::transfer(width, &out[i * n..], sums);
    }
    let sums = accumulate(sums, block.as_chunks().0, panel);
    for (i, sums) in sums.iter().enumerate().take(rows) {
        pack::transfer(width, sums, &mut out[i * n..]);
    }
}

/// Takes the sums by value, so that the compiler keeps them in registers.
#[inline(always)]
fn accumulate<const R: usize>(
    mut sums: [[f32; COLUMNS]; R],
    block: &[[f32; R]],
    panel: &[[f32; COLUMNS]],
) -> [[f32; COLUMNS]; R] {
    for (left, right) in block.iter().zip(panel) {
        for i in 0..R {
            for j in 0..COLUMNS {
                sums[i][j] += left[i] * right[j];
            }
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(seed: u32, count: usize) -> Vec<f32> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 23) as f32 - 1.0
        };
        (0..count).map(|_| next()).collect()
    }

    /// The definition, element by element.
    fn plain(m: usize, k: usize, n: usize, a: &[f32], b: impl Fn(usize, usize) -> f32) -> Vec<f32> {
        let mut out = Vec::with_capacity(m * n);
        for i in 0..m {
            for j in 0..n {
                let mut sum = 0.0;
                for inner in 0..k {
                    sum += a[i * k + inner] * b(inner, j);
                }
                out.push(sum);
            }
        }
        out
    }

    fn bits(values: &[f32]) -> Vec<u32> {
        values.iter().map(|x| x.to_bits()).collect()
    }

    /// Sizes at, below and above those of tiles, panels and slices.
    const SIZES: [(usize, usize, usize); 9] = [
        (1, 1, 1),
        (1, 300, 33),
        (2, 97, 16),
        (3, 96, 64),
        (4, 192, 65),
        (5, 7, 100),
        (6, 200, 15),
        (13, 95, 130),
        (17, 400, 48),
    ];

    #[test]
    fn tiles_panels_and_lanes_do_not_change_a_bit() {
        for (m, k, n) in SIZES {
            let (a, b) = (numbers(1, m * k), numbers(2, k * n));
            let expected = bits(&plain(m, k, n, &a, |inner, j| b[inner * n + j]));
            let turned: Vec<f32> = (0..n * k).map(|i| b[i % k * n + i / k]).collect();
            let stored: Vec<[u8; 4]> = b.iter().map(|x| x.to_le_bytes()).collect();
            for matrix in [
                Matrix::Rows(&b),
                Matrix::Columns(&turned),
                Matrix::Stored(&stored),
            ] {
                let mut scalar = vec![0.0; m * n];
                tiled(m, k, n, &a, &matrix, &mut scalar);
                assert_eq!(
                    bits(&scalar),
                    expected,
                    "as compiled for any processor, {m}×{k}×{n}"
                );
                let mut dispatched = vec![0.0; m * n];
                product(m, k, n, &a, &matrix, &mut dispatched);
                assert_eq!(
                    bits(&dispatched),
                    expected,
                    "as compiled for this one, {m}×{k}×{n}"
                );
            }
        }
    }

    #[test]
    fn quantized_weights_expand_by_their_formula() {
        for (m, k, n) in SIZES {
            let a = numbers(3, m * k);
            let weights: Vec<u8> = numbers(4, k * n)
                .into_iter()
                .map(|x| (x * 128.0) as i8 as u8)
                .collect();
            let scale = numbers(5, n);
            let zero: Vec<f32> = numbers(6, n)
                .into_iter()
                .map(|x| (x * 100.0) as i8 as f32)
                .collect();
            let at = |inner: usize, j: usize| {
                (f32::from(weights[inner * n + j] as i8) - zero[j]) * scale[j]
            };
            let expected = bits(&plain(m, k, n, &a, at));
            let matrix = Matrix::Quantized {
                weights: &weights,
                scale: &scale,
                zero: &zero,
            };
            let (mut scalar, mut dispatched) = (vec![0.0; m * n], vec![0.0; m * n]);
            tiled(m, k, n, &a, &matrix, &mut scalar);
            product(m, k, n, &a, &matrix, &mut dispatched);
            assert_eq!(bits(&scalar), expected, "{m}×{k}×{n}");
            assert_eq!(bits(&dispatched), expected, "{m}×{k}×{n}");
        }
    }

    #[test]
    fn an_empty_product_is_zero() {
        let mut out = vec![0.0; 6];
        product(2, 0, 3, &[], &Matrix::Rows(&[]), &mut out);
        assert_eq!(out, [0.0; 6]);
        product(0, 4, 3, &[], &Matrix::Rows(&[0.0; 12]), &mut []);
    }
}
