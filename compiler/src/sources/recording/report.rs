//! The report of an import, for machines and for people.

use super::{Analysis, Recorded};
use crate::{compiled::Compiled, pipeline::Pass};
use asperity_io::shown::counted;
use asperity_recording::{
    friction::{Friction, Law},
    impact::SpeedSource,
    resonance::{FreeAir, Resonance},
};
use serde_json::{Value, json};
use std::fmt::{self, Write as _};

/// The report for machines.
pub(super) fn json(recorded: &Recorded, compiled: &Compiled) -> Value {
    let analysis = &recorded.analysis;
    let grid = &compiled.texture.grid;
    let segments: Vec<Value> = analysis
        .strokes
        .segments
        .iter()
        .map(|s| json!({ "start_s": s.start as f64 / 1000.0, "seconds": s.length as f64 / 1000.0, "speed_mm_s": s.speed_mm_s, "force_n": s.force_n, "steady": s.is_steady, "stationarity": s.statistic }))
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
    let steps: Vec<Value> = compiled
        .timings
        .iter()
        .take_while(|(pass, _)| *pass != Pass::Complete)
        .map(|(pass, took)| json!({ "step": pass.name(), "ms": 1e3 * took.as_secs_f64() }))
        .collect();
    json!({
        "name": compiled.texture.name,
        "check": analysis.checked,
        "resonance": { "free_air_taps": analysis.free_air.taps, "compensated": analysis.free_air.resonances },
        "segments": { "used": segments, "rejected": analysis.strokes.rejected, "covered_s": analysis.strokes.covered_s() },
        "grid": { "chosen": analysis.fit.chosen, "tried": analysis.fit.tried, "vertices": analysis.fit.facts, "extrapolated": extrapolated, "slopes_kept": analysis.fit.beyond },
        "friction": analysis.friction,
        "taps": { "impacts": analysis.impacts.len(), "speed_source": analysis.speed_source, "speeds": taps },
        "sources": recorded.parts,
        "nearest": recorded.completed.nearest,
        "asset": { "vertices": grid.vertices.len(), "triangles": grid.triangles.len(), "error": compiled.compared.map(|compared| compared.error), "reduction": compiled.reduced(), "bytes": { "haptic": compiled.lowered.haptic_bytes, "total": compiled.lowered.bytes.len() } },
        "steps": steps,
        "stages_ms": compiled.timings.json(),
    })
}

/// A few lines for people.
pub(super) fn text(recorded: &Recorded, compiled: &Compiled) -> String {
    let mut text = format!("{}\n", compiled.line());
    // Writing to a string cannot fail.
    let _ = lines(recorded, &mut text);
    text
}

fn lines(recorded: &Recorded, f: &mut String) -> fmt::Result {
    let Analysis {
        checked,
        free_air,
        strokes,
        fit,
        friction,
        impacts,
        transients,
        speed_source,
        ..
    } = &recorded.analysis;
    writeln!(f, "resonance {}", resonance_text(free_air))?;
    writeln!(
        f,
        "strokes   {:.1} s of strokes used, in {}, out of {:.1} s in contact; {} rejected",
        strokes.covered_s(),
        counted(strokes.segments.len(), "segment", "segments"),
        checked.contact_s,
        counted(strokes.rejected, "segment", "segments")
    )?;
    let chosen = &fit.chosen;
    let zero = if chosen.nyquist_zero {
        " with a zero at half the rate"
    } else {
        ""
    };
    writeln!(
        f,
        "grid      {} and {}, AR order {}{zero}, chosen by held-out segments",
        counted(fit.facts.len(), "measured vertex", "measured vertices"),
        counted(
            fit.extrapolated().count(),
            "extrapolated vertex",
            "extrapolated vertices"
        ),
        chosen.order
    )?;
    match friction {
        Some(friction) => {
            let law = match friction.law {
                Law::Coulomb => "Coulomb's law".to_owned(),
                Law::Power {
                    of_speed, of_load, ..
                } => format!("proportional to v^{of_speed:.2}·F^{of_load:.2}"),
                Law::Stribeck {
                    sliding,
                    rest,
                    v_s_mm_s,
                } => {
                    format!(
                        "from {rest:.2} at rest to {sliding:.2} sliding, over {v_s_mm_s:.0} mm/s"
                    )
                }
            };
            writeln!(
                f,
                "friction  μ = {:.3} ± {:.3} over {}, {law}{}",
                friction.mu,
                friction.spread,
                counted(friction.blocks, "block", "blocks"),
                rendered(friction)
            )?;
            if friction.stick_slip > 0.02 {
                writeln!(
                    f,
                    "          stick-slip in {:.0} % of the sliding time",
                    100.0 * friction.stick_slip
                )?;
            }
        }
        None => writeln!(
            f,
            "friction  not recorded; taken from the nearest materials"
        )?,
    }
    if recorded.parts.taps == "recorded" {
        let speeds: Vec<String> = transients
            .iter()
            .map(|t| format!("{:.3} ({})", t.speed_m_s, t.impacts))
            .collect();
        write!(
            f,
            "taps      impact speeds in m/s (number of impacts): {}",
            speeds.join(", ")
        )?;
        if recorded.parts.tap_scale < 1.0 {
            write!(
                f,
                "; scaled by {:.2} to what the device can render",
                recorded.parts.tap_scale
            )?;
        }
        writeln!(f, "\n          {}", speeds_text(speed_source))?;
    } else {
        writeln!(
            f,
            "taps      {} found, too few at any one speed; decoded by the learned model instead",
            counted(impacts.len(), "impact", "impacts")
        )?;
    }
    let nearest: Vec<String> = recorded
        .completed
        .nearest
        .iter()
        .map(|n| format!("{} ({}, {:.2})", n.name, n.family, n.cosine))
        .collect();
    write!(f, "nearest   {}", nearest.join(", "))
}

/// Describes the rendered part of a friction law.
fn rendered(friction: &Friction) -> String {
    let of_load = matches!(friction.law, Law::Power { of_load, .. } if of_load != 0.0);
    if friction.depends_on_speed() {
        let [slow, fast] = friction.speeds_mm_s;
        let load = if of_load {
            ", at the median load for every load"
        } else {
            ""
        };
        format!(", rendered over speed from {slow:.0} to {fast:.0} mm/s{load}")
    } else if friction.law == Law::Coulomb {
        String::new()
    } else {
        ", rendered as Coulomb friction, because it depends only on the load".to_owned()
    }
}

/// Describes the resonances found in free-air taps, and their compensation.
fn resonance_text(free_air: &FreeAir) -> String {
    if free_air.taps == 0 {
        return "of tool and sensor not compensated: there is no tap in free air".into();
    }
    let taps = |count: usize| counted(count, "tap", "taps");
    if free_air.resonances.is_empty() {
        return format!(
            "of tool and sensor: none in {} in free air; nothing was changed",
            taps(free_air.taps)
        );
    }
    let of_axis = |r: &Resonance| {
        format!(
            "{} {:.0} ± {:.0} Hz, Q {:.1} ± {:.1} ({})",
            r.axis,
            r.freq_hz,
            r.freq_spread_hz,
            r.q,
            r.q_spread,
            taps(r.taps)
        )
    };
    let axes: Vec<String> = free_air.resonances.iter().map(of_axis).collect();
    format!("of tool and sensor compensated: {}", axes.join("; "))
}

/// Where impact speeds come from, and how far two sources agree.
fn speeds_text(source: &SpeedSource) -> String {
    let by = match source.source {
        "position" => "speeds from the position along z",
        _ => "speeds from the integrated acceleration: no position along z was recorded",
    };
    match (source.integrated_over_position, source.apart) {
        (Some(off), Some(apart)) => format!(
            "{by}; those from the integrated acceleration differ by {:+.0} % in the median ({:.0} % in magnitude) over {}",
            100.0 * off,
            100.0 * apart,
            counted(source.by_both, "impact", "impacts")
        ),
        _ => by.into(),
    }
}
