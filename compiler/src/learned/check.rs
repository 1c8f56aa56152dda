//! Validation of a model description before its networks are used.

use super::{
    description::{FORMAT, LATENT, ModelDescription},
    files::wrong_file,
};
use asperity_io::diagnostic::Fault;

/// Checks counts, ranges and lengths.
///
/// # Errors
/// [`Fault`] with the field.
pub(super) fn check(description: &ModelDescription) -> Result<(), Fault> {
    let fault = |what: String| Err(wrong_file("model.json", what));
    if description.format != FORMAT {
        return fault(format!(
            "format: {}, this version reads {FORMAT}",
            description.format
        ));
    }
    let grid = &description.grid;
    if grid.speeds_mm_s.len() != grid.forces_n.len() || grid.speeds_mm_s.len() < 3 {
        return fault("grid: at least three bins with a speed and a force each".into());
    }
    let inside = |values: &[f64], border: f64| {
        values.iter().all(|x| *x > 0.0 && *x < border) && border.is_finite()
    };
    if !inside(&grid.speeds_mm_s, grid.max_speed_mm_s) || !inside(&grid.forces_n, grid.max_force_n)
    {
        return fault("grid: a bin outside the borders".into());
    }
    if description.taps.speeds_m_s.is_empty() || description.taps.samples == 0 {
        return fault("taps: no trace".into());
    }
    if description.anchors.is_empty() {
        return fault("anchors: none, friction needs one at least".into());
    }
    for anchor in &description.anchors {
        if anchor.z.len() != LATENT || !anchor.z.iter().all(|x| x.is_finite()) {
            return fault(format!(
                "anchors: {}: z: {LATENT} finite numbers wanted",
                anchor.name
            ));
        }
        if !(anchor.mu >= 0.0 && anchor.mu.is_finite() && anchor.stiffness_n_m > 0.0) {
            return fault(format!(
                "anchors: {}: mu or stiffness_n_m is no such value",
                anchor.name
            ));
        }
    }
    if description.spread.len() != LATENT || !description.spread.iter().all(|x| x.is_finite()) {
        return fault(format!("spread: {LATENT} finite numbers wanted"));
    }
    if description.friction.temperature.is_nan() || description.friction.temperature <= 0.0 {
        return fault("friction.temperature: not above 0".into());
    }
    let curve = &description.certainty;
    if curve.similarity.is_empty() || curve.similarity.len() != curve.certainty.len() {
        return fault("certainty: as many similarities as certainties, one at least".into());
    }
    if !description.unfamiliar.is_finite() {
        return fault("unfamiliar: not a number".into());
    }
    Ok(())
}
