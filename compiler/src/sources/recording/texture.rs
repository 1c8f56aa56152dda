//! An analysis as a texture.

use super::{analyse::Analysis, complete::Completed};
use crate::learned::contact;
use asperity_recording::impact::TAP_RATE_HZ;
use asperity_texture::model::{
    Friction, FrictionAnchor, FrictionLaw, LawPoint, Provenance, TapBank, TapTrace, TextureModel,
    Wall, defaults,
};
use serde::Serialize;

/// Speeds at which a fitted law is looked at, before the points are chosen.
const LAW_SPEEDS: i32 = 128;
/// Fewest impact speeds that make a bank.
const FEWEST_SPEEDS: usize = 2;
/// No friction is so many times its median; an asset could hold eight times.
const HIGHEST_FACTOR: f64 = 5.0;
/// Largest part of the device's force that a tap may take.
const TAP_SHARE: f64 = 0.95;

/// Where each part of a texture comes from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parts {
    /// `recorded`.
    pub grid: &'static str,
    /// `recorded` or `completed`.
    pub taps: &'static str,
    /// `recorded` or `completed`.
    pub friction: &'static str,
    /// `completed`: no sensor of a tool tells the stiffness of a wall.
    pub wall: &'static str,
    /// Factor by which recorded taps were lowered to what the device can give.
    pub tap_scale: f64,
}

/// The texture of an analysis; what it lacks is taken from `completed`.
#[must_use]
pub fn texture(
    analysis: &Analysis,
    completed: &Completed,
    source_crc32: u32,
) -> (TextureModel, Parts) {
    let description = &analysis.recording.description;
    let gains = defaults::gains();
    let recorded_taps = analysis.transients.len() >= FEWEST_SPEEDS;
    let (taps, tap_scale) = if recorded_taps {
        bank(
            analysis,
            TAP_SHARE * gains.f_max_n / gains.effective_mass_kg,
        )
    } else {
        (completed.taps.clone(), 1.0)
    };
    let mu = analysis
        .friction
        .as_ref()
        .map_or(completed.mu, |friction| friction.mu)
        .max(0.0);
    let law = analysis.friction.as_ref().and_then(law);
    let say = |recorded: bool| if recorded { "recorded" } else { "completed" };
    let parts = Parts {
        grid: "recorded",
        taps: say(recorded_taps),
        friction: say(analysis.friction.is_some()),
        wall: "completed",
        tap_scale,
    };
    let notes = format!(
        "Grid recorded with {} over {:.0} s of strokes. Taps {}{}. Friction {}{}. Wall by the nearest materials of the learned model. Gains and masses are unconfirmed defaults.",
        description.device.as_deref().unwrap_or("an unnamed device"),
        analysis.strokes.covered_s(),
        parts.taps,
        if tap_scale < 1.0 {
            format!(", scaled by {tap_scale:.2} to what the device can give")
        } else {
            String::new()
        },
        parts.friction,
        if law.is_some() { ", over speed" } else { "" },
    );
    let mut texture = TextureModel {
        name: description.name.clone(),
        grid: analysis.fit.grid.clone(),
        taps,
        friction: Friction {
            mu,
            anchors: vec![FrictionAnchor {
                name: description.name.clone(),
                mu,
                weight: 1.0,
            }],
            law,
        },
        wall: Wall {
            stiffness_n_m: completed.stiffness_n_m,
            damping_n_s_m: defaults::DAMPING_N_S_M,
        },
        contact: None,
        direction: None,
        gains,
        provenance: Provenance {
            generator: format!("asperity {} import recording", env!("CARGO_PKG_VERSION")),
            source: analysis
                .recording
                .folder
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            source_crc32,
            prompt: None,
            seed: 0,
            fidelity: "full".into(),
            taps_synthetic: !recorded_taps,
            lsf_error_db: 0.0,
            notes,
        },
    };
    // Its friction is its own, or that of the nearest.
    contact::set(&mut texture, completed.contact.clone());
    (texture, parts)
}

/// The part of a fitted law that speed has, over the recorded speeds; `None` where the data do not
/// ask for one.
fn law(friction: &asperity_recording::friction::Friction) -> Option<FrictionLaw> {
    let [slowest, fastest] = friction.speeds_mm_s;
    if !friction.depends_on_speed() || friction.mu <= 0.0 {
        return None;
    }
    let ratio = fastest / slowest;
    let points = (0..=LAW_SPEEDS).map(|step| {
        let speed_mm_s = slowest * libm::pow(ratio, f64::from(step) / f64::from(LAW_SPEEDS));
        LawPoint {
            speed_mm_s,
            factor: (friction.mu_at(speed_mm_s) / friction.mu).clamp(0.0, HIGHEST_FACTOR),
        }
    });
    FrictionLaw::through(points.collect())
}

/// The recorded transients as a bank within ±`limit_m_s2`. One factor lowers all of them, so that
/// their ratios stay.
fn bank(analysis: &Analysis, limit_m_s2: f64) -> (TapBank, f64) {
    let peak = analysis
        .transients
        .iter()
        .flat_map(|t| &t.accel_m_s2)
        .fold(0.0_f64, |peak, a| peak.max(a.abs()));
    let scale = (limit_m_s2 / peak.max(1e-300)).min(1.0);
    let traces = analysis
        .transients
        .iter()
        .map(|t| TapTrace {
            speed_m_s: t.speed_m_s,
            accel_m_s2: t.accel_m_s2.iter().map(|a| a * scale).collect(),
        })
        .collect();
    (
        TapBank {
            sample_rate_hz: TAP_RATE_HZ,
            traces,
        },
        scale,
    )
}
