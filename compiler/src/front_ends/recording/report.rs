//! The report of an import, for machines and for people.

use super::{analyse::Analysis, import::RecordingImport};
use asperity_recording::friction::Law;
use serde_json::{Value, json};
use std::fmt;

/// The report for machines.
#[must_use]
pub fn json(import: &RecordingImport) -> Value {
    let analysis = &import.analysis;
    let segments: Vec<Value> = analysis
        .steady
        .segments
        .iter()
        .map(|s| json!({ "start_s": s.start as f64 / 1000.0, "seconds": s.length as f64 / 1000.0, "speed_mm_s": s.speed_mm_s, "force_n": s.force_n, "stationarity": s.statistic }))
        .collect();
    let taps: Vec<Value> = analysis
        .transients
        .iter()
        .map(|t| json!({ "speed_m_s": t.speed_m_s, "impacts": t.impacts, "spread": t.spread }))
        .collect();
    let extrapolated: Vec<Value> = analysis
        .fit
        .extrapolated()
        .map(|v| json!({ "speed_mm_s": v.speed_mm_s, "force_n": v.force_n }))
        .collect();
    let steps: Vec<Value> = analysis
        .steps
        .iter()
        .map(|step| json!({ "step": step.name, "ms": 1e3 * step.took.as_secs_f64() }))
        .collect();
    json!({
        "name": import.report.name,
        "check": analysis.checked,
        "axes": { "method": "dft321", "principal_share": analysis.principal_share },
        "segments": { "used": segments, "rejected": analysis.steady.rejected, "covered_s": analysis.steady.covered_s() },
        "methods": analysis.methods,
        "grid": { "chosen": analysis.fit.chosen, "tried": analysis.fit.tried, "vertices": analysis.fit.facts, "extrapolated": extrapolated, "slopes_kept": analysis.fit.beyond },
        "friction": analysis.friction,
        "taps": { "impacts": analysis.impacts.len(), "speeds": taps },
        "sources": import.sources,
        "nearest": import.completed.nearest,
        "asset": { "vertices": import.report.vertices, "triangles": import.report.triangles, "error": import.report.error, "reduction": import.report.reduction, "bytes": { "haptic": import.report.haptic_bytes, "total": import.report.total_bytes } },
        "steps": steps,
        "stages_ms": import.pipeline.timings().json(),
    })
}

/// A few lines for people.
impl fmt::Display for RecordingImport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Analysis {
            checked,
            steady,
            fit,
            friction,
            impacts,
            transients,
            ..
        } = &self.analysis;
        writeln!(f, "{}", self.report)?;
        writeln!(
            f,
            "strokes   {:.1} s steady in {} segments of {:.1} s in contact, {} rejected",
            steady.covered_s(),
            steady.segments.len(),
            checked.contact_s,
            steady.rejected
        )?;
        let chosen = &fit.chosen;
        let zero = if chosen.nyquist_zero {
            " with a zero at half the rate"
        } else {
            ""
        };
        writeln!(
            f,
            "grid      {} measured vertices, {} extrapolated beyond what was visited, AR order {}{zero}, chosen by held-out segments",
            fit.facts.len(),
            fit.extrapolated().count(),
            chosen.order
        )?;
        match friction {
            Some(friction) => {
                let law = match friction.law {
                    Law::Coulomb => "as Coulomb says".to_owned(),
                    Law::Power {
                        of_speed, of_load, ..
                    } => format!("goes as v^{of_speed:.2}·F^{of_load:.2}, rendered as Coulomb's"),
                    Law::Stribeck {
                        sliding,
                        rest,
                        v_s_mm_s,
                    } => format!(
                        "falls from {rest:.2} to {sliding:.2} over {v_s_mm_s:.0} mm/s, rendered as Coulomb's"
                    ),
                };
                writeln!(
                    f,
                    "friction  μ = {:.3} ± {:.3} over {} blocks, {law}",
                    friction.mu, friction.spread, friction.blocks
                )?;
                if friction.stick_slip > 0.02 {
                    writeln!(
                        f,
                        "          sticks and slips in {:.0} % of the sliding time",
                        100.0 * friction.stick_slip
                    )?;
                }
            }
            None => writeln!(
                f,
                "friction  not recorded; completed by the nearest materials"
            )?,
        }
        if self.sources.taps == "recorded" {
            let speeds: Vec<String> = transients
                .iter()
                .map(|t| format!("{:.3} ({})", t.speed_m_s, t.impacts))
                .collect();
            write!(f, "taps      m/s (impacts): {}", speeds.join(", "))?;
            if self.sources.tap_scale < 1.0 {
                write!(
                    f,
                    "; scaled by {:.2} to what the device can give",
                    self.sources.tap_scale
                )?;
            }
            writeln!(f)?;
        } else {
            writeln!(
                f,
                "taps      {} impacts found, too few at one speed; completed by the learned model",
                impacts.len()
            )?;
        }
        let nearest: Vec<String> = self
            .completed
            .nearest
            .iter()
            .map(|n| format!("{} ({}, {:.2})", n.name, n.family, n.cosine))
            .collect();
        write!(f, "nearest   {}", nearest.join(", "))
    }
}
