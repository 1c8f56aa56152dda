//! The roots of the sum and the difference polynomial on the unit circle.
//!
//! In `x = cos(ω/2)` both obey three-term recurrences with positive coefficients (Delsarte and
//! Genin, "The split Levinson algorithm", 1986), hence are Sturm sequences: bisection on the
//! count of sign changes finds every root, however close it lies to the next.

use multiversion::multiversion;

/// Number of roots that are sought side by side, as many as fit the registers of a processor.
pub(super) const LANES: usize = 8;
/// Halvings of [0, 1], which reach the last bit of a number near 1.
const HALVINGS: usize = 54;
/// A Newton step as small as this is rounding.
const PRECISION: f64 = f64::EPSILON;

/// Which of the two polynomials.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    /// The sum polynomial Q.
    Sum,
    /// The difference polynomial P.
    Difference,
}

/// `s_{k+1}(x) = 2x·s_k(x) − α_k·s_{k−1}(x)` from `s₀ = 1`, all α positive.
pub(super) struct Sturm {
    alpha: Vec<f64>,
}

impl Sturm {
    /// The sequence of a filter with these reflection coefficients.
    pub(super) fn new(reflection: &[f64], side: Side) -> Self {
        let sign = if side == Side::Sum { 1.0 } else { -1.0 };
        let r = |k: usize| {
            if k == 0 {
                0.0
            } else {
                sign * reflection[k - 1]
            }
        };
        // S₀ = 2, S₁ = 1 + z⁻¹; the difference side, freed of its factor 1 − z⁻¹,
        // starts one order later.
        let first = if side == Side::Sum { 1 } else { 2 };
        let mut alpha: Vec<f64> = (first..=reflection.len())
            .map(|k| (1.0 - r(k)) * (1.0 + r(k - 1)))
            .collect();
        if side == Side::Sum
            && let Some(first) = alpha.first_mut()
        {
            *first *= 2.0;
        }
        Self { alpha }
    }

    /// The angles of roots, numbered from the smallest angle.
    ///
    /// Halvings until every root is alone in its bracket, then Newton's method inside it.
    pub(super) fn roots(&self, indices: &[usize]) -> impl Iterator<Item = f64> {
        let mut brackets = Brackets::around(indices);
        for _ in 0..HALVINGS {
            let middle = brackets.middle();
            brackets.keep(&middle, &roots_beyond(&self.alpha, &middle));
            if brackets.are_isolating() {
                break;
            }
        }
        let mut x = brackets.middle();
        for _ in 0..HALVINGS {
            let (value, slope) = value_and_slope(&self.alpha, &x);
            let before = x;
            x = brackets.newton(&x, &value, &slope);
            if (0..LANES).all(|lane| (x[lane] - before[lane]).abs() <= PRECISION) {
                break;
            }
        }
        (0..indices.len()).map(move |lane| 2.0 * libm::acos(x[lane]))
    }
}

/// Where the roots of [`LANES`] indices lie.
struct Brackets {
    index: [f64; LANES],
    low: [f64; LANES],
    high: [f64; LANES],
    /// Roots beyond either end.
    beyond_low: [f64; LANES],
    beyond_high: [f64; LANES],
}

impl Brackets {
    /// [0, 1] for every index; lanes without one repeat the first.
    fn around(indices: &[usize]) -> Self {
        let index = std::array::from_fn(|lane| indices.get(lane).map_or(indices[0], |i| *i) as f64);
        Self {
            index,
            low: [0.0; LANES],
            high: [1.0; LANES],
            beyond_low: [f64::INFINITY; LANES],
            beyond_high: [0.0; LANES],
        }
    }

    fn middle(&self) -> [f64; LANES] {
        std::array::from_fn(|lane| 0.5 * (self.low[lane] + self.high[lane]))
    }

    /// Returns true if every bracket holds a single root.
    fn are_isolating(&self) -> bool {
        (0..LANES).all(|lane| self.beyond_low[lane] - self.beyond_high[lane] == 1.0)
    }

    /// Keeps the side of x where the root is, given how many roots lie beyond x.
    fn keep(&mut self, x: &[f64; LANES], beyond: &[f64; LANES]) {
        for lane in 0..LANES {
            if beyond[lane] > self.index[lane] {
                (self.low[lane], self.beyond_low[lane]) = (x[lane], beyond[lane]);
            } else {
                (self.high[lane], self.beyond_high[lane]) = (x[lane], beyond[lane]);
            }
        }
    }

    /// A step of Newton's method from x; where it would leave the bracket, a halving.
    fn newton(
        &mut self,
        x: &[f64; LANES],
        value: &[f64; LANES],
        slope: &[f64; LANES],
    ) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            // Positive beyond the first root, negative beyond the second, and so on.
            let is_even = self.index[lane] % 2.0 == 0.0;
            if (value[lane] < 0.0) == is_even {
                self.low[lane] = x[lane];
            } else {
                self.high[lane] = x[lane];
            }
            let (low, high) = (self.low[lane], self.high[lane]);
            let next = x[lane] - value[lane] / slope[lane];
            if low <= next && next <= high {
                next
            } else {
                0.5 * (low + high)
            }
        })
    }
}

/// For every x in [0, 1] the number of roots beyond it, which are those with a smaller angle.
///
/// Lanes never mix, so wider registers give the same bits.
#[multiversion(targets("x86_64+avx2"))]
fn roots_beyond(alpha: &[f64], x: &[f64; LANES]) -> [f64; LANES] {
    let mut before = [1.0; LANES];
    let mut here = x.map(|x| 2.0 * x);
    let mut was_negative = [0.0; LANES];
    let mut count = [0.0; LANES];
    for alpha in alpha {
        for lane in 0..LANES {
            let next = 2.0 * x[lane] * here[lane] - alpha * before[lane];
            // A zero counts as positive: the next one has the sign opposite to the last.
            // Counted in f64, for which there are lanes everywhere.
            let negative = if next < 0.0 { 1.0 } else { 0.0_f64 };
            count[lane] += (negative - was_negative[lane]).abs();
            was_negative[lane] = negative;
            before[lane] = here[lane];
            here[lane] = next;
        }
    }
    count
}

/// The last of the sequence and its derivative at every x.
#[multiversion(targets("x86_64+avx2"))]
fn value_and_slope(alpha: &[f64], x: &[f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
    let (mut before, mut here) = ([1.0; LANES], [0.0; LANES]);
    let (mut slope_before, mut slope) = ([0.0; LANES], [2.0; LANES]);
    for lane in 0..LANES {
        here[lane] = 2.0 * x[lane];
    }
    for alpha in alpha {
        for lane in 0..LANES {
            let twice = 2.0 * x[lane];
            let next = twice * here[lane] - alpha * before[lane];
            let next_slope = twice * slope[lane] + 2.0 * here[lane] - alpha * slope_before[lane];
            (before[lane], here[lane]) = (here[lane], next);
            (slope_before[lane], slope[lane]) = (slope[lane], next_slope);
        }
    }
    (here, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::lsf::from_reflection;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_frequency_is_where_the_count_of_roots_changes(
            r in prop::collection::vec(-0.99_f64..0.99, 1..=24),
        ) {
            let lsf = from_reflection(&r);
            for (n, omega) in lsf.iter().enumerate() {
                let side = if n % 2 == 0 { Side::Sum } else { Side::Difference };
                let alpha = Sturm::new(&r, side).alpha;
                let x = libm::cos(0.5 * omega);
                let beyond = |x: f64| roots_beyond(&alpha, &[x; LANES])[0];
                prop_assert!(beyond(x + 1e-13) <= (n / 2) as f64, "{:?}", r);
                prop_assert!(beyond(x - 1e-13) > (n / 2) as f64, "{:?}", r);
            }
        }
    }
}
