//! A folder of the signature of Stable Diffusion, small enough for tests: 4 channels of 16 × 16.
//!
//! Its UNet is no learned network but the right answer for a single picture: data that are one
//! point x₀ have the noise ε = (x − √ᾱ·x₀)/√(1−ᾱ) in x, whatever the step. x₀ follows from the
//! text, linearly in its tokens. So any right scheduler ends at x₀, and classifier-free guidance
//! at x₀(negative) + scale·(x₀(prompt) − x₀(negative)): [`clean`] says where.
//!
//! The decoder darkens a border of one latent, as padding does.

use crate::{
    folder::{
        MERGES as MERGES_FILE, MODEL_INDEX, SCHEDULER_CONFIG, TEXT_ENCODER, TOKENIZER_CONFIG, UNET,
        UNET_CONFIG, VAE_CONFIG, VAE_DECODER, VOCABULARY,
    },
    noise::Noise,
    scheduler::{Config, Prediction},
    tokenizer::{CONTEXT, byte_letters},
};
use asperity_nn::{
    Dim, ElementType, OnnxError, Tensor,
    build::{Attribute, GraphBuilder, Value},
};
use serde_json::{Map, json};

/// Merges of the tokenizer: enough for one word.
pub const MERGES: [&str; 3] = ["c o", "r k</w>", "co rk</w>"];
/// Width and height of a latent.
pub const LATENT: usize = 16;
/// Width and height of a picture, pixels.
pub const PICTURE: usize = FACTOR * LATENT;

const CHANNELS: usize = 4;
const FACTOR: usize = 8;
const SCALING: f64 = 0.18215;
/// Tokens that x₀ follows from: those after the start mark.
const READ: usize = 8;
const SIZE: usize = LATENT * LATENT;

/// Options of a tiny folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Quantity that its UNet predicts.
    pub prediction: Prediction,
    /// Type of its UNet's steps: int64, int32 or float32.
    pub timestep: ElementType,
    /// Width of its text encoder.
    pub text_width: usize,
    /// Width of text that its UNet takes.
    pub unet_text_width: usize,
    /// True if its UNet outputs NaN.
    pub is_broken: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            prediction: Prediction::Epsilon,
            timestep: ElementType::I64,
            text_width: 12,
            unet_text_width: 12,
            is_broken: false,
        }
    }
}

/// The files of a folder, by their paths in it. The same options give the same bytes.
///
/// # Panics
/// Never with types and widths that [`Options`] names.
#[must_use]
pub fn folder(options: &Options) -> Vec<(&'static str, Vec<u8>)> {
    let network = |built: Result<Vec<u8>, OnnxError>| built.expect("a network that loads");
    vec![
        (
            MODEL_INDEX,
            text(&json!({
                "_class_name": "StableDiffusionPipeline",
                "_name_or_path": "asperity/tiny",
            })),
        ),
        (
            SCHEDULER_CONFIG,
            scheduler_config(options.prediction).into_bytes(),
        ),
        (VOCABULARY, vocabulary()),
        (
            MERGES_FILE,
            format!("#version: 0.2\n{}\n", MERGES.join("\n")).into_bytes(),
        ),
        (
            TOKENIZER_CONFIG,
            text(&json!({"model_max_length": CONTEXT, "pad_token": "!"})),
        ),
        (TEXT_ENCODER, network(text_encoder(options.text_width))),
        (UNET, network(unet(options))),
        (
            UNET_CONFIG,
            text(&json!({"in_channels": CHANNELS, "sample_size": LATENT})),
        ),
        (VAE_DECODER, network(vae_decoder())),
        (VAE_CONFIG, text(&json!({"scaling_factor": SCALING}))),
    ]
}

/// x₀ of a text's ids: [channel, row, column].
#[must_use]
pub fn clean(ids: &[i64], options: &Options) -> Vec<f32> {
    let width = options.text_width;
    let (table, projection) = (table(width), projection(width));
    let mut means = [0.0_f32; CHANNELS];
    for &id in &ids[1..=READ] {
        let row = &table[id as usize * width..][..width];
        for (n, x) in row.iter().enumerate() {
            for (c, mean) in means.iter_mut().enumerate() {
                *mean += x * projection[n * CHANNELS + c] / READ as f32;
            }
        }
    }
    let pattern = pattern();
    (0..CHANNELS * SIZE)
        .map(|at| means[at / SIZE] + pattern[at])
        .collect()
}

/// The colours of a latent in −1..1, without the dark border: three planes of [`LATENT`] ×
/// [`LATENT`].
#[must_use]
pub fn colors(latent: &[f32]) -> Vec<f32> {
    let mix = color_mix();
    let color = |c: usize, at: usize| -> f32 {
        let channels = (0..CHANNELS).map(|k| latent[k * SIZE + at] * mix[k * 3 + c]);
        channels.sum::<f32>() / SCALING as f32
    };
    (0..3)
        .flat_map(|c| (0..SIZE).map(move |at| color(c, at)))
        .collect()
}

fn text(value: &serde_json::Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

fn scheduler_config(prediction: Prediction) -> String {
    let prediction = match prediction {
        Prediction::Epsilon => "epsilon",
        Prediction::Velocity => "v_prediction",
    };
    // As Stable Diffusion 2 has it, but that the last step ends at the picture itself.
    let value = json!({
        "_class_name": "DDIMScheduler",
        "beta_start": 0.00085,
        "beta_end": 0.012,
        "beta_schedule": "scaled_linear",
        "clip_sample": false,
        "num_train_timesteps": 1000,
        "prediction_type": prediction,
        "set_alpha_to_one": true,
        "steps_offset": 1,
    });
    format!("{value:#}\n")
}

fn vocabulary() -> Vec<u8> {
    let letters = byte_letters().map(|letter| letter.to_string());
    let ends = byte_letters().map(|letter| format!("{letter}</w>"));
    let merged = MERGES.iter().map(|merge| merge.replace(' ', ""));
    let marks = ["<|startoftext|>", "<|endoftext|>"].map(str::to_owned);
    let tokens = letters.chain(ends).chain(merged).chain(marks);
    let ids: Map<String, serde_json::Value> = tokens
        .enumerate()
        .map(|(id, token)| (token, id.into()))
        .collect();
    text(&ids.into())
}

/// A vector for each token.
fn table(width: usize) -> Vec<f32> {
    Noise::new(1).normal((512 + MERGES.len() + 2) * width)
}

/// From a text's mean vector to x₀'s channels: [width, channels].
fn projection(width: usize) -> Vec<f32> {
    let gain = 0.6 / (width as f32).sqrt();
    let numbers = Noise::new(2).normal(width * CHANNELS);
    numbers.into_iter().map(|x| gain * x).collect()
}

/// The part of x₀ that does not depend on the text.
fn pattern() -> Vec<f32> {
    let numbers = Noise::new(3).normal(CHANNELS * SIZE);
    numbers.into_iter().map(|x| 0.05 * x).collect()
}

/// From channels to colours: [channels, 3].
fn color_mix() -> Vec<f32> {
    let numbers = Noise::new(4).normal(CHANNELS * 3);
    numbers.into_iter().map(|x| 0.25 * x).collect()
}

fn text_encoder(width: usize) -> Result<Vec<u8>, OnnxError> {
    let mut graph = GraphBuilder::new("text_encoder");
    let dims = [Dim::named("batch_size"), Dim::named("sequence_length")];
    let ids = graph.input("input_ids", ElementType::I64, &dims);
    let table = Tensor::f32(&[512 + MERGES.len() + 2, width], table(width));
    let table = graph.constant("table", table);
    let states = graph.node("Gather", &[Some(&table), Some(&ids)], &[]);
    let pooled = graph.node(
        "ReduceMean",
        &[Some(&states)],
        &[
            ("axes", Attribute::Ints(vec![1])),
            ("keepdims", Attribute::Int(0)),
        ],
    );
    let [batch, sequence] = dims;
    let width = Dim::Fixed(width);
    let dims = [batch.clone(), sequence, width.clone()];
    graph.output("last_hidden_state", &states, ElementType::F32, &dims);
    graph.output("pooler_output", &pooled, ElementType::F32, &[batch, width]);
    graph.finish()
}

fn unet(options: &Options) -> Result<Vec<u8>, OnnxError> {
    let mut graph = GraphBuilder::new("unet");
    let width = options.unet_text_width;
    let latents = [
        Dim::named("batch_size"),
        Dim::Fixed(CHANNELS),
        Dim::named("height"),
        Dim::named("width"),
    ];
    let sample = graph.input("sample", ElementType::F32, &latents);
    let timestep = graph.input("timestep", options.timestep, &[Dim::named("steps")]);
    let texts = [
        Dim::named("batch_size"),
        Dim::named("sequence_length"),
        Dim::Fixed(width),
    ];
    let states = graph.input("encoder_hidden_states", ElementType::F32, &texts);
    let (signal, noise) = shares(&mut graph, &timestep);
    let clean = clean_graph(&mut graph, &states, width);
    let shown = graph.mul(&signal, &clean);
    let rest = graph.sub(&sample, &shown);
    let mut output = graph.div(&rest, &noise);
    if options.prediction == Prediction::Velocity {
        let forth = graph.mul(&signal, &output);
        let back = graph.mul(&noise, &clean);
        output = graph.sub(&forth, &back);
    }
    if options.is_broken {
        let nothing = graph.scalar(f32::NAN);
        output = graph.add(&output, &nothing);
    }
    graph.output("out_sample", &output, ElementType::F32, &latents);
    graph.finish()
}

/// √ᾱ and √(1−ᾱ) of a step.
fn shares(graph: &mut GraphBuilder, timestep: &Value) -> (Value, Value) {
    let config = Config::parse(&scheduler_config(Prediction::Epsilon)).expect("its own schedule");
    let alphas: Vec<f32> = config.alphas_cumprod.iter().map(|&a| a as f32).collect();
    let alphas = graph.constant("alphas_cumprod", Tensor::f32(&[alphas.len()], alphas));
    let code = i64::from(ElementType::I64.onnx_code());
    let place = graph.node("Cast", &[Some(timestep)], &[("to", Attribute::Int(code))]);
    let share = graph.node("Gather", &[Some(&alphas), Some(&place)], &[]);
    let one = graph.scalar(1.0);
    let rest = graph.sub(&one, &share);
    (graph.unary("Sqrt", &share), graph.unary("Sqrt", &rest))
}

/// x₀ of a text.
fn clean_graph(graph: &mut GraphBuilder, states: &Value, width: usize) -> Value {
    let read = graph.slice(states, 1, 1, 1 + READ as i64);
    let mean = graph.node(
        "ReduceMean",
        &[Some(&read)],
        &[
            ("axes", Attribute::Ints(vec![1])),
            ("keepdims", Attribute::Int(0)),
        ],
    );
    let weights = Tensor::f32(&[width, CHANNELS], projection(width));
    let weights = graph.constant("projection", weights);
    let channels = graph.node("MatMul", &[Some(&mean), Some(&weights)], &[]);
    let channels = graph.unsqueeze(&channels, &[2, 3]);
    let pattern = Tensor::f32(&[1, CHANNELS, LATENT, LATENT], pattern());
    let pattern = graph.constant("pattern", pattern);
    graph.add(&channels, &pattern)
}

fn vae_decoder() -> Result<Vec<u8>, OnnxError> {
    let mut graph = GraphBuilder::new("vae_decoder");
    let dims = |channels: usize, name: &str| {
        [
            Dim::named("batch_size"),
            Dim::Fixed(channels),
            Dim::named(&format!("height_{name}")),
            Dim::named(&format!("width_{name}")),
        ]
    };
    let latent = dims(CHANNELS, "latent");
    let latent = graph.input("latent_sample", ElementType::F32, &latent);
    let order = |graph: &mut GraphBuilder, x: &Value, order: &[i64]| {
        let order = ("perm", Attribute::Ints(order.to_vec()));
        graph.node("Transpose", &[Some(x)], &[order])
    };
    let last = order(&mut graph, &latent, &[0, 2, 3, 1]);
    let mix = graph.constant("colors", Tensor::f32(&[CHANNELS, 3], color_mix()));
    let colors = graph.node("MatMul", &[Some(&last), Some(&mix)], &[]);
    let colors = order(&mut graph, &colors, &[0, 3, 1, 2]);
    let wide = graph.unsqueeze(&colors, &[3, 5]);
    let factor = FACTOR as i64;
    let repeats = graph.integers(&[1, 1, 1, factor, 1, factor]);
    let wide = graph.node("Expand", &[Some(&wide), Some(&repeats)], &[]);
    let size = PICTURE as i64;
    let pixels = graph.reshape(&wide, &[-1, 3, size, size]);
    let border = graph.constant("border", Tensor::f32(&[1, 1, PICTURE, PICTURE], border()));
    let pixels = graph.mul(&pixels, &border);
    graph.output("sample", &pixels, ElementType::F32, &dims(3, "picture"));
    graph.finish()
}

/// Half the light on a border of one latent.
fn border() -> Vec<f32> {
    let inside = FACTOR..PICTURE - FACTOR;
    let pixel = |at: usize| inside.contains(&(at / PICTURE)) && inside.contains(&(at % PICTURE));
    (0..PICTURE * PICTURE)
        .map(|at| if pixel(at) { 1.0 } else { 0.5 })
        .collect()
}
