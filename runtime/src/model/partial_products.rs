//! Section pairs multiplied into partial products, four polynomials side by side or one by itself.

use super::{
    row::LANES,
    scratch::{ROWS, Scratch, bits, numbers},
    section_pair::{SectionPair, SectionProduct},
};
use crate::{
    arithmetic::Scalar as _,
    quantity::{
        Four, Quantity,
        unit::{Coefficient, LineCosine},
    },
};
use core::{
    marker::PhantomData,
    ops::{Add, Sub},
};

/// Partial products in a [`Scratch`], times ½: coefficients 1..=12 of each, the half that
/// symmetry leaves. The first coefficient is ½ itself.
pub(super) struct Products<'a, A>(&'a mut Scratch, PhantomData<A>);

/// A single lane of the products, at a stride of four.
pub(super) struct Lane<'a, A>(&'a mut [u32; LANES * (ROWS - 1) + 1], PhantomData<A>);

impl<'a, A: SectionProduct> Products<'a, A> {
    #[inline(always)]
    pub(super) fn of(scratch: &'a mut Scratch) -> Self {
        Self(scratch, PhantomData)
    }
}

impl<'a, A: SectionProduct> Lane<'a, A> {
    /// Returns the lane of a single polynomial.
    #[inline(always)]
    pub(super) fn of(scratch: &'a mut Scratch, polynomial: usize) -> Option<Self> {
        let from = scratch.0.as_flattened_mut().get_mut(polynomial..)?;
        from.first_chunk_mut().map(|lane| Self(lane, PhantomData))
    }
}

/// −2 cos ω of one section of each polynomial.
pub(super) trait Cosines: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// A whole number.
    fn whole(n: i32) -> Self;

    /// Product.
    fn times(self, other: Self) -> Self;
}

impl<A: SectionProduct> Cosines for Four<A, LineCosine> {
    #[inline(always)]
    fn whole(n: i32) -> Self {
        Self::splat(Quantity::whole(n))
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }
}

impl<A: SectionProduct> Cosines for Quantity<A, LineCosine> {
    #[inline(always)]
    fn whole(n: i32) -> Self {
        Self::whole(n)
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }
}

/// The pair of a low section and a high one.
#[inline(always)]
fn pair_of<T: Cosines>([low, high]: [T; 2]) -> SectionPair<T> {
    SectionPair {
        s: low + high,
        q: T::whole(2) + low.times(high),
        o: T::whole(1),
    }
}

/// The pair where polynomials may lack the high section, or both. What a polynomial lacks is 0, and
/// so is its `has`.
#[inline(always)]
fn pair_of_some<T: Cosines>([low, high]: [T; 2], [has_low, has_high]: [T; 2]) -> SectionPair<T> {
    SectionPair {
        s: low + high,
        q: has_low + has_high + low.times(high),
        o: has_high,
    }
}

/// Polynomials side by side, or one by itself.
pub(super) trait Polynomial<A: SectionProduct> {
    type Cosines: Cosines;
    type Number: Copy;
    /// The number of sections of each.
    type Count: Copy;

    fn get(&self, k: usize) -> Self::Number;

    fn set(&mut self, k: usize, x: Self::Number);

    /// 1 where a count is above a number, else 0.
    fn is_above(count: Self::Count, number: usize) -> Self::Cosines;

    /// See [`SectionProduct::extend`].
    fn extend<const FULL: bool>(
        by: &SectionPair<Self::Cosines>,
        c: [Option<Self::Number>; 5],
    ) -> Self::Number;

    /// Multiplies in place, from degree 4·`pair`, by a low section and a high one. A polynomial has
    /// `sections` sections, and each has at least `fewest`. Coefficients beyond its own middle are
    /// not used.
    #[inline(always)]
    fn multiply(
        &mut self,
        pair: usize,
        cosines: [Self::Cosines; 2],
        sections: Self::Count,
        fewest: u8,
    ) {
        if pair < usize::from(fewest / 2) {
            by_pair::<A, Self, true>(self, pair, &pair_of(cosines));
        } else {
            let has = [2 * pair, 2 * pair + 1].map(|slot| Self::is_above(sections, slot));
            by_pair::<A, Self, false>(self, pair, &pair_of_some(cosines, has));
        }
    }
}

impl<A: SectionProduct> Polynomial<A> for Products<'_, A> {
    type Cosines = Four<A, LineCosine>;
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
            let left = Quantity::<A, Coefficient>::whole(i32::from(count) - number as i32);
            left.clamp_from_zero(Quantity::whole(1))
                .to::<LineCosine>()
                .0
        });
        Four::load(&left)
    }

    #[inline(always)]
    fn extend<const FULL: bool>(
        by: &SectionPair<Self::Cosines>,
        c: [Option<Self::Number>; 5],
    ) -> Self::Number {
        let by = by.map(|factor| factor.0);
        Four(A::extend_four::<FULL>(&by, c.map(|c| c.map(|c| c.0))))
    }
}

impl<A: SectionProduct> Polynomial<A> for Lane<'_, A> {
    type Cosines = Quantity<A, LineCosine>;
    type Number = Quantity<A, Coefficient>;
    type Count = u8;

    #[inline(always)]
    fn get(&self, k: usize) -> Self::Number {
        let number = k.checked_sub(1).map(|row| self.0[LANES * row]);
        Quantity(number.map_or(A::ONE_HALF, A::Scalar::from_bits))
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: Self::Number) {
        self.0[LANES * (k - 1)] = x.0.bits();
    }

    #[inline(always)]
    fn is_above(count: u8, number: usize) -> Self::Cosines {
        Quantity::whole(i32::from(usize::from(count) > number))
    }

    #[inline(always)]
    fn extend<const FULL: bool>(
        by: &SectionPair<Self::Cosines>,
        c: [Option<Self::Number>; 5],
    ) -> Self::Number {
        let by = by.map(|factor| factor.0);
        Quantity(A::extend::<FULL>(&by, c.map(|c| c.map(|c| c.0))))
    }
}

/// Multiplies polynomials of degree 4·`pair` in place; with `FULL`, o = 1.
#[inline(always)]
fn by_pair<A: SectionProduct, C: Polynomial<A> + ?Sized, const FULL: bool>(
    c: &mut C,
    pair: usize,
    by: &SectionPair<C::Cosines>,
) {
    match pair {
        0 => extend::<A, C, FULL, 0>(c, by),
        1 => extend::<A, C, FULL, 1>(c, by),
        2 => extend::<A, C, FULL, 2>(c, by),
        3 => extend::<A, C, FULL, 3>(c, by),
        4 => extend::<A, C, FULL, 4>(c, by),
        _ => extend::<A, C, FULL, 5>(c, by),
    }
}

/// Multiplies from the highest coefficient down, so that nothing is overwritten before it is read.
#[inline(always)]
fn extend<A: SectionProduct, C: Polynomial<A> + ?Sized, const FULL: bool, const PAIR: usize>(
    c: &mut C,
    by: &SectionPair<C::Cosines>,
) {
    // Symmetry gives what lies beyond the middle.
    let old = |c: &C, k: usize| {
        let k = if k <= 2 * PAIR {
            k
        } else {
            (4 * PAIR).checked_sub(k)?
        };
        Some(c.get(k))
    };
    for k in (1..2 * PAIR + 3).rev() {
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
        for sections in [[12; 4], [12, 11, 10, 9], [8, 12, 0, 11]] {
            let (mut at_once, mut singly) = (Scratch::IDLE, Scratch::IDLE);
            for pair in 0..ROWS / 2 {
                let cosines = [number(pair), number(pair + 10)];
                let fours = cosines.map(|four| Four::load(&four));
                let fewest = *sections.iter().min().unwrap();
                Products::<Float>::of(&mut at_once).multiply(pair, fours, sections, fewest);
                for polynomial in 0..LANES {
                    let cosines = cosines.map(|four| Quantity(four[polynomial]));
                    let mut lane = Lane::<Float>::of(&mut singly, polynomial).unwrap();
                    let sections = sections[polynomial];
                    lane.multiply(pair, cosines, sections, sections);
                }
                assert_eq!(at_once, singly, "pair {pair}");
            }
        }
    }
}
