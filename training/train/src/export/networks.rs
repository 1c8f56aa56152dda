//! The four networks of a model folder. Normalisation lies inside: physical units in
//! and out.

use super::{ExportError, gain, graph::Writer};
use crate::{
    attribute_regression::{AttributeRegression, LEAST},
    config::{self, Excitation},
    kernel_ridge::{KernelRidge, SHARPNESS},
    lda_retrieval::LdaRetrieval,
    network::{GAPS, LOG_VARIANCE_BOUND, Trunk, gap_matrix, gap_offsets},
    normaliser::{LSFS, TAP_VALUES},
    parameters::Slot,
    trained::Trained,
};
use asperity::learned::description::LATENT;
use asperity_corpus::{BINS, CHANNELS, ORDER, TAP_SAMPLES, TAPS};
use asperity_nn::{
    Tensor,
    build::{Attribute, Value},
};
use std::f64::consts::{LN_10, LOG10_E};

pub(super) const TEXT_PROJECTION: &str = "text_projection.onnx";
pub(super) const AR_DECODER: &str = "ar_decoder.onnx";
pub(super) const TAP_DECODER: &str = "tap_decoder.onnx";
pub(super) const ENCODER: &str = "encoder.onnx";

/// Roughness, slipperiness, hardness.
const FELT: usize = 3;

type File = (&'static str, Vec<u8>);

/// Names and bytes of the four.
pub(super) fn write(trained: &Trained) -> Result<[File; 4], ExportError> {
    Ok([
        finish(TEXT_PROJECTION, &text_projection(trained))?,
        finish(AR_DECODER, &ar_decoder(trained))?,
        finish(TAP_DECODER, &tap_decoder(trained))?,
        finish(ENCODER, &encoder(trained))?,
    ])
}

fn finish(file: &'static str, writer: &Writer<'_>) -> Result<File, ExportError> {
    let bytes = writer.graph.finish();
    let bytes = bytes.map_err(|source| ExportError::Graph { file, source })?;
    Ok((file, bytes))
}

/// `embedding` [B, W] → `z` [B, 64], `similarity` [B, M], its cosine with the mean caption of
/// every material, `familiarity` [B, 1], and from a memory with a lexicon `felt` [B, 3]: dB, −ln μ
/// and ln Hz.
fn text_projection(trained: &Trained) -> Writer<'_> {
    let mut writer = Writer::new("text_projection", &trained.parameters);
    let (width, count) = (trained.width, trained.materials.len());
    let embedding = writer.input("embedding", &[width]);
    let mut columns = vec![0.0; width * count];
    for (column, material) in trained.materials.iter().enumerate() {
        for (row, x) in material.caption.iter().enumerate() {
            columns[row * count + column] = *x;
        }
    }
    let direction = unit_rows(&mut writer, &embedding);
    let similarity = writer.product("mean_captions", &direction, &columns, count);
    let Remembered { z, felt, likeness } = match &trained.memory {
        Some(memory) => from_memory(&mut writer, trained, memory, &direction),
        None => Remembered {
            z: writer.chain(&trained.network.text.layers, &embedding),
            felt: None,
            likeness: writer.plus(&similarity, -1.0),
        },
    };
    writer.output("z", &z, &[LATENT]);
    if let Some(felt) = felt {
        writer.output("felt", &felt, &[FELT]);
    }
    writer.output("similarity", &similarity, &[count]);
    let familiarity = soft_maximum(&mut writer, &likeness);
    writer.output("familiarity", &familiarity, &[1]);
    writer
}

/// `1 + ln(Σ exp(κ·likeness))/κ`, as [`KernelRidge::familiarity`].
fn soft_maximum(writer: &mut Writer<'_>, likeness: &Value) -> Value {
    let sharp = writer.times(likeness, SHARPNESS);
    let terms = writer.graph.unary("Exp", &sharp);
    let sum = row_sum(writer, &terms);
    let sum = writer.plus(&sum, f32::MIN_POSITIVE);
    let logarithm = writer.graph.unary("Log", &sum);
    let scaled = writer.times(&logarithm, 1.0 / SHARPNESS);
    writer.plus(&scaled, 1.0)
}

/// Output of a memory for a text.
struct Remembered {
    z: Value,
    felt: Option<Value>,
    /// e·e_i − 1.
    likeness: Value,
}

/// The latent of a text drawn to its material, as [`LdaRetrieval::draw`].
fn recalled(
    writer: &mut Writer<'_>,
    trained: &Trained,
    recall: &LdaRetrieval,
    z: &Value,
    direction: &Value,
) -> Value {
    let (count, width) = (recall.owners.len(), recall.discriminant.offset.len());
    let basis = &recall.discriminant.basis;
    let placed = exact_product(writer, "recall.basis", direction, basis, width);
    let offset = writer.row("recall.offset", &recall.discriminant.offset);
    let placed = writer.graph.add(&placed, &offset);
    let placed = unit_rows(writer, &placed);
    let prototypes = dequantised(writer, "prototypes", &recall.codes, width, &recall.scales);
    let inputs = [Some(&placed), Some(&prototypes)];
    let nearness = writer.graph.node("MatMul", &inputs, &[]);
    let nearness = writer.plus(&nearness, -1.0);
    let exponent = writer.times(&nearness, 1.0 / recall.how.temperature as f32);
    let log_weights = writer.row("prototypes.log_weights", &recall.log_weights);
    let exponent = writer.graph.add(&exponent, &log_weights);
    let weights = writer.graph.unary("Exp", &exponent);
    let owners = recall.owners.iter();
    let means: Vec<f32> = owners
        .flat_map(|&owner| trained.materials[owner].mean)
        .collect();
    let kept = writer.row("recall.kept", &[recall.kept()]);
    let means = writer.table("prototypes.z", &[count, LATENT], means);
    drawn(writer, &means, z, &kept, &weights)
}

/// Attributes of a text drawn to those of the material that it names, as [`AttributeRegression::ask`]; `likeness`
/// is that of the memory's examples.
fn felt_recalled(
    writer: &mut Writer<'_>,
    feel: &AttributeRegression,
    how: &config::Recall,
    felt: &Value,
    likeness: &Value,
    examples: usize,
) -> Value {
    let exponent = writer.times(likeness, 1.0 / how.felt_temperature as f32);
    let near = writer.graph.unary("Exp", &exponent);
    let names = feel.names.examples.iter().map(|&example| example as i64);
    let weights = writer.gather(&near, 1, &names.collect::<Vec<i64>>());
    let phrases = (feel.names.phrases_from as i64, examples as i64);
    let phrases = writer.graph.slice(&near, 1, phrases.0, phrases.1);
    let kept = row_sum(writer, &phrases);
    let kept = writer.times(&kept, how.felt_phrase_weight as f32);
    let kept = writer.plus(&kept, LEAST);
    let owners = feel.names.owners.iter();
    let rows: Vec<f32> = owners.flat_map(|&owner| feel.materials[owner]).collect();
    let rows = writer.table("names.felt", &[feel.names.owners.len(), FELT], rows);
    drawn(writer, &rows, felt, &kept, &weights)
}

/// `(w·X + g·x)/(Σ w + g)`, as [`lda_retrieval::drawn`]; g is `kept`.
fn drawn(
    writer: &mut Writer<'_>,
    rows: &Value,
    said: &Value,
    kept: &Value,
    weights: &Value,
) -> Value {
    let inputs = [Some(weights), Some(rows)];
    let drawn = writer.graph.node("MatMul", &inputs, &[]);
    let own = writer.graph.mul(said, kept);
    let numerator = writer.graph.add(&drawn, &own);
    let total = row_sum(writer, weights);
    let total = writer.graph.add(&total, kept);
    writer.graph.div(&numerator, &total)
}

/// `x·W` for a matrix of so many columns, W as it is: where a τ divides what follows, or where the
/// rounding of many thousand rows would add up.
fn exact_product(
    writer: &mut Writer<'_>,
    name: &str,
    x: &Value,
    values: &[f32],
    columns: usize,
) -> Value {
    let rows = values.len() / columns.max(1);
    let matrix = writer.table(name, &[rows, columns], values.to_vec());
    let inputs = [Some(x), Some(&matrix)];
    writer.graph.node("MatMul", &inputs, &[])
}

/// Rows of length one, [B, W].
fn unit_rows(writer: &mut Writer<'_>, x: &Value) -> Value {
    let attributes = [
        ("axes", Attribute::Ints(vec![1])),
        ("keepdims", Attribute::Int(1)),
    ];
    let norm = writer.graph.node("ReduceL2", &[Some(x)], &attributes);
    let norm = writer.plus(&norm, f32::MIN_POSITIVE);
    writer.graph.div(x, &norm)
}

/// The sum of each row, [B, 1].
fn row_sum(writer: &mut Writer<'_>, x: &Value) -> Value {
    // An input from opset 13 on, which these graphs are beyond.
    let axes = writer.graph.integers(&[1]);
    let keep = ("keepdims", Attribute::Int(1));
    writer
        .graph
        .node("ReduceSum", &[Some(x), Some(&axes)], &[keep])
}

/// 8-bit rows as a matrix of columns, [width, rows].
fn dequantised(
    writer: &mut Writer<'_>,
    name: &str,
    codes: &[i8],
    width: usize,
    scales: &[f32],
) -> Value {
    let count = scales.len();
    let mut columns = vec![0_u8; width * count];
    for (column, example) in codes.chunks(width.max(1)).enumerate() {
        for (row, code) in example.iter().enumerate() {
            columns[row * count + column] = code.to_ne_bytes()[0];
        }
    }
    let codes = Tensor::I8 {
        shape: vec![width, count],
        data: columns.into(),
    };
    let codes = writer.graph.constant(name, codes);
    let scales = Tensor::f32(&[count], scales.to_vec());
    let scales = writer.graph.constant(&format!("{name}.scales"), scales);
    let axis = ("axis", Attribute::Int(1));
    let inputs = [Some(&codes), Some(&scales)];
    writer.graph.node("DequantizeLinear", &inputs, &[axis])
}

/// The latent `z̄ + exp(γ(e·e_i − 1))·a` and the attributes by the same with a γ of their own, recalled:
/// 8-bit vectors on their principal directions, and 8-bit coefficients of the latent.
fn from_memory(
    writer: &mut Writer<'_>,
    trained: &Trained,
    memory: &KernelRidge,
    direction: &Value,
) -> Remembered {
    let (width, count) = (memory.kept, memory.scales.len());
    let direction = &exact_product(writer, "memory.basis", direction, &memory.basis, width);
    let kept = dequantised(
        writer,
        "memory.vectors",
        &memory.codes,
        width,
        &memory.scales,
    );
    let likeness = writer
        .graph
        .node("MatMul", &[Some(direction), Some(&kept)], &[]);
    let likeness = writer.plus(&likeness, -1.0);
    let kernel = kernel(writer, &likeness, memory.concentration);
    let coefficients = Tensor::I8 {
        shape: vec![count, LATENT],
        data: memory
            .coefficients
            .iter()
            .map(|code| code.to_ne_bytes()[0])
            .collect::<Vec<u8>>()
            .into(),
    };
    let coefficients = writer.graph.constant("memory.coefficients", coefficients);
    let scales = Tensor::f32(&[LATENT], memory.coefficient_scales.to_vec());
    let scales = writer.graph.constant("memory.coefficient_scales", scales);
    let axis = ("axis", Attribute::Int(1));
    let inputs = [Some(&coefficients), Some(&scales)];
    let coefficients = writer.graph.node("DequantizeLinear", &inputs, &[axis]);
    let from_mean = writer
        .graph
        .node("MatMul", &[Some(&kernel), Some(&coefficients)], &[]);
    let mean = writer.row("memory.mean", &memory.mean);
    let z = writer.graph.add(&from_mean, &mean);
    let felt = trained.feel.as_ref().map(|feel| {
        let kernel = self::kernel(writer, &likeness, feel.concentration);
        let coefficients = feel.coefficients.as_flattened();
        let felt = exact_product(writer, "feel.coefficients", &kernel, coefficients, FELT);
        let mean = writer.row("feel.mean", &feel.mean);
        let felt = writer.graph.add(&felt, &mean);
        match &feel.recall {
            Some(how) => felt_recalled(writer, feel, how, &felt, &likeness, count),
            None => felt,
        }
    });
    let z = match &trained.recall {
        Some(recall) => recalled(writer, trained, recall, &z, direction),
        None => z,
    };
    Remembered { z, felt, likeness }
}

/// `exp(γ·likeness)`.
fn kernel(writer: &mut Writer<'_>, likeness: &Value, concentration: f32) -> Value {
    let exponent = writer.times(likeness, concentration);
    writer.graph.unary("Exp", &exponent)
}

/// `z` [B, 64] → `lsf_rad` [B, 18, 21] and `level_db` [B, 18].
fn ar_decoder(trained: &Trained) -> Writer<'_> {
    let mut writer = Writer::new("ar_decoder", &trained.parameters);
    let (decoder, normaliser) = (&trained.network.ar_decoder, &trained.normaliser);
    let z = writer.input("z", &[LATENT]);
    let features = trunk(&mut writer, &decoder.trunk, &z);
    let logits = writer.linear(decoder.lsf_head, &features);
    let (bins, gaps) = (BINS as i64, GAPS as i64);
    let logits = writer.graph.reshape(&logits, &[0, bins, gaps]);
    let shares = writer.graph.softmax(&logits, 2);
    let matrix = writer.table("gap_matrix", &[GAPS, ORDER], gap_matrix());
    let offsets = writer.table("gap_offsets", &[ORDER], gap_offsets());
    let above = writer
        .graph
        .node("MatMul", &[Some(&shares), Some(&matrix)], &[]);
    let lsf_rad = writer.graph.add(&above, &offsets);
    writer.output("lsf_rad", &lsf_rad, &[BINS, ORDER]);
    let free = writer.linear(decoder.excitation_head, &features);
    let (mean, deviation) = (
        &normaliser.ar_mean[LSFS..],
        &normaliser.ar_deviation[LSFS..],
    );
    let free = writer.restore("excitation", &free, mean, deviation);
    let (low, high) = normaliser.excitation_bounds;
    let (centre, reach) = (0.5 * (low + high), 0.5 * (high - low));
    let free = writer.plus(&free, -centre);
    let free = writer.times(&free, 1.0 / reach);
    let bounded = writer.graph.unary("Tanh", &free);
    let bounded = writer.times(&bounded, reach);
    let code = writer.plus(&bounded, centre);
    let level_db = match normaliser.coding.excitation {
        Excitation::Level => code,
        Excitation::Variance => {
            // The bounds are positive, but rounding may reach below the lower one.
            let code = writer.graph.clip(&code, low, high);
            let logarithm = writer.graph.unary("Log", &code);
            let variance_db = writer.times(&logarithm, (10.0 * LOG10_E) as f32);
            let gain_db = gain::decibels(&mut writer, &lsf_rad);
            writer.graph.add(&variance_db, &gain_db)
        }
    };
    let (low, high) = normaliser.level_bounds_db;
    let level_db = writer.graph.clip(&level_db, low, high);
    writer.output("level_db", &level_db, &[BINS]);
    writer
}

/// `z` [B, 64] → `taps_m_s2` [B, 13, 100].
fn tap_decoder(trained: &Trained) -> Writer<'_> {
    let mut writer = Writer::new("tap_decoder", &trained.parameters);
    let (decoder, normaliser) = (&trained.network.tap_decoder, &trained.normaliser);
    let z = writer.input("z", &[LATENT]);
    let features = trunk(&mut writer, &decoder.trunk, &z);
    let free = writer.linear(decoder.head, &features);
    let free = writer.restore(
        "taps",
        &free,
        &normaliser.tap_mean,
        &normaliser.tap_deviation,
    );
    let limit = writer.row("taps.bound", &normaliser.tap_bound);
    let free = writer.graph.div(&free, &limit);
    let bounded = writer.graph.unary("Tanh", &free);
    let taps = writer.graph.mul(&bounded, &limit);
    let taps = writer
        .graph
        .reshape(&taps, &[0, TAPS as i64, TAP_SAMPLES as i64]);
    writer.output("taps_m_s2", &taps, &[TAPS, TAP_SAMPLES]);
    writer
}

fn trunk(writer: &mut Writer<'_>, trunk: &Trunk, z: &Value) -> Value {
    let widened = writer.chain(&trunk.layers, z);
    let mut x = writer.graph.relu(&widened);
    for (first, second) in &trunk.blocks {
        let inner = writer.linear(*first, &x);
        let inner = writer.graph.relu(&inner);
        let change = writer.linear(*second, &inner);
        let sum = writer.graph.add(&x, &change);
        x = writer.graph.relu(&sum);
    }
    x
}

/// `ar` [B, 18, 22], `taps_m_s2` [B, 13, 100], `present` [B, 2] → `mean` and
/// `log_variance` [B, 64].
fn encoder(trained: &Trained) -> Writer<'_> {
    let mut writer = Writer::new("encoder", &trained.parameters);
    let (encoder, normaliser) = (&trained.network.encoder, &trained.normaliser);
    let ar = writer.input("ar", &[BINS, CHANNELS]);
    let taps = writer.input("taps_m_s2", &[TAPS, TAP_SAMPLES]);
    let present = writer.input("present", &[2]);
    let lsf_rad = writer.graph.slice(&ar, 2, 0, ORDER as i64);
    let level_db = writer.graph.slice(&ar, 2, ORDER as i64, CHANNELS as i64);
    let level_db = writer.graph.reshape(&level_db, &[0, BINS as i64]);
    let code = excitation_code(
        &mut writer,
        normaliser.coding.excitation,
        &lsf_rad,
        &level_db,
    );
    let lsf_rad = writer.graph.reshape(&lsf_rad, &[0, LSFS as i64]);
    let ar = writer.graph.concat(&[&lsf_rad, &code], 1);
    let ar = writer.normalise("ar", &ar, &normaliser.ar_mean, &normaliser.ar_deviation);
    let taps = writer.graph.reshape(&taps, &[0, TAP_VALUES as i64]);
    let taps = writer.normalise(
        "taps",
        &taps,
        &normaliser.tap_mean,
        &normaliser.tap_deviation,
    );
    let ar = writer.chain(&encoder.ar, &ar);
    let taps = writer.chain(&encoder.taps, &taps);
    let mut either = |features: &Value, absent: Slot, column: i64| {
        let there = writer.graph.slice(&present, 1, column, column + 1);
        let absent = writer.parameter(absent);
        let difference = writer.graph.sub(features, &absent);
        let kept = writer.graph.mul(&difference, &there);
        writer.graph.add(&kept, &absent)
    };
    let ar = either(&ar, encoder.absent_ar, 0);
    let taps = either(&taps, encoder.absent_taps, 1);
    let joint = writer.graph.concat(&[&ar, &taps], 1);
    let mean = writer.linear(encoder.mean, &joint);
    writer.output("mean", &mean, &[LATENT]);
    let free = writer.linear(encoder.log_variance, &joint);
    let free = writer.times(&free, 1.0 / LOG_VARIANCE_BOUND);
    let bounded = writer.graph.unary("Tanh", &free);
    let log_variance = writer.times(&bounded, LOG_VARIANCE_BOUND);
    writer.output("log_variance", &log_variance, &[LATENT]);
    writer
}

/// The level as the network was trained to see it, [B, 18].
fn excitation_code(
    writer: &mut Writer<'_>,
    excitation: Excitation,
    lsf_rad: &Value,
    level_db: &Value,
) -> Value {
    if excitation == Excitation::Level {
        return level_db.clone();
    }
    let gain_db = gain::decibels(writer, lsf_rad);
    let sigma_db = writer.graph.sub(level_db, &gain_db);
    let exponent = writer.times(&sigma_db, (0.1 * LN_10) as f32);
    writer.graph.unary("Exp", &exponent)
}
