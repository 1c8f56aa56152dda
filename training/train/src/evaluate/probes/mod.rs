//! Part 4: prompts that say the same, the opposite, more and less.

mod prompts;

use prompts::Change;
pub(super) use prompts::{Attribute, ChangeKind, Direction, Probes, sources};

use super::{
    EvaluateError, Watch,
    signature::{Objective, Signature},
    statistics::{Share, mean, median},
    subject::Subject,
    texts::Texts,
};
use crate::captions::{Phrase, dot};
use asperity_corpus::Rating;
use prompts::Pairs;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Similarity of paraphrases' textures; distances in deviations of the corpus, over `rough_db` and the logarithms of
/// `sharp_hz`, `hard_hz` and μ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Paraphrases {
    /// Pairs.
    pub pairs: usize,
    /// Mean distance within pairs.
    pub distance: f64,
    /// Mean distance between prompts of different pairs.
    pub random_distance: f64,
    /// The first over the second.
    pub ratio: f64,
    /// Pairs closer than half of all random ones.
    pub closer: Share,
}

/// A direction and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The direction.
    #[serde(flatten)]
    pub direction: Direction,
    /// Objective attribute before.
    pub before: f64,
    /// And after.
    pub after: f64,
    /// True if it changed in the right direction.
    pub right: bool,
}

/// Right rankings of pairs by an attribute.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ranked {
    /// The attribute.
    pub attribute: Attribute,
    /// By the decoded textures.
    pub model: Share,
    /// By the training materials nearest to the prompts.
    pub material: Baseline,
    /// By the ratings of the lexicon's phrases nearest to the prompts.
    pub phrase: Baseline,
}

/// A baseline that may give both prompts the same.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Baseline {
    /// Right rankings.
    pub right: Share,
    /// Pairs that it does not tell apart.
    pub tied: usize,
}

impl Baseline {
    /// Counts over pairs of values, of the prompt with more and the one with less.
    fn of(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        Self {
            right: Share::of(pairs.clone().map(|(more, less)| more > less)),
            tied: pairs.filter(|(more, less)| more == less).count(),
        }
    }
}

/// Three prompts whose textures should be ever less sharp and rough.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Order {
    /// The prompts.
    pub prompts: [String; 3],
    /// Spectral centroids, Hz.
    pub sharp_hz: [f64; 3],
    /// Levels, dB.
    pub rough_db: [f64; 3],
    /// True if the centroids fall.
    pub sharp_falls: bool,
    /// True if the levels fall.
    pub rough_falls: bool,
}

/// Part 4.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Probing {
    /// Two ways to say the same.
    pub paraphrases: Paraphrases,
    /// Every direction.
    pub steps: Vec<Step>,
    /// Pairs of the committed list.
    pub pairs: Vec<Ranked>,
    /// Abrasive, cork, foam.
    pub orders: Vec<Order>,
}

impl Probing {
    /// Right directions among those that `which` accepts.
    #[must_use]
    pub fn right(&self, which: impl Fn(&Direction) -> bool) -> Share {
        let steps = self.steps.iter().filter(|step| which(&step.direction));
        Share::of(steps.map(|step| step.right))
    }
}

/// Decoded attributes of a prompt, and those of its nearest neighbours in text.
struct PromptAttributes {
    decoded: Objective,
    material: Objective,
    phrase: Rating,
}

/// References for the prompts.
pub(super) struct Known<'a> {
    /// Signatures of the anchors' materials.
    pub(super) materials: &'a [Signature],
    /// Vectors and ratings.
    pub(super) lexicon: &'a [Phrase],
}

/// Asks the model all prompts.
pub(super) fn measure(
    subject: &Subject,
    known: &Known<'_>,
    texts: &Texts<'_>,
    watch: &mut dyn Watch,
) -> Result<Probing, EvaluateError> {
    let (probes, pairs) = (Probes::read()?, Pairs::read()?);
    let of_pairs = Attribute::ALL.iter().flat_map(|a| pairs.of(*a)).flatten();
    let prompts: Vec<&str> = probes
        .prompts()
        .chain(of_pairs.map(String::as_str))
        .collect();
    let felt = ask(subject, known, texts, &prompts, watch)?;
    let of = |prompt: &String| &felt[prompt.as_str()];
    let steps = probes.directions.iter().map(|direction| {
        let value = |prompt| value(&of(prompt).decoded, direction.attribute);
        let (before, after) = (value(&direction.from), value(&direction.to));
        Step {
            direction: direction.clone(),
            before,
            after,
            right: match direction.change {
                Change::More => after > before,
                Change::Less => after < before,
            },
        }
    });
    let ranked = Attribute::ALL.iter().map(|&attribute| {
        let pairs = |value: fn(&PromptAttributes, Attribute) -> f64| {
            let pairs = pairs.of(attribute).iter();
            pairs.map(move |[more, less]| (value(of(more), attribute), value(of(less), attribute)))
        };
        let decoded = pairs(|felt, attribute| value(&felt.decoded, attribute));
        Ranked {
            attribute,
            model: Share::of(decoded.map(|(more, less)| more > less)),
            material: Baseline::of(pairs(|felt, attribute| value(&felt.material, attribute))),
            phrase: Baseline::of(pairs(|felt, attribute| rated(&felt.phrase, attribute))),
        }
    });
    let orders = probes.orders.iter().map(|prompts| {
        let values =
            |value: fn(&Objective) -> f64| std::array::from_fn(|k| value(&of(&prompts[k]).decoded));
        let falls = |x: [f64; 3]| x[0] > x[1] && x[1] > x[2];
        let (sharp_hz, rough_db) = (values(|o| o.sharp_hz), values(|o| o.rough_db));
        Order {
            prompts: prompts.clone(),
            sharp_hz,
            rough_db,
            sharp_falls: falls(sharp_hz),
            rough_falls: falls(rough_db),
        }
    });
    let scales = scales(known.materials);
    let places = probes.paraphrases.iter().map(|pair| {
        [0, 1].map(|k: usize| {
            let even = of(&pair[k]).decoded.even();
            std::array::from_fn(|axis| even[axis] / scales[axis])
        })
    });
    Ok(Probing {
        paraphrases: paraphrases(&places.collect::<Vec<_>>()),
        steps: steps.collect(),
        pairs: ranked.collect(),
        orders: orders.collect(),
    })
}

fn ask<'p>(
    subject: &Subject,
    known: &Known<'_>,
    texts: &Texts<'_>,
    prompts: &[&'p str],
    watch: &mut dyn Watch,
) -> Result<BTreeMap<&'p str, PromptAttributes>, EvaluateError> {
    texts.learn(prompts.iter().copied(), watch)?;
    let mut distinct = prompts.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    watch.begin("prompts", distinct.len());
    let vectors: Vec<Vec<f32>> = distinct
        .iter()
        .map(|prompt| texts.vector(prompt))
        .collect::<Result<_, _>>()?;
    let projected = subject.project(&vectors)?;
    let decoded = subject.felt(&projected)?;
    watch.done(distinct.len());
    let found = vectors.iter().zip(&projected).zip(decoded);
    let felt = found.map(|((vector, said), decoded)| {
        let phrases: Vec<f32> = known
            .lexicon
            .iter()
            .map(|phrase| dot(vector, &phrase.vector))
            .collect();
        PromptAttributes {
            decoded,
            material: known.materials[nearest(&said.similarity)].objective,
            phrase: known
                .lexicon
                .get(nearest(&phrases))
                .map_or(UNRATED, |found| found.rating),
        }
    });
    Ok(distinct.iter().copied().zip(felt).collect())
}

/// Rating used where there is no lexicon.
const UNRATED: Rating = Rating {
    rough: 50.0,
    slippery: 50.0,
    hard: 50.0,
};

fn rated(rating: &Rating, attribute: Attribute) -> f64 {
    match attribute {
        Attribute::Rough => rating.rough,
        Attribute::Slippery => rating.slippery,
        Attribute::Hard => rating.hard,
    }
}

/// Index of the largest; the first of equal ones.
fn nearest(similarity: &[f32]) -> usize {
    let ranked = similarity.iter().enumerate();
    ranked
        .max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)))
        .map_or(0, |(index, _)| index)
}

fn value(objective: &Objective, attribute: Attribute) -> f64 {
    match attribute {
        Attribute::Rough => objective.rough_db,
        Attribute::Slippery => -objective.mu,
        Attribute::Hard => objective.hard_hz,
    }
}

/// Deviations of the attributes over the materials, on even scales.
pub(super) fn scales(materials: &[Signature]) -> [f64; 4] {
    std::array::from_fn(|axis| {
        let values: Vec<f64> = materials.iter().map(|m| m.objective.even()[axis]).collect();
        super::statistics::Spread::of(&values).deviation.max(1e-9)
    })
}

fn paraphrases(places: &[[[f64; 4]; 2]]) -> Paraphrases {
    let distance = |x: &[f64; 4], y: &[f64; 4]| -> f64 {
        let squares = x.iter().zip(y).map(|(x, y)| (x - y) * (x - y));
        squares.sum::<f64>().sqrt()
    };
    let within: Vec<f64> = places.iter().map(|[x, y]| distance(x, y)).collect();
    let mut random = Vec::new();
    for (index, pair) in places.iter().enumerate() {
        for other in &places[index + 1..] {
            for x in pair {
                random.extend(other.iter().map(|y| distance(x, y)));
            }
        }
    }
    let (own, apart, half) = (mean(&within), mean(&random), median(&random));
    Paraphrases {
        pairs: places.len(),
        distance: own,
        random_distance: apart,
        ratio: if apart > 0.0 { own / apart } else { 1.0 },
        closer: Share::of(within.iter().map(|&x| x < half)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paraphrases_that_fall_together_are_closer_than_chance() {
        let at = |x: f64| [x, 0.0, 0.0, 0.0];
        let found = paraphrases(&[[at(0.0), at(0.1)], [at(3.0), at(3.1)], [at(9.0), at(9.0)]]);
        assert_eq!(found.closer.hits, 3);
        assert!(found.ratio < 0.05, "{found:?}");
    }
}
