//! The product of one row, whose time is that of reading the matrix.

use multiversion::multiversion;

use super::number::Number;

/// Rows of b that are added before a sum is stored.
const TOGETHER: usize = 4;

/// `out` (n, all zero before) becomes `a` (k) · `b` (k × n, row-major).
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn product(n: usize, a: &[f32], b: &[f32], out: &mut [f32]) {
    add(n, a, b, out);
}

/// [`product`] with the bytes of a file.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn stored(n: usize, a: &[f32], b: &[[u8; 4]], out: &mut [f32]) {
    add(n, a, b, out);
}

/// [`product`] with int8 weights in two's complement, each (q − zero) · scale of its column.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn quantized(
    n: usize,
    a: &[f32],
    weights: &[u8],
    scale: &[f32],
    zero: &[f32],
    out: &mut [f32],
) {
    for (factor, row) in a.iter().zip(weights.chunks_exact(n)) {
        let columns = out.iter_mut().zip(row).zip(scale).zip(zero);
        for (((sum, q), scale), zero) in columns {
            *sum += factor * ((f32::from(*q as i8) - zero) * scale);
        }
    }
}

/// b is read once from front to back, so that the processor prefetches it. The sums stay in the
/// first-level cache.
#[inline(always)]
fn add<T: Number>(n: usize, a: &[f32], b: &[T], out: &mut [f32]) {
    let (fours, rest) = a.as_chunks::<TOGETHER>();
    let mut rows = b.chunks_exact(n);
    for factors in fours {
        let mut next = || rows.next().unwrap_or_default();
        let [b0, b1, b2, b3]: [&[T]; TOGETHER] = [next(), next(), next(), next()];
        let columns = out.iter_mut().zip(b0).zip(b1).zip(b2).zip(b3);
        for ((((sum, b0), b1), b2), b3) in columns {
            let begun = *sum + factors[0] * b0.f32() + factors[1] * b1.f32();
            *sum = begun + factors[2] * b2.f32() + factors[3] * b3.f32();
        }
    }
    for (factor, row) in rest.iter().zip(rows) {
        for (sum, b) in out.iter_mut().zip(row) {
            *sum += factor * b.f32();
        }
    }
}
