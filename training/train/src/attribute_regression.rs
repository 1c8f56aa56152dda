//! How rough, slippery and hard a text is: a regression of its own beside that of the latent.
//!
//! The latent of a text is a mixture of materials, and what a mixture decodes to follows the words
//! less closely than a regression on the ratings themselves. Ratings become attributes by a line
//! for each, fitted to the materials. A material's name is drawn to its own attributes, with the
//! weights `exp((e·e_i − 1)/τ)` of names beside those of phrases, which keep what the regression
//! says: not by the recall of the latent, whose directions carry nothing about how a material feels.

use crate::{
    attributes::{self, Layout},
    captions::Captions,
    config::{self, Memory},
    kernel_ridge::KernelRidge,
    lda_retrieval,
    material::MaterialLatent,
};
use asperity_corpus::{Material, Rating};

/// Rough, slippery and hard, as dB re 1 (m/s²)², −ln μ and ln Hz: the scales on which the compiler
/// moves a texture.
pub(crate) type Felt = [f32; 3];

/// A fitted regression on the examples of a [`KernelRidge`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AttributeRegression {
    /// γ.
    pub(crate) concentration: f32,
    /// The mean of the examples.
    pub(crate) mean: Felt,
    /// a, an example of the memory each.
    pub(crate) coefficients: Vec<Felt>,
    /// Attributes of the materials.
    pub(crate) materials: Vec<Felt>,
    /// Which examples of the memory are names, and whose.
    pub(crate) names: Names,
    /// How names are drawn to their materials, if they are.
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
        (felt, ratings): (&[Felt], &[Option<Rating>]),
        captions: &Captions,
        how: &Memory,
        mut done: impl FnMut(usize, usize, f32),
    ) -> Option<Self> {
        let pairs = ratings.iter().zip(felt);
        let rated: Vec<(Felt, Felt)> = pairs
            .filter_map(|(rating, felt)| Some((numbers(rating.as_ref()?), *felt)))
            .collect();
        if rated.is_empty() || captions.lexicon.is_empty() {
            return None;
        }
        let lines: [(f32, f32); 3] = std::array::from_fn(|k| {
            let points: Vec<_> = rated.iter().map(|(r, felt)| (r[k], felt[k])).collect();
            line(&points)
        });
        let (mut values, mut weights) = (Vec::new(), Vec::new());
        let mut of = Names::default();
        let on_lines = |rating: &Rating| -> Felt {
            let rating = numbers(rating);
            std::array::from_fn(|k| lines[k].0 + lines[k].1 * rating[k])
        };
        for (owner, ((m, rating), felt)) in materials.iter().zip(ratings).zip(felt).enumerate() {
            let texts = captions.training[m.material].len();
            let names = captions.names[m.material];
            // By its rating, as the phrases: what lies off the lines is the recall's to add.
            let value = rating.as_ref().map_or(*felt, on_lines);
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
            values.push(on_lines(&phrase.rating));
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

    /// What texts ask for.
    pub(crate) fn ask(&self, memory: &KernelRidge, vectors: &[&[f32]]) -> Vec<Felt> {
        let mut felt = memory.apply(vectors, self.concentration, &self.coefficients, &self.mean);
        if let Some(how) = &self.recall {
            for (felt, likeness) in felt.iter_mut().zip(memory.likeness(vectors)) {
                self.draw(how, &likeness, felt);
            }
        }
        felt
    }

    /// Draws attributes to those of the materials whose names a text is like.
    fn draw(&self, how: &config::Recall, likeness: &[f32], felt: &mut Felt) {
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
pub(crate) fn of(material: &Material, layout: &Layout) -> Felt {
    let attributes = attributes::of(&material.prototype, layout);
    let ln = |x: f64| libm::log(x.max(f64::MIN_POSITIVE)) as f32;
    [
        attributes.rough_db as f32,
        -ln(material.mu),
        ln(attributes.hard_hz),
    ]
}

fn numbers(rating: &Rating) -> Felt {
    [
        rating.rough as f32,
        rating.slippery as f32,
        rating.hard as f32,
    ]
}

/// Least squares: offset and slope; flat where x does not vary.
fn line(points: &[(f32, f32)]) -> (f32, f32) {
    let count = points.len().max(1) as f32;
    let mean_x = points.iter().map(|p| p.0).sum::<f32>() / count;
    let mean_y = points.iter().map(|p| p.1).sum::<f32>() / count;
    let (mut product, mut square) = (0.0, 0.0);
    for (x, y) in points {
        product += (x - mean_x) * (y - mean_y);
        square += (x - mean_x) * (x - mean_x);
    }
    let slope = if square > 0.0 { product / square } else { 0.0 };
    (mean_y - slope * mean_x, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn a_line_goes_through_its_points_and_is_flat_through_one() {
        let (offset, slope) = line(&[(0.0, 1.0), (50.0, 2.0), (100.0, 3.0)]);
        assert!((offset - 1.0).abs() < 1e-5 && (slope - 0.02).abs() < 1e-6);
        assert_eq!(line(&[(7.0, 3.0)]), (3.0, 0.0));
    }
}
