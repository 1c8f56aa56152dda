//! Direct LSP synthesis: second-order sections 1 − 2x z⁻¹ + z⁻², x = cos ω, in series.
//!
//! Every section passes its input on unchanged and adds what it has stored. What is stored
//! can therefore be summed before the input is known: (P + Q)/2 = input + delayed.

use crate::convert::Row;
use crate::number::Number;
use asperity_formats::limits::MAX_ORDER;

/// The sections of the sum polynomial in series, and those of the difference polynomial.
#[derive(Debug, Clone)]
pub(crate) struct Chain<S> {
    /// Two past inputs of every section, sum and difference in turn.
    past: [[S; 2]; MAX_ORDER],
    /// Past inputs of the factors at 0 and π.
    ends: [[S; 2]; 2],
}

/// What the inputs of all sections are without the newest sample.
pub(crate) struct Known<S> {
    sections: Row<S>,
    ends: [S; 2],
}

impl<S: Number> Chain<S> {
    /// Sections that have stored nothing.
    pub(crate) fn silent() -> Self {
        Self {
            past: [[S::ZERO; 2]; MAX_ORDER],
            ends: [[S::ZERO; 2]; 2],
        }
    }

    /// What the stored samples add to A(z) at `order`, and the known part of every section's
    /// input.
    #[inline]
    pub(crate) fn delayed(&self, cosines: &Row<S>, order: usize) -> (Known<S>, S) {
        let minus_two = S::of(-2.0);
        let mut sections = [S::ZERO; MAX_ORDER];
        let mut side = [S::ZERO; 2];
        for i in 0..order {
            let sum = &mut side[i % 2];
            sections[i] = *sum;
            let m = minus_two.times(cosines[i]);
            *sum = sum.plus(m.times(self.past[i][0])).plus(self.past[i][1]);
        }
        let ends = side;
        let [q, p] = side;
        let (q, p) = if order.is_multiple_of(2) {
            (q.plus(self.ends[0][0]), p.minus(self.ends[1][0]))
        } else {
            (q, p.minus(self.ends[1][1]))
        };
        (Known { sections, ends }, S::of(0.5).times(q.plus(p)))
    }

    /// Stores the newest sample in every section.
    #[inline]
    pub(crate) fn push(&mut self, known: &Known<S>, order: usize, newest: S) {
        for (past, known) in self.past.iter_mut().zip(&known.sections).take(order) {
            *past = [newest.plus(*known), past[0]];
        }
        for (past, known) in self.ends.iter_mut().zip(&known.ends) {
            *past = [newest.plus(*known), past[0]];
        }
    }
}
