//! Regression of a text's roughness, slipperiness and hardness, beside that of the latent.
//!
//! A text's latent is a mixture of materials, and the decoded mixture follows the words less closely than a regression
//! on the ratings themselves. Ratings map to attributes by a line each, fitted to the materials; a harder material of
//! the same roughness vibrates more, and half of that effect counts. A material's name is drawn to its own attributes,
//! with weights `exp((e·e_i − 1)/τ)` of names relative to those of phrases, which keep the regression's result. The
//! recall of the latent is not used for this: its directions carry nothing about how a material feels.

use crate::{
    attributes::{self, Layout},
    captions::Captions,
    config::{self, Memory},
    kernel_ridge::KernelRidge,
    lda_retrieval,
    material::MaterialLatent,
    ridge::{self, Line},
};
use asperity_corpus::{Material, Rating};

/// Rough, slippery and hard, as dB re 1 (m/s²)², −ln μ and ln Hz: the scales on which the compiler
/// moves a texture.
pub(crate) type AttributeValues = [f32; 3];

/// Share of what hardness adds to the level of a roughness that counts. People call rough what is deep: with all of it,
/// deep and soft things fall behind hard and smooth ones.
const HARD_SHARE: f64 = 0.5;

/// A fitted regression on the examples of a [`KernelRidge`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AttributeRegression {
    /// γ.
    pub(crate) concentration: f32,
    /// The mean of the examples.
    pub(crate) mean: AttributeValues,
    /// a, an example of the memory each.
    pub(crate) coefficients: Vec<AttributeValues>,
    /// Attributes of the materials.
    pub(crate) materials: Vec<AttributeValues>,
    /// Which examples of the memory are names, and whose.
    pub(crate) names: Names,
    /// Recall that draws names to their materials, if any.
    pub(crate) recall: Option<config::Recall>,
}

/// The examples of a memory, by what they are.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Names {
    /// Examples that are a material's name or synonym.
    pub(crate) examples: Vec<usize>,
    /// The material of each.
    pub(crate) owners: Vec<usize>,
    /// First example that is a phrase of the lexicon; all behind it are.
    pub(crate) phrases_from: usize,
}

impl AttributeRegression {
    /// Fits, on materials of these attributes and ratings; `None` where no phrase or no material is
    /// rated.
    pub(crate) fn fit(
        memory: &KernelRidge,
        materials: &[MaterialLatent],
        (felt, ratings): (&[AttributeValues], &[Option<Rating>]),
        captions: &Captions,
        how: &Memory,
        mut done: impl FnMut(usize, usize, f32),
    ) -> Option<Self> {
        let pairs = ratings.iter().zip(felt);
        let rated: Vec<([f64; 3], AttributeValues)> = pairs
            .filter_map(|(rating, felt)| Some((numbers(rating.as_ref()?), *felt)))
            .collect();
        if rated.is_empty() || captions.lexicon.is_empty() {
            return None;
        }
        let by_ratings = ByRatings::fit(&rated);
        let (mut values, mut weights) = (Vec::new(), Vec::new());
        let mut of = Names::default();
        let felt_as = |rating: &Rating| by_ratings.felt(&numbers(rating));
        for (owner, ((m, rating), felt)) in materials.iter().zip(ratings).zip(felt).enumerate() {
            let texts = captions.training[m.material].len();
            let names = captions.names[m.material];
            // By its rating, as the phrases: what lies off the lines is the recall's to add.
            let value = rating.as_ref().map_or(*felt, felt_as);
            for place in 0..texts {
                let is_name = place >= texts - names;
                if is_name {
                    of.examples.push(values.len());
                    of.owners.push(owner);
                }
                values.push(value);
                weights.push(if is_name {
                    1.0
                } else {
                    how.felt_caption_weight as f32
                });
            }
        }
        of.phrases_from = values.len();
        for phrase in &captions.lexicon {
            values.push(felt_as(&phrase.rating));
            weights.push(phrase.weight);
        }
        let concentration = how.felt_concentration as f32;
        let (mean, coefficients) = memory.solve(concentration, &values, &weights, how, &mut done);
        Some(Self {
            concentration,
            mean,
            coefficients,
            materials: felt.to_vec(),
            names: of,
            recall: how.recall,
        })
    }

    /// Returns the attributes that texts ask for.
    pub(crate) fn ask(&self, memory: &KernelRidge, vectors: &[&[f32]]) -> Vec<AttributeValues> {
        let mut felt = memory.apply(vectors, self.concentration, &self.coefficients, &self.mean);
        if let Some(how) = &self.recall {
            for (felt, likeness) in felt.iter_mut().zip(memory.likeness(vectors)) {
                self.draw(how, &likeness, felt);
            }
        }
        felt
    }

    /// Draws attributes to those of the materials whose names a text is like.
    fn draw(&self, how: &config::Recall, likeness: &[f32], felt: &mut AttributeValues) {
        let near = |x: f32| libm::expf((x - 1.0) / how.felt_temperature as f32);
        let examples = self.names.examples.iter();
        let weights: Vec<f32> = examples.map(|&example| near(likeness[example])).collect();
        let phrases = likeness[self.names.phrases_from..].iter();
        let phrases: f32 = phrases.map(|&x| near(x)).sum();
        let kept = how.felt_phrase_weight as f32 * phrases + LEAST;
        lda_retrieval::drawn(felt, kept, &weights, &self.names.owners, &self.materials);
    }
}

/// Added to what the regression counts, so that a text like nothing stays where it was.
pub(crate) const LEAST: f32 = 1e-30;

/// The attributes of a material, by its prototype.
pub(crate) fn of(material: &Material, layout: &Layout) -> AttributeValues {
    let attributes = attributes::of(&material.prototype, layout);
    let ln = |x: f64| libm::log(x.max(f64::MIN_POSITIVE)) as f32;
    [
        attributes.rough_db as f32,
        -ln(material.mu),
        ln(attributes.hard_hz),
    ]
}

/// Map from ratings to attributes.
struct ByRatings {
    /// Line of each attribute in its own rating.
    lines: [Line; 3],
    /// dB for a step of the rated hardness.
    level_per_hard: f64,
}

impl ByRatings {
    fn fit(rated: &[([f64; 3], AttributeValues)]) -> Self {
        let column = |k: usize| rated.iter().map(move |(_, felt)| f64::from(felt[k]));
        let rough_and_hard: Vec<Vec<f64>> = rated.iter().map(|(r, _)| vec![r[0], r[2]]).collect();
        let levels: Vec<f64> = column(0).collect();
        let level_per_hard = HARD_SHARE * ridge::fit(&rough_and_hard, &levels).direction[1];
        let lines = std::array::from_fn(|k| {
            let points: Vec<Vec<f64>> = rated.iter().map(|(r, _)| vec![r[k]]).collect();
            let counted = if k == 0 { level_per_hard } else { 0.0 };
            let values = column(k)
                .zip(rated)
                .map(|(value, (r, _))| value - counted * r[2]);
            ridge::fit(&points, &values.collect::<Vec<_>>())
        });
        Self {
            lines,
            level_per_hard,
        }
    }

    fn felt(&self, rating: &[f64; 3]) -> AttributeValues {
        let mut felt: [f64; 3] =
            std::array::from_fn(|k| self.lines[k].offset + self.lines[k].direction[0] * rating[k]);
        felt[0] += self.level_per_hard * rating[2];
        felt.map(|value| value as f32)
    }
}

fn numbers(rating: &Rating) -> [f64; 3] {
    [rating.rough, rating.slippery, rating.hard]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_what_hardness_adds_to_a_level_counts_and_the_mean_stays() {
        // Level = rough + 0.2·hard, no correlation between the two.
        let rated: Vec<([f64; 3], AttributeValues)> = (0..100)
            .map(|n| (f64::from(10 * (n % 10)), f64::from(10 * (n / 10))))
            .map(|(rough, hard)| {
                let level = rough + 0.2 * hard;
                ([rough, 50.0, hard], [level as f32, 1.0, 5.0 + hard as f32])
            })
            .collect();
        let by_ratings = ByRatings::fit(&rated);
        let of = |rough, hard| by_ratings.felt(&[rough, 50.0, hard]);
        let near = |x: f32, y: f32| (x - y).abs() < 0.05;
        assert!(near(of(50.0, 100.0)[0] - of(50.0, 0.0)[0], 10.0));
        assert!(near(of(45.0, 45.0)[0], 54.0), "{:?}", of(45.0, 45.0));
        assert_eq!(of(0.0, 0.0)[1], 1.0);
        assert!(near(of(0.0, 40.0)[2], 45.0));
    }

    #[test]
    fn a_name_feels_as_its_material_and_a_phrase_as_it_was_rated() {
        let feel = AttributeRegression {
            concentration: 1.0,
            mean: [0.0; 3],
            coefficients: Vec::new(),
            materials: vec![[1.0; 3], [3.0; 3]],
            names: Names {
                examples: vec![1, 2],
                owners: vec![0, 1],
                phrases_from: 3,
            },
            recall: None,
        };
        let how = config::Recall {
            temperature: 0.05,
            directions: 1,
            shrinkage: 1.0,
            mean_weight: 1.0,
            familiar: 0.7,
            felt_temperature: 0.02,
            felt_phrase_weight: 3.0,
        };
        // A caption, the two names, a phrase.
        for (likeness, expected) in [
            ([1.0, 0.0, 1.0, 0.0], 3.0),
            ([1.0, 0.0, 0.0, 1.0], -5.0),
            ([1.0, 0.9, 0.0, 0.9], (1.0 - 3.0 * 5.0) / 4.0),
            ([1.0, -1.0, -1.0, -1.0], -5.0),
        ] {
            let mut felt = [-5.0; 3];
            feel.draw(&how, &likeness, &mut felt);
            assert!((felt[1] - expected).abs() < 1e-3, "{} {expected}", felt[1]);
        }
    }
}
