//! The tiny folder on the portable engine.

use asperity_diffusion::{DiffusionError, Parts, Request, StableDiffusion, folder, tiny};
use asperity_nn::{Portable, Session};

/// The parts of a folder.
pub(crate) fn parts(options: &tiny::Options) -> Parts {
    let files = tiny::folder(options);
    let bytes = |part: &str| {
        let found = files.iter().find(|(name, _)| *name == part);
        found.expect("a part").1.clone()
    };
    let text = |part: &str| String::from_utf8(bytes(part)).expect("text");
    let network = |part: &str| -> Box<dyn Session> {
        Box::new(Portable::from_bytes(&bytes(part)).expect("a network"))
    };
    Parts {
        model_index: text(folder::MODEL_INDEX),
        scheduler_config: text(folder::SCHEDULER_CONFIG),
        vocabulary: text(folder::VOCABULARY),
        merges: text(folder::MERGES),
        tokenizer_config: Some(text(folder::TOKENIZER_CONFIG)),
        unet_config: Some(text(folder::UNET_CONFIG)),
        vae_config: Some(text(folder::VAE_CONFIG)),
        text_encoder: network(folder::TEXT_ENCODER),
        unet: network(folder::UNET),
        vae_decoder: network(folder::VAE_DECODER),
    }
}

/// The model of a folder with changes.
pub(crate) fn opened(
    options: &tiny::Options,
    change: impl FnOnce(&mut Parts),
) -> Result<StableDiffusion, DiffusionError> {
    let mut parts = parts(options);
    change(&mut parts);
    StableDiffusion::new(parts)
}

/// A picture of cork.
pub(crate) fn cork() -> Request {
    Request {
        steps: 7,
        ..Request::new("cork".into(), 1)
    }
}
