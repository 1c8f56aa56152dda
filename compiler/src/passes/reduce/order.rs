//! Lowers the order of a grid, and replaces its numerator by one that costs nothing.
//!
//! Where the numerator stays 1 or 1 + z⁻¹, a lower order keeps the autocorrelation of 1/A up to
//! that order. Levinson's recursion on it has the same first reflection coefficients, so the
//! reduction leaves out the last ones. Where the numerator changes, the poles are fitted once to
//! the power spectrum over the new numerator, at the largest order; lower orders are its first
//! reflection coefficients. The level is kept.

use asperity_formats::limits;
use asperity_texture::{
    model::{GridVertex, ModelGrid, Numerator},
    signal::{
        level, levinson, lsf, reflection,
        spectrum::{ArmaModel, squared_magnitude},
    },
};
use std::{collections::HashMap, f64::consts::PI};

/// Floor of the power under a fit, relative to the peak: 60 dB down.
const FLOOR: f64 = 1e-6;
/// Least |1 + z⁻¹|² that a spectrum is divided by.
const LEAST_ZERO: f64 = 1e-4;
/// Frequencies over which a power is summed.
const POINTS: u32 = 2048;

/// The models of a grid under another numerator, ready for any order.
#[derive(Debug, Clone)]
pub struct Fits<'a> {
    grid: &'a ModelGrid,
    numerator: Numerator,
    /// Reflection coefficients, and RMS at unit level, of every distinct model.
    fits: Vec<(Vec<f64>, f64)>,
    /// Index of the model of every vertex.
    fit_of: Vec<usize>,
}

impl<'a> Fits<'a> {
    /// Prepares a grid. `None` for a numerator of a model's own, to which nothing is fitted, and
    /// for models that are not stable.
    #[must_use]
    pub fn new(grid: &'a ModelGrid, numerator: Numerator) -> Option<Self> {
        if numerator == Numerator::Lsf {
            return None;
        }
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut fits = Vec::new();
        let mut fit_of = Vec::new();
        for vertex in &grid.vertices {
            // Edge models share the frequencies of the vertex they continue.
            let ma = vertex.ma_lsf_rad.as_deref().unwrap_or_default();
            let bits = vertex.lsf_rad.iter().chain(ma).map(|x| x.to_bits());
            let next = fits.len();
            let index = *known.entry(bits.collect()).or_insert(next);
            if index == next {
                fits.push(fit(grid, vertex, numerator)?);
            }
            fit_of.push(index);
        }
        Some(Self {
            grid,
            numerator,
            fits,
            fit_of,
        })
    }

    /// The numerator.
    #[must_use]
    pub fn numerator(&self) -> Numerator {
        self.numerator
    }

    /// Largest order there is.
    #[must_use]
    pub fn largest(&self) -> usize {
        self.fits.iter().map(|(r, _)| r.len()).min().unwrap_or(0)
    }

    /// The grid at an order. `None` above the largest order.
    #[must_use]
    pub fn at(&self, order: usize) -> Option<ModelGrid> {
        if order == 0 || order > self.largest() {
            return None;
        }
        let reduced = self
            .fits
            .iter()
            .map(|(reflection, rms)| {
                let reflection = &reflection[..order];
                let scale = rms / unit_rms(reflection, self.numerator);
                (lsf::from_reflection(reflection), scale)
            })
            .collect::<Vec<_>>();
        let vertices = self
            .grid
            .vertices
            .iter()
            .zip(&self.fit_of)
            .map(|(vertex, &fit)| GridVertex {
                lsf_rad: reduced[fit].0.clone(),
                ma_lsf_rad: None,
                gain: 1.0,
                sigma_m_s2: vertex.gain * vertex.sigma_m_s2 * reduced[fit].1,
                ..vertex.clone()
            })
            .collect();
        Some(ModelGrid {
            order,
            numerator: self.numerator,
            vertices,
            ..self.grid.clone()
        })
    }
}

/// Reflection coefficients under a numerator, and the RMS of the model at unit level.
fn fit(grid: &ModelGrid, vertex: &GridVertex, numerator: Numerator) -> Option<(Vec<f64>, f64)> {
    let model = ArmaModel {
        level_m_s2: 1.0,
        ..ArmaModel::at_vertex(grid, vertex)
    };
    if numerator == grid.numerator {
        let reflection = reflection::step_down(&model.a)?;
        let rms = unit_rms(&reflection, numerator);
        return Some((reflection, rms));
    }
    let power =
        |omega: f64| squared_magnitude(&model.b, omega) / squared_magnitude(&model.a, omega);
    let at = |n: u32| (f64::from(n) + 0.5) * PI / f64::from(POINTS);
    let powers: Vec<f64> = (0..POINTS).map(|n| power(at(n))).collect();
    let peak = powers.iter().copied().fold(0.0, f64::max);
    let (monic, _) = levinson::all_pole(limits::MAX_ORDER, |omega| {
        let zero = match numerator {
            Numerator::None => 1.0,
            Numerator::Nyquist | Numerator::Lsf => {
                squared_magnitude(&[1.0, 1.0], omega).max(LEAST_ZERO)
            }
        };
        (power(omega) + FLOOR * peak) / zero
    });
    let mean = powers.iter().sum::<f64>() / f64::from(POINTS);
    Some((reflection::step_down(&monic)?, mean.sqrt()))
}

/// RMS of the filter driven by unit white noise.
fn unit_rms(reflection: &[f64], numerator: Numerator) -> f64 {
    match numerator {
        Numerator::Nyquist => level::nyquist_rms_of(reflection),
        Numerator::None | Numerator::Lsf => level::all_pole_variance(reflection).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;

    fn level(grid: &ModelGrid, vertex: &GridVertex) -> f64 {
        let model = ArmaModel::at_vertex(grid, vertex);
        (0..2000)
            .map(|n| model.power(0.25 * (f64::from(n) + 0.5)))
            .sum()
    }

    #[test]
    fn a_lower_order_has_no_numerator_of_its_own() {
        let mut full = builtin::texture().grid;
        full.numerator = Numerator::Lsf;
        for vertex in &mut full.vertices {
            vertex.ma_lsf_rad = Some(vertex.lsf_rad.clone());
        }
        let reduced = Fits::new(&full, Numerator::Nyquist).unwrap().at(4).unwrap();
        assert!(reduced.vertices.iter().all(|v| v.ma_lsf_rad.is_none()));
    }

    #[test]
    fn a_lower_order_keeps_the_level_of_every_vertex() {
        let full = builtin::texture().grid;
        for numerator in [Numerator::Nyquist, Numerator::None] {
            let fits = Fits::new(&full, numerator).unwrap();
            for order in [1, 4, 9] {
                let reduced = fits.at(order).unwrap();
                assert_eq!((reduced.order, reduced.numerator), (order, numerator));
                for (x, y) in full.vertices.iter().zip(&reduced.vertices) {
                    if x.sigma_m_s2 > 0.0 {
                        let ratio = level(&reduced, y) / level(&full, x);
                        assert!((ratio - 1.0).abs() < 1e-3, "order {order}: {ratio}");
                    }
                }
            }
        }
    }

    /// Claim: what a zero at half the rate takes away, the poles give back: a model without zeros keeps
    /// its spectrum under either numerator.
    #[test]
    fn a_spectrum_is_kept_under_another_numerator() {
        use asperity_texture::signal::spectrum::log_spectral_distance_db;
        let mut full = builtin::texture().grid;
        full.order = 4;
        full.numerator = Numerator::None;
        for vertex in &mut full.vertices {
            vertex.lsf_rad = vec![0.4, 0.7, 1.6, 2.4];
        }
        let reduced = Fits::new(&full, Numerator::Nyquist)
            .unwrap()
            .at(16)
            .unwrap();
        for (x, y) in full.vertices.iter().zip(&reduced.vertices) {
            if x.sigma_m_s2 > 0.0 {
                let [x, y] = [(&full, x), (&reduced, y)].map(|(g, v)| ArmaModel::at_vertex(g, v));
                let distance_db = log_spectral_distance_db(&x, &y);
                assert!(distance_db < 1.0, "{distance_db} dB");
            }
        }
    }
}
