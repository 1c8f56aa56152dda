//! Converts a grid to another sample rate.
//!
//! Every model is fitted again to its own power spectrum at the new rate. Above half the old rate
//! there was no power, except for a floor that keeps the fit regular.
//!
//! ```
//! use asperity::{sources::builtin, passes::rerate::rerate};
//!
//! let grid = builtin::texture().grid;
//! let doubled = rerate(&grid, 2.0 * grid.sample_rate_hz).expect("a rate within range");
//! assert!(doubled.order > grid.order); // the same band is a smaller part of the unit circle
//! assert_eq!(rerate(&grid, 0.0), None);
//! ```

use asperity_formats::limits;
use asperity_texture::{
    model::{GridVertex, ModelGrid, Numerator},
    signal::{
        levinson, lsf,
        spectrum::{ArmaModel, squared_magnitude},
    },
};
use std::f64::consts::TAU;

/// Rates that a grid can be converted to, Hz.
///
/// An order of 24 can follow at most twice the decoder's rate. In faster servo loops the models
/// keep their own rate, and the runtime's upsampler gives the ticks between.
pub const RATE_RANGE_HZ: (f64, f64) = (500.0, 2000.0);
/// Power above half the old rate, relative to the peak.
const FLOOR: f64 = 1e-4;
/// Frequencies over which powers are summed.
const POINTS: usize = 2048;

/// The grid at `rate_hz`; `None` for a rate outside [`RATE_RANGE_HZ`].
///
/// The order grows with the rate, up to the format's limit, because the same band takes a smaller
/// part of the unit circle. A numerator 1 or 1 + z⁻¹ stays, and a numerator of a model's own becomes
/// 1 + z⁻¹. The power in the band that both rates have is kept.
#[must_use]
pub fn rerate(grid: &ModelGrid, rate_hz: f64) -> Option<ModelGrid> {
    let (low, high) = RATE_RANGE_HZ;
    if !(low..=high).contains(&rate_hz) {
        return None;
    }
    if rate_hz == grid.sample_rate_hz {
        return Some(grid.clone());
    }
    let numerator = match grid.numerator {
        Numerator::None => Numerator::None,
        Numerator::Nyquist | Numerator::Lsf => Numerator::Nyquist,
    };
    let grown = (grid.order as f64 * rate_hz / grid.sample_rate_hz).ceil() as usize;
    let order = grown.clamp(grid.order, limits::MAX_ORDER.max(grid.order));
    let vertices = grid
        .vertices
        .iter()
        .map(|vertex| convert(grid, vertex, numerator, order, rate_hz))
        .collect::<Option<Vec<_>>>()?;
    Some(ModelGrid {
        sample_rate_hz: rate_hz,
        order,
        numerator,
        vertices,
        ..grid.clone()
    })
}

fn convert(
    grid: &ModelGrid,
    vertex: &GridVertex,
    numerator: Numerator,
    order: usize,
    rate_hz: f64,
) -> Option<GridVertex> {
    // The spectrum of a silent vertex matters, because its neighbours are mixed with it.
    let model = ArmaModel {
        level_m_s2: 1.0,
        ..ArmaModel::at_vertex(grid, vertex)
    };
    let old_nyquist = 0.5 * grid.sample_rate_hz;
    let common = old_nyquist.min(0.5 * rate_hz);
    let step = common / POINTS as f64;
    let at = |n: usize| (n as f64 + 0.5) * step;
    let peak = (0..POINTS).fold(0.0_f64, |peak, n| peak.max(model.power(at(n))));
    let shape = |omega: f64| {
        let freq_hz = omega / TAU * rate_hz;
        let power = if freq_hz < old_nyquist {
            model.power(freq_hz)
        } else {
            0.0
        };
        let zero = match numerator {
            Numerator::None => 1.0,
            // No frequency here is half the new rate itself.
            _ => squared_magnitude(&[1.0, 1.0], omega).max(1e-3),
        };
        (power + FLOOR * peak) / zero
    };
    let (monic, _) = levinson::all_pole(order, shape);
    let lsf_rad = lsf::from_polynomial(&monic)?;
    let fitted = ArmaModel {
        sample_rate_hz: rate_hz,
        a: monic,
        b: if numerator == Numerator::None {
            vec![1.0]
        } else {
            vec![1.0, 1.0]
        },
        level_m_s2: 1.0,
    };
    // One-sided densities 2·S/rate over the common band.
    let wanted: f64 = (0..POINTS).map(|n| model.power(at(n))).sum::<f64>() / grid.sample_rate_hz;
    let found: f64 = (0..POINTS).map(|n| fitted.power(at(n))).sum::<f64>() / rate_hz;
    Some(GridVertex {
        lsf_rad,
        ma_lsf_rad: None,
        gain: 1.0,
        sigma_m_s2: vertex.gain * vertex.sigma_m_s2 * (wanted / found).sqrt(),
        ..vertex.clone()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;
    use asperity_texture::model::VertexKind;

    #[test]
    fn the_spectrum_stays_where_it_is_in_hertz_within_a_seventh_and_a_db_and_a_half() {
        let grid = builtin::texture().grid;
        for rate_hz in [800.0, 1500.0, 2000.0] {
            let converted = rerate(&grid, rate_hz).unwrap();
            for (x, y) in grid.vertices.iter().zip(&converted.vertices) {
                if x.kind != VertexKind::Interior {
                    continue;
                }
                let of = |grid: &ModelGrid, vertex: &GridVertex| {
                    ArmaModel::at_vertex(grid, vertex).vibration().unwrap()
                };
                let (before, after) = (of(&grid, x), of(&converted, y));
                let shift = after.centroid_hz / before.centroid_hz;
                assert!(
                    (shift - 1.0).abs() < 0.15,
                    "{rate_hz} Hz: centroid × {shift}"
                );
                let level_db = 10.0 * (after.power / before.power).log10();
                assert!(level_db.abs() < 1.5, "{rate_hz} Hz: {level_db} dB");
            }
        }
    }

    #[test]
    fn rates_out_of_range_are_refused() {
        let grid = builtin::texture().grid;
        for rate_hz in [0.0, -1.0, f64::NAN, 1e9] {
            assert!(rerate(&grid, rate_hz).is_none());
        }
    }

    /// Claim: the order grows as the rate does, up to the format's limit, and never falls.
    #[test]
    fn the_order_grows_with_the_rate() {
        let mut grid = builtin::texture().grid;
        grid.order = 4;
        for vertex in &mut grid.vertices {
            vertex.lsf_rad = vec![0.5, 1.1, 1.8, 2.5];
        }
        for (rate_hz, order) in [
            (500.0, 4),
            (1000.0, 4),
            (1200.0, 5),
            (1500.0, 6),
            (2000.0, 8),
        ] {
            let converted = rerate(&grid, rate_hz).unwrap();
            assert_eq!(converted.order, order, "{rate_hz} Hz");
            assert!(converted.vertices.iter().all(|v| v.lsf_rad.len() == order));
        }
        let largest = builtin::texture().grid;
        assert_eq!(rerate(&largest, 2000.0).unwrap().order, limits::MAX_ORDER);
    }
}
