//! The steps of a participant: a function of the study and of the participant's number.

use super::{
    design::{After, Design, Order, Prompts, Ratings},
    forms::Form,
};
use rand_xoshiro::{
    Xoshiro256PlusPlus,
    rand_core::{Rng, SeedableRng},
};

/// Time that a slider takes, a form's item, a prompt, and reading what one agrees to, s. Assumed, not measured.
const SLIDER_S: f64 = 4.0;
const ITEM_S: f64 = 6.0;
const PROMPT_S: f64 = 60.0;
const CONSENT_S: f64 = 60.0;

/// Why a texture is rated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Phase {
    Practice,
    Main,
    /// A rating of the same block once more.
    Catch,
}

impl Phase {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Practice => "practice",
            Self::Main => "main",
            Self::Catch => "catch",
        }
    }
}

/// A step; textures and forms by their places.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step {
    Consent,
    Rating {
        texture: usize,
        phase: Phase,
        /// The block, from 1; of practice, the rating.
        repeat: usize,
    },
    Break {
        /// Ratings before it.
        done: usize,
    },
    Form(usize),
    Prompt,
}

impl Step {
    /// Its name in the dataset.
    pub(crate) const fn trial_type(self) -> &'static str {
        match self {
            Self::Consent => "consent",
            Self::Rating { .. } => "texture-rating",
            Self::Break { .. } => "break",
            Self::Form(_) => "form",
            Self::Prompt => "prompt",
        }
    }

    /// True if a texture is felt in it.
    pub(crate) const fn is_felt(self) -> bool {
        matches!(self, Self::Rating { .. } | Self::Prompt)
    }
}

/// The steps of the participant of this number, from 0.
pub(crate) fn steps(
    design: &Design,
    textures: usize,
    forms: &[Form],
    participant: usize,
) -> Vec<Step> {
    let Ratings {
        repeats,
        practice,
        catch_trials,
        break_every,
        order,
        ..
    } = design.ratings;
    let mut random = Shuffle::new(design.seed, participant as u64);
    let mut steps = vec![Step::Consent];
    let mut ratings = Vec::new();
    if textures > 0 {
        for repeat in 1..=practice {
            let texture = random.below(textures);
            ratings.push(Step::Rating {
                texture,
                phase: Phase::Practice,
                repeat,
            });
        }
        for repeat in 1..=repeats {
            let block = match order {
                Order::Latin => latin_row(textures, participant * repeats + repeat - 1),
                Order::Seeded => random.order(textures),
            };
            let rating = |texture| Step::Rating {
                texture,
                phase: Phase::Main,
                repeat,
            };
            ratings.extend(block.into_iter().map(rating));
        }
        repeat_some(&mut ratings, catch_trials, textures, repeats, &mut random);
    }
    for (done, rating) in ratings.iter().enumerate() {
        if break_every > 0 && done > practice && (done - practice).is_multiple_of(break_every) {
            steps.push(Step::Break { done });
        }
        steps.push(*rating);
    }
    let after = |when: After| {
        (0..forms.len())
            .filter(move |at| forms[*at].after == when)
            .map(Step::Form)
    };
    steps.extend(after(After::Ratings));
    let count = design
        .prompts
        .as_ref()
        .map_or(0, |prompts: &Prompts| prompts.count);
    steps.extend((0..count).map(|_| Step::Prompt));
    steps.extend(after(After::Prompts));
    steps
}

/// Puts ratings of the last block once more, in random places after half of it.
fn repeat_some(
    ratings: &mut Vec<Step>,
    count: usize,
    textures: usize,
    repeats: usize,
    random: &mut Shuffle,
) {
    let last = ratings.len() - textures;
    for texture in random.order(textures).into_iter().take(count) {
        let again = Step::Rating {
            texture,
            phase: Phase::Catch,
            repeat: repeats,
        };
        let first = ratings.iter().rposition(|step| matches!(step, Step::Rating { texture: at, phase: Phase::Main, .. } if *at == texture));
        // Never right after the first time.
        let from = first
            .map_or(last, |first| first + 2)
            .max(last + textures / 2)
            .min(ratings.len());
        let place = from + random.below(ratings.len() - from + 1);
        ratings.insert(place, again);
    }
}

/// A row of a balanced Latin square of `n` (Williams 1949): over `n` rows, or 2n where n is odd, each one stands at each
/// place and follows each other one equally often.
fn latin_row(n: usize, row: usize) -> Vec<usize> {
    let zigzag = |at: usize| {
        if at.is_multiple_of(2) {
            n - at / 2
        } else {
            at.div_ceil(2)
        }
    };
    let mut order: Vec<usize> = (0..n).map(|at| (zigzag(at) + row) % n).collect();
    if !n.is_multiple_of(2) && (row / n) % 2 == 1 {
        order.reverse();
    }
    order
}

/// About how long a participant takes, s: least times of exploring and breaks, and what is assumed of everything else.
pub(crate) fn seconds(design: &Design, steps: &[Step], forms: &[Form]) -> f64 {
    let of = |step: &Step| match *step {
        Step::Consent => CONSENT_S,
        Step::Rating { .. } => design.explore.seconds + SLIDER_S * design.attributes.len() as f64,
        Step::Break { .. } => design.ratings.break_s,
        Step::Form(at) => ITEM_S * forms[at].items.len() as f64,
        Step::Prompt => {
            let refinements = design
                .prompts
                .as_ref()
                .map_or(0, |prompts| prompts.refinements);
            PROMPT_S * (1 + refinements) as f64
        }
    };
    steps.iter().map(of).sum()
}

/// Random numbers of a study: the same for the same seed on every machine.
pub(crate) struct Shuffle(Xoshiro256PlusPlus);

impl Shuffle {
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        let mixed = seed ^ stream.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        Self(Xoshiro256PlusPlus::seed_from_u64(mixed))
    }

    /// A whole number below `n`, which is small: the bias of the remainder is 2⁻⁵⁰ at most.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.0.next_u64() % n as u64) as usize
    }

    /// A normal number (Box & Muller 1958).
    pub(crate) fn normal(&mut self) -> f64 {
        let mut unit = || (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let (u, v) = (1.0 - unit(), unit());
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    }

    /// 0 to n − 1 in random order (Fisher & Yates).
    fn order(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for last in (1..n).rev() {
            order.swap(last, self.below(last + 1));
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn in_a_latin_square_each_stands_at_each_place_and_follows_each_other_equally_often() {
        for n in [1, 2, 3, 4, 5, 8, 15] {
            let rows = if n % 2 == 0 { n } else { 2 * n };
            let (mut places, mut pairs) = (HashMap::new(), HashMap::new());
            for row in 0..rows {
                let order = latin_row(n, row);
                for (at, one) in order.iter().enumerate() {
                    *places.entry((at, *one)).or_insert(0) += 1;
                }
                for pair in order.windows(2) {
                    *pairs.entry((pair[0], pair[1])).or_insert(0) += 1;
                }
            }
            assert_eq!(places.len(), n * n);
            assert!(places.values().all(|count| *count == rows / n), "{n}");
            assert_eq!(pairs.len(), n * (n - 1));
            assert!(pairs.values().all(|count| *count == rows / n), "{n}");
        }
    }
}
