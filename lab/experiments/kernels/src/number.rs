//! The numbers of a kernel: floating point, or fixed point of 32 and 16 bits.

use fixed::{FixedI16, FixedI32, types::extra};

/// 32 bits, 24 after the point: ±128 in steps of 6e-8.
pub type Fixed32 = FixedI32<extra::U24>;
/// 16 bits, 12 after the point: ±8 in steps of 2.4e-4.
pub type Fixed16 = FixedI16<extra::U12>;

/// A real number of some precision. Fixed point saturates.
pub trait Number: Copy + Send + Sync + 'static {
    /// Zero.
    const ZERO: Self;
    /// The nearest number.
    fn of(value: f64) -> Self;
    /// Its value.
    fn value(self) -> f64;
    /// Sum.
    fn plus(self, other: Self) -> Self;
    /// Difference.
    fn minus(self, other: Self) -> Self;
    /// Product.
    fn times(self, other: Self) -> Self;
    /// Quotient. In fixed point a division by zero gives the largest number.
    fn over(self, other: Self) -> Self;
    /// Square root of a number that is not negative.
    #[must_use]
    fn root(self) -> Self {
        Self::of(libm::sqrt(self.value()))
    }
    /// e to the power of it.
    #[must_use]
    fn exp(self) -> Self {
        Self::of(libm::exp(self.value()))
    }
    /// Σ c_k x_k; lengths are equal and multiples of four.
    fn dot(c: &[Self], x: &[Self]) -> Self;
}

/// Rounding from the numbers of parameters to those of signals.
pub trait Rounds<S> {
    /// The nearest signal.
    fn rounded(self) -> S;
}

macro_rules! float {
    ($($float:ty, $root:path, $exp:path;)*) => {$(
        impl Number for $float {
            const ZERO: Self = 0.0;
            #[inline]
            fn of(value: f64) -> Self { value as $float }
            #[inline]
            fn value(self) -> f64 { f64::from(self) }
            #[inline]
            fn plus(self, other: Self) -> Self { self + other }
            #[inline]
            fn minus(self, other: Self) -> Self { self - other }
            #[inline]
            fn times(self, other: Self) -> Self { self * other }
            #[inline]
            fn over(self, other: Self) -> Self { self / other }
            #[inline]
            fn root(self) -> Self { $root(self) }
            #[inline]
            fn exp(self) -> Self { $exp(self) }
            // Four partial sums fit into one vector register.
            #[inline]
            fn dot(c: &[Self], x: &[Self]) -> Self {
                let mut partial = [0.0; 4];
                for (c, x) in c.as_chunks::<4>().0.iter().zip(x.as_chunks::<4>().0) {
                    for lane in 0..4 {
                        partial[lane] += c[lane] * x[lane];
                    }
                }
                (partial[0] + partial[1]) + (partial[2] + partial[3])
            }
        }

        impl Rounds<$float> for $float {
            #[inline]
            fn rounded(self) -> $float { self }
        }
    )*};
}

float! {
    f32, libm::sqrtf, libm::expf;
    f64, libm::sqrt, libm::exp;
}

macro_rules! fixed {
    ($fixed:ty, $bits:ty, $wide:ty, $point:literal) => {
        impl Number for $fixed {
            const ZERO: Self = Self::ZERO;
            #[inline]
            fn of(value: f64) -> Self {
                Self::saturating_from_num(if value.is_nan() { 0.0 } else { value })
            }
            #[inline]
            fn value(self) -> f64 {
                self.to_num()
            }
            #[inline]
            fn plus(self, other: Self) -> Self {
                self.saturating_add(other)
            }
            #[inline]
            fn minus(self, other: Self) -> Self {
                self.saturating_sub(other)
            }
            #[inline]
            fn times(self, other: Self) -> Self {
                self.saturating_mul(other)
            }
            #[inline]
            fn over(self, other: Self) -> Self {
                if other == Self::ZERO {
                    Self::MAX
                } else {
                    self.saturating_div(other)
                }
            }
            // The products are exact in the wide sum, which is rounded once.
            #[inline]
            fn dot(c: &[Self], x: &[Self]) -> Self {
                let mut sum: $wide = 0;
                for (c, x) in c.iter().zip(x) {
                    sum = sum.wrapping_add(
                        <$wide>::from(c.to_bits()).wrapping_mul(<$wide>::from(x.to_bits())),
                    );
                }
                let rounded = (sum + (1 << ($point - 1))) >> $point;
                let (least, most) = (<$wide>::from(<$bits>::MIN), <$wide>::from(<$bits>::MAX));
                Self::from_bits(rounded.clamp(least, most) as $bits)
            }
        }
    };
}

fixed!(Fixed32, i32, i64, 24);
fixed!(Fixed16, i16, i32, 12);

impl Rounds<Fixed32> for Fixed32 {
    #[inline]
    fn rounded(self) -> Fixed32 {
        self
    }
}

impl Rounds<Fixed16> for Fixed32 {
    #[inline]
    fn rounded(self) -> Fixed16 {
        let half = Self::from_bits(1 << 11);
        Fixed16::saturating_from_num(self.saturating_add(half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn dot_agrees<N: Number>(tolerance: f64) {
        let c: Vec<f64> = (0..8).map(|n| (f64::from(n) * 1.7).sin()).collect();
        let x: Vec<f64> = (0..8).map(|n| (f64::from(n) * 0.9).cos()).collect();
        let exact: f64 = c.iter().zip(&x).map(|(c, x)| c * x).sum();
        let of = |v: &[f64]| v.iter().map(|&v| N::of(v)).collect::<Vec<_>>();
        let found = N::dot(&of(&c), &of(&x)).value();
        assert!((found - exact).abs() < tolerance, "{found} for {exact}");
    }

    #[test]
    fn an_inner_product_is_as_exact_as_its_numbers() {
        dot_agrees::<f64>(1e-14);
        dot_agrees::<f32>(1e-6);
        dot_agrees::<Fixed32>(1e-6);
        dot_agrees::<Fixed16>(2e-3);
    }

    #[test]
    fn fixed_point_saturates() {
        assert_eq!(Fixed16::of(100.0), Fixed16::MAX);
        assert_eq!(Fixed32::of(-100.0).times(Fixed32::of(100.0)), Fixed32::MIN);
        let rounded: Fixed16 = Fixed32::of(-300.0).rounded();
        assert_eq!(rounded, Fixed16::MIN);
    }
}
