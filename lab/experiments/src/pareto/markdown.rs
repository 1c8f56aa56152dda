//! The comparison as tables of the documentation.

use super::contact::ContactSummary;
use super::cortex_m::CortexM;
use super::direction::DirectionSummary;
use super::measure::Results;
use super::reduced_material::ReducedMaterial;
use super::statistics::{Spread, percentile};
use super::summary::VariantSummary;
use asperity::passes::reduce::Change;
use asperity_kernels::design::Factor;
use std::fmt::Write as _;

/// Markdown of every table: designs by factor, contact laws, directions, what `auto` keeps.
#[must_use]
pub fn tables(results: &Results, cortex_m: &CortexM) -> String {
    let mut text = String::new();
    for group in results
        .summaries
        .chunk_by(|x, y| x.variant.factor == y.variant.factor)
    {
        let factor = group[0].variant.factor;
        if factor != Factor::Default {
            let default = results
                .summaries
                .iter()
                .find(|s| s.variant.factor == Factor::Default);
            designs(
                &mut text,
                factor,
                default.into_iter().chain(group),
                cortex_m,
            );
        }
    }
    contact(&mut text, &results.contact);
    direction(&mut text, &results.direction);
    kept(&mut text, results);
    text
}

/// A number with `decimals` decimals, or a dash.
fn number(value: Option<f64>, decimals: usize) -> String {
    match value {
        None => "–".into(),
        Some(value) if value.is_infinite() => "unbounded".into(),
        Some(value) => format!("{value:.decimals$}"),
    }
}

fn designs<'a>(
    text: &mut String,
    factor: Factor,
    rows: impl Iterator<Item = &'a VariantSummary>,
    cortex_m: &CortexM,
) {
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "### {}\n\n| design | instr. | M4F | bytes | at rest, dB: median / p95 / max | in motion, p95 dB | alternating, dB: p95 / max | unstable |\n|---|---:|---:|---:|---:|---:|---:|---:|\n",
        factor.name()
    );
    for row in rows {
        let variant = &row.variant;
        let of = |spread: Option<Spread>, value: fn(&Spread) -> f64| spread.as_ref().map(value);
        let name = if variant.factor == Factor::Default {
            format!("**{}**", variant.name)
        } else {
            variant.name.clone()
        };
        let on_cortex = cortex_m.get(&(variant.factor.name().to_owned(), variant.name.clone()));
        let unstable = if row.unstable == 0.0 {
            "0".to_owned()
        } else {
            format!(
                "{:.2} %, {} materials",
                100.0 * row.unstable,
                row.unstable_materials
            )
        };
        let (rest, alternating) = (row.distortion_db, row.alternation_db);
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {} | {} / {} / {} | {} | {} / {} | {unstable} |",
            number(row.instructions, 0),
            number(on_cortex.copied(), 0),
            number(row.bytes.map(|b| b as f64), 0),
            number(of(rest, |s| s.median), 3),
            number(of(rest, |s| s.p95), 3),
            number(of(rest, |s| s.max), 2),
            number(of(row.moving_level_db, |s| s.p95), 2),
            number(of(alternating, |s| s.p95), 1),
            number(of(alternating, |s| s.max), 1),
        );
    }
    text.push('\n');
}

fn contact(text: &mut String, designs: &[ContactSummary]) {
    text.push_str(
        "### contact law\n\n| design | materials | instr. | of the whole law | away from the surface, %: median / p95 / max | along it, %: median / p95 / max |\n|---|---:|---:|---:|---:|---:|\n",
    );
    for design in designs {
        let percent = |spread: Option<Spread>| {
            spread.map_or("–".into(), |s| {
                format!(
                    "{:.1} / {:.1} / {:.1}",
                    100.0 * s.median,
                    100.0 * s.p95,
                    100.0 * s.max
                )
            })
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} |",
            design.name,
            design.materials,
            number(design.instructions, 0),
            number(design.whole, 0),
            percent(design.press),
            percent(design.drag)
        );
    }
    text.push('\n');
}

fn direction(text: &mut String, designs: &[DirectionSummary]) {
    text.push_str(
        "### direction\n\n| design | ribs, dB: median / p95 | ribs at the worst angle, dB: median / p95 | grain, dB: median / p95 | materials over 2 dB worse than a second grid |\n|---|---:|---:|---:|---:|\n",
    );
    for design in designs {
        let spread = |s: Spread| format!("{:.2} / {:.2}", s.median, s.p95);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} of {} |",
            design.design.name(),
            spread(design.ribs_db),
            spread(design.worst_db),
            spread(design.grain_db),
            design.lose,
            design.materials
        );
    }
    text.push('\n');
}

fn kept(text: &mut String, results: &Results) {
    let kept = &results.kept;
    let median = |values: Vec<f64>| number(percentile(&values, 0.5).map(|x| 100.0 * x), 0);
    let percent_kept = |change: fn(&asperity::passes::reduce::Report) -> Change| {
        let of = |kept: &ReducedMaterial| {
            let Change { full, kept } = change(&kept.report);
            (full > 0).then(|| kept as f64 / full as f64)
        };
        median(kept.iter().filter_map(of).collect())
    };
    let ratios: Vec<f64> = kept.iter().filter_map(|k| k.ratio()).collect();
    let bytes = kept
        .iter()
        .filter_map(|k| k.bytes)
        .map(|(full, kept)| kept as f64 / full as f64);
    let largest = |value: fn(&asperity::passes::reduce::Report) -> f64| {
        kept.iter().map(|k| value(&k.report)).fold(0.0, f64::max)
    };
    let _ = write!(
        text,
        "### what auto keeps\n\n| over {} materials | |\n|---|---:|\n| within the budget | {} |\n| instructions at least halved | {} |\n| instructions kept, median | {} % |\n| vertices kept, median | {} % |\n| tap samples kept, median | {} % |\n| bytes kept, median | {} % |\n| largest p95 / worst | {:.2} / {:.2} dB |\n",
        kept.len(),
        kept.iter().filter(|k| k.is_within_budget()).count(),
        ratios.iter().filter(|ratio| **ratio <= 0.5).count(),
        median(ratios.clone()),
        percent_kept(|r| r.vertices),
        percent_kept(|r| r.tap_samples),
        median(bytes.collect()),
        largest(|r| r.p95_db),
        largest(|r| r.worst_db),
    );
    let names = |wanted: &dyn Fn(&ReducedMaterial) -> bool| -> String {
        let some = results
            .materials
            .iter()
            .zip(kept)
            .filter(|(_, kept)| wanted(kept));
        some.map(|(name, _)| name.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let _ = write!(
        text,
        "\n### not halved\n\n{}\n\n### all poles and zeros kept\n\n{}\n",
        names(&|k| k.ratio().is_some_and(|ratio| ratio > 0.5)),
        names(&|k| k.report.order.full == k.report.order.kept
            && k.report.zeros.full == k.report.zeros.kept)
    );
}
