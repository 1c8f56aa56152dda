//! The gate before an asset is written: the runtime itself renders it over its whole domain.
//!
//! Weights must be convex, filters stable, spectra close to those of the model, and a scripted run of taps, strokes,
//! lost and absurd samples must stay within the limits of force.
//!
//! ```
//! use asperity::{
//!     builtin,
//!     lower::lower,
//!     verify::{VerifyError, verify},
//! };
//!
//! let texture = builtin::texture();
//! let bytes = lower(&texture, None).expect("a texture that fits an asset").bytes;
//! assert!(verify(&texture, &bytes).is_ok());
//!
//! // An asset that sounds unlike its model is refused.
//! let mut louder = texture.clone();
//! louder.grid.vertices[3].sigma_m_s2 *= 1.2;
//! let bytes = lower(&louder, None).expect("a texture that fits an asset").bytes;
//! assert!(matches!(verify(&texture, &bytes), Err(VerifyError::Spectrum { vertex: 3, .. })));
//! ```

mod error;
mod queries;
mod spectra;

pub use error::VerifyError;
pub use spectra::SPECTRUM_BUDGET_DB;

use asperity_formats::Asset;
use asperity_runtime::{Config, Flags, HostTexture, Renderer, Sample, State};
use asperity_texture::model::TextureModel;
use serde::Serialize;

/// What verification found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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

/// Loads the asset into the runtime, queries it at vertices, on edges, over a grid, along the border,
/// beyond it, and at NaN and infinities, then runs it through a script of ticks.
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
    let (queries, max_reflection) = queries::check(&slot, &texture.grid)?;
    let max_db = spectra::check(&slot, &texture.grid)?;
    let (ticks, peak_force_n) = check(&slot, rate_hz)?;
    Ok(VerifyReport {
        queries,
        ticks,
        max_db,
        max_reflection,
        peak_force_n,
    })
}

// A scripted run through the runtime: taps, strokes, lost and absurd samples.

/// Forces may exceed a limit by rounding, relative.
const FORCE_SLACK: f32 = 1e-5;

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
        let fraction = n as f32 / stroke as f32;
        x += 0.4 * fraction / rate_hz;
        // From 0 to 8 mm deep, eight times a second.
        let press = (8.0 * fraction).fract();
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

/// Returns how many ticks ran, and the largest force, N.
///
/// # Errors
/// [`VerifyError::Tick`] with the tick that left the limits.
fn check(slot: &HostTexture, rate_hz: f32) -> Result<(usize, f32), VerifyError> {
    let config = Config {
        servo_rate_hz: rate_hz,
        ..Config::default()
    };
    let renderer = Renderer::new(&config)?;
    let mut state = State::new(1);
    let mut previous = [0.0_f32; 3];
    let (mut ticks, mut peak_force_n) = (0, 0.0_f32);
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
            ticks += 1;
            peak_force_n = peak_force_n.max(norm(force));
            continue;
        };
        return Err(VerifyError::Tick { tick, what });
    }
    Ok((ticks, peak_force_n))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    #[test]
    fn the_builtin_texture_passes() {
        let texture = builtin::texture();
        let report = verify(&texture, &lower(&texture, None).unwrap().bytes).unwrap();
        assert!(report.max_db < 0.1, "{report:?}");
        assert!(report.queries > 2000 && report.ticks > 1000);
        assert!(report.peak_force_n > 1.0);
    }

    #[test]
    fn the_script_presses_eight_times_down_to_eight_millimetres() {
        let depths_m: Vec<f32> = script(1000.0)
            .iter()
            .skip(100)
            .take(1000)
            .map(|sample| -sample.position_m[2])
            .collect();
        let deepest_m = depths_m.iter().copied().fold(0.0, f32::max);
        assert!((0.007_9..=0.008).contains(&deepest_m), "{deepest_m}");
        let pressed = |pair: &[f32]| pair[0] < 0.004 && pair[1] >= 0.004;
        assert_eq!(depths_m.windows(2).filter(|pair| pressed(pair)).count(), 8);
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
