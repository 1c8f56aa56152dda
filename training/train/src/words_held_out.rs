//! Accuracy of the regression on held-out phrases.
//!
//! Groups of near phrases are held out together, a fifth of them; the ratings of the rest, and of the materials'
//! captions, predict theirs.

use crate::{
    captions::{Captions, dot},
    certainty::calibration_error,
    config::Memory,
    kernel_ridge::{KernelRidge, regress},
    rng::{Purpose, Stream},
    statistics::mean,
};
use asperity::signal::quantile::rank_correlation;
use asperity_corpus::{Corpus, Rating};
use rayon::prelude::*;
use serde::Serialize;

/// Phrases of a larger cosine are of one group.
const NEAR: f32 = 0.8;
/// Number of folds: every fifth group is held out.
const FOLDS: usize = 5;
/// A prediction is right within so many points of each rating.
const TOLERANCE: f64 = 15.0;
/// Quantile of the familiarity of phrases, each left out, below which a text is unfamiliar.
const UNFAMILIAR: f64 = 0.05;

/// Predictions of held-out phrases against their ratings.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct WordsHeldOut {
    /// Phrases held out.
    pub phrases: usize,
    /// Groups that the whole lexicon falls into.
    pub groups: usize,
    /// Phrases of the largest group.
    pub largest_group: usize,
    /// R² of rough, slippery and hard.
    pub r_squared: [f64; 3],
    /// Spearman's ρ of the same.
    pub spearman: [f64; 3],
    /// Familiarity of each, and 1 if all three ratings are within [`TOLERANCE`], else 0.
    #[serde(skip)]
    pub trials: Vec<(f64, f64)>,
    /// Expected calibration error of the certainty that these trials give, see
    /// [`calibration_error`].
    pub calibration_error: f64,
    /// Familiarity below which a text is unfamiliar: 95 % of the phrases, each left out, are more
    /// familiar.
    pub unfamiliar: f64,
}

/// Predicts the ratings of held-out phrases.
pub(crate) fn measure(
    memory: &KernelRidge,
    corpus: &Corpus,
    materials: &[usize],
    captions: &Captions,
    how: &Memory,
    seed: u64,
) -> WordsHeldOut {
    let phrases: Vec<&[f32]> = captions
        .lexicon
        .iter()
        .map(|p| p.vector.as_slice())
        .collect();
    if phrases.len() < 2 * FOLDS {
        return WordsHeldOut::default();
    }
    let group = groups(&phrases);
    let held_out = chosen(&group, seed);
    let mut known: (Vec<&[f32]>, Vec<[f32; 3]>, Vec<f32>) = Default::default();
    let mut asked: (Vec<&[f32]>, Vec<[f32; 3]>) = Default::default();
    for (phrase, held_out) in captions.lexicon.iter().zip(&held_out) {
        if *held_out {
            asked.0.push(&phrase.vector);
            asked.1.push(numbers(&phrase.rating));
        } else {
            known.0.push(&phrase.vector);
            known.1.push(numbers(&phrase.rating));
            known.2.push(phrase.weight);
        }
    }
    for &material in materials {
        if let Some(rating) = &corpus.materials[material].rating {
            for vector in &captions.training[material] {
                // A caption near a held-out phrase would tell its rating.
                if asked.0.iter().all(|phrase| dot(phrase, vector) <= NEAR) {
                    known.0.push(vector);
                    known.1.push(numbers(rating));
                    known.2.push(how.caption_weight as f32);
                }
            }
        }
    }
    let said = regress(&known.0, &known.1, &known.2, &asked.0, how);
    let familiarity = familiarity(&known.0[..], &asked.0);
    let right = |said: &[f32; 3], truth: &[f32; 3]| {
        let apart = said
            .iter()
            .zip(truth)
            .map(|(x, y)| f64::from((x - y).abs()));
        f64::from(u8::from(apart.fold(0.0, f64::max) <= TOLERANCE))
    };
    let trials = said
        .iter()
        .zip(&asked.1)
        .map(|(said, truth)| right(said, truth));
    let trials: Vec<(f64, f64)> = familiarity.into_iter().zip(trials).collect();
    let column = |rows: &[[f32; 3]], k: usize| -> Vec<f64> {
        rows.iter().map(|row| f64::from(row[k])).collect()
    };
    let all: Vec<usize> = (captions_before(captions, materials)..)
        .take(phrases.len())
        .collect();
    let mut left_out = memory.familiarity(&phrases, &all);
    left_out.sort_by(f64::total_cmp);
    WordsHeldOut {
        phrases: asked.0.len(),
        groups: group.iter().copied().max().map_or(0, |last| last + 1),
        largest_group: largest(&group),
        r_squared: std::array::from_fn(|k| explained(&column(&said, k), &column(&asked.1, k))),
        spearman: std::array::from_fn(|k| {
            rank_correlation(&column(&said, k), &column(&asked.1, k)).unwrap_or_default()
        }),
        calibration_error: calibration_error(&trials),
        trials,
        unfamiliar: left_out[(UNFAMILIAR * left_out.len() as f64) as usize],
    }
}

/// Captions come before the phrases among a memory's examples.
fn captions_before(captions: &Captions, materials: &[usize]) -> usize {
    materials.iter().map(|&m| captions.training[m].len()).sum()
}

fn numbers(rating: &Rating) -> [f32; 3] {
    [
        rating.rough as f32,
        rating.slippery as f32,
        rating.hard as f32,
    ]
}

/// The soft maximum of [`KernelRidge::familiarity`] over these vectors themselves.
fn familiarity(known: &[&[f32]], asked: &[&[f32]]) -> Vec<f64> {
    let sharpness = f64::from(crate::kernel_ridge::SHARPNESS);
    asked
        .par_iter()
        .map(|vector| {
            let terms = known.iter().map(|other| f64::from(dot(vector, other)));
            let sum: f64 = terms.map(|x| libm::exp(sharpness * (x - 1.0))).sum();
            1.0 + libm::log(sum.max(f64::MIN_POSITIVE)) / sharpness
        })
        .collect()
}

/// The group of each phrase, numbered from 0: phrases nearer than [`NEAR`] share one, by chains,
/// too.
pub(crate) fn groups(phrases: &[&[f32]]) -> Vec<usize> {
    let near: Vec<Vec<usize>> = phrases
        .par_iter()
        .enumerate()
        .map(|(i, phrase)| (0..i).filter(|&j| dot(phrase, phrases[j]) > NEAR).collect())
        .collect();
    let mut parent: Vec<usize> = (0..phrases.len()).collect();
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    for (i, others) in near.iter().enumerate() {
        for &j in others {
            let (a, b) = (root(&mut parent, i), root(&mut parent, j));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut names = vec![usize::MAX; phrases.len()];
    let mut count = 0;
    (0..phrases.len())
        .map(|i| {
            let root = root(&mut parent, i);
            if names[root] == usize::MAX {
                names[root] = count;
                count += 1;
            }
            names[root]
        })
        .collect()
}

fn largest(group: &[usize]) -> usize {
    let mut counts = vec![0; group.len()];
    group.iter().for_each(|&g| counts[g] += 1);
    counts.into_iter().max().unwrap_or_default()
}

/// Marks the phrases to hold out: every fifth of the shuffled groups, but never the largest, whose phrases are near
/// most others by chains.
fn chosen(group: &[usize], seed: u64) -> Vec<bool> {
    let mut counts = vec![0_usize; group.iter().copied().max().map_or(0, |last| last + 1)];
    group.iter().for_each(|&g| counts[g] += 1);
    let largest = (0..counts.len()).max_by_key(|&g| counts[g]);
    let mut order: Vec<usize> = (0..counts.len()).collect();
    Stream::new(seed, Purpose::Verification, 1).shuffle(&mut order);
    let mut out = vec![false; counts.len()];
    for g in order.into_iter().step_by(FOLDS) {
        out[g] = Some(g) != largest;
    }
    group.iter().map(|&g| out[g]).collect()
}

fn explained(said: &[f64], truth: &[f64]) -> f64 {
    let centre = mean(truth);
    let total: f64 = truth.iter().map(|y| (y - centre) * (y - centre)).sum();
    let residual: f64 = said.iter().zip(truth).map(|(x, y)| (x - y) * (x - y)).sum();
    if total > 0.0 {
        1.0 - residual / total
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_is_held_out_whole_and_joined_by_chains() {
        let at = |angle: f32| vec![angle.cos(), angle.sin()];
        let vectors = [at(0.0), at(0.5), at(1.0), at(3.0)];
        let phrases: Vec<&[f32]> = vectors.iter().map(Vec::as_slice).collect();
        assert_eq!(groups(&phrases), [0, 0, 0, 1]);
        let group: Vec<usize> = (0..100).map(|i| i / 2).collect();
        let out = chosen(&group, 1);
        assert!(out.chunks(2).all(|pair| pair[0] == pair[1]));
        let share = out.iter().filter(|&&out| out).count();
        assert!((18..=20).contains(&share), "{share}");
    }

    #[test]
    fn all_is_explained_by_the_truth_and_nothing_by_its_mean() {
        let truth = [1.0, 2.0, 6.0];
        assert_eq!(explained(&truth, &truth), 1.0);
        assert!(explained(&[3.0; 3], &truth).abs() < 1e-12);
    }
}
