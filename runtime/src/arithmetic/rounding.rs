//! Rounding a wide number.

/// `wide`·2^−shift, to the nearest.
#[inline(always)]
pub(super) const fn round(wide: i64, shift: i32) -> i64 {
    if shift > 0 {
        (wide + (1 << (shift - 1))) >> shift
    } else {
        wide << -shift
    }
}
