//! Part 5: what lies halfway between two materials in the latent.
//!
//! The paper asked people whether a mixture feels between its ends. This is the objective
//! analogue: where the midpoint's attributes lie on the line between the ends'.

use super::{
    EvaluateError, probes, probes::Probes, signature::Signature, statistics::Share,
    subject::Subject,
};
use asperity::learned::Latent;
use serde::{Deserialize, Serialize};

/// Ends whose attributes differ by less than this share of the corpus's deviation leave
/// nothing to lie between.
const LEAST_DIFFERENCE: f64 = 0.1;

/// A pair of materials and what lies between them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Midpoint {
    /// Names of the ends.
    pub ends: [String; 2],
    /// Attributes of one end, the midpoint and the other, each decoded.
    pub attributes: [[f64; 4]; 3],
    /// (midpoint − A)/(B − A) of each attribute; `None` where the ends hardly differ.
    pub place: [Option<f64>; 4],
    /// The same of the projection on the line through all attributes, each on an even
    /// scale in deviations of the corpus.
    pub place_on_line: f64,
    /// Distance from that line over the distance of the ends.
    pub off_line: f64,
}

/// Part 5.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Midpoints {
    /// Materials in the corpus that stand for the names.
    pub ends: Vec<[String; 2]>,
    /// Every pair.
    pub pairs: Vec<Midpoint>,
    /// Midpoints between the ends, of each attribute.
    pub between: [Share; 4],
    /// The same for all attributes together.
    pub between_any: Share,
    /// Projections that lie between the ends.
    pub between_on_line: Share,
}

/// Mixes and decodes. `materials` are the signatures of the anchors' materials.
pub(super) fn measure(
    subject: &Subject,
    materials: &[Signature],
) -> Result<Midpoints, EvaluateError> {
    let description = subject.description();
    let latents = subject.anchors();
    let mut ends: Vec<([String; 2], Latent)> = Vec::new();
    for end in Probes::read()?.ends {
        let name = match description.corpus.name.as_str() {
            "hatt" => end.hatt,
            _ => end.reference,
        };
        // A model of some materials has some of the ends.
        let anchors = description.anchors.iter().zip(&latents);
        if let Some((_, z)) = anchors.into_iter().find(|(anchor, _)| anchor.name == name) {
            ends.push(([end.name, name], *z));
        }
    }
    let scales = probes::scales(materials);
    let mut pairs = Vec::new();
    for (index, (a, z_a)) in ends.iter().enumerate() {
        for (b, z_b) in &ends[index + 1..] {
            let middle: Latent = std::array::from_fn(|k| 0.5 * (z_a[k] + z_b[k]));
            let decoded = subject.decode(&[*z_a, middle, *z_b])?;
            let even: Vec<[f64; 4]> = decoded
                .iter()
                .map(|t| t.signature.objective.even())
                .collect();
            let values: Vec<[f64; 4]> = decoded
                .iter()
                .map(|t| t.signature.objective.values())
                .collect();
            if let (&[a_even, m_even, b_even], &[a_values, m_values, b_values]) =
                (even.as_slice(), values.as_slice())
            {
                let (place_on_line, off_line) = on_line(a_even, m_even, b_even, scales);
                pairs.push(Midpoint {
                    ends: [a[0].clone(), b[0].clone()],
                    attributes: [a_values, m_values, b_values],
                    place: std::array::from_fn(|k| {
                        let apart = (b_even[k] - a_even[k]).abs() / scales[k];
                        let place = (m_values[k] - a_values[k]) / (b_values[k] - a_values[k]);
                        (apart >= LEAST_DIFFERENCE).then_some(place)
                    }),
                    place_on_line,
                    off_line,
                });
            }
        }
    }
    let inside = |t: f64| (0.0..=1.0).contains(&t);
    let between = |k: usize| {
        pairs
            .iter()
            .filter_map(move |pair| pair.place[k])
            .map(inside)
    };
    Ok(Midpoints {
        between: std::array::from_fn(|k| Share::of(between(k))),
        between_any: Share::of((0..4).flat_map(between)),
        between_on_line: Share::of(pairs.iter().map(|pair| inside(pair.place_on_line))),
        ends: ends.into_iter().map(|(names, _)| names).collect(),
        pairs,
    })
}

/// Where a point projects on the line from `a` to `b`, and its distance from it, both
/// over their distance.
fn on_line(a: [f64; 4], m: [f64; 4], b: [f64; 4], scales: [f64; 4]) -> (f64, f64) {
    let along: [f64; 4] = std::array::from_fn(|k| (b[k] - a[k]) / scales[k]);
    let away: [f64; 4] = std::array::from_fn(|k| (m[k] - a[k]) / scales[k]);
    let dot = |x: &[f64; 4], y: &[f64; 4]| -> f64 { x.iter().zip(y).map(|(x, y)| x * y).sum() };
    let length = dot(&along, &along).max(f64::MIN_POSITIVE);
    let place = dot(&away, &along) / length;
    let left: [f64; 4] = std::array::from_fn(|k| away[k] - place * along[k]);
    (place, (dot(&left, &left) / length).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_a_line_is_on_it() {
        let (a, b) = ([1.0, 2.0, 3.0, 4.0], [3.0, 0.0, 3.0, 5.0]);
        let middle = std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
        let (place, off) = on_line(a, middle, b, [1.0, 2.0, 3.0, 4.0]);
        assert!((place - 0.5).abs() < 1e-12 && off < 1e-12);
        let (_, off) = on_line(
            [0.0; 4],
            [0.5, 0.5, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
            [1.0; 4],
        );
        assert!((off - 0.5).abs() < 1e-12);
    }
}
