//! Synthesis: from coefficients and an excitation to a sample, in four structures.
//!
//! All of them apply the numerator first, to the excitation, and then the poles.

use crate::{coefficients::Coefficients, convert::OrderArray, number::Number};
use asperity_formats::limits::MAX_ORDER;

/// The state of a filter.
#[derive(Debug, Clone)]
pub(crate) struct Synthesis<S> {
    /// Past excitations, the newest first.
    e: OrderArray<S>,
    /// Past outputs, the newest first, or what the stages of a lattice have stored.
    y: OrderArray<S>,
    ma_chain: Chain<S>,
    ar_chain: Chain<S>,
}

impl<S: Number> Synthesis<S> {
    /// A filter at rest.
    pub(crate) fn silent() -> Self {
        Self {
            e: [S::ZERO; MAX_ORDER],
            y: [S::ZERO; MAX_ORDER],
            ma_chain: Chain::silent(),
            ar_chain: Chain::silent(),
        }
    }

    /// The excitation through the numerator; `used` is a multiple of four.
    #[inline]
    fn numerator(&mut self, ma: &OrderArray<S>, used: usize, e: S) -> S {
        if used == 0 {
            return e;
        }
        let x = e.plus(S::dot(&ma[..used], &self.e[..used]));
        push(&mut self.e[..used], e);
        x
    }

    /// y = x − Σ a_k y[n−k].
    #[inline]
    pub(crate) fn direct(&mut self, c: &Coefficients<S>, used: (usize, usize), e: S) -> S {
        let x = self.numerator(&c.ma, used.1, e);
        let y = x.minus(S::dot(&c.ar[..used.0], &self.y[..used.0]));
        push(&mut self.y[..used.0], y);
        y
    }

    /// Numerator and poles as chains of sections in cos ω. `has_chain` is false where the
    /// numerator is 1 + z⁻¹ or 1.
    #[inline]
    pub(crate) fn lsp(
        &mut self,
        c: &Coefficients<S>,
        (order, ma_order): (usize, usize),
        (used, has_chain): (usize, bool),
        e: S,
    ) -> S {
        let x = if has_chain {
            let (known, delayed) = self.ma_chain.delayed(&c.ma, ma_order);
            self.ma_chain.push(&known, ma_order, e);
            e.plus(delayed)
        } else {
            self.numerator(&c.ma, used, e)
        };
        let (known, delayed) = self.ar_chain.delayed(&c.ar, order);
        let y = x.minus(delayed);
        self.ar_chain.push(&known, order, y);
        y
    }

    /// The lattice: `f_{i−1} = f_i − k_i g_{i−1}[n−1]`, `g_i = g_{i−1}[n−1] + k_i f_{i−1}`.
    #[inline]
    pub(crate) fn lattice(&mut self, c: &Coefficients<S>, order: usize, used_ma: usize, e: S) -> S {
        let mut f = self.numerator(&c.ma, used_ma, e);
        for i in (0..order).rev() {
            f = f.minus(c.ar[i].times(self.y[i]));
            let g = self.y[i].plus(c.ar[i].times(f));
            if i + 1 < order {
                self.y[i + 1] = g;
            }
        }
        self.y[0] = f;
        f
    }

    /// The normalised lattice: every stage rotates (f, g), so what is stored cannot grow when
    /// coefficients change.
    #[inline]
    pub(crate) fn normalised(
        &mut self,
        c: &Coefficients<S>,
        order: usize,
        used_ma: usize,
        e: S,
    ) -> S {
        let mut f = self.numerator(&c.ma, used_ma, e).times(c.gain);
        for i in (0..order).rev() {
            let (before, g) = (f, self.y[i]);
            f = c.complement[i].times(before).minus(c.ar[i].times(g));
            if i + 1 < order {
                self.y[i + 1] = c.ar[i].times(before).plus(c.complement[i].times(g));
            }
        }
        self.y[0] = f;
        f
    }
}

#[inline]
fn push<S: Copy>(past: &mut [S], newest: S) {
    let last = past.len() - 1;
    past.copy_within(..last, 1);
    past[0] = newest;
}

// Direct LSP synthesis: second-order sections 1 − 2x z⁻¹ + z⁻², x = cos ω, in series.
//
// Every section passes its input on unchanged and adds what it has stored. What is stored
// can therefore be summed before the input is known: (P + Q)/2 = input + delayed.

/// The sections of the sum polynomial in series, and those of the difference polynomial.
#[derive(Debug, Clone)]
struct Chain<S> {
    /// Two past inputs of every section, sum and difference in turn.
    past: [[S; 2]; MAX_ORDER],
    /// Past inputs of the factors at 0 and π.
    ends: [[S; 2]; 2],
}

/// Section inputs without the newest sample.
struct Known<S> {
    sections: OrderArray<S>,
    ends: [S; 2],
}

impl<S: Number> Chain<S> {
    /// Sections that have stored nothing.
    fn silent() -> Self {
        Self {
            past: [[S::ZERO; 2]; MAX_ORDER],
            ends: [[S::ZERO; 2]; 2],
        }
    }

    /// Returns the known part of every section's input, and the contribution of the stored samples to A(z) at `order`.
    #[inline]
    fn delayed(&self, cosines: &OrderArray<S>, order: usize) -> (Known<S>, S) {
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
    fn push(&mut self, known: &Known<S>, order: usize, newest: S) {
        for (past, known) in self.past.iter_mut().zip(&known.sections).take(order) {
            *past = [newest.plus(*known), past[0]];
        }
        for (past, known) in self.ends.iter_mut().zip(&known.ends) {
            *past = [newest.plus(*known), past[0]];
        }
    }
}
