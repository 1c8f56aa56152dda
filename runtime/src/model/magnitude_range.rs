//! The range of |A(e^jω)|, which tells how much rounding A(z) bears.
//!
//! Coefficients that are off by δ_k are those of a stable filter as long as Σ|δ_k| < min |A(e^jω)|: A(z) keeps its
//! zeros inside the unit circle (Rouché's theorem). δ_k grows with the partial products of the conversion, hence with
//! max |A(e^jω)|. The range, maximum over minimum, therefore tells how exact an arithmetic has to be. In a mixture the minimum is no smaller than the smallest of its corners, and the maximum at most half more than
//! the largest of theirs (measured, `tests/laws_lsf.rs`; not proven). So a look at the models of a texture covers every
//! query.

use super::row::LANES;
use crate::math;
use asperity_formats::limits::MAX_ORDER;

/// Zeros of Q or P at most, those at z = ±1 included.
const POINTS: usize = MAX_ORDER / 2 + LANES;

/// −2 cos ω at ω = π/32, 3π/32 … 31π/32.
const EVEN: [f32; POINTS] = [
    -1.990_369_4,
    -1.913_880_6,
    -1.763_842_5,
    -1.546_020_9,
    -1.268_786_5,
    -0.942_793_5,
    -0.580_569_4,
    -0.196_034_3,
    0.196_034_3,
    0.580_569_4,
    0.942_793_5,
    1.268_786_5,
    1.546_020_9,
    1.763_842_5,
    1.913_880_6,
    1.990_369_4,
];

/// The range of |A(e^jω)|².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MagnitudeRange {
    /// The least at the line spectral frequencies, 0 and π; 0 where it is too small for f32.
    least_squared: f32,
    /// The largest there and at 16 frequencies in between.
    most_squared: f32,
}

impl MagnitudeRange {
    /// Computes the range of A(z) from its line spectral frequencies, given as −2 cos ω in the
    /// order of [`place`](super::lsf_to_ar::place).
    pub(crate) fn of(lines: &[f32]) -> Self {
        // A simple zero at z = 1 has −2 cos ω = −2, one at z = −1 has 2.
        let (of_sum, of_difference): (&[f32], &[f32]) = if lines.len().is_multiple_of(2) {
            (&[2.0], &[-2.0])
        } else {
            (&[], &[-2.0, 2.0])
        };
        let sum = Zeros::new(lines, of_sum);
        let difference = Zeros::new(lines.get(1..).unwrap_or_default(), of_difference);
        let (mut least, mut most) = (f32::INFINITY, 0.0);
        // Where one polynomial is 0, |A| is half of the other.
        for (polynomial, other) in [(&sum, &difference), (&difference, &sum)] {
            for squared in polynomial.squares(&other.all) {
                least = math::min(least, squared);
                most = math::max(most, squared);
            }
        }
        for (q, p) in sum
            .squares(&EVEN)
            .into_iter()
            .zip(difference.squares(&EVEN))
        {
            most = math::max(most, q + p);
        }
        Self {
            least_squared: least,
            most_squared: most,
        }
    }

    /// max |A(e^jω)|.
    pub(crate) fn most(self) -> f32 {
        math::sqrt(self.most_squared)
    }

    /// max |A(e^jω)| / min |A(e^jω)|.
    pub(crate) fn ratio(self) -> f32 {
        math::sqrt(self.most_squared / self.least_squared)
    }
}

/// The zeros of Q or P on the unit circle as −2 cos ω.
struct Zeros<'a> {
    /// Those of its sections, then the simple ones; the rest repeats one of them.
    all: [f32; POINTS],
    sections: usize,
    simple: &'a [f32],
}

impl<'a> Zeros<'a> {
    /// The first of every two lines, and simple zeros.
    fn new(lines: &[f32], simple: &'a [f32]) -> Self {
        let (pairs, last) = lines.as_chunks::<2>();
        let any = simple.first().or(lines.first());
        let mut all = [any.copied().unwrap_or_default(); POINTS];
        for (zero, pair) in all.iter_mut().zip(pairs) {
            *zero = pair[0];
        }
        let sections = pairs.len() + last.len();
        let rest = all.iter_mut().skip(pairs.len());
        for (zero, &other) in rest.zip(last.iter().chain(simple)) {
            *zero = other;
        }
        Self {
            all,
            sections,
            simple,
        }
    }

    /// A quarter of the squared magnitude of the polynomial.
    fn squares(&self, points: &[f32; POINTS]) -> [f32; POINTS] {
        let mut halves = [0.5_f32; POINTS];
        // Zero by zero, all points side by side.
        for &zero in self.all.iter().take(self.sections) {
            for (half, point) in halves.iter_mut().zip(points) {
                *half *= point - zero;
            }
        }
        let mut squares = halves.map(|half| half * half);
        for &zero in self.simple {
            for (square, point) in squares.iter_mut().zip(points) {
                *square *= (point - zero).abs();
            }
        }
        squares
    }
}
