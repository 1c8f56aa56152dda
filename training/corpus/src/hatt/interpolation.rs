//! A material between its own models: its grid, and the growth of its level.

use super::ar::Sounding;
use crate::ORDER;

/// Bounds of the exponents. Larger ones come from a few models that lie close together.
const SPEED_EXPONENTS: (f64, f64) = (0.0, 2.0);
const FORCE_EXPONENTS: (f64, f64) = (-0.5, 1.5);
/// Least independence of speeds and forces, 1 − r², for which two exponents are fitted.
const LEAST_INDEPENDENCE: f64 = 1e-3;

/// The models of a material on its own triangles.
#[derive(Debug, Clone)]
pub(super) struct OwnGrid {
    /// The model of each vertex; `None` where a vertex is silent.
    pub models: Vec<Option<Sounding>>,
    /// Speed, mm/s, and force, N, of each vertex.
    pub places: Vec<(f64, f64)>,
    /// Indices of vertices.
    pub triangles: Vec<[usize; 3]>,
    /// Right and upper border, mm/s and N.
    pub corner: (f64, f64),
}

impl OwnGrid {
    /// Returns true if a vertex lies on the border of the rectangle, where models are extrapolated rather than
    /// measured.
    pub(super) fn is_edge(&self, vertex: usize) -> bool {
        let (speed_mm_s, force_n) = self.places[vertex];
        let on = |value: f64, border: f64| value == 0.0 || value == border;
        on(speed_mm_s, self.corner.0) || on(force_n, self.corner.1)
    }

    /// The measured models.
    pub(super) fn samples(&self) -> impl Iterator<Item = &Sounding> {
        self.models
            .iter()
            .enumerate()
            .filter(|(vertex, _)| !self.is_edge(*vertex))
            .filter_map(|(_, model)| model.as_ref())
    }

    /// The models around a place that vibrate, with positive weights whose sum is one.
    ///
    /// They are the corners of the place's triangle, weighted by barycentric coordinates. A place
    /// outside is moved to the border. Where all corners are silent, the nearest model is used alone.
    pub(super) fn around(&self, speed_mm_s: f64, force_n: f64) -> Vec<(f64, &Sounding)> {
        let place = (speed_mm_s.min(self.corner.0), force_n.min(self.corner.1));
        let mut best = (f64::NEG_INFINITY, [0; 3], [0.0; 3]);
        for corners in &self.triangles {
            let Some(weights) = barycentric(place, corners.map(|c| self.places[c])) else {
                continue;
            };
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            if least > best.0 {
                best = (least, *corners, weights);
            }
        }
        let (_, corners, weights) = best;
        let mut around: Vec<(f64, &Sounding)> = corners
            .iter()
            .zip(weights)
            .filter_map(|(&corner, weight)| Some((weight, self.models[corner].as_ref()?)))
            .filter(|(weight, _)| *weight > 1e-9)
            .collect();
        let sum: f64 = around.iter().map(|(weight, _)| weight).sum();
        for (weight, _) in &mut around {
            *weight /= sum;
        }
        if around.is_empty() {
            around.extend(self.nearest(place).map(|model| (1.0, model)));
        }
        around
    }

    fn nearest(&self, place: (f64, f64)) -> Option<&Sounding> {
        let squared = |model: &Sounding| {
            let x = (model.speed_mm_s - place.0) / self.corner.0;
            let y = (model.force_n - place.1) / self.corner.1;
            x * x + y * y
        };
        let all = self.models.iter().flatten();
        all.min_by(|a, b| squared(a).total_cmp(&squared(b)))
    }
}

/// Barycentric coordinates; `None` for a triangle without area.
fn barycentric(place: (f64, f64), corners: [(f64, f64); 3]) -> Option<[f64; 3]> {
    let cross = |o: (f64, f64), a: (f64, f64), b: (f64, f64)| {
        (a.0 - o.0) * (b.1 - o.1) - (a.1 - o.1) * (b.0 - o.0)
    };
    let [a, b, c] = corners;
    let area = cross(a, b, c);
    let weights = [
        cross(place, b, c) / area,
        cross(a, place, c) / area,
        cross(a, b, place) / area,
    ];
    weights.iter().all(|w| w.is_finite()).then_some(weights)
}

/// Weighted mean of LSFs. It is ordered because all of them are.
pub(super) fn mixed_lsf<'a>(
    parts: impl IntoIterator<Item = (f64, &'a [f64; ORDER])>,
) -> [f64; ORDER] {
    let mut mixed = [0.0; ORDER];
    for (weight, lsf_rad) in parts {
        for (sum, omega) in mixed.iter_mut().zip(lsf_rad) {
            *sum += weight * omega;
        }
    }
    mixed
}

/// RMS ∝ speed^`speed`·force^`force`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Growth {
    pub speed: f64,
    pub force: f64,
}

impl Growth {
    /// Least-squares fit of levels over 20·log₁₀ of speed and force; exponents of 0 where the models
    /// do not determine them.
    pub(super) fn of<'a>(models: impl Iterator<Item = &'a Sounding>) -> Self {
        let rows: Vec<[f64; 3]> = models
            .map(|m| {
                [
                    20.0 * libm::log10(m.speed_mm_s),
                    20.0 * libm::log10(m.force_n),
                    m.level_db,
                ]
            })
            .collect();
        let count = rows.len().max(1) as f64;
        let mean: [f64; 3] =
            std::array::from_fn(|k| rows.iter().map(|row| row[k]).sum::<f64>() / count);
        let product = |i: usize, j: usize| -> f64 {
            rows.iter()
                .map(|row| (row[i] - mean[i]) * (row[j] - mean[j]))
                .sum()
        };
        let (vv, ff, vf) = (product(0, 0), product(1, 1), product(0, 1));
        let (vl, fl) = (product(0, 2), product(1, 2));
        let determinant = vv * ff - vf * vf;
        // Two models, or models on a line, do not determine two exponents.
        if determinant <= LEAST_INDEPENDENCE * vv * ff {
            return Self {
                speed: 0.0,
                force: 0.0,
            };
        }
        Self {
            speed: ((vl * ff - fl * vf) / determinant).clamp(SPEED_EXPONENTS.0, SPEED_EXPONENTS.1),
            force: ((fl * vv - vl * vf) / determinant).clamp(FORCE_EXPONENTS.0, FORCE_EXPONENTS.1),
        }
    }

    /// The level that a model has at another place, dB.
    pub(super) fn carried(&self, model: &Sounding, speed_mm_s: f64, force_n: f64) -> f64 {
        model.level_db
            + self.speed * 20.0 * libm::log10(speed_mm_s / model.speed_mm_s)
            + self.force * 20.0 * libm::log10(force_n / model.force_n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(speed_mm_s: f64, force_n: f64) -> Sounding {
        Sounding {
            speed_mm_s,
            force_n,
            lsf_rad: std::array::from_fn(|k| (k as f64 + speed_mm_s / 1000.0 + 0.5) / 7.5),
            level_db: 3.0 + 0.8 * 20.0 * libm::log10(speed_mm_s) + 5.0 * libm::log10(force_n),
        }
    }

    /// Corners of a rectangle, the lower left one at rest, and a model inside.
    fn grid() -> OwnGrid {
        let places = vec![
            (0.0, 0.0),
            (200.0, 0.0),
            (200.0, 4.0),
            (0.0, 4.0),
            (80.0, 1.5),
        ];
        OwnGrid {
            models: vec![
                None,
                None,
                Some(model(200.0, 4.0)),
                None,
                Some(model(80.0, 1.5)),
            ],
            places,
            triangles: vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
            corner: (200.0, 4.0),
        }
    }

    #[test]
    fn exponents_of_a_power_law_are_found() {
        let models: Vec<Sounding> = [(50.0, 0.5), (120.0, 0.7), (90.0, 2.0), (200.0, 1.3)]
            .map(|(v, f)| model(v, f))
            .into();
        let growth = Growth::of(models.iter());
        assert!((growth.speed - 0.8).abs() < 1e-9 && (growth.force - 0.25).abs() < 1e-9);
        let carried = growth.carried(&models[0], 180.0, 3.0);
        assert!((carried - model(180.0, 3.0).level_db).abs() < 1e-9);
    }

    #[test]
    fn models_on_a_line_have_no_exponents() {
        let models = [(50.0, 1.0), (100.0, 1.0), (150.0, 1.0)].map(|(v, f)| model(v, f));
        let flat = Growth {
            speed: 0.0,
            force: 0.0,
        };
        assert_eq!(Growth::of(models.iter()), flat);
        assert_eq!(Growth::of(models[..1].iter()), flat);
        assert_eq!(Growth::of([].iter()), flat);
    }

    #[test]
    fn weights_are_convex_everywhere_and_exact_at_a_model() {
        let grid = grid();
        for step in 0..400 {
            let place = (f64::from(step % 20) * 15.0, f64::from(step / 20) * 0.3);
            let around = grid.around(place.0, place.1);
            let sum: f64 = around.iter().map(|(w, _)| w).sum();
            assert!((sum - 1.0).abs() < 1e-9 && around.iter().all(|(w, _)| *w > 0.0));
        }
        assert_eq!(grid.around(80.0, 1.5), [(1.0, &model(80.0, 1.5))]);
    }

    #[test]
    fn beyond_the_grid_its_border_counts() {
        let grid = grid();
        assert_eq!(grid.around(900.0, 9.0), grid.around(200.0, 4.0));
        // A triangle of silent corners alone.
        let mut bare = grid.clone();
        bare.models[4] = None;
        assert_eq!(bare.around(10.0, 0.1), [(1.0, &model(200.0, 4.0))]);
    }

    #[test]
    fn only_models_inside_count_as_measured() {
        let grid = grid();
        let samples: Vec<f64> = grid.samples().map(|m| m.speed_mm_s).collect();
        assert_eq!(samples, [80.0]);
    }
}
