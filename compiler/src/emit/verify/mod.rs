//! The gate before an asset is written: the runtime itself renders it over its whole domain.
//!
//! Weights must be convex, filters stable, spectra close to those of the model, and a scripted run of taps, strokes,
//! lost and absurd samples must stay within the limits of force.
//!
//! ```
//! use asperity::{sources::builtin, emit::{lower::lower, verify::{VerifyError, verify}}};
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
use asperity_runtime::{Config, Flags, HostTexture, Output, Renderer, Sample, State};
use asperity_texture::model::TextureModel;
use serde::Serialize;

/// Verification results.
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
        if let Some(what) = broken(&output, previous, peak_n, step_n) {
            return Err(VerifyError::Tick { tick, what });
        }
        previous = output.force_n;
        ticks += 1;
        peak_force_n = peak_force_n.max(norm(output.force_n));
    }
    Ok((ticks, peak_force_n))
}

fn norm(v: [f32; 3]) -> f32 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// Returns the limit that an output violates, given the force of the previous tick.
fn broken(output: &Output, previous: [f32; 3], peak_n: f32, step_n: f32) -> Option<&'static str> {
    let force = output.force_n;
    let step = norm(std::array::from_fn(|axis| force[axis] - previous[axis]));
    let numbers = [
        output.depth_m,
        output.speed_mm_s,
        output.normal_force_n,
        output.vib_m_s2,
        output.tap_n,
        output.friction_n,
        norm(force),
    ];
    if numbers.iter().any(|x| !x.is_finite()) {
        Some("an output is not finite")
    } else if norm(force) > peak_n {
        Some("the force exceeds the device's peak")
    } else if step > step_n {
        Some("the force exceeds the device's slew")
    } else if output.flags.contains(Flags::VIB_CLAMPED) {
        Some("the vibration had to be clamped")
    } else {
        None
    }
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

    /// Claim: an output is refused for the first number that is not finite, a force beyond the peak, a
    /// step beyond the slew along any axis, and a clamped vibration; at the bounds it is not.
    #[test]
    fn an_output_beyond_a_bound_is_named() {
        // A tick in free air, whose numbers are all 0.
        let texture = builtin::texture();
        let lowered = lower(&texture, None).unwrap();
        let mut slot = HostTexture::new();
        slot.load(&Asset::parse(&lowered.bytes).unwrap(), 1000.0)
            .unwrap();
        let renderer = Renderer::new(&Config::default()).unwrap();
        let free = renderer.tick(&slot, &mut State::new(1), &Sample::at([0.0, 0.0, 0.05]));
        let of = |force_n: [f32; 3]| {
            let mut output = free;
            output.force_n = force_n;
            output
        };
        let found = |output: &Output, previous| broken(output, previous, 3.0, 0.5);
        assert_eq!(found(&of([0.0; 3]), [0.0; 3]), None);
        for axis in 0..3 {
            let along = |n: f32| std::array::from_fn(|other| if other == axis { n } else { 0.0 });
            assert_eq!(found(&of(along(3.0)), along(2.5)), None);
            assert_eq!(found(&of(along(-0.25)), along(0.25)), None);
            let peak = found(&of(along(-3.1)), along(-3.0));
            assert!(peak.is_some_and(|what| what.contains("peak")), "{axis}");
            for (from, to) in [(0.0, 0.6), (0.25, -0.35), (2.0, 1.4)] {
                let slew = found(&of(along(to)), along(from));
                assert!(slew.is_some_and(|what| what.contains("slew")), "{axis}");
            }
        }
        let numbers: [fn(&mut Output) -> &mut f32; 7] = [
            |output| &mut output.depth_m,
            |output| &mut output.speed_mm_s,
            |output| &mut output.normal_force_n,
            |output| &mut output.vib_m_s2,
            |output| &mut output.tap_n,
            |output| &mut output.friction_n,
            |output| &mut output.force_n[1],
        ];
        for number in numbers {
            for odd in [f32::NAN, f32::INFINITY] {
                let mut output = of([0.0; 3]);
                *number(&mut output) = odd;
                let what = found(&output, [0.0; 3]);
                assert!(what.is_some_and(|what| what.contains("finite")));
            }
        }
        let mut clamped = of([0.0; 3]);
        clamped.flags = Flags::VIB_CLAMPED;
        assert!(found(&clamped, [0.0; 3]).is_some_and(|what| what.contains("clamped")));
    }

    /// Claim: a vertex next to silence passes whatever its level, at any loudness of the others.
    #[test]
    fn a_vertex_that_nobody_hears_is_not_compared() {
        for loudness in [0.2, 1.0, 5.0] {
            let mut texture = builtin::texture();
            for vertex in &mut texture.grid.vertices {
                vertex.sigma_m_s2 *= loudness;
            }
            let level =
                |vertex: &asperity_texture::model::GridVertex| vertex.gain * vertex.sigma_m_s2;
            let loudest = texture.grid.vertices.iter().map(level).fold(0.0, f64::max);
            let vertex = &mut texture.grid.vertices[3];
            vertex.sigma_m_s2 = 0.9 * spectra::SILENCE_SHARE * loudest / vertex.gain;
            let bytes = lower(&texture, None).unwrap().bytes;
            let report = verify(&texture, &bytes);
            assert!(report.is_ok(), "{loudness}: {report:?}");
        }
    }

    /// Claim: an asset that sounds where its texture is silent is of another texture, however soft.
    #[test]
    fn a_vertex_that_should_be_silent_must_be() {
        let mut silent = builtin::texture();
        let mut sounding = silent.clone();
        let level = |vertex: &asperity_texture::model::GridVertex| vertex.gain * vertex.sigma_m_s2;
        let loudest = silent.grid.vertices.iter().map(level).fold(0.0, f64::max);
        silent.grid.vertices[3].sigma_m_s2 = 0.0;
        let vertex = &mut sounding.grid.vertices[3];
        vertex.sigma_m_s2 = 20.0 * spectra::SILENCE_SHARE * loudest / vertex.gain;
        let bytes = lower(&sounding, None).unwrap().bytes;
        let refused = verify(&silent, &bytes);
        assert!(
            matches!(refused, Err(VerifyError::Spectrum { vertex: 3, .. })),
            "{refused:?}"
        );
    }
}
