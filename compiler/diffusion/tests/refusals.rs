//! Folders with parts that do not fit: which part, which port, and what to do.

use crate::common::{cork, opened, parts};
use asperity_diffusion::{DiffusionError, Parts, Problem, Request, tiny::Options};
use asperity_nn::{Dim, ElementType, Port, RunError, Session, Tensor};

/// A network with the ports of another, changed; it answers as the other does.
struct Changed {
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    answers: Box<dyn Session>,
}

impl Session for Changed {
    fn inputs(&self) -> &[Port] {
        &self.inputs
    }

    fn outputs(&self) -> &[Port] {
        &self.outputs
    }

    fn run(&self, inputs: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
        self.answers.run(inputs)
    }
}

fn changed(
    network: Box<dyn Session>,
    change: impl FnOnce(&mut Vec<Port>, &mut Vec<Port>),
) -> Box<dyn Session> {
    let (mut inputs, mut outputs) = (network.inputs().to_vec(), network.outputs().to_vec());
    change(&mut inputs, &mut outputs);
    Box::new(Changed {
        inputs,
        outputs,
        answers: network,
    })
}

/// Returns the error for a folder with a changed part.
fn refusal(change: impl FnOnce(&mut Parts)) -> DiffusionError {
    let mut parts = parts(&Options::default());
    change(&mut parts);
    let error = asperity_diffusion::StableDiffusion::new(parts).err();
    error.expect("a refusal")
}

/// A stand-in while a network is changed.
struct Nothing;

impl Session for Nothing {
    fn inputs(&self) -> &[Port] {
        &[]
    }

    fn outputs(&self) -> &[Port] {
        &[]
    }

    fn run(&self, _: &[(&str, &Tensor)]) -> Result<Vec<(String, Tensor)>, RunError> {
        Ok(Vec::new())
    }
}

fn of(network: &mut Box<dyn Session>, change: impl FnOnce(&mut Vec<Port>, &mut Vec<Port>)) {
    let old = std::mem::replace(network, Box::new(Nothing));
    *network = changed(old, change);
}

fn says(error: &DiffusionError, words: &[&str]) {
    let message = format!("{error}; {}", error.remedy());
    for word in words {
        assert!(message.contains(word), "{word} in: {message}");
    }
}

fn dims(sizes: &[usize]) -> Option<Vec<Dim>> {
    Some(sizes.iter().map(|&size| Dim::Fixed(size)).collect())
}

#[test]
fn a_port_of_another_name_is_named_with_those_that_exist() {
    let error = refusal(|parts| of(&mut parts.unet, |inputs, _| inputs[1].name = "t".into()));
    says(
        &error,
        &[
            "unet/model.onnx",
            "`timestep`",
            "`sample`, `t`",
            "optimum-cli",
        ],
    );
    let error = refusal(|parts| of(&mut parts.text_encoder, |inputs, _| inputs.clear()));
    says(&error, &["text_encoder/model.onnx", "`input_ids`", "none"]);
    let error = refusal(|parts| {
        of(&mut parts.text_encoder, |_, outputs| {
            outputs[0].name = "hidden".into();
        });
    });
    says(
        &error,
        &["text_encoder", "output `last_hidden_state`", "`hidden`"],
    );
    let error = refusal(|parts| {
        of(&mut parts.vae_decoder, |inputs, _| {
            inputs[0].name = "z".into()
        })
    });
    says(
        &error,
        &["vae_decoder/model.onnx", "`latent_sample`", "`z`"],
    );
}

#[test]
fn a_port_of_another_type_or_shape_is_named_with_what_it_should_be() {
    let error = refusal(|parts| {
        of(&mut parts.unet, |inputs, _| {
            inputs[0].element_type = ElementType::U8
        });
    });
    says(&error, &["`sample`", "uint8", "expected float32 of 4"]);
    let error = refusal(|parts| {
        of(&mut parts.text_encoder, |inputs, _| {
            inputs[0].element_type = ElementType::F32
        });
    });
    says(&error, &["`input_ids`", "float32", "int64 or int32"]);
    let error = refusal(|parts| {
        of(&mut parts.unet, |_, outputs| {
            outputs[0].dims = dims(&[1, 2])
        })
    });
    says(&error, &["output `out_sample`", "[1, 2]", "4 dimensions"]);
    let error = refusal(|parts| {
        of(&mut parts.unet, |inputs, _| {
            inputs[0].dims = dims(&[1, 9, 64, 64])
        })
    });
    says(&error, &["`sample`", "4 channels, it has 9"]);
    for sizes in [[2, 4, 16, 24], [2, 4, 4096, 4096], [2, 4, 0, 0]] {
        let error = refusal(|parts| of(&mut parts.unet, |inputs, _| inputs[0].dims = dims(&sizes)));
        says(&error, &["`sample`", "square latents"]);
    }
    let error = refusal(|parts| {
        of(&mut parts.unet, |inputs, _| {
            inputs[0].dims = dims(&[3, 4, 16, 16])
        })
    });
    says(&error, &["`sample`", "a batch of 1"]);
    let error = refusal(|parts| of(&mut parts.unet, |inputs, _| inputs[1].dims = dims(&[5])));
    says(&error, &["`timestep`", "one number"]);
    let error = refusal(|parts| {
        of(&mut parts.vae_decoder, |inputs, _| {
            inputs[0].dims = dims(&[1, 4, 64, 64])
        });
    });
    says(&error, &["`latent_sample`", "[1, 4, 16, 16]"]);
}

#[test]
fn networks_of_other_models_are_refused() {
    let options = Options {
        text_width: 768,
        unet_text_width: 1024,
        ..Options::default()
    };
    let error = opened(&options, |_| {}).err().expect("a refusal");
    says(&error, &["unet/model.onnx", "1024", "768", "one export"]);
    let error = refusal(|parts| {
        of(&mut parts.unet, |inputs, _| {
            let more = Port {
                name: "time_ids".into(),
                ..inputs[0].clone()
            };
            inputs.push(more);
        });
    });
    says(&error, &["`time_ids`", "Stable Diffusion 1 or 2"]);
    let error = refusal(|parts| {
        parts.model_index = r#"{"_class_name": "StableDiffusionXLPipeline"}"#.into();
    });
    says(&error, &["model_index.json", "XL"]);
}

#[test]
fn broken_texts_are_named() {
    for (change, part) in [
        (
            (|parts: &mut Parts| parts.model_index = "{".into()) as fn(&mut Parts),
            "model_index.json",
        ),
        (
            |parts| parts.scheduler_config = "null".into(),
            "scheduler/scheduler_config.json",
        ),
        (
            |parts| parts.vocabulary = "[".repeat(100_000),
            "tokenizer/vocab.json",
        ),
        (
            |parts| parts.merges = "\0".repeat(1000),
            "tokenizer/vocab.json",
        ),
        (
            |parts| parts.tokenizer_config = Some("7".into()),
            "tokenizer/tokenizer_config.json",
        ),
        (
            |parts| parts.unet_config = Some(r#"{"sample_size": -1}"#.into()),
            "unet/config.json",
        ),
        (
            |parts| parts.vae_config = Some(r#"{"scaling_factor": 0}"#.into()),
            "vae_decoder/config.json",
        ),
    ] {
        assert_eq!(refusal(change).part, part);
    }
}

#[test]
fn what_is_no_number_is_said_with_its_step() {
    let options = Options {
        is_broken: true,
        ..Options::default()
    };
    let model = opened(&options, |_| {}).expect("its ports are right");
    let error = model.sample(&cork(), &mut |_| {}).expect_err("NaN");
    says(
        &error,
        &[
            "unet/model.onnx",
            "`out_sample`",
            "NaN",
            "at step 1 of 7",
            "float32",
        ],
    );
}

/// Guidance that overflows is found as well, where the decoder meets it at the latest.
#[test]
fn endless_guidance_ends_in_an_error() {
    let model = opened(&Options::default(), |_| {}).expect("a model");
    for guidance in [f32::INFINITY, f32::NAN] {
        let request = Request { guidance, ..cork() };
        let error = model.sample(&request, &mut |_| {}).expect_err("no picture");
        assert!(
            matches!(error.problem, Problem::NotFinite { .. }),
            "{error}"
        );
    }
}

/// A latent of a size that the network does not take: the engine says so at the first step.
#[test]
fn a_network_that_fails_is_named() {
    let change = |parts: &mut Parts| parts.unet_config = Some(r#"{"sample_size": 24}"#.into());
    let model = opened(&Options::default(), change).expect("its ports leave the size open");
    let error = model.sample(&cork(), &mut |_| {}).expect_err("no picture");
    assert_eq!(error.part, "unet/model.onnx");
    says(&error, &["ONNX Runtime"]);
}
