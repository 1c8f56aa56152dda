//! From a prompt to a picture.

use crate::{
    error::DiffusionError,
    folder::{MODEL_INDEX, Parts, SCHEDULER_CONFIG},
    index,
    noise::Noise,
    picture::Picture,
    scheduler::{Config, Method, Schedule},
    text::TextEncoder,
    tile::rolled,
    tokenizer::Tokens,
    unet::{Guidance, Unet},
    vae::VaeDecoder,
};

/// A model, ready to make pictures.
pub struct StableDiffusion {
    name: String,
    scheduler: Config,
    tokens: Tokens,
    text_encoder: TextEncoder,
    unet: Unet,
    vae_decoder: VaeDecoder,
}

/// A request to a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Description of the picture.
    pub prompt: String,
    /// Description to steer away from; may be empty.
    pub negative: String,
    /// Number of steps.
    pub steps: usize,
    /// Guidance scale: factor from the negative prediction to that of the prompt; 1 follows the prompt alone.
    pub guidance: f32,
    /// Sampling method.
    pub method: Method,
    /// Seed of the noise.
    pub seed: u64,
    /// True if the picture repeats in both directions.
    pub tile: bool,
}

impl Request {
    /// A picture of a prompt in 30 steps of DDIM, guidance 7.5.
    #[must_use]
    pub fn new(prompt: String, seed: u64) -> Self {
        Self {
            prompt,
            negative: String::new(),
            steps: 30,
            guidance: 7.5,
            method: Method::default(),
            seed,
            tile: false,
        }
    }
}

/// A picture, and what a user should know of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sampled {
    /// The picture at the model's size.
    pub picture: Picture,
    /// Tokens of the prompt that did not fit.
    pub cut: usize,
}

impl StableDiffusion {
    /// Checks the parts of a folder against each other.
    ///
    /// # Errors
    /// [`DiffusionError`] names the part.
    pub fn new(parts: Parts) -> Result<Self, DiffusionError> {
        let name = index::name(&parts.model_index).map_err(|p| p.of(MODEL_INDEX))?;
        let scheduler =
            Config::parse(&parts.scheduler_config).map_err(|p| p.of(SCHEDULER_CONFIG))?;
        let settings = parts.tokenizer_config.as_deref();
        let tokens = Tokens::parse(&parts.vocabulary, &parts.merges, settings)?;
        let text_encoder = TextEncoder::new(parts.text_encoder)?;
        // Exports often leave the width open, so the network is asked.
        let width = text_encoder.encode(&tokens.encode("").ids)?.width;
        let unet = Unet::new(parts.unet, parts.unet_config.as_deref(), width)?;
        let vae_decoder =
            VaeDecoder::new(parts.vae_decoder, parts.vae_config.as_deref(), unet.latent)?;
        Ok(Self {
            name,
            scheduler,
            tokens,
            text_encoder,
            unet,
            vae_decoder,
        })
    }

    /// The model's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Makes a picture; `on_step` is called after each step with how many are done.
    ///
    /// # Errors
    /// [`DiffusionError`] for more steps than the model has, and when a network fails or gives
    /// what is no number.
    pub fn sample(
        &self,
        request: &Request,
        on_step: &mut dyn FnMut(usize),
    ) -> Result<Sampled, DiffusionError> {
        let whole = self.unet.takes_whole_steps();
        let schedule = Schedule::new(&self.scheduler, request.method, request.steps, whole)
            .map_err(|problem| problem.of(SCHEDULER_CONFIG))?;
        let prompt = self.tokens.encode(&request.prompt);
        let negative = self.tokens.encode(&request.negative);
        let guidance = Guidance {
            prompt: &self.text_encoder.encode(&prompt.ids)?,
            negative: &self.text_encoder.encode(&negative.ids)?,
            scale: request.guidance,
        };
        let latent = self.denoised(request, &schedule, &guidance, on_step)?;
        Ok(Sampled {
            picture: self.vae_decoder.decode(&latent, request.tile)?,
            cut: prompt.cut,
        })
    }

    fn denoised(
        &self,
        request: &Request,
        schedule: &Schedule,
        guidance: &Guidance<'_>,
        on_step: &mut dyn FnMut(usize),
    ) -> Result<Vec<f32>, DiffusionError> {
        let size = self.unet.latent.size;
        let mut noise = Noise::new(request.seed);
        let spread = schedule.first_spread as f32;
        let mut latent = noise.normal(self.unet.latent.len());
        latent.iter_mut().for_each(|x| *x *= spread);
        for (n, step) in schedule.steps.iter().enumerate() {
            let scale = step.input_scale as f32;
            let scaled: Vec<f32> = latent.iter().map(|x| x * scale).collect();
            let (down, right) = match request.tile {
                true => (noise.below(size), noise.below(size)),
                false => (0, 0),
            };
            let moved = rolled(&scaled, size, down, right);
            let when = || format!("at step {} of {}", n + 1, schedule.steps.len());
            let output = self.unet.predict(&moved, step.timestep, guidance, &when)?;
            let output = rolled(&output, size, size - down, size - right);
            step.advance(&mut latent, &output);
            on_step(n + 1);
        }
        Ok(latent)
    }
}
