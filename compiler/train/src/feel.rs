//! How rough, slippery and hard a text is: a regression of its own beside that of the latent.
//!
//! The latent of a text is a mixture of materials, and what a mixture decodes to follows the words
//! less closely than a regression on the ratings themselves. Ratings become attributes by a line
//! for each, fitted to the materials; the recall draws a material's name to its own attributes.

use crate::{
    attributes, captions::Captions, config::Memory, material::MaterialLatent, memory::TextMemory,
    recall::Recall,
};
use asperity_corpus::{Material, Rating};

/// Rough, slippery and hard, as dB re 1 (m/s²)², −ln μ and ln Hz: the scales on which the compiler
/// moves a texture.
pub(crate) type Felt = [f32; 3];

/// A fitted regression on the examples of a [`TextMemory`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Feel {
    /// γ.
    pub(crate) concentration: f32,
    /// The mean of the examples.
    pub(crate) mean: Felt,
    /// a, an example of the memory each.
    pub(crate) coefficients: Vec<Felt>,
    /// Attributes of the materials.
    pub(crate) materials: Vec<Felt>,
}

impl Feel {
    /// Fits, on materials of these attributes and ratings; `None` where no phrase or no material is
    /// rated.
    pub(crate) fn fit(
        memory: &TextMemory,
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
        let on_lines = |rating: &Rating| -> Felt {
            let rating = numbers(rating);
            std::array::from_fn(|k| lines[k].0 + lines[k].1 * rating[k])
        };
        for ((m, rating), felt) in materials.iter().zip(ratings).zip(felt) {
            let texts = captions.training[m.material].len();
            let names = captions.names[m.material];
            // By its rating, as the phrases: what lies off the lines is the recall's to add.
            let value = rating.as_ref().map_or(*felt, on_lines);
            for place in 0..texts {
                let is_name = place >= texts - names;
                values.push(value);
                weights.push(if is_name {
                    1.0
                } else {
                    how.felt_caption_weight as f32
                });
            }
        }
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
        })
    }

    /// What texts ask for.
    pub(crate) fn ask(
        &self,
        memory: &TextMemory,
        recall: Option<&Recall>,
        vectors: &[&[f32]],
    ) -> Vec<Felt> {
        let mut felt = memory.apply(vectors, self.concentration, &self.coefficients, &self.mean);
        if let Some(recall) = recall {
            let directions = memory.directions(vectors);
            let familiar = recall.how.felt_familiar;
            recall.draw(&self.materials, familiar, &directions, &mut felt);
        }
        felt
    }
}

/// The attributes of a material, by its prototype.
pub(crate) fn of(material: &Material) -> Felt {
    let attributes = attributes::of(&material.prototype);
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
    fn a_line_goes_through_its_points_and_is_flat_through_one() {
        let (offset, slope) = line(&[(0.0, 1.0), (50.0, 2.0), (100.0, 3.0)]);
        assert!((offset - 1.0).abs() < 1e-5 && (slope - 0.02).abs() < 1e-6);
        assert_eq!(line(&[(7.0, 3.0)]), (3.0, 0.0));
    }
}
