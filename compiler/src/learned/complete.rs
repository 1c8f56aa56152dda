//! Cross-modal completion: the latent of one modality decodes to the other.

use super::{
    description::{GridDescription, TapDescription},
    model::{LearnedModel, Present},
    texture,
};
use asperity_io::diagnostic::Fault;
use asperity_texture::{
    model::{Gains, ModelGrid, TapBank},
    signal::{
        levinson, lsf,
        spectrum::{ArmaModel, squared_magnitude},
    },
};
use std::f64::consts::{PI, TAU};

/// Frequencies at which spectra are mixed.
const POINTS: usize = 512;
/// Power floor relative to the peak, before the zero at half the rate is divided out.
const FLOOR: f64 = 1e-6;
/// Least value of |1 + z⁻¹|² that a spectrum is divided by; at half the rate it is zero.
const LEAST_ZERO: f64 = 1e-3;

/// A tap bank decoded from an AR grid.
///
/// # Errors
/// [`Fault`] when a network fails.
pub fn taps_of_grid(
    model: &LearnedModel,
    grid: &ModelGrid,
    gains: &Gains,
) -> Result<TapBank, Fault> {
    let description = model.description();
    let z = model.encode(Present::Ar(&ar_channels(&description.grid, grid)))?;
    let decoded = model.decode_taps(&z)?;
    Ok(texture::taps(description, &decoded, gains))
}

/// Returns the AR encoder's input for a grid: 21 LSFs and the level in every bin.
///
/// Within the grid the log spectra of a triangle's corners are mixed with their barycentric weights.
/// Bins beyond its rectangle are moved onto the border. Silent corners do not count.
#[must_use]
pub fn ar_channels(bins: &GridDescription, grid: &ModelGrid) -> Vec<f32> {
    let mut channels = Vec::with_capacity(bins.speeds_mm_s.len() * (bins.order + 1));
    for (&speed_mm_s, &force_n) in bins.speeds_mm_s.iter().zip(&bins.forces_n) {
        let (lsf_rad, level_db) = at(grid, speed_mm_s, force_n, bins);
        channels.extend(lsf_rad.iter().map(|&x| x as f32));
        channels.push(level_db as f32);
    }
    channels
}

/// LSFs and level of the AR model at a point of a grid.
fn at(grid: &ModelGrid, speed_mm_s: f64, force_n: f64, bins: &GridDescription) -> (Vec<f64>, f64) {
    let (width, height) = asperity_texture::model::mesh::corner(grid);
    let corners = corners(grid, speed_mm_s.min(width), force_n.min(height));
    let models: Vec<(ArmaModel, f64)> = corners
        .iter()
        .map(|&(vertex, weight)| (ArmaModel::at_vertex(grid, &grid.vertices[vertex]), weight))
        .filter(|(model, weight)| model.level_m_s2 > 0.0 && *weight > 0.0)
        .collect();
    let total: f64 = models.iter().map(|(_, weight)| weight).sum();
    let omegas = (0..POINTS).map(|n| (n as f64 + 0.5) * PI / POINTS as f64);
    let power: Vec<f64> = omegas
        .clone()
        .map(|omega| {
            let freq_hz = omega / TAU * bins.sample_rate_hz;
            let log: f64 = models
                .iter()
                .map(|(model, weight)| weight / total * libm::log(model.power(freq_hz).max(1e-30)))
                .sum();
            libm::exp(log)
        })
        .collect();
    let mean = power.iter().sum::<f64>() / POINTS as f64;
    let peak = power.iter().copied().fold(0.0, f64::max);
    let shaped: Vec<f64> = omegas
        .zip(&power)
        .map(|(omega, p)| {
            (p + FLOOR * peak) / squared_magnitude(&[1.0, 1.0], omega).max(LEAST_ZERO)
        })
        .collect();
    let autocorrelation: Vec<f64> = (0..=bins.order)
        .map(|lag| {
            let sum: f64 = shaped
                .iter()
                .enumerate()
                .map(|(n, p)| p * libm::cos(lag as f64 * (n as f64 + 0.5) * PI / POINTS as f64))
                .sum();
            sum / POINTS as f64
        })
        .collect();
    let (monic, _) = levinson::from_autocorrelation(&autocorrelation);
    // A silent grid has no spectrum. Evenly spaced frequencies are white noise.
    let flat = || {
        (1..=bins.order)
            .map(|k| k as f64 * PI / (bins.order + 1) as f64)
            .collect()
    };
    let level_db = if total > 0.0 {
        10.0 * libm::log10(mean.max(1e-12))
    } else {
        -120.0
    };
    (lsf::from_polynomial(&monic).unwrap_or_else(flat), level_db)
}

/// The triangle around a point with its barycentric weights, or the nearest vertex where rounding
/// leaves the point outside all triangles.
fn corners(grid: &ModelGrid, speed_mm_s: f64, force_n: f64) -> Vec<(usize, f64)> {
    let place = |v: usize| (grid.vertices[v].speed_mm_s, grid.vertices[v].force_n);
    for &[a, b, c] in &grid.triangles {
        let ((ax, ay), (bx, by), (cx, cy)) = (place(a), place(b), place(c));
        let area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
        let u = ((bx - speed_mm_s) * (cy - force_n) - (cx - speed_mm_s) * (by - force_n)) / area;
        let v = ((cx - speed_mm_s) * (ay - force_n) - (ax - speed_mm_s) * (cy - force_n)) / area;
        let w = 1.0 - u - v;
        if [u, v, w].iter().all(|x| *x >= -1e-9) {
            return vec![(a, u.max(0.0)), (b, v.max(0.0)), (c, w.max(0.0))];
        }
    }
    let distance = |v: usize| {
        let (x, y) = place(v);
        (x - speed_mm_s) * (x - speed_mm_s) + (y - force_n) * (y - force_n)
    };
    (0..grid.vertices.len())
        .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
        .map(|nearest| vec![(nearest, 1.0)])
        .unwrap_or_default()
}

/// Returns the tap encoder's input for a bank: traces at the encoder's speeds, rate and length. They are interpolated
/// linearly between the two nearest, and proportional to speed beyond the ends.
#[must_use]
pub fn tap_channels(wanted: &TapDescription, taps: &TapBank) -> Vec<f32> {
    let mut channels = Vec::with_capacity(wanted.speeds_m_s.len() * wanted.samples);
    for &speed_m_s in &wanted.speeds_m_s {
        let mix = speeds(taps, speed_m_s);
        for sample in 0..wanted.samples {
            let t = sample as f64 / wanted.sample_rate_hz * taps.sample_rate_hz;
            let a: f64 = mix
                .iter()
                .map(|&(trace, weight)| weight * linear(&taps.traces[trace].accel_m_s2, t))
                .sum();
            channels.push(a as f32);
        }
    }
    channels
}

fn speeds(taps: &TapBank, speed_m_s: f64) -> Vec<(usize, f64)> {
    let traces = &taps.traces;
    match traces.iter().position(|trace| trace.speed_m_s >= speed_m_s) {
        Some(0) => vec![(0, speed_m_s / traces[0].speed_m_s)],
        Some(above) => {
            let (low, high) = (traces[above - 1].speed_m_s, traces[above].speed_m_s);
            let share = (speed_m_s - low) / (high - low);
            vec![(above - 1, 1.0 - share), (above, share)]
        }
        None => traces
            .last()
            .map(|last| vec![(traces.len() - 1, speed_m_s / last.speed_m_s)])
            .unwrap_or_default(),
    }
}

fn linear(trace: &[f64], t: f64) -> f64 {
    let below = t.floor() as usize;
    let at = |n: usize| trace.get(n).copied().unwrap_or(0.0);
    at(below) + (t - below as f64) * (at(below + 1) - at(below))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;
    use asperity_texture::model::VertexKind;

    #[test]
    fn at_a_vertex_the_channels_are_its_own_model() {
        let texture = builtin::texture();
        let interior: Vec<_> = texture
            .grid
            .vertices
            .iter()
            .filter(|v| v.kind == VertexKind::Interior)
            .collect();
        let bins = GridDescription {
            order: texture.grid.order,
            sample_rate_hz: 1000.0,
            speeds_mm_s: interior.iter().map(|v| v.speed_mm_s).collect(),
            forces_n: interior.iter().map(|v| v.force_n).collect(),
            max_speed_mm_s: 240.0,
            max_force_n: 3.2,
        };
        let channels = ar_channels(&bins, &texture.grid);
        for (vertex, found) in interior.iter().zip(channels.chunks(bins.order + 1)) {
            for (expected, found) in vertex.lsf_rad.iter().zip(found) {
                // Near half the rate the floor under the zero decides.
                if *expected > 2.8 {
                    continue;
                }
                assert!(
                    (expected - f64::from(*found)).abs() < 0.02,
                    "{expected} {found}"
                );
            }
            let level =
                vertex.sigma_m_s2 * asperity_texture::signal::level::nyquist_rms(&vertex.lsf_rad);
            let level_db = 20.0 * libm::log10(level);
            assert!((level_db - f64::from(found[bins.order])).abs() < 0.05);
        }
    }

    #[test]
    fn a_bank_at_the_wanted_speeds_and_rate_stays_as_it_is() {
        let taps = builtin::texture().taps;
        let wanted = TapDescription {
            sample_rate_hz: taps.sample_rate_hz,
            speeds_m_s: taps.traces.iter().map(|t| t.speed_m_s).collect(),
            samples: taps.traces[0].accel_m_s2.len(),
        };
        let channels = tap_channels(&wanted, &taps);
        let expected = taps.traces.iter().flat_map(|t| &t.accel_m_s2);
        for (found, expected) in channels.iter().zip(expected) {
            assert!((f64::from(*found) - expected).abs() < 1e-5);
        }
    }
}
