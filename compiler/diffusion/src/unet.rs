//! The UNet, with classifier-free guidance (Ho and Salimans, 2022).

use crate::{
    error::{DiffusionError, Problem},
    folder::{UNET, UNET_CONFIG},
    json, ports,
    text::Embedding,
    tokenizer::CONTEXT,
};
use asperity_nn::{ElementType, Port, Session, Tensor};
use serde::Deserialize;

const SAMPLE: &str = "sample";
const TIMESTEP: &str = "timestep";
const TEXT: &str = "encoder_hidden_states";
const OUTPUT: &str = "out_sample";

/// Channels of Stable Diffusion's latents.
const CHANNELS: usize = 4;
/// Width and height of Stable Diffusion's latents where the folder states none.
const LATENT_SIZE: usize = 64;
/// Widths and heights that a latent may have.
const LATENT_SIZES: std::ops::RangeInclusive<usize> = 4..=128;

/// The shape of a latent: channels, height and width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Latent {
    pub(crate) channels: usize,
    pub(crate) size: usize,
}

impl Latent {
    pub(crate) fn len(self) -> usize {
        self.channels * self.size * self.size
    }

    /// The shape of a batch.
    pub(crate) fn batch(self, count: usize) -> [usize; 4] {
        [count, self.channels, self.size, self.size]
    }
}

/// The UNet of a folder.
pub(crate) struct Unet {
    session: Box<dyn Session>,
    timestep: Port,
    output: String,
    /// Latents per run, if fixed by the file.
    batch: Option<usize>,
    pub(crate) latent: Latent,
}

/// Inputs that steer a latent.
pub(crate) struct Guidance<'a> {
    pub(crate) prompt: &'a Embedding,
    pub(crate) negative: &'a Embedding,
    /// 1 follows the prompt alone.
    pub(crate) scale: f32,
}

#[derive(Deserialize, Default)]
struct Config {
    in_channels: Option<usize>,
    sample_size: Option<usize>,
}

impl Unet {
    /// Checks the ports of a network; its text must be `text_width` wide.
    pub(crate) fn new(
        session: Box<dyn Session>,
        config: Option<&str>,
        text_width: usize,
    ) -> Result<Self, DiffusionError> {
        let config: Config = match config {
            Some(text) => json::parse(text).map_err(|problem| problem.of(UNET_CONFIG))?,
            None => Config::default(),
        };
        let (timestep, output) =
            signature(&*session, text_width).map_err(|problem| problem.of(UNET))?;
        let (latent, batch) = latent(&*session, &config).map_err(|problem| problem.of(UNET))?;
        Ok(Self {
            session,
            timestep,
            output,
            batch,
            latent,
        })
    }

    /// Returns true if the trained steps are integers.
    pub(crate) fn takes_whole_steps(&self) -> bool {
        self.timestep.element_type != ElementType::F32
    }

    /// The guided prediction for a latent that is scaled for the network. `when` says which step.
    pub(crate) fn predict(
        &self,
        latent: &[f32],
        timestep: f64,
        guidance: &Guidance<'_>,
        when: &dyn Fn() -> String,
    ) -> Result<Vec<f32>, DiffusionError> {
        self.guided(latent, timestep, guidance, when)
            .map_err(|problem| problem.of(UNET))
    }

    /// ε(x|negative) + scale·(ε(x|prompt) − ε(x|negative)).
    fn guided(
        &self,
        latent: &[f32],
        timestep: f64,
        guidance: &Guidance<'_>,
        when: &dyn Fn() -> String,
    ) -> Result<Vec<f32>, Problem> {
        let scale = guidance.scale;
        let texts = [guidance.negative, guidance.prompt];
        if scale == 1.0 && self.batch != Some(2) {
            return self.run(latent, timestep, &texts[1..], when);
        }
        let (without, with) = if self.batch == Some(1) {
            (
                self.run(latent, timestep, &texts[..1], when)?,
                self.run(latent, timestep, &texts[1..], when)?,
            )
        } else {
            let mut both = self.run(latent, timestep, &texts, when)?;
            let with = both.split_off(latent.len());
            (both, with)
        };
        let pairs = without.iter().zip(with);
        Ok(pairs
            .map(|(without, with)| without + scale * (with - without))
            .collect())
    }

    /// The prediction for one latent with each of these texts.
    fn run(
        &self,
        latent: &[f32],
        timestep: f64,
        texts: &[&Embedding],
        when: &dyn Fn() -> String,
    ) -> Result<Vec<f32>, Problem> {
        let count = texts.len();
        let sample = Tensor::f32(&self.latent.batch(count), latent.repeat(count));
        let text: Vec<f32> = texts.iter().flat_map(|text| text.data.clone()).collect();
        let width = texts.first().map_or(0, |text| text.width);
        let text = Tensor::f32(&[count, CONTEXT, width], text);
        // A number, a list of one, or one for each latent.
        let timesteps = match self.timestep.dims.as_deref() {
            Some([]) => 0,
            _ => ports::fixed(&self.timestep, 0).unwrap_or(1),
        };
        let timestep = if timesteps == 0 {
            numbers(&self.timestep, &[], timestep)
        } else {
            numbers(&self.timestep, &[timesteps], timestep)
        };
        let inputs = [(SAMPLE, &sample), (TIMESTEP, &timestep), (TEXT, &text)];
        let (shape, data) = ports::run(&*self.session, &inputs, &self.output, when)?;
        let expected = self.latent.batch(count);
        if shape == expected {
            Ok(data)
        } else {
            Err(ports::wrong_shape(&self.output, &shape, &expected))
        }
    }
}

/// The trained step in the type of its port.
fn numbers(port: &Port, shape: &[usize], timestep: f64) -> Tensor {
    let count = shape.iter().product();
    match port.element_type {
        ElementType::F32 => Tensor::f32(shape, vec![timestep as f32; count]),
        _ => ports::integers(port, shape, &vec![timestep as i64; count]),
    }
}

fn signature(session: &dyn Session, text_width: usize) -> Result<(Port, String), Problem> {
    let float = [ElementType::F32];
    let sample = ports::input(session, SAMPLE, &float, &[4])?;
    let numbers = [ElementType::I64, ElementType::I32, ElementType::F32];
    let timestep = ports::input(session, TIMESTEP, &numbers, &[0, 1])?;
    let text = ports::input(session, TEXT, &float, &[3])?;
    let expected = "sample, timestep and encoder_hidden_states";
    ports::no_others(session, &[SAMPLE, TIMESTEP, TEXT], expected)?;
    let output = ports::output(session, OUTPUT, 4)?;
    if let Some(expected) = ports::fixed(text, 2).filter(|&width| width != text_width) {
        return Err(Problem::Width {
            name: TEXT,
            expected,
            found: text_width,
        });
    }
    let batch = ports::fixed(sample, 0);
    let wrong = |port: &Port, expected: &str| Problem::Port {
        direction: "input",
        name: port.name.clone(),
        found: port.to_string(),
        expected: expected.to_owned(),
    };
    if batch.is_some_and(|batch| batch != 1 && batch != 2) {
        return Err(wrong(sample, "a batch of 1, of 2 or of any size"));
    }
    let room = ports::fixed(timestep, 0);
    if room.is_some_and(|room| room != 1 && Some(room) != batch) {
        return Err(wrong(timestep, "one number, or one for each latent"));
    }
    Ok((timestep.clone(), output.name.clone()))
}

/// The latent that the ports and the configuration agree on, and the batch.
fn latent(session: &dyn Session, config: &Config) -> Result<(Latent, Option<usize>), Problem> {
    let sample = ports::input(session, SAMPLE, &[ElementType::F32], &[4])?;
    let wrong = |expected: String| Problem::Port {
        direction: "input",
        name: SAMPLE.to_owned(),
        found: sample.to_string(),
        expected,
    };
    let channels = ports::fixed(sample, 1)
        .or(config.in_channels)
        .unwrap_or(CHANNELS);
    let height = ports::fixed(sample, 2).or(config.sample_size);
    let size = height.unwrap_or(LATENT_SIZE);
    let width = ports::fixed(sample, 3).unwrap_or(size);
    if channels != CHANNELS {
        // An inpainting UNet takes nine, a mask and a picture among them.
        return Err(wrong(format!("{CHANNELS} channels, it has {channels}")));
    }
    if width != size || !LATENT_SIZES.contains(&size) {
        return Err(wrong(format!(
            "square latents of {} to {}, it has {size} × {width}",
            LATENT_SIZES.start(),
            LATENT_SIZES.end()
        )));
    }
    Ok((Latent { channels, size }, ports::fixed(sample, 0)))
}
