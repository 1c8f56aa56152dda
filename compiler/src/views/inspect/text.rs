//! An asset as text for people.

use super::json::{Document, Vertex};
use asperity_formats::{Asset, SectionInfo};
use asperity_texture::model::{Numerator, VertexKind, attributes};
use std::fmt::Write as _;

/// The text of an asset and its document: what it is, what it holds, how it was made.
#[must_use]
pub fn text(document: &Document, asset: &Asset<'_>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write_text(&mut out, document, asset.sections());
    out
}

fn write_text(
    out: &mut String,
    d: &Document,
    sections: impl Iterator<Item = SectionInfo>,
) -> std::fmt::Result {
    writeln!(out, "{}", d.name)?;
    if let Some(prompt) = &d.prompt {
        writeln!(out, "  prompt       {prompt:?}")?;
    }
    writeln!(
        out,
        "  format       version {}, all checksums verified",
        d.format_version
    )?;
    writeln!(
        out,
        "  bytes        {} haptic, {} preview, {} in total",
        d.bytes.haptic, d.bytes.preview, d.bytes.total
    )?;
    let listed: Vec<String> = sections
        .map(|s| format!("{} {}", String::from_utf8_lossy(&s.tag), s.len))
        .collect();
    writeln!(out, "  sections     {}", listed.join(", "))?;

    let interior = |v: &&Vertex| v.kind == VertexKind::Interior;
    let inside = d.ar.vertices.iter().filter(interior).count();
    let numerator = match d.ar.numerator {
        Numerator::None => "none".to_owned(),
        Numerator::Nyquist => "1 + z⁻¹".to_owned(),
        Numerator::Lsf => {
            let first = d.ar.vertices.first();
            let order = first
                .and_then(|v| v.ma_lsf_rad.as_ref())
                .map_or(0, Vec::len);
            format!("MA of order {order}")
        }
    };
    writeln!(
        out,
        "  models       AR order {}, numerator {numerator}, {} Hz",
        d.ar.order, d.ar.sample_rate_hz
    )?;
    writeln!(
        out,
        "  grid         {inside} interior and {} edge vertices, {} triangles, 0–{:.1} mm/s × 0–{:.2} N",
        d.ar.vertices.len() - inside,
        d.ar.triangles.len(),
        d.ar.max_speed_mm_s,
        d.ar.max_force_n
    )?;
    match (d.taps.speeds_m_s.first(), d.taps.speeds_m_s.last()) {
        (Some(slowest), Some(fastest)) => writeln!(
            out,
            "  taps         {} traces of {} samples at {} Hz, {slowest:.3}–{fastest:.3} m/s{}",
            d.taps.speeds_m_s.len(),
            d.taps.traces_m_s2.first().map_or(0, Vec::len),
            d.taps.sample_rate_hz,
            if d.provenance.taps_synthetic {
                ", synthetic"
            } else {
                ""
            }
        )?,
        _ => writeln!(out, "  taps         none")?,
    }
    writeln!(out, "  friction     {}", d.friction)?;
    if let Some(law) = &d.friction.law {
        let points = law.points.iter();
        let points: Vec<String> = points
            .map(|p| format!("{:.3} at {:.0}", d.friction.mu * p.factor, p.speed_mm_s))
            .collect();
        writeln!(out, "               over speed: {} mm/s", points.join(", "))?;
    }
    writeln!(
        out,
        "  wall         {:.0} N/m, {:.3} N·s/m",
        d.wall.stiffness_n_m, d.wall.damping_n_s_m
    )?;
    if let Some(contact) = &d.contact {
        writeln!(out, "  contact      {contact}")?;
    }
    if let Some(direction) = &d.direction {
        writeln!(out, "  direction    {direction}")?;
    }
    writeln!(
        out,
        "  gains        vibration {:.5} s²/m × {:.2} N, effective mass {:.3} kg",
        d.gains.vib_s2_m, d.gains.f_max_n, d.gains.effective_mass_kg
    )?;
    let figure = |value: Option<f64>, unit: &str| {
        value.map_or_else(|| "undefined".to_owned(), |x| format!("{x:.1} {unit}"))
    };
    let p = &d.provenance;
    writeln!(
        out,
        "  attributes   rough {}, sharp {} at {:.0} mm/s and {:.1} N; hard {}{}; μ {:.3}",
        figure(d.attributes.rough_db, "dB re 1 (m/s²)²"),
        figure(d.attributes.sharp_hz, "Hz"),
        attributes::SPEED_MM_S.min(d.ar.max_speed_mm_s),
        attributes::FORCE_N.min(d.ar.max_force_n),
        figure(d.attributes.hard_hz, "Hz"),
        if p.taps_synthetic {
            " (from synthetic taps)"
        } else {
            ""
        },
        d.attributes.mu
    )?;
    writeln!(
        out,
        "  provenance   {} from {:?} (CRC-32 {:08x}), fidelity {}, seed {}",
        p.generator, p.source, p.source_crc32, p.fidelity, p.seed
    )?;
    writeln!(
        out,
        "  rounding     {:.4} dB RMS from LSF quantisation",
        p.lsf_error_db
    )?;
    if !p.notes.is_empty() {
        writeln!(out, "  notes        {}", p.notes)?;
    }
    writeln!(
        out,
        "  vertices     speed mm/s   force N   kind       level m/s²"
    )?;
    for (index, v) in d.ar.vertices.iter().enumerate() {
        let kind = match v.kind {
            VertexKind::Interior => "interior",
            VertexKind::Edge => "edge",
        };
        writeln!(
            out,
            "        {index:>3}    {:>10.3}  {:>8.4}   {kind:<8}  {:>11.5}",
            v.speed_mm_s,
            v.force_n,
            v.gain * v.sigma_m_s2
        )?;
    }
    Ok(())
}
