//! Pictures of a texture by Stable Diffusion, from an ONNX folder that the user brings.
//!
//! The picture follows from the prompt alone: unlike [`preview`](super::preview), it knows nothing
//! of how the texture feels.

use crate::learned::inference::{Backend, BackendName};
use asperity_diffusion::{
    DiffusionError, Parts, Picture, StableDiffusion,
    folder::{
        MERGES, MODEL_INDEX, SCHEDULER_CONFIG, TEXT_ENCODER, TOKENIZER_CONFIG, UNET, UNET_CONFIG,
        VAE_CONFIG, VAE_DECODER, VOCABULARY,
    },
};
use asperity_io::{
    diagnostic::Fault,
    input::{self, InputKind, InputProblem, Opened},
    shown::plain,
};
use asperity_nn::Session;
use asperity_preview::EncodeError;
use asperity_texture::model::TextureModel;
use std::{
    io,
    path::{Path, PathBuf},
};

pub use asperity_diffusion::{Method, Request};

/// A model of a folder.
pub struct Model {
    folder: PathBuf,
    diffusion: StableDiffusion,
}

/// A picture, with what made it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawn {
    picture: Picture,
    prompt: String,
    negative: String,
    /// Model, method, steps, guidance and seed, for people: `by diffusion: …`.
    pub note: String,
    /// Tokens of the prompt that did not fit.
    pub cut: usize,
}

/// The prompt that a picture of a texture is made from: its prompt, or else its name, [`framed`].
#[must_use]
pub fn prompt_of(texture: &TextureModel) -> String {
    framed(
        texture
            .provenance
            .prompt
            .as_deref()
            .unwrap_or(&texture.name),
    )
}

/// A prompt of how something feels as one of a texture that is seen from above.
#[must_use]
pub fn framed(prompt: &str) -> String {
    format!("{prompt}, texture, top view, seamless")
}

/// The files of a folder, as far as they are there: its parts, and weights beside the networks.
#[must_use]
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let parts = [
        SCHEDULER_CONFIG,
        VOCABULARY,
        TEXT_ENCODER,
        UNET,
        VAE_DECODER,
    ];
    let folders = parts
        .iter()
        .filter_map(|part| folder.join(part).parent().map(Path::to_owned));
    let listed = folders.flat_map(|folder| {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries.filter_map(|entry| Some(entry.ok()?.path()))
    });
    listed
        .chain([folder.join(MODEL_INDEX)])
        .filter(|path| path.is_file())
        .collect()
}

/// Opens a folder on a back end.
///
/// # Errors
/// [`Fault`] with the file.
pub fn open(folder: &Path, backend: BackendName) -> Result<Model, Fault> {
    let parts = [
        MODEL_INDEX,
        SCHEDULER_CONFIG,
        VOCABULARY,
        MERGES,
        TEXT_ENCODER,
        UNET,
        VAE_DECODER,
    ];
    // Before gigabytes are read.
    if let Some(missing) = parts.iter().map(|part| folder.join(part)).find(is_missing) {
        let remedy = "export the whole folder with `optimum-cli export onnx --model MODEL \
                      DIR`; docs/preview.md lists its parts";
        return Err(Fault::new("the diffusion folder has no such file", remedy).at(missing));
    }
    let text = |part: &str, kind: InputKind| {
        let file = folder.join(part);
        input::read_text(&file, kind).map_err(|problem| Fault::from(problem).at(file))
    };
    let optional = |part: &str| -> Result<Option<String>, Fault> {
        match is_missing(&folder.join(part)) {
            true => Ok(None),
            false => text(part, InputKind::DiffusionConfig).map(Some),
        }
    };
    let texts = (
        text(MODEL_INDEX, InputKind::DiffusionConfig)?,
        text(SCHEDULER_CONFIG, InputKind::DiffusionConfig)?,
        text(VOCABULARY, InputKind::Vocabulary)?,
        text(MERGES, InputKind::Vocabulary)?,
    );
    let configs = (
        optional(TOKENIZER_CONFIG)?,
        optional(UNET_CONFIG)?,
        optional(VAE_CONFIG)?,
    );
    let running = Backend::open(backend).map_err(|error| {
        let what = format!("--diffusion runs on ONNX Runtime: {error}");
        Fault::new(what, error.remedy())
    })?;
    let network = |part: &str| network(&folder.join(part), &running, backend);
    let (model_index, scheduler_config, vocabulary, merges) = texts;
    let (tokenizer_config, unet_config, vae_config) = configs;
    let diffusion = StableDiffusion::new(Parts {
        model_index,
        scheduler_config,
        vocabulary,
        merges,
        tokenizer_config,
        unet_config,
        vae_config,
        text_encoder: network(TEXT_ENCODER)?,
        unet: network(UNET)?,
        vae_decoder: network(VAE_DECODER)?,
    });
    let diffusion = diffusion.map_err(|error| of_model(folder, &error))?;
    let folder = folder.to_owned();
    Ok(Model { folder, diffusion })
}

/// Returns the fault of a part that is of another model, or fails at work.
fn of_model(folder: &Path, error: &DiffusionError) -> Fault {
    Fault::new(error, error.remedy()).at(folder)
}

fn not_encoded(error: EncodeError) -> Fault {
    Fault::new(error, "give another --size")
}

/// Only what is not there: a link that leads nowhere is, and reading says why it fails.
fn is_missing(file: &PathBuf) -> bool {
    let found = std::fs::symlink_metadata(file);
    found.is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}

fn network(
    file: &Path,
    running: &Backend,
    backend: BackendName,
) -> Result<Box<dyn Session>, Fault> {
    let unreadable = |problem: InputProblem| Fault::from(problem).at(file);
    let refused = |message: String| {
        let remedy = match backend {
            BackendName::Portable => "leave --diffusion-backend out, for ONNX Runtime",
            BackendName::OnnxRuntime => {
                "export the folder again, all files of a network \
                 beside each other, or install a newer onnxruntime"
            }
        };
        Fault::new(message, remedy).at(file)
    };
    match backend {
        BackendName::Portable => {
            let bytes = input::read(file, InputKind::DiffusionNetwork).map_err(unreadable)?;
            running.session(bytes.into()).map_err(refused)
        }
        BackendName::OnnxRuntime => {
            // It reads the file itself, and weights beside it: only what a file is, is checked.
            match input::open(file).map_err(unreadable)? {
                Opened::File(_) => running.session_of_file(file).map_err(refused),
                Opened::Pipe(_) => Err(refused("a pipe, not a file".into())),
            }
        }
    }
}

impl Model {
    /// Makes a picture, `size_px` wide and high or as the model makes it. `on_step` is called after
    /// each step with how many are done.
    ///
    /// # Errors
    /// [`Fault`] when a network fails, or gives what is no number.
    pub fn draw(
        &self,
        request: Request,
        size_px: Option<u32>,
        on_step: &mut dyn FnMut(usize),
    ) -> Result<Drawn, Fault> {
        let sampled = self.diffusion.sample(&request, on_step);
        let sampled = sampled.map_err(|error| of_model(&self.folder, &error))?;
        let picture = match size_px {
            Some(size) => sampled.picture.resized(size as usize, request.tile),
            None => sampled.picture,
        };
        let repeats = if request.tile { ", repeats" } else { "" };
        Ok(Drawn {
            picture,
            note: format!(
                "by diffusion: {}, {}, {} steps, guidance {}, seed {}{repeats}",
                self.diffusion.name(),
                request.method,
                request.steps,
                request.guidance,
                request.seed
            ),
            cut: sampled.cut,
            prompt: request.prompt,
            negative: request.negative,
        })
    }
}

impl Drawn {
    /// Width and height, pixels.
    #[must_use]
    pub fn size_px(&self) -> u32 {
        self.picture.size as u32
    }

    /// The picture as PNG with every colour, which says what made it.
    ///
    /// # Errors
    /// [`Fault`] when the encoder fails.
    pub fn png(&self) -> Result<Vec<u8>, Fault> {
        let prompt = plain(&self.prompt);
        let negative = format!("not: {}", plain(&self.negative));
        let mut texts = vec![
            ("Software", concat!("asperity ", env!("CARGO_PKG_VERSION"))),
            ("Description", &*prompt),
            ("Comment", self.note.as_str()),
        ];
        if !self.negative.is_empty() {
            texts.push(("Comment", negative.as_str()));
        }
        asperity_preview::png(&self.picture.pixels, self.size_px(), &texts).map_err(not_encoded)
    }

    /// The picture as an asset keeps it: with a palette, as small as one that is drawn.
    ///
    /// # Errors
    /// As [`png`](Self::png).
    pub fn compact_png(&self) -> Result<Vec<u8>, Fault> {
        let texts = [("Comment", self.note.as_str())];
        asperity_preview::compact_png(&self.picture.pixels, self.size_px(), &texts)
            .map_err(not_encoded)
    }
}
