//! Twos of zero pairs multiplied into polynomials, four side by side or one by itself.

use crate::{
    arithmetic::{
        Arithmetic, Four, Number, Scalar as _,
        units::{Coefficient, Pair},
    },
    workspace::{LANES, ROWS, Workspace, bits, numbers},
};
use core::{
    marker::PhantomData,
    ops::{Add, Sub},
};

/// Partial products in a [`Workspace`], times ½: coefficients 1..=12 of each, the half that
/// symmetry leaves. The first coefficient is ½ itself.
pub(super) struct Products<'a, A>(&'a mut Workspace, PhantomData<A>);

/// One of them: every fourth number.
pub(super) struct Lane<'a, A>(&'a mut [u32; LANES * (ROWS - 1) + 1], PhantomData<A>);

impl<'a, A: Arithmetic> Products<'a, A> {
    #[inline(always)]
    pub(super) fn of(workspace: &'a mut Workspace) -> Self {
        Self(workspace, PhantomData)
    }
}

impl<'a, A: Arithmetic> Lane<'a, A> {
    /// One polynomial by itself.
    #[inline(always)]
    pub(super) fn of(workspace: &'a mut Workspace, polynomial: usize) -> Option<Self> {
        let from = workspace.0.as_flattened_mut().get_mut(polynomial..)?;
        from.first_chunk_mut().map(|lane| Self(lane, PhantomData))
    }
}

/// A two: 1 + s z⁻¹ + q z⁻² + os z⁻³ + o z⁻⁴. Without a high pair o is 0.
#[derive(Debug, Clone, Copy)]
pub struct Two<T> {
    pub(crate) s: T,
    pub(crate) q: T,
    pub(crate) o: T,
}

impl<T> Two<T> {
    /// Each factor made something else.
    #[inline(always)]
    fn map<U>(self, f: impl Fn(T) -> U) -> Two<U> {
        Two {
            s: f(self.s),
            q: f(self.q),
            o: f(self.o),
        }
    }
}

/// −2 cos ω of one pair of each polynomial.
pub trait Cosines: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// A whole number.
    fn whole(n: i32) -> Self;

    /// Product.
    fn times(self, other: Self) -> Self;
}

impl<A: Arithmetic> Cosines for Four<A, Pair> {
    #[inline(always)]
    fn whole(n: i32) -> Self {
        Self::splat(Number::whole(n))
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self.times::<Pair, Pair>(other)
    }
}

impl<A: Arithmetic> Cosines for Number<A, Pair> {
    #[inline(always)]
    fn whole(n: i32) -> Self {
        Self::whole(n)
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self.times::<Pair, Pair>(other)
    }
}

impl<T: Cosines> Two<T> {
    /// Of a low pair and a high one.
    #[inline(always)]
    fn of([low, high]: [T; 2]) -> Self {
        Self {
            s: low + high,
            q: T::whole(2) + low.times(high),
            o: T::whole(1),
        }
    }

    /// Where polynomials may lack the high pair, or both: those are 0, and so is `has`.
    #[inline(always)]
    fn of_some([low, high]: [T; 2], [has_low, has_high]: [T; 2]) -> Self {
        Self {
            s: low + high,
            q: has_low + has_high + low.times(high),
            o: has_high,
        }
    }
}

/// Polynomials side by side, or one by itself.
pub(super) trait Polynomial<A: Arithmetic> {
    type Cosines: Cosines;
    type Number: Copy;
    /// A number of pairs of each.
    type Count: Copy;

    fn get(&self, k: usize) -> Self::Number;

    fn set(&mut self, k: usize, x: Self::Number);

    /// 1 where a count is above a number, else 0.
    fn is_above(count: Self::Count, number: usize) -> Self::Cosines;

    /// See [`Arithmetic::extend`].
    fn extend<const FULL: bool>(
        by: &Two<Self::Cosines>,
        c: [Option<Self::Number>; 5],
    ) -> Self::Number;

    /// Multiplies in place, from degree 4·`two`, by a low pair and a high one. Of `pairs` pairs
    /// that a polynomial has, all of them `fewest` at least; what it gets beyond its own middle
    /// is not used.
    #[inline(always)]
    fn multiply(
        &mut self,
        two: usize,
        cosines: [Self::Cosines; 2],
        pairs: Self::Count,
        fewest: u8,
    ) {
        if two < usize::from(fewest / 2) {
            by_two::<A, Self, true>(self, two, &Two::of(cosines));
        } else {
            let has = [2 * two, 2 * two + 1].map(|slot| Self::is_above(pairs, slot));
            by_two::<A, Self, false>(self, two, &Two::of_some(cosines, has));
        }
    }
}

impl<A: Arithmetic> Polynomial<A> for Products<'_, A> {
    type Cosines = Four<A, Pair>;
    type Number = Four<A, Coefficient>;
    type Count = [u8; LANES];

    #[inline(always)]
    fn get(&self, k: usize) -> Self::Number {
        let row = k.checked_sub(1).map(|row| numbers(&self.0.0[row]));
        Four::load(&row.unwrap_or([A::ONE_HALF; LANES]))
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: Self::Number) {
        self.0.0[k - 1] = bits(x.to_array());
    }

    #[inline(always)]
    fn is_above(count: Self::Count, number: usize) -> Self::Cosines {
        let left = count.map(|count| {
            let left = Number::<A, Coefficient>::whole(i32::from(count) - number as i32);
            left.clamp_from_zero(Number::whole(1)).to::<Pair>().0
        });
        Four::load(&left)
    }

    #[inline(always)]
    fn extend<const FULL: bool>(
        by: &Two<Self::Cosines>,
        c: [Option<Self::Number>; 5],
    ) -> Self::Number {
        let by = by.map(|factor| factor.0);
        Four(A::extend_four::<FULL>(&by, c.map(|c| c.map(|c| c.0))))
    }
}

impl<A: Arithmetic> Polynomial<A> for Lane<'_, A> {
    type Cosines = Number<A, Pair>;
    type Number = Number<A, Coefficient>;
    type Count = u8;

    #[inline(always)]
    fn get(&self, k: usize) -> Self::Number {
        let number = k.checked_sub(1).map(|row| self.0[LANES * row]);
        Number(number.map_or(A::ONE_HALF, A::Scalar::from_bits))
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: Self::Number) {
        self.0[LANES * (k - 1)] = x.0.bits();
    }

    #[inline(always)]
    fn is_above(count: u8, number: usize) -> Self::Cosines {
        Number::whole(i32::from(usize::from(count) > number))
    }

    #[inline(always)]
    fn extend<const FULL: bool>(
        by: &Two<Self::Cosines>,
        c: [Option<Self::Number>; 5],
    ) -> Self::Number {
        let by = by.map(|factor| factor.0);
        Number(A::extend::<FULL>(&by, c.map(|c| c.map(|c| c.0))))
    }
}

/// Multiplies polynomials of degree 4·`two` in place; with `FULL`, o = 1.
#[inline(always)]
fn by_two<A: Arithmetic, C: Polynomial<A> + ?Sized, const FULL: bool>(
    c: &mut C,
    two: usize,
    by: &Two<C::Cosines>,
) {
    match two {
        0 => extend::<A, C, FULL, 0>(c, by),
        1 => extend::<A, C, FULL, 1>(c, by),
        2 => extend::<A, C, FULL, 2>(c, by),
        3 => extend::<A, C, FULL, 3>(c, by),
        4 => extend::<A, C, FULL, 4>(c, by),
        _ => extend::<A, C, FULL, 5>(c, by),
    }
}

/// From the highest coefficient down, so that nothing is overwritten before it is read.
#[inline(always)]
fn extend<A: Arithmetic, C: Polynomial<A> + ?Sized, const FULL: bool, const TWO: usize>(
    c: &mut C,
    by: &Two<C::Cosines>,
) {
    // Symmetry gives what lies beyond the middle.
    let old = |c: &C, k: usize| {
        let k = if k <= 2 * TWO {
            k
        } else {
            (4 * TWO).checked_sub(k)?
        };
        Some(c.get(k))
    };
    for k in (1..2 * TWO + 3).rev() {
        let back = |by: usize| k.checked_sub(by).and_then(|k| old(c, k));
        let x = C::extend::<FULL>(by, [old(c, k), back(1), back(2), back(3), back(4)]);
        c.set(k, x);
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
mod tests {
    use super::*;
    use crate::arithmetic::Float;

    /// Processors without registers of four numbers take the lanes one by one.
    #[test]
    fn one_polynomial_by_itself_gives_the_same_bits() {
        let number = |k: usize| [1, 2, 3, 4].map(|lane| ((7 * k + lane) as f32).sin());
        for pairs in [[12; 4], [12, 11, 10, 9], [8, 12, 0, 11]] {
            let (mut at_once, mut singly) = (Workspace::IDLE, Workspace::IDLE);
            for two in 0..ROWS / 2 {
                let cosines = [number(two), number(two + 10)];
                let fours = cosines.map(|four| Four::load(&four));
                let fewest = *pairs.iter().min().unwrap();
                Products::<Float>::of(&mut at_once).multiply(two, fours, pairs, fewest);
                for polynomial in 0..LANES {
                    let cosines = cosines.map(|four| Number(four[polynomial]));
                    let mut lane = Lane::<Float>::of(&mut singly, polynomial).unwrap();
                    let pairs = pairs[polynomial];
                    lane.multiply(two, cosines, pairs, pairs);
                }
                assert_eq!(at_once, singly, "two {two}");
            }
        }
    }
}
