//! From a prompt to a picture, on a folder whose picture is known.

use crate::common;
use crate::common::{cork, opened};
use asperity_diffusion::{
    Method, Picture, Request, Tokens, folder,
    scheduler::Prediction,
    tiny::{self, LATENT, Options, PICTURE},
};
use asperity_nn::ElementType;

/// The picture that a right sampler ends at: x₀(negative) + scale·(x₀(prompt) − x₀(negative)),
/// decoded.
fn expected(request: &Request, options: &Options) -> Picture {
    let parts = common::parts(options);
    let settings = parts.tokenizer_config.as_deref();
    let tokens = Tokens::parse(&parts.vocabulary, &parts.merges, settings).expect("a tokenizer");
    let clean = |text: &str| tiny::clean(&tokens.encode(text).ids, options);
    let pairs = clean(&request.negative)
        .into_iter()
        .zip(clean(&request.prompt));
    let latent: Vec<f32> = pairs
        .map(|(without, with)| without + request.guidance * (with - without))
        .collect();
    let colors = tiny::colors(&latent);
    let factor = PICTURE / LATENT;
    let pixel = |at: usize| {
        let (y, x) = (at / PICTURE, at % PICTURE);
        let is_border = |place: usize| place < factor || place >= PICTURE - factor;
        let light = match !request.tile && (is_border(y) || is_border(x)) {
            true => 0.5,
            false => 1.0,
        };
        [0, 1, 2].map(|c| {
            let color = light * colors[(c * LATENT + y / factor) * LATENT + x / factor];
            ((color * 0.5 + 0.5).clamp(0.0, 1.0) * 255.0).round() as u8
        })
    };
    Picture {
        size: PICTURE,
        pixels: (0..PICTURE * PICTURE).map(pixel).collect(),
    }
}

/// The largest difference of a channel, and the mean difference of the wanted picture from grey.
fn difference(found: &Picture, expected: &Picture) -> (u8, f64) {
    assert_eq!(found.size, expected.size);
    let (found, expected) = (found.pixels.as_flattened(), expected.pixels.as_flattened());
    let pairs = found.iter().zip(expected);
    let largest = pairs.map(|(a, b)| a.abs_diff(*b)).max().expect("a pixel");
    let from_grey: f64 = expected.iter().map(|x| f64::from(x.abs_diff(128))).sum();
    (largest, from_grey / expected.len() as f64)
}

/// Claim: both methods, both predictions and every type of step end at the picture that the
/// folder stands for, guided as far as asked. A level is 1/255: rounding may move a pixel by one.
#[test]
fn the_picture_is_the_one_that_the_folder_stands_for() {
    for method in [Method::Ddim, Method::Euler] {
        for prediction in [Prediction::Epsilon, Prediction::Velocity] {
            for timestep in [ElementType::I64, ElementType::I32, ElementType::F32] {
                let options = Options {
                    prediction,
                    timestep,
                    ..Options::default()
                };
                let model = opened(&options, |_| {}).expect("a model");
                // Whole steps where the tiny UNet cuts fractions off.
                let steps = if timestep == ElementType::F32 { 4 } else { 7 };
                for guidance in [1.0, 7.5] {
                    let request = Request {
                        steps,
                        guidance,
                        method,
                        ..cork()
                    };
                    let sampled = model.sample(&request, &mut |_| {}).expect("a picture");
                    let (largest, from_grey) =
                        difference(&sampled.picture, &expected(&request, &options));
                    assert!(
                        largest <= 1,
                        "{method} {prediction:?} {timestep}: {largest}"
                    );
                    assert!(from_grey > 20.0, "nothing is shown: {from_grey}");
                }
            }
        }
    }
}

#[test]
fn a_prompt_guidance_and_a_negative_prompt_change_the_picture() {
    let options = Options::default();
    let model = opened(&options, |_| {}).expect("a model");
    let mut pictures = Vec::new();
    for (prompt, negative, guidance) in [
        ("cork", "", 7.5),
        ("c o r k", "", 7.5),
        ("cork", "grass", 7.5),
        ("cork", "", 2.0),
    ] {
        let request = Request {
            prompt: prompt.into(),
            negative: negative.into(),
            guidance,
            ..cork()
        };
        let sampled = model.sample(&request, &mut |_| {}).expect("a picture");
        assert!(difference(&sampled.picture, &expected(&request, &options)).0 <= 1);
        assert!(!pictures.contains(&sampled.picture), "{prompt} {negative}");
        pictures.push(sampled.picture);
    }
}

/// Claim: a picture that repeats has no dark border, which the decoder gives to all others. The
/// tiny UNet puts its pattern at a fixed place of what it is given, so the picture is the expected
/// one, moved by as much as the last step was rolled.
#[test]
fn a_tile_has_no_border() {
    let options = Options::default();
    let model = opened(&options, |_| {}).expect("a model");
    for method in [Method::Ddim, Method::Euler] {
        let request = Request {
            tile: true,
            method,
            ..cork()
        };
        let tiled = model.sample(&request, &mut |_| {}).expect("a picture");
        let wanted = expected(&request, &options);
        let factor = PICTURE / LATENT;
        let moved = |down: usize, right: usize| {
            let pixel = |at: usize| {
                let y = (at / PICTURE + factor * down) % PICTURE;
                let x = (at % PICTURE + factor * right) % PICTURE;
                wanted.pixels[y * PICTURE + x]
            };
            Picture {
                size: PICTURE,
                pixels: (0..PICTURE * PICTURE).map(pixel).collect(),
            }
        };
        let rolls = (0..LATENT).flat_map(|down| (0..LATENT).map(move |right| (down, right)));
        let nearest = rolls
            .map(|(down, right)| difference(&tiled.picture, &moved(down, right)).0)
            .min();
        assert!(nearest <= Some(1), "{method}: {nearest:?}");
    }
}

#[test]
fn the_same_seed_gives_the_same_picture_and_steps_are_told() {
    let model = opened(&Options::default(), |_| {}).expect("a model");
    // Rolling leaves a trace of the seed, which the right answer to one point would not.
    let request = Request {
        tile: true,
        ..cork()
    };
    let mut told = Vec::new();
    let first = model.sample(&request, &mut |step| told.push(step));
    assert_eq!(told, [1, 2, 3, 4, 5, 6, 7]);
    let first = first.expect("a picture");
    assert_eq!(model.sample(&request, &mut |_| {}).as_ref(), Ok(&first));
    let other = Request { seed: 2, ..request };
    assert_ne!(model.sample(&other, &mut |_| {}), Ok(first));
}

#[test]
fn how_texts_are_padded_is_seen() {
    let picture = |settings: &str| {
        let change = |parts: &mut asperity_diffusion::Parts| {
            parts.tokenizer_config = Some(settings.to_owned());
        };
        let model = opened(&Options::default(), change).expect("a model");
        let request = Request {
            guidance: 1.0,
            ..cork()
        };
        model.sample(&request, &mut |_| {}).expect("a picture")
    };
    assert_ne!(
        picture(r#"{"pad_token": "!"}"#),
        picture(r#"{"pad_token": "<|endoftext|>"}"#)
    );
}

#[test]
fn tokens_that_do_not_fit_are_counted() {
    let model = opened(&Options::default(), |_| {}).expect("a model");
    let long = "cork ".repeat(80);
    let request = Request {
        prompt: long,
        ..cork()
    };
    assert_eq!(
        model.sample(&request, &mut |_| {}).expect("a picture").cut,
        5
    );
    assert_eq!(model.name(), "asperity/tiny");
}

/// The folder is written and named as exporters do.
#[test]
fn the_tiny_folder_holds_every_part() {
    let files = tiny::folder(&Options::default());
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    for part in [
        folder::MODEL_INDEX,
        "scheduler/scheduler_config.json",
        "tokenizer/vocab.json",
        "tokenizer/merges.txt",
        "tokenizer/tokenizer_config.json",
        "text_encoder/model.onnx",
        "unet/model.onnx",
        "unet/config.json",
        "vae_decoder/model.onnx",
        "vae_decoder/config.json",
    ] {
        assert!(names.contains(&part), "{part}");
    }
    let bytes: usize = files.iter().map(|(_, bytes)| bytes.len()).sum();
    assert!(bytes < 200_000, "{bytes}");
}
