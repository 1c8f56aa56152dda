//! The shortest way through the latent space to given attributes.
//!
//! Lengths are those of Mahalanobis, with the covariance C of the model's materials, so that a
//! texture moves the way that materials differ. The gradients J of the description start a
//! quasi-Newton search, and every decoded texture corrects them (Broyden):
//!
//! ```text
//! s = C Jᵀ (J C Jᵀ)⁻¹ (y* − y),   J ← J + (Δy − J s)(C⁻¹ s)ᵀ / (sᵀ C⁻¹ s)
//! ```

use crate::learned::{
    Latent,
    description::{Anchor, LATENT},
};

/// Decoded textures that a search may look at.
const TRIALS: usize = 16;
/// Distance at which a search ends, steps of a slider.
const CLOSE: f64 = 0.05;
/// Largest step of a search, and how far it may go, standard deviations.
const REACH: (f64, f64) = (1.5, 8.0);
/// Variance that is added to every direction, so that none is closed.
const OPEN: f64 = 1e-4;

/// Covariance of the materials about their mean.
pub(super) struct Metric(Vec<[f64; LATENT]>);

impl Metric {
    pub(super) fn of(anchors: &[Anchor]) -> Self {
        let count = anchors.len().max(1) as f64;
        let at = |anchor: &Anchor, k: usize| f64::from(anchor.z.get(k).copied().unwrap_or(0.0));
        let mean: [f64; LATENT] =
            std::array::from_fn(|k| anchors.iter().map(|a| at(a, k)).sum::<f64>() / count);
        let mut rows = vec![[0.0; LATENT]; LATENT];
        for anchor in anchors {
            let d: [f64; LATENT] = std::array::from_fn(|k| at(anchor, k) - mean[k]);
            for (row, x) in rows.iter_mut().zip(d) {
                row.iter_mut()
                    .zip(d)
                    .for_each(|(sum, y)| *sum += x * y / count);
            }
        }
        for (k, row) in rows.iter_mut().enumerate() {
            row[k] += OPEN;
        }
        Self(rows)
    }

    /// C·v.
    pub(super) fn times(&self, v: &[f64]) -> Vec<f64> {
        self.0.iter().map(|row| dot(row, v)).collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Moves a latent until `look` says `target`, or as near to it as the search comes. `gradients`
/// are those of what `look` says, one for each number.
pub(super) fn reach<E>(
    start: &Latent,
    gradients: &[&[f64]],
    metric: &Metric,
    target: &[f64],
    mut look: impl FnMut(&Latent) -> Result<Option<Vec<f64>>, E>,
) -> Result<Latent, E> {
    let mut jacobian: Vec<Vec<f64>> = gradients.iter().map(|g| g.to_vec()).collect();
    let mut best = *start;
    let Some(mut seen) = look(start)? else {
        return Ok(best);
    };
    // C⁻¹ of the way from the start.
    let mut way = vec![0.0; LATENT];
    let mut radius = REACH.0;
    for _ in 0..TRIALS {
        let missing: Vec<f64> = target.iter().zip(&seen).map(|(t, y)| t - y).collect();
        if largest(&missing) < CLOSE {
            break;
        }
        let spread: Vec<Vec<f64>> = jacobian.iter().map(|row| metric.times(row)).collect();
        let Some(weights) = solved(&jacobian, &spread, &missing) else {
            break;
        };
        let length = dot(&weights, &missing).max(0.0).sqrt();
        let short = (radius / length.max(1e-12)).min(1.0);
        let covector: Vec<f64> = (0..LATENT)
            .map(|k| {
                short
                    * (0..weights.len())
                        .map(|n| weights[n] * jacobian[n][k])
                        .sum::<f64>()
            })
            .collect();
        let step = metric.times(&covector);
        let longer: Vec<f64> = way.iter().zip(&covector).map(|(a, b)| a + b).collect();
        if dot(&longer, &metric.times(&longer)).sqrt() > REACH.1 {
            break;
        }
        let next: Latent = std::array::from_fn(|k| (f64::from(best[k]) + step[k]) as f32);
        let Some(there) = look(&next)? else { break };
        let along = dot(&step, &covector).max(1e-12);
        for (n, row) in jacobian.iter_mut().enumerate() {
            let surprise = there[n] - seen[n] - dot(row, &step);
            for (slope, w) in row.iter_mut().zip(&covector) {
                *slope += surprise * w / along;
            }
        }
        let left: Vec<f64> = target.iter().zip(&there).map(|(t, y)| t - y).collect();
        if largest(&left) < largest(&missing) {
            (best, seen, way) = (next, there, longer);
            radius = (1.5 * radius).min(REACH.0);
        } else {
            radius = 0.5 * short * length;
        }
    }
    Ok(best)
}

/// (J C Jᵀ)⁻¹·missing, for one or two attributes.
fn solved(jacobian: &[Vec<f64>], spread: &[Vec<f64>], missing: &[f64]) -> Option<Vec<f64>> {
    let at = |i: usize, j: usize| dot(&jacobian[i], &spread[j]);
    match missing {
        [x] => (at(0, 0) > 0.0).then(|| vec![x / at(0, 0)]),
        [x, y] => {
            let (a, b, d) = (at(0, 0), at(0, 1), at(1, 1));
            let determinant = a * d - b * b;
            (determinant > 1e-9 * a * d)
                .then(|| vec![(d * x - b * y) / determinant, (a * y - b * x) / determinant])
        }
        _ => None,
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Steps, and standard deviations, that a line is looked at.
const LINE: (i32, f64) = (32, 0.25);

/// Moves a latent along a line until `look` says `target`, by bisection of the nearest change of
/// sign, or else to where it is nearest.
pub(super) fn along(
    start: &Latent,
    gradient: &[f64],
    metric: &Metric,
    target: f64,
    look: impl Fn(&Latent) -> f64,
) -> Latent {
    let spread = metric.times(gradient);
    let length = dot(gradient, &spread).max(1e-12).sqrt();
    let at = |t: f64| -> Latent {
        std::array::from_fn(|k| (f64::from(start[k]) + t * spread[k] / length) as f32)
    };
    let missing = |t: f64| look(&at(t)) - target;
    let here = missing(0.0);
    if here.abs() < CLOSE {
        return *start;
    }
    let (mut nearest, mut least) = (0.0, here.abs());
    let sides = [1.0, -1.0];
    let mut previous = [(0.0, here); 2];
    for n in 1..=LINE.0 {
        for (side, sign) in sides.into_iter().enumerate() {
            let t = sign * LINE.1 * f64::from(n);
            let there = missing(t);
            let (t0, before) = previous[side];
            if (there > 0.0) != (before > 0.0) {
                return at(bisected(t0, t, before, &missing));
            }
            if there.abs() < least {
                (nearest, least) = (t, there.abs());
            }
            previous[side] = (t, there);
        }
    }
    at(nearest)
}

fn bisected(mut a: f64, mut b: f64, at_a: f64, missing: &impl Fn(f64) -> f64) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (a + b);
        if (missing(middle) > 0.0) == (at_a > 0.0) {
            a = middle;
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(k: usize) -> Vec<f64> {
        let mut v = vec![0.0; LATENT];
        v[k] = 1.0;
        v
    }

    #[test]
    fn bent_attributes_are_reached_though_the_gradients_are_only_near() {
        let metric = Metric(
            (0..LATENT)
                .map(|k| std::array::from_fn(|j| f64::from(u8::from(j == k))))
                .collect(),
        );
        let look = |z: &Latent| -> Result<Option<Vec<f64>>, ()> {
            let (x, y) = (f64::from(z[0]), f64::from(z[1]));
            Ok(Some(vec![10.0 * x + 3.0 * y * y, 8.0 * y - 2.0 * x]))
        };
        let (a, b) = (unit(0), unit(1));
        let scaled = |v: &[f64]| v.iter().map(|x| 12.0 * x).collect::<Vec<_>>();
        let found = reach(
            &[0.0; LATENT],
            &[&scaled(&a), &scaled(&b)],
            &metric,
            &[20.0, 0.0],
            look,
        );
        let Ok(found) = found else { panic!("it looks") };
        let seen = look(&found).unwrap().unwrap();
        assert!(
            (seen[0] - 20.0).abs() < 0.1 && seen[1].abs() < 0.1,
            "{seen:?}"
        );
        assert!(found[2..].iter().all(|x| *x == 0.0));
    }

    #[test]
    fn a_line_ends_at_the_value_or_nearest_to_it() {
        let metric = Metric(
            (0..LATENT)
                .map(|k| std::array::from_fn(|j| f64::from(u8::from(j == k))))
                .collect(),
        );
        let look = |z: &Latent| 30.0 * libm::tanh(f64::from(z[0]));
        let found = along(&[0.0; LATENT], &unit(0), &metric, 20.0, look);
        assert!((look(&found) - 20.0).abs() < 1e-3);
        let beyond = along(&[0.0; LATENT], &unit(0), &metric, 50.0, look);
        assert!(look(&beyond) > 29.9);
    }
}
