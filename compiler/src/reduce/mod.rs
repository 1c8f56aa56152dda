//! A grid of lower order: fewer poles where fewer do.
//!
//! The autocorrelation of 1/A is kept up to the new order: Levinson's recursion on it
//! has the same first reflection coefficients, so the reduction is to leave out the
//! last ones. The numerator stays; the level is kept exactly.

pub mod order;

use crate::{
    learned::level::nyquist_rms,
    lsf,
    model::{GridVertex, ModelGrid, Numerator, VertexKind},
    reflection,
    spectrum::Angles,
};
use std::{collections::HashMap, f64::consts::TAU, fmt, str::FromStr};

/// Largest RMS log-spectral distance of a bin that `auto` accepts, dB, level free: the
/// 95th percentile over the bins and the worst.
pub const AUTO_BUDGET_DB: (f64, f64) = (0.5, 1.0);
/// Frequencies at which spectra are compared: evenly over 10–450 Hz.
const POINTS: usize = 111;

/// How much of a model an asset keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fidelity {
    /// Everything.
    Full,
    /// The smallest order within [`AUTO_BUDGET_DB`].
    Auto,
    /// This AR order.
    Order(usize),
}

impl FromStr for Fidelity {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const MAX: usize = asperity_formats::limits::MAX_ORDER;
        match text {
            "full" => Ok(Self::Full),
            "auto" => Ok(Self::Auto),
            _ => match text.parse() {
                Ok(order) if (1..=MAX).contains(&order) => Ok(Self::Order(order)),
                _ => Err(format!("`full`, `auto` or an order from 1 to {MAX}")),
            },
        }
    }
}

impl fmt::Display for Fidelity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full => f.write_str("full"),
            Self::Auto => f.write_str("auto"),
            Self::Order(order) => write!(f, "{order}"),
        }
    }
}

/// A grid at the wanted fidelity and the largest distance of an interior bin from the
/// full one, dB (RMS over 10–450 Hz, level free). Grids with a numerator of their own
/// are returned as they are.
#[must_use]
pub fn reduce(grid: &ModelGrid, fidelity: Fidelity) -> (ModelGrid, f64) {
    if grid.numerator == Numerator::Lsf {
        return (grid.clone(), 0.0);
    }
    match fidelity {
        Fidelity::Full => (grid.clone(), 0.0),
        Fidelity::Order(order) if order >= grid.order => (grid.clone(), 0.0),
        Fidelity::Order(order) => {
            let full = Interior::of(grid);
            let worst = full.distances(order).iter().copied().fold(0.0, f64::max);
            (with_order(grid, order), worst)
        }
        Fidelity::Auto => {
            let full = Interior::of(grid);
            // Distances fall with the order: bisection finds the smallest that does.
            let (mut low, mut high) = (1, grid.order);
            let mut worst_db = 0.0;
            while low < high {
                let middle = usize::midpoint(low, high);
                let mut distances = full.distances(middle);
                distances.sort_by(f64::total_cmp);
                let at = |share: f64| {
                    let index = (share * distances.len() as f64).ceil() as usize;
                    distances.get(index.max(1) - 1).copied().unwrap_or(0.0)
                };
                if at(0.95) <= AUTO_BUDGET_DB.0 && at(1.0) <= AUTO_BUDGET_DB.1 {
                    high = middle;
                    worst_db = at(1.0);
                } else {
                    low = middle + 1;
                }
            }
            if high == grid.order {
                return (grid.clone(), 0.0);
            }
            (with_order(grid, high), worst_db)
        }
    }
}

/// Reflection coefficients and log spectra of the interior bins.
struct Interior {
    bins: Vec<(Vec<f64>, Vec<f64>)>,
    /// [`POINTS`] frequencies, evenly over 10–450 Hz.
    angles: Angles,
}

impl Interior {
    fn of(grid: &ModelGrid) -> Self {
        let rate_hz = grid.sample_rate_hz;
        let high = 450.0_f64.min(0.45 * rate_hz);
        let step = (high - 10.0) / (POINTS - 1) as f64;
        let angles = Angles::new((0..POINTS).map(|n| TAU * (10.0 + n as f64 * step) / rate_hz));
        let bins = grid
            .vertices
            .iter()
            .filter(|vertex| vertex.kind == VertexKind::Interior)
            .filter_map(|vertex| {
                let monic = lsf::to_polynomial(&vertex.lsf_rad);
                let reflection = reflection::step_down(&monic)?;
                Some((reflection, log_spectrum(&angles, &monic)))
            })
            .collect();
        Self { bins, angles }
    }

    /// RMS distance of every bin at an order, dB, level free.
    fn distances(&self, order: usize) -> Vec<f64> {
        self.bins
            .iter()
            .map(|(reflection, full)| {
                let kept = &reflection[..order.min(reflection.len())];
                let reduced = log_spectrum(&self.angles, &reflection::step_up(kept));
                let count = full.len() as f64;
                let mean = full.iter().zip(&reduced).map(|(a, b)| a - b).sum::<f64>() / count;
                let squares = full.iter().zip(&reduced).map(|(a, b)| {
                    let difference = a - b - mean;
                    difference * difference
                });
                (squares.sum::<f64>() / count).sqrt()
            })
            .collect()
    }
}

/// −10 log₁₀|A|², dB: a common numerator cancels in differences.
fn log_spectrum(angles: &Angles, monic: &[f64]) -> Vec<f64> {
    let squares = angles.squared_magnitudes(monic);
    squares
        .into_iter()
        .map(|a| -10.0 * libm::log10(a))
        .collect()
}

fn with_order(grid: &ModelGrid, order: usize) -> ModelGrid {
    // Edge models share the frequencies of the bin they continue.
    let mut known: HashMap<Vec<u64>, Option<(Vec<f64>, f64)>> = HashMap::new();
    let vertices = grid
        .vertices
        .iter()
        .map(|vertex| {
            let bits = vertex.lsf_rad.iter().map(|x| x.to_bits()).collect();
            let reduced = known.entry(bits).or_insert_with(|| {
                let reflection = reflection::step_down(&lsf::to_polynomial(&vertex.lsf_rad))?;
                let lsf_rad = lsf::from_polynomial(&reflection::step_up(&reflection[..order]))?;
                let gain = rms(grid, &vertex.lsf_rad) / rms(grid, &lsf_rad);
                Some((lsf_rad, gain))
            });
            match reduced {
                Some((lsf_rad, gain)) => GridVertex {
                    sigma_m_s2: vertex.sigma_m_s2 * *gain,
                    lsf_rad: lsf_rad.clone(),
                    ..vertex.clone()
                },
                None => vertex.clone(),
            }
        })
        .collect();
    ModelGrid {
        order,
        vertices,
        ..grid.clone()
    }
}

/// RMS of the filter driven by unit white noise.
fn rms(grid: &ModelGrid, lsf_rad: &[f64]) -> f64 {
    match grid.numerator {
        Numerator::Nyquist => nyquist_rms(lsf_rad),
        Numerator::None | Numerator::Lsf => {
            let monic = lsf::to_polynomial(lsf_rad);
            reflection::step_down(&monic).map_or(f64::INFINITY, |reflection| {
                reflection
                    .iter()
                    .map(|k| 1.0 / ((1.0 - k) * (1.0 + k)).sqrt())
                    .product()
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{builtin, spectrum::ArmaModel};

    fn level(grid: &ModelGrid, vertex: &GridVertex) -> f64 {
        let model = ArmaModel::at_vertex(grid, vertex);
        (0..2000)
            .map(|n| model.power(0.25 * (f64::from(n) + 0.5)))
            .sum()
    }

    #[test]
    fn a_lower_order_keeps_the_level_of_every_bin() {
        let full = builtin::texture().grid;
        for order in [1, 4, 9] {
            let (reduced, _) = reduce(&full, Fidelity::Order(order));
            assert_eq!(reduced.order, order);
            for (x, y) in full.vertices.iter().zip(&reduced.vertices) {
                if x.sigma_m_s2 > 0.0 {
                    let ratio = level(&reduced, y) / level(&full, x);
                    assert!((ratio - 1.0).abs() < 1e-6, "order {order}: {ratio}");
                }
            }
        }
    }

    #[test]
    fn auto_is_the_smallest_order_within_its_budget() {
        let full = builtin::texture().grid;
        let (auto, worst_db) = reduce(&full, Fidelity::Auto);
        assert!(worst_db <= AUTO_BUDGET_DB.1);
        if auto.order > 1 {
            let below = Interior::of(&full).distances(auto.order - 1);
            let over = below.iter().filter(|d| **d > AUTO_BUDGET_DB.0).count();
            assert!(over > 0, "order {} would do", auto.order - 1);
        }
    }
}
