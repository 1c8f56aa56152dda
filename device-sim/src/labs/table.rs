//! The CSV files of a comparison: one fact a cell, a header, empty where nothing is known.
//!
//! | file | a row is | columns |
//! |---|---|---|
//! | `summary.csv` | a design over all materials | factor, name, the eight settings; instructions a tick, Cortex-M4F instructions where given, time ratio, bytes; median, p95 and max (dB) of distortion, level, moving level, moving error and alternation; unstable share, materials with an unstable place |
//! | `designs.csv` | a design on a material | factor, name, material, poles, zeros, bytes; the same errors; unstable places of how many |
//! | `held-out.csv` | a method in a region over all materials | what is varied, method, region, models, refused; median, p95, max of distortion, of shape alone and of the absolute level error, median of the signed one (dB); share of models to which it is nearer than the product's way |
//! | `fidelity.csv` | what `auto` keeps of a material | material, poles, zeros, vertices, triangles, tap samples, instructions and bytes, each whole and kept; ratio of instructions; p95 and worst (dB) |

use super::accuracy::Errors;
use super::held_out::{Exponents, Method, Prediction, Region};
use super::pareto::{Results, Summary};
use super::statistics::{Spread, percentile};
use asperity::reduce::Change;
use asperity_kernels::design::{Design, Level, Shape, Variant};
use std::collections::HashMap;

/// Counts of a firmware bench: instructions a tick by factor and name of the design.
pub type CortexM = HashMap<(String, String), f64>;

/// Reads `factor,name,instructions`.
///
/// # Errors
/// The parser's for a file that is no such table.
pub fn read_cortex_m(bytes: &[u8]) -> Result<CortexM, csv::Error> {
    let mut reader = csv::Reader::from_reader(bytes);
    reader
        .deserialize::<(String, String, f64)>()
        .map(|row| row.map(|(factor, name, count)| ((factor, name), count)))
        .collect()
}

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
/// None that a buffer in memory has.
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
        "time_ratio",
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
            optional(summary.time_ratio),
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
        design.every.to_string(),
        design.transition.name().into(),
        design.lsf_bits.to_string(),
    ]
}

/// `designs.csv`.
///
/// # Errors
/// None that a buffer in memory has.
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

/// One method in one region over all materials.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// By what.
    pub method: Method,
    /// Where.
    pub region: Region,
    /// Models that were predicted.
    pub models: usize,
    /// Of these, predictions that were no stable, sounding filter.
    pub refused: usize,
    /// Distortion, level included.
    pub distortion_db: Option<Spread>,
    /// Distortion of the shape alone.
    pub shape_db: Option<Spread>,
    /// Absolute level error.
    pub level_db: Option<Spread>,
    /// Median of the signed level error.
    pub bias_db: Option<f64>,
    /// Share of the models to which it comes nearer than the product's way: in shape where
    /// that is varied, else in level. Ties count half.
    pub nearer: Option<f64>,
}

/// Predictions by method and region, in the order in which they first appear.
#[must_use]
pub fn held_out_summary(predictions: &[Vec<Prediction>]) -> Vec<HeldOut> {
    let mut groups: Vec<(Method, Region, Vec<&Prediction>)> = Vec::new();
    for prediction in predictions.iter().flatten() {
        let known = groups
            .iter_mut()
            .find(|(m, r, _)| (*m, *r) == (prediction.method, prediction.region));
        match known {
            Some((_, _, group)) => group.push(prediction),
            None => groups.push((prediction.method, prediction.region, vec![prediction])),
        }
    }
    groups
        .into_iter()
        .map(|(method, region, group)| {
            let list = |value: fn(&super::accuracy::Difference) -> f64| -> Vec<f64> {
                let found = group.iter().filter_map(|p| p.difference.as_ref());
                found.map(value).collect()
            };
            let signed = list(|d| d.level_db);
            HeldOut {
                method,
                region,
                models: group.len(),
                refused: group.len() - signed.len(),
                distortion_db: Spread::of(&list(|d| d.distortion_db)),
                shape_db: Spread::of(&list(|d| d.shape_db)),
                level_db: Spread::of(&list(|d| d.level_db.abs())),
                bias_db: percentile(&signed, 0.5),
                nearer: nearer(predictions, method, region),
            }
        })
        .collect()
}

/// The product's way where a method is compared.
fn chosen(method: Method, region: Region) -> Method {
    match (method, region) {
        (Method::Powers(_), _) | (_, Region::Beyond) => Method::Powers(Exponents::Fitted),
        (Method::Shape(_), _) => Method::Shape(Shape::LsfCosine),
        (Method::Level(_) | Method::Nearest, _) => Method::Level(Level::Rms),
    }
}

fn nearer(predictions: &[Vec<Prediction>], method: Method, region: Region) -> Option<f64> {
    let error = |prediction: &Prediction| {
        prediction.difference.map(|d| match method {
            Method::Shape(_) => d.shape_db,
            _ => d.level_db.abs(),
        })
    };
    let other = chosen(method, region);
    let (mut won, mut count) = (0.0, 0.0);
    for material in predictions {
        let of = |method| {
            material
                .iter()
                .filter(move |p| (p.method, p.region) == (method, region))
        };
        for (mine, theirs) in of(method).zip(of(other)) {
            debug_assert_eq!(mine.model, theirs.model);
            if let (Some(mine), Some(theirs)) = (error(mine), error(theirs)) {
                won += match mine.total_cmp(&theirs) {
                    std::cmp::Ordering::Less => 1.0,
                    std::cmp::Ordering::Equal => 0.5,
                    std::cmp::Ordering::Greater => 0.0,
                };
                count += 1.0;
            }
        }
    }
    (count > 0.0).then(|| won / count)
}

/// `held-out.csv`.
///
/// # Errors
/// None that a buffer in memory has.
pub fn held_out(summary: &[HeldOut]) -> Result<Vec<u8>, csv::Error> {
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
/// None that a buffer in memory has.
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

/// The comparison as JSON: what a program wants of `summary.csv` and of what `auto` keeps.
#[must_use]
pub fn json(results: &Results) -> serde_json::Value {
    let spread = |s: Option<Spread>| {
        s.map(|s| serde_json::json!({"median": s.median, "p95": s.p95, "max": s.max}))
    };
    let designs: Vec<_> = results
        .summaries
        .iter()
        .map(|s: &Summary| {
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
    let exponent = |of: fn(&(f64, f64)) -> f64| {
        let values: Vec<f64> = results.exponents.iter().map(of).collect();
        [0.25, 0.5, 0.75].map(|share| percentile(&values, share))
    };
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
        "level_exponents_quartiles": {
            "speed": exponent(|e| e.0),
            "force": exponent(|e| e.1),
        },
        "auto": {
            "halved": halved.count(),
            "within_budget": results.kept.iter().filter(|k| k.is_within_budget()).count(),
        },
        "not_counted": results.not_counted,
    })
}
