//! Four numbers side by side: the same operations in the same order on every processor.
//!
//! They are a register where the processor has such, and an array elsewhere. Every operation rounds
//! alike, and no two are fused.

use core::ops::{Add, Mul, Sub};
use wide::{CmpGt, CmpLe, f32x4, i32x4};

/// The smallest numbers in use are whole multiples of this, 2⁻⁶²: their squares and products are
/// normal floats. So no result depends on denormals, which a caller may have switched off.
pub(crate) const GRID: f32 = f32::from_bits((127 - 62) << 23);
/// Adding this multiple of a grid and taking it away again rounds to the grid.
const SETTLING: f32 = 1.5 * (1_u32 << 23) as f32;

/// `x` rounded to whole multiples of `grid`, if it is below 2²³ of them. Up to 2⁴⁸ of them its last
/// bit may change; a larger number stays as it is.
#[inline(always)]
pub(crate) fn settled(x: f32, grid: f32) -> f32 {
    let shift = grid * SETTLING;
    x + shift - shift
}

/// Four `f32`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct F4(f32x4);

/// Three components as a state keeps them; with a fourth number where memory is not scarce.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct F3(StoredLanes);

#[cfg(target_arch = "arm")]
type StoredLanes = [f32; 3];
#[cfg(not(target_arch = "arm"))]
type StoredLanes = F4;

#[cfg(target_arch = "arm")]
impl F3 {
    pub(crate) const ZERO: Self = Self([0.0; 3]);

    #[inline(always)]
    pub(crate) fn of(four: F4) -> Self {
        let [x, y, z, _] = four.to_array();
        Self([x, y, z])
    }

    #[inline(always)]
    pub(crate) fn four(self) -> F4 {
        let [x, y, z] = self.0;
        F4::load(&[x, y, z, 0.0])
    }
}

#[cfg(not(target_arch = "arm"))]
impl F3 {
    pub(crate) const ZERO: Self = Self(F4::ZERO);

    #[inline(always)]
    pub(crate) fn of(four: F4) -> Self {
        Self(four)
    }

    #[inline(always)]
    pub(crate) fn four(self) -> F4 {
        self.0
    }
}

impl F4 {
    /// True if four lanes fit a register; without one, long work is cheaper lane by lane.
    pub(crate) const IN_REGISTERS: bool = cfg!(any(
        target_feature = "sse2",
        target_feature = "simd128",
        all(target_feature = "neon", target_arch = "aarch64")
    ));
    pub(crate) const ZERO: Self = Self(f32x4::ZERO);
    pub(crate) const ONE: Self = Self(f32x4::ONE);
    pub(crate) const HALF: Self = Self(f32x4::HALF);

    #[inline(always)]
    pub(crate) const fn load(from: &[f32; 4]) -> Self {
        Self(f32x4::new(*from))
    }

    #[inline(always)]
    pub(crate) fn splat(x: f32) -> Self {
        Self(f32x4::splat(x))
    }

    #[inline(always)]
    pub(crate) fn to_array(self) -> [f32; 4] {
        self.0.to_array()
    }

    /// The smaller of each two; nothing is NaN.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0))
    }

    /// The larger of each two; nothing is NaN.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0))
    }

    /// The bits of each number, without those of `clear`, plus `set`.
    #[inline(always)]
    pub(crate) fn mark(self, clear: u32, set: u32) -> Self {
        let keep = i32x4::splat(!clear as i32);
        Self::of_bits((self.bits() & keep) + i32x4::splat(set as i32))
    }

    /// Each number as [`settled`] gives it.
    #[inline(always)]
    pub(crate) fn settled(self, grid: f32) -> Self {
        let shift = Self::splat(grid * SETTLING);
        self + shift - shift
    }

    #[inline(always)]
    fn bits(self) -> i32x4 {
        i32x4::new(self.to_array().map(|x| x.to_bits() as i32))
    }

    #[inline(always)]
    fn of_bits(bits: i32x4) -> Self {
        Self::load(&bits.to_array().map(|bits| f32::from_bits(bits as u32)))
    }

    /// All four: (1st + 2nd) + (3rd + 4th).
    #[inline(always)]
    pub(crate) fn sum(self) -> f32 {
        let [a, b, c, d] = self.to_array();
        let [ab, _, cd, _] = (self + Self::load(&[b, a, d, c])).to_array();
        ab + cd
    }

    /// Returns true if all four lanes are within ±`limit`; false for NaN.
    #[inline(always)]
    pub(crate) fn is_within(self, limit: f32) -> bool {
        // The bits of positive floats are in the order of the floats, and the bits of a NaN are
        // above. A comparison of floats would raise an exception for a NaN.
        if Self::IN_REGISTERS {
            let size = self.bits() & i32x4::splat(i32::MAX);
            return size.cmp_gt(i32x4::splat(limit.to_bits() as i32)).none();
        }
        let within = |x: f32| x.abs().to_bits() <= limit.to_bits();
        self.to_array().into_iter().all(within)
    }

    /// Returns true if any of the four lanes is `least` or more; none may be NaN.
    #[inline(always)]
    pub(crate) fn reaches(self, least: f32) -> bool {
        f32x4::splat(least).cmp_le(self.0).any()
    }

    /// The root of each, correctly rounded; ARM's FPUs have theirs in `asperity-vfp`.
    #[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    /// Inner product of the first three.
    #[inline(always)]
    pub(crate) fn dot3(self, other: Self) -> f32 {
        let [x, y, z, _] = (self * other).to_array();
        x + y + z
    }
}

impl Add for F4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for F4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for F4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_next_to_nothing_is_rounded_to_the_grid() {
        assert_eq!(GRID, 1.0 / (1_u64 << 62) as f32);
        for grid in [GRID, 1.0 / 1024.0] {
            for (x, wanted) in [
                (0.0, 0.0),
                (0.4, 0.0),
                (0.6, 1.0),
                (-0.6, -1.0),
                (3.4, 3.0),
                (-1000.7, -1001.0),
                (1e6 + 0.25, 1e6),
            ] {
                let (x, wanted) = (x * grid, wanted * grid);
                assert_eq!(settled(x, grid), wanted, "{x}");
                assert_eq!(F4::splat(x).settled(grid).to_array(), [wanted; 4], "{x}");
            }
            let large = grid * 1e15;
            assert_eq!(settled(large, grid), large);
        }
        for denormal in [f32::from_bits(1), 1e-40, -1e-30, 1e-19 / 2.0] {
            assert_eq!(settled(denormal, GRID), 0.0);
            assert_eq!(F4::splat(denormal).settled(GRID).to_array(), [0.0; 4]);
        }
    }

    #[test]
    fn lanes_are_marked_and_compared_one_by_one() {
        let four = F4::load(&[1.0, -2.0, 3.0, -4.0]);
        let bits = four.mark(0xff, 0x123).to_array().map(f32::to_bits);
        assert_eq!(
            bits,
            [1.0, -2.0, 3.0, -4.0].map(|x: f32| x.to_bits() + 0x123)
        );
        let odd = F4::splat(f32::from_bits(0x4000_00f7));
        assert_eq!(odd.mark(0xff, 1).to_array()[0].to_bits(), 0x4000_0001);
        for (least, reached) in [(2.9, true), (3.0, true), (3.1, false), (-9.0, true)] {
            assert_eq!(four.reaches(least), reached, "{least}");
        }
        assert_eq!(four.sum(), -2.0);
        assert_eq!(four.dot3(F4::splat(2.0)), 4.0);
        let other = F4::load(&[2.0, -3.0, 3.0, 0.0]);
        assert_eq!(four.min(other).to_array(), [1.0, -3.0, 3.0, -4.0]);
        assert_eq!(four.max(other).to_array(), [2.0, -2.0, 3.0, 0.0]);
        assert_eq!(F3::of(four).four().to_array()[..3], [1.0, -2.0, 3.0]);
    }
}
