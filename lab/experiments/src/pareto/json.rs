//! The comparison as JSON.

use super::measure::Results;
use super::statistics::Spread;
use super::summary::VariantSummary;

/// The comparison as JSON: the figures of `tables.md` that a program is likely to read.
#[must_use]
pub fn encode(results: &Results) -> serde_json::Value {
    let spread = |s: Option<Spread>| {
        s.map(|s| serde_json::json!({"median": s.median, "p95": s.p95, "max": s.max}))
    };
    let designs: Vec<_> = results
        .summaries
        .iter()
        .map(|s: &VariantSummary| {
            serde_json::json!({
                "factor": s.variant.factor.name(),
                "name": s.variant.name,
                "instructions_a_tick": s.instructions,
                "bytes": s.bytes,
                "distortion_db": spread(s.distortion_db),
                "moving_level_db": spread(s.moving_level_db),
                "unstable_share": s.unstable,
                "within_budget": s.is_within_budget(),
            })
        })
        .collect();
    let halved = results
        .kept
        .iter()
        .filter(|k| k.ratio().is_some_and(|r| r <= 0.5));
    serde_json::json!({
        "materials": results.materials.len(),
        "counted_at": {
            "poles": results.common.poles,
            "zeros": results.common.zeros,
            "nyquist_zero": results.common.nyquist,
        },
        "designs": designs,
        "auto": {
            "halved": halved.count(),
            "within_budget": results.kept.iter().filter(|k| k.is_within_budget()).count(),
        },
        "not_counted": results.not_counted,
    })
}
