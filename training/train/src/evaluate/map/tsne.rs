//! Exact t-SNE (van der Maaten and Hinton, 2008) for a few hundred points: no tree, no
//! randomness; it starts at the first two principal components.

/// Steps of the descent, and those with exaggerated neighbourhoods.
const STEPS: usize = 1000;
const EXAGGERATED: usize = 250;
const EXAGGERATION: f64 = 12.0;
/// Halvings that find a bandwidth.
const HALVINGS: usize = 60;

/// Places in the plane; `start` gives their first ones.
pub(super) fn embed(points: &[Vec<f64>], start: &[[f64; 2]], perplexity: f64) -> Vec<[f64; 2]> {
    let count = points.len();
    if count < 4 {
        return start.to_vec();
    }
    let affinities = affinities(points, perplexity.min((count - 1) as f64 / 3.0));
    // A start this small lets neighbourhoods form before they repel each other.
    let largest = start
        .iter()
        .flatten()
        .fold(1e-12, |m: f64, x| m.max(x.abs()));
    let mut places: Vec<[f64; 2]> = start
        .iter()
        .map(|p| p.map(|x| 1e-2 * x / largest))
        .collect();
    let mut speed = vec![[0.0; 2]; count];
    let mut gains = vec![[1.0_f64; 2]; count];
    let rate = (count as f64 / EXAGGERATION).max(50.0);
    for step in 0..STEPS {
        let (exaggeration, momentum) = if step < EXAGGERATED {
            (EXAGGERATION, 0.5)
        } else {
            (1.0, 0.8)
        };
        let gradient = gradient(&affinities, &places, exaggeration);
        for i in 0..count {
            for axis in 0..2 {
                let (g, v) = (gradient[i][axis], &mut speed[i][axis]);
                let gain = &mut gains[i][axis];
                *gain = if (g > 0.0) == (*v > 0.0) {
                    0.8 * *gain
                } else {
                    *gain + 0.2
                };
                *gain = gain.max(0.01);
                *v = momentum * *v - rate * *gain * g;
                places[i][axis] += *v;
            }
        }
    }
    places
}

/// Symmetric neighbourhoods p_ij, row by row.
fn affinities(points: &[Vec<f64>], perplexity: f64) -> Vec<f64> {
    let count = points.len();
    let mut conditional = vec![0.0; count * count];
    for i in 0..count {
        let square: Vec<f64> = points
            .iter()
            .map(|x| {
                x.iter()
                    .zip(&points[i])
                    .map(|(x, y)| (x - y) * (x - y))
                    .sum()
            })
            .collect();
        let nearest = (0..count)
            .filter(|&j| j != i)
            .map(|j| square[j])
            .fold(f64::INFINITY, f64::min);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut precision = 1.0 / nearest.max(1e-12);
        for _ in 0..HALVINGS {
            let row = &mut conditional[i * count..(i + 1) * count];
            let (mut sum, mut moment) = (0.0, 0.0);
            for j in (0..count).filter(|&j| j != i) {
                // Relative to the nearest, so that a row never underflows.
                row[j] = libm::exp(-precision * (square[j] - nearest));
                sum += row[j];
                moment += row[j] * (square[j] - nearest);
            }
            row.iter_mut().for_each(|p| *p /= sum);
            let entropy = libm::log(sum) + precision * moment / sum;
            if entropy > libm::log(perplexity) {
                low = precision;
                precision = if high.is_finite() {
                    0.5 * (low + high)
                } else {
                    2.0 * precision
                };
            } else {
                high = precision;
                precision = 0.5 * (low + high);
            }
        }
    }
    let scale = 0.5 / count as f64;
    (0..count * count)
        .map(|at| scale * (conditional[at] + conditional[at % count * count + at / count]))
        .collect()
}

fn gradient(affinities: &[f64], places: &[[f64; 2]], exaggeration: f64) -> Vec<[f64; 2]> {
    let count = places.len();
    let mut nearness = vec![0.0; count * count];
    let mut sum = 0.0;
    for i in 0..count {
        for j in (0..count).filter(|&j| j != i) {
            let (dx, dy) = (places[i][0] - places[j][0], places[i][1] - places[j][1]);
            nearness[i * count + j] = 1.0 / (1.0 + dx * dx + dy * dy);
            sum += nearness[i * count + j];
        }
    }
    let mut gradient = vec![[0.0; 2]; count];
    for i in 0..count {
        for j in 0..count {
            let at = i * count + j;
            let pull = 4.0 * (exaggeration * affinities[at] - nearness[at] / sum) * nearness[at];
            for (axis, slope) in gradient[i].iter_mut().enumerate() {
                *slope += pull * (places[i][axis] - places[j][axis]);
            }
        }
    }
    gradient
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clouds_far_apart_stay_apart() {
        let points: Vec<Vec<f64>> = (0..60)
            .map(|n| {
                let cloud = f64::from(n / 20);
                vec![
                    10.0 * cloud,
                    f64::from(n * 7 % 20) * 0.05,
                    f64::from(n * 3 % 20) * 0.05,
                ]
            })
            .collect();
        let start: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        let places = embed(&points, &start, 10.0);
        let distance = |i: usize, j: usize| {
            let (dx, dy) = (places[i][0] - places[j][0], places[i][1] - places[j][1]);
            (dx * dx + dy * dy).sqrt()
        };
        for i in 0..60 {
            let nearest = (0..60)
                .filter(|&j| j != i)
                .min_by(|&a, &b| distance(i, a).total_cmp(&distance(i, b)))
                .unwrap();
            assert_eq!(nearest / 20, i / 20);
        }
    }
}
