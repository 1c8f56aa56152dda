//! The power of a band as a power law of speed and force around a place, under the sensors' noise.
//!
//! The noise N adds to the power L, and what is measured varies as (L + N)². A logarithm of what is left
//! after N is subtracted would be biased where L is small, and may not exist. So L is the generalised
//! linear model E\[P\] = exp(β·x) + N (McCullagh and Nelder, 1989) by Fisher's scoring, in which a
//! segment weighs (L/(L + N))² of its time.

/// Bands of the regression, some 31 Hz each.
pub(super) const BANDS: usize = 14;
/// Least part of the noise that the power of a band is believed to be.
const LEAST_SIGNAL: f64 = 0.003;
/// Spread of the power of a band about a power law over the whole plane, nepers.
const SPREAD: f64 = 0.7;
/// Steps of Fisher's scoring, and the largest change of a coefficient in one.
const STEPS: usize = 12;
const LARGEST_STEP: f64 = 2.0;

/// Power of a band in a segment, near a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured {
    /// Mean power over the band, noise included, (m/s²)².
    pub(super) power: f64,
    /// The way from the place.
    pub(super) away: [f64; 2],
    /// Its weight, samples.
    pub(super) weight: f64,
}

/// The power of a band around a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// ln L at the place, and its slopes.
    pub(super) beta: [f64; 3],
    least: f64,
    /// Samples without noise that know as much of the value.
    pub(super) weight: f64,
}

impl Fit {
    /// `law` is what the value and the slopes are without any segment.
    pub(super) fn new(
        near: &[Measured],
        noise: f64,
        slopes: f64,
        law: Option<[f64; 3]>,
    ) -> Option<Self> {
        let samples: f64 = near.iter().map(|m| m.weight).sum();
        let mean = near.iter().map(|m| m.weight * m.power).sum::<f64>() / samples;
        let least = (LEAST_SIGNAL * noise).max(1e-9 * mean).max(1e-300);
        let start = libm::log((mean - noise).max(least));
        let prior = law.unwrap_or([start, 0.0, 0.0]);
        // A band of 1/14 of the width tells its level to 1/√(samples/14).
        let held = law.map_or(1e-6 * samples, |_| BANDS as f64 / (SPREAD * SPREAD));
        let mut fit = Self {
            beta: [start, prior[1], prior[2]],
            least,
            weight: 0.0,
        };
        for _ in 0..STEPS {
            let mut normal = ridge(slopes, held);
            let mut gradient = [0, 1, 2].map(|k| normal[k][k] * (prior[k] - fit.beta[k]));
            fit.weight = 0.0;
            for m in near {
                let level = fit.level(m.away);
                let weight = m.weight * (level / (level + noise)).powi(2);
                let terms = [1.0, m.away[0], m.away[1]];
                add(&mut normal, terms, weight);
                fit.weight += weight;
                let residual = (m.power - level - noise) / level;
                for (sum, x) in gradient.iter_mut().zip(terms) {
                    *sum += weight * residual * x;
                }
            }
            let step = inverse(&normal)?
                .map(|row| row.iter().zip(gradient).map(|(x, y)| x * y).sum::<f64>());
            for (x, step) in fit.beta.iter_mut().zip(step) {
                *x += step.clamp(-LARGEST_STEP, LARGEST_STEP);
            }
            if step.iter().all(|step| step.abs() < 1e-3) {
                break;
            }
        }
        Some(fit)
    }

    /// Power at a place this far away, (m/s²)².
    pub(super) fn level(&self, [x, y]: [f64; 2]) -> f64 {
        let [value, slope_x, slope_y] = self.beta;
        libm::exp((value + slope_x * x + slope_y * y).clamp(-100.0, 100.0)).max(self.least)
    }
}

/// The normal equations before any segment.
pub(super) fn ridge(slopes: f64, value: f64) -> [[f64; 3]; 3] {
    [[value, 0.0, 0.0], [0.0, slopes, 0.0], [0.0, 0.0, slopes]]
}

/// Adds a segment to the normal equations.
pub(super) fn add(normal: &mut [[f64; 3]; 3], terms: [f64; 3], weight: f64) {
    for (row, x) in normal.iter_mut().zip(terms) {
        for (sum, y) in row.iter_mut().zip(terms) {
            *sum += weight * x * y;
        }
    }
}

/// The inverse of a symmetric matrix.
pub(super) fn inverse(m: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cofactor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    (determinant.abs() > 1e-300)
        .then(|| [0, 1, 2].map(|i| [0, 1, 2].map(|j| cofactor(j, i) / determinant)))
}
