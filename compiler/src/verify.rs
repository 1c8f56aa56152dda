//! The gate before an asset is written: the real runtime, driven over the whole domain.

use crate::{
    diagnostic::Diagnostic,
    mesh,
    model::{ModelGrid, TextureModel},
    reflection::{LANES, largest_reflections},
    spectrum::{ArmaModel, ERROR_POINTS, ErrorBand},
};
use asperity_formats::{Asset, FormatError};
use asperity_runtime::{
    Config, ConfigError, Filter, Flags, HostTexture, LoadError, Renderer, Sample, State,
};
use thiserror::Error;

/// Largest RMS log-spectral error of a vertex as the runtime renders it, dB.
pub const SPECTRUM_BUDGET_DB: f64 = 0.5;
/// Steps of the query grid along each axis, from below zero to beyond the border.
const GRID_STEPS: usize = 40;
/// Points of the walk along each side of the border.
const BORDER_STEPS: usize = 200;
/// Weights may differ from a sum of one by this, in f32.
const SUM_TOLERANCE: f32 = 1e-5;
/// Sound allowed where the model is silent, relative to the loudest vertex.
const SILENCE_SHARE: f64 = 1e-4;
/// Forces may exceed a limit by rounding, relative.
const FORCE_SLACK: f32 = 1e-5;

/// Why an asset is not fit to be written.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// A reader rejects the bytes.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The runtime's slot refuses the texture.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The servo rate is none the runtime can have.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// Weights that are not convex, or a vertex that is not there.
    #[error(
        "at {speed_mm_s} mm/s and {force_n} N the weights are {weights:?} of vertices {vertices:?}"
    )]
    Weights {
        /// Speed of the query.
        speed_mm_s: f32,
        /// Force of the query.
        force_n: f32,
        /// Vertices found.
        vertices: [u8; 3],
        /// Weights found.
        weights: [f32; 3],
    },
    /// A filter that is not finite or has a pole on or outside the unit circle.
    #[error("at {speed_mm_s} mm/s and {force_n} N the filter is not stable")]
    Unstable {
        /// Speed of the query.
        speed_mm_s: f32,
        /// Force of the query.
        force_n: f32,
    },
    /// A vertex whose rendered spectrum is too far from its model's.
    #[error("vertex {vertex} is rendered {distance_db:.3} dB from its model, {budget_db} at most")]
    Spectrum {
        /// Index of the vertex.
        vertex: usize,
        /// RMS log-spectral distance, dB.
        distance_db: f64,
        /// What is allowed, dB.
        budget_db: f64,
    },
    /// A tick that left the limits, or clamped the vibration.
    #[error("tick {tick} of the scripted run: {what}")]
    Tick {
        /// Index of the tick.
        tick: usize,
        /// What went wrong.
        what: &'static str,
    },
}

impl Diagnostic for VerifyError {
    fn remedy(&self) -> String {
        match self {
            Self::Format(_) | Self::Load(_) | Self::Config(_) => {
                "bring the source within the limits of a texture".into()
            }
            Self::Weights { .. } => "triangulate the source anew around this point".into(),
            Self::Unstable { .. } => "widen the resonances of the models around this point".into(),
            Self::Spectrum { .. } => {
                "keep vertices apart and resonances wide enough for single precision".into()
            }
            Self::Tick { .. } => "lower the gains or the level of the source".into(),
        }
    }
}

/// What the gate saw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerifyReport {
    /// Queries of speed and force.
    pub queries: usize,
    /// Ticks of the scripted run.
    pub ticks: usize,
    /// Largest distance of a sounding vertex's rendered spectrum from its model, dB.
    pub max_db: f64,
    /// Largest reflection coefficient met, below 1.
    pub max_reflection: f64,
    /// Largest force of the scripted run, N.
    pub peak_force_n: f32,
}

/// Loads the asset into the runtime and drives it over vertices, edges, a grid, the
/// border, beyond it, NaN and infinities, then through a script of ticks.
///
/// `texture` is what the asset was made from.
///
/// # Errors
/// The first [`VerifyError`] met.
pub fn verify(texture: &TextureModel, bytes: &[u8]) -> Result<VerifyReport, VerifyError> {
    let asset = Asset::parse(bytes)?;
    let rate_hz = asset.grid().sample_rate_hz();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, rate_hz)?;
    let mut report = VerifyReport {
        queries: 0,
        ticks: 0,
        max_db: 0.0,
        max_reflection: 0.0,
        peak_force_n: 0.0,
    };
    let queries = queries(&texture.grid);
    report.queries = queries.len();
    for together in queries.chunks(LANES) {
        let reflection = check_queries(&slot, &texture.grid, together)?;
        report.max_reflection = report.max_reflection.max(reflection);
    }
    report.max_db = check_spectra(&slot, &texture.grid)?;
    check_ticks(&slot, rate_hz, &mut report)?;
    Ok(report)
}

/// Every place worth asking for, and some that are not places.
fn queries(grid: &ModelGrid) -> Vec<(f32, f32)> {
    let mut places = Vec::new();
    for vertex in &grid.vertices {
        places.push((vertex.speed_mm_s, vertex.force_n));
    }
    let at = |v: usize| (grid.vertices[v].speed_mm_s, grid.vertices[v].force_n);
    for &[a, b, c] in &grid.triangles {
        let (a, b, c) = (at(a), at(b), at(c));
        for (p, q) in [(a, b), (b, c), (c, a)] {
            places.push(((p.0 + q.0) / 2.0, (p.1 + q.1) / 2.0));
        }
        places.push(((a.0 + b.0 + c.0) / 3.0, (a.1 + b.1 + c.1) / 3.0));
    }
    let (width, height) = mesh::corner(grid);
    for i in 0..=GRID_STEPS {
        for j in 0..=GRID_STEPS {
            let share = |k: usize| 1.5 * k as f64 / GRID_STEPS as f64 - 0.25;
            places.push((share(i) * width, share(j) * height));
        }
    }
    for step in 0..=BORDER_STEPS {
        let share = step as f64 / BORDER_STEPS as f64;
        places.extend([
            (share * width, 0.0),
            (share * width, height),
            (0.0, share * height),
            (width, share * height),
        ]);
    }
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1e30];
    for v in odd {
        for f in odd {
            places.push((v, f));
        }
    }
    places
        .into_iter()
        .map(|(v, f)| (v as f32, f as f32))
        .collect()
}

/// Checks up to [`LANES`] queries, whose filters are stepped down side by side; returns the
/// largest reflection coefficient.
fn check_queries(
    slot: &HostTexture,
    grid: &ModelGrid,
    queries: &[(f32, f32)],
) -> Result<f64, VerifyError> {
    // Lanes without a query hold A(z) = 1.
    let mut monic = vec![[0.0; LANES]; grid.order + 1];
    monic[0] = [1.0; LANES];
    for (lane, &(speed_mm_s, force_n)) in queries.iter().enumerate() {
        let filter = check_query(slot, grid, speed_mm_s, force_n)?;
        for (row, &coefficient) in monic[1..].iter_mut().zip(&filter.a) {
            row[lane] = f64::from(coefficient);
        }
    }
    let largest = largest_reflections(&mut monic);
    if let Some((_, &(speed_mm_s, force_n))) = largest
        .iter()
        .zip(queries)
        .find(|(reflection, _)| reflection.is_infinite())
    {
        return Err(VerifyError::Unstable {
            speed_mm_s,
            force_n,
        });
    }
    Ok(largest.into_iter().fold(0.0, f64::max))
}

/// Checks the weights of a query and that its filter is finite.
fn check_query(
    slot: &HostTexture,
    grid: &ModelGrid,
    speed_mm_s: f32,
    force_n: f32,
) -> Result<Filter, VerifyError> {
    let found = slot.weights_at(speed_mm_s, force_n);
    let sum: f32 = found.values().iter().sum();
    let convex = found.values().iter().all(|w| (0.0..=1.0).contains(w))
        && (sum - 1.0).abs() <= SUM_TOLERANCE
        && found
            .vertices
            .iter()
            .all(|&v| usize::from(v) < grid.vertices.len());
    if !convex {
        return Err(VerifyError::Weights {
            speed_mm_s,
            force_n,
            vertices: found.vertices,
            weights: found.values(),
        });
    }
    let filter = slot.filter_of(&found);
    let finite = filter.b.iter().all(|b| b.is_finite())
        && filter.level_m_s2.is_finite()
        && filter.level_m_s2 >= 0.0;
    if !finite {
        return Err(VerifyError::Unstable {
            speed_mm_s,
            force_n,
        });
    }
    Ok(filter)
}

fn monic(coefficients: &[f32], order: usize) -> Vec<f64> {
    std::iter::once(1.0)
        .chain(coefficients.iter().take(order).map(|&c| f64::from(c)))
        .collect()
}

/// The runtime's filter as a model to compare.
fn rendered(grid: &ModelGrid, filter: &Filter) -> ArmaModel {
    ArmaModel {
        sample_rate_hz: grid.sample_rate_hz,
        a: monic(&filter.a, grid.order),
        b: monic(&filter.b, filter.b.len()),
        level_m_s2: f64::from(filter.level_m_s2),
    }
}

/// Returns the largest distance of a sounding vertex, dB.
fn check_spectra(slot: &HostTexture, grid: &ModelGrid) -> Result<f64, VerifyError> {
    let loudest = grid
        .vertices
        .iter()
        .fold(0.0, |m: f64, v| m.max(v.gain * v.sigma_m_s2));
    let band = ErrorBand::new(grid.sample_rate_hz, ERROR_POINTS);
    let mut max_db = 0.0_f64;
    for (index, vertex) in grid.vertices.iter().enumerate() {
        let filter = slot.filter_at(vertex.speed_mm_s as f32, vertex.force_n as f32);
        let found = rendered(grid, &filter);
        // Vertices at one position: the runtime may answer with any of them.
        let distance_db = grid
            .vertices
            .iter()
            .filter(|twin| twin.speed_mm_s == vertex.speed_mm_s && twin.force_n == vertex.force_n)
            .map(|twin| {
                let expected = ArmaModel::at_vertex(grid, twin);
                if expected.level_m_s2 <= SILENCE_SHARE * loudest {
                    let silent = found.level_m_s2 <= 2.0 * SILENCE_SHARE * loudest;
                    if silent { 0.0 } else { f64::INFINITY }
                } else {
                    band.distance_db(&expected, &found)
                }
            })
            .fold(f64::INFINITY, f64::min);
        if distance_db > SPECTRUM_BUDGET_DB {
            return Err(VerifyError::Spectrum {
                vertex: index,
                distance_db,
                budget_db: SPECTRUM_BUDGET_DB,
            });
        }
        max_db = max_db.max(distance_db);
    }
    Ok(max_db)
}

/// A tap, a circular stroke through all speeds and forces, lost and absurd samples.
fn script(rate_hz: f32) -> Vec<Sample> {
    let seconds = |s: f32| (s * rate_hz) as usize;
    let mut samples = Vec::new();
    let approach = seconds(0.1);
    for n in 0..approach {
        // From 5 mm above to 2 mm below.
        let z = 0.005 - 0.007 * n as f32 / approach as f32;
        samples.push(Sample::at([0.0, 0.0, z]));
    }
    let stroke = seconds(1.0);
    let mut x = 0.0;
    for n in 0..stroke {
        let share = n as f32 / stroke as f32;
        x += 0.4 * share / rate_hz;
        // Every eighth of a second deeper and back: 0 to 8 mm.
        let press = (8.0 * share).fract();
        samples.push(Sample::at([x, 0.0, -0.008 * press * (2.0 - press)]));
    }
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30];
    for value in odd {
        for k in 0..4 {
            let mut position_m = [x, 0.0, -0.002];
            position_m[k % 3] = value;
            samples.push(Sample::at(position_m));
        }
        samples.extend([Sample::STALE; 3]);
        samples.extend([Sample::at([x, 0.0, -0.002]); 20]);
    }
    samples.extend(vec![Sample::at([x, 0.0, -0.002]); seconds(0.2)]);
    samples
}

fn check_ticks(
    slot: &HostTexture,
    rate_hz: f32,
    report: &mut VerifyReport,
) -> Result<(), VerifyError> {
    let config = Config {
        servo_rate_hz: rate_hz,
        ..Config::default()
    };
    let renderer = Renderer::new(&config)?;
    let mut state = State::new(1);
    let mut previous = [0.0_f32; 3];
    let slack = 1.0 + FORCE_SLACK;
    let peak_n = config.limits.peak_n * slack;
    let step_n = config.limits.slew_n_s / rate_hz * slack + FORCE_SLACK;
    for (tick, sample) in script(rate_hz).iter().enumerate() {
        let output = renderer.tick(slot, &mut state, sample);
        let force = output.force_n;
        let norm = |v: [f32; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        let step = norm([
            force[0] - previous[0],
            force[1] - previous[1],
            force[2] - previous[2],
        ]);
        previous = force;
        let numbers = [
            output.depth_m,
            output.speed_mm_s,
            output.normal_force_n,
            output.vib_m_s2,
            output.tap_n,
            output.friction_n,
            norm(force),
        ];
        let what = if numbers.iter().any(|x| !x.is_finite()) {
            "an output is not finite"
        } else if norm(force) > peak_n {
            "the force exceeds the device's peak"
        } else if step > step_n {
            "the force exceeds the device's slew"
        } else if output.flags.contains(Flags::VIB_CLAMPED) {
            "the vibration had to be clamped"
        } else {
            report.ticks += 1;
            report.peak_force_n = report.peak_force_n.max(norm(force));
            continue;
        };
        return Err(VerifyError::Tick { tick, what });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{builtin, lower::lower};

    #[test]
    fn the_builtin_texture_passes() {
        let texture = builtin::texture();
        let report = verify(&texture, &lower(&texture, None).unwrap().bytes).unwrap();
        assert!(report.max_db < 0.1, "{report:?}");
        assert!(report.queries > 2000 && report.ticks > 1000);
        assert!(report.peak_force_n > 1.0);
    }

    #[test]
    fn an_asset_of_another_texture_is_refused() {
        let texture = builtin::texture();
        let mut other = texture.clone();
        other.grid.vertices[3].sigma_m_s2 *= 1.2;
        let bytes = lower(&other, None).unwrap().bytes;
        assert!(matches!(
            verify(&texture, &bytes),
            Err(VerifyError::Spectrum { vertex: 3, .. })
        ));
    }

    #[test]
    fn a_deafening_texture_is_refused() {
        let mut texture = builtin::texture();
        for vertex in &mut texture.grid.vertices {
            vertex.sigma_m_s2 *= 4_000.0;
        }
        let bytes = lower(&texture, None).unwrap().bytes;
        assert!(matches!(
            verify(&texture, &bytes),
            Err(VerifyError::Tick { .. })
        ));
    }
}
