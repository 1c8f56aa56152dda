//! The CSV files of a comparison. A cell is empty where its value is not known.
//!
//! | file | each row | columns |
//! |---|---|---|
//! | `summary.csv` | a design over all materials | factor, name, the eight settings; instructions a tick, Cortex-M4F instructions where given, bytes; median, p95 and max (dB) of distortion, level, moving level, moving error and alternation; fraction of unstable places, number of materials with an unstable place |
//! | `designs.csv` | a design on a material | factor, name, material, poles, zeros, bytes; the same errors; number of unstable places and of all places |
//! | `held-out.csv` | a method in a region over all materials | what is varied, method, region, models, refused; median, p95, max of distortion, of shape alone and of the absolute level error, median of the signed one (dB); fraction of models to which it is nearer than the product's method |
//! | `fidelity.csv` | what `auto` keeps of a material | material, poles, zeros, vertices, triangles, tap samples, instructions and bytes, each whole and kept; ratio of instructions; p95 and worst (dB) |

use super::accuracy::Errors;
use super::cortex_m::CortexM;
use super::held_out::MethodSummary;
use super::measure::Results;
use super::statistics::Spread;
use asperity::passes::reduce::Change;
use asperity_kernels::design::{Design, Variant};

fn number(value: f64) -> String {
    format!("{value:.4}")
}

fn optional(value: Option<f64>) -> String {
    value.map(number).unwrap_or_default()
}

fn spread(value: Option<Spread>) -> [String; 3] {
    [
        optional(value.map(|s| s.median)),
        optional(value.map(|s| s.p95)),
        optional(value.map(|s| s.max)),
    ]
}

fn spread_names(what: &str) -> [String; 3] {
    ["median", "p95", "max"].map(|rank| format!("{what}_{rank}_db"))
}

fn finished(writer: csv::Writer<Vec<u8>>) -> Result<Vec<u8>, csv::Error> {
    writer
        .into_inner()
        .map_err(|error| csv::Error::from(error.into_error()))
}

fn texts<const N: usize>(names: [&str; N]) -> Vec<String> {
    names.map(String::from).to_vec()
}

/// `summary.csv`.
///
/// # Errors
/// The CSV writer's error; none occurs with a buffer in memory.
pub fn summary(results: &Results, cortex_m: &CortexM) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = texts([
        "factor",
        "name",
        "shape",
        "level",
        "structure",
        "order",
        "arithmetic",
        "update_ticks",
        "transition",
        "lsf_bits",
        "instructions_a_tick",
        "cortex_m4f_instructions_a_tick",
        "bytes",
    ]);
    for what in [
        "distortion",
        "level",
        "moving_level",
        "moving_error",
        "alternation",
    ] {
        header.extend(spread_names(what));
    }
    header.extend(texts(["unstable_share", "unstable_materials"]));
    writer.write_record(&header)?;
    for summary in &results.summaries {
        let Variant {
            factor,
            name,
            design,
        } = &summary.variant;
        let mut row = vec![factor.name().to_owned(), name.clone()];
        row.extend(settings(design));
        let cortex = cortex_m.get(&(factor.name().to_owned(), name.clone()));
        row.extend([
            optional(summary.instructions),
            optional(cortex.copied()),
            summary.bytes.map(|b| b.to_string()).unwrap_or_default(),
        ]);
        for errors in [
            summary.distortion_db,
            summary.level_db,
            summary.moving_level_db,
            summary.moving_error_db,
            summary.alternation_db,
        ] {
            row.extend(spread(errors));
        }
        row.push(format!("{:.6}", summary.unstable));
        row.push(summary.unstable_materials.to_string());
        writer.write_record(&row)?;
    }
    finished(writer)
}

fn settings(design: &Design) -> [String; 8] {
    [
        design.shape.name().into(),
        design.level.name().into(),
        design.structure.name().into(),
        design.order.to_string(),
        design.arithmetic.name().into(),
        design.update_ticks.to_string(),
        design.transition.name().into(),
        design.lsf_bits.to_string(),
    ]
}

/// `designs.csv`.
///
/// # Errors
/// The CSV writer's error; none occurs with a buffer in memory.
pub fn designs(results: &Results) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = texts(["factor", "name", "material", "poles", "zeros", "bytes"]);
    for what in ["distortion", "level", "moving_level"] {
        header.extend(spread_names(what));
    }
    header.extend(texts(["moving_error_db"]));
    header.extend(spread_names("alternation"));
    header.extend(texts(["unstable", "places"]));
    writer.write_record(&header)?;
    for row in &results.rows {
        let variant = &results.summaries[row.variant].variant;
        let Errors {
            distortion_db,
            level_db,
            moving_level_db,
            moving_error_db,
            alternation_db,
            unstable,
            places,
        } = &row.errors;
        let absolute: Vec<f64> = level_db.iter().map(|db| db.abs()).collect();
        let mut record = vec![
            variant.factor.name().to_owned(),
            variant.name.clone(),
            results.materials[row.material].clone(),
            row.orders.poles.to_string(),
            row.orders.zeros.to_string(),
            row.bytes.map(|b| b.to_string()).unwrap_or_default(),
        ];
        for list in [distortion_db, &absolute, moving_level_db] {
            record.extend(spread(Spread::of(list)));
        }
        record.push(number(*moving_error_db));
        record.extend(spread(Spread::of(alternation_db)));
        record.extend([unstable.to_string(), places.to_string()]);
        writer.write_record(&record)?;
    }
    finished(writer)
}

/// `held-out.csv`.
///
/// # Errors
/// The CSV writer's error; none occurs with a buffer in memory.
pub fn held_out(summary: &[MethodSummary]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = texts(["varied", "method", "region", "models", "refused"]);
    for what in ["distortion", "shape", "level"] {
        header.extend(spread_names(what));
    }
    header.extend(texts(["level_bias_median_db", "nearer_than_chosen_share"]));
    writer.write_record(&header)?;
    for group in summary {
        let (varied, method) = group.method.names();
        let mut row = vec![
            varied.to_owned(),
            method,
            group.region.name().to_owned(),
            group.models.to_string(),
            group.refused.to_string(),
        ];
        for errors in [group.distortion_db, group.shape_db, group.level_db] {
            row.extend(spread(errors));
        }
        row.push(optional(group.bias_db));
        row.push(optional(group.nearer));
        writer.write_record(&row)?;
    }
    finished(writer)
}

/// `fidelity.csv`.
///
/// # Errors
/// The CSV writer's error; none occurs with a buffer in memory.
pub fn fidelity(results: &Results) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = texts(["material"]);
    for what in [
        "poles",
        "zeros",
        "vertices",
        "triangles",
        "tap_samples",
        "instructions_a_tick",
        "bytes",
    ] {
        header.extend([format!("{what}_full"), format!("{what}_kept")]);
    }
    header.extend(texts(["instructions_ratio", "p95_db", "worst_db"]));
    writer.write_record(&header)?;
    for (name, kept) in results.materials.iter().zip(&results.kept) {
        let report = &kept.report;
        let mut row = vec![name.clone()];
        for Change { full, kept } in [
            report.order,
            report.zeros,
            report.vertices,
            report.triangles,
            report.tap_samples,
        ] {
            row.extend([full.to_string(), kept.to_string()]);
        }
        row.extend([
            optional(kept.instructions.map(|i| i.0)),
            optional(kept.instructions.map(|i| i.1)),
            kept.bytes.map(|b| b.0.to_string()).unwrap_or_default(),
            kept.bytes.map(|b| b.1.to_string()).unwrap_or_default(),
            optional(kept.ratio()),
            number(report.p95_db),
            number(report.worst_db),
        ]);
        writer.write_record(&row)?;
    }
    finished(writer)
}
