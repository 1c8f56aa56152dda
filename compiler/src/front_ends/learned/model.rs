//! A learned model: its networks, loaded once, and what they are asked.

use super::{
    check::check,
    description::{LATENT, ModelDescription},
    error::ModelError,
    files::Files,
    network::{run, take},
};
use crate::front_ends::inference::Backend;
use asperity_nn::Session;
use std::{borrow::Cow, sync::OnceLock};

/// A latent code.
pub type Latent = [f32; LATENT];

/// The latent of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Projected {
    /// The latent.
    pub z: Latent,
    /// Cosine of the text with the mean caption of every anchor, in their order.
    pub similarity: Vec<f32>,
    /// A soft maximum of its cosines with the examples of the projection: 1 and more for what the
    /// model was trained on.
    pub familiarity: f32,
}

/// What a latent decodes to, bins and traces in the order of the description.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded {
    /// LSFs, rad, `bins × order`.
    pub lsf_rad: Vec<f32>,
    /// RMS of the vibration in every bin, dB re 1 m/s².
    pub level_db: Vec<f32>,
    /// Traces, m/s², `speeds × samples`.
    pub taps_m_s2: Vec<f32>,
}

/// Which modalities an encoder is given; the other is decoded from the latent.
#[derive(Debug, Clone, Copy)]
pub enum Present<'a> {
    /// LSFs in rad and the level in dB of every bin: `bins × (order + 1)`.
    Ar(&'a [f32]),
    /// Traces, m/s², `speeds × samples`.
    Taps(&'a [f32]),
    /// Both.
    Both(&'a [f32], &'a [f32]),
}

/// A learned model on a back end.
pub struct LearnedModel {
    crc32: u32,
    description: ModelDescription,
    text_projection: Box<dyn Session>,
    ar_decoder: Box<dyn Session>,
    tap_decoder: Box<dyn Session>,
    /// Loaded on first use, because a prompt needs no encoder.
    encoder: OnceLock<Box<dyn Session>>,
    encoder_bytes: Cow<'static, [u8]>,
    backend: Backend,
}

impl LearnedModel {
    /// Loads the networks that a prompt needs.
    ///
    /// # Errors
    /// [`ModelError`] with the file and what is wrong in it.
    pub fn load(files: Files, backend: &Backend) -> Result<Self, ModelError> {
        let description: ModelDescription =
            serde_json::from_str(&files.description).map_err(|error| ModelError::Description {
                file: "model.json".into(),
                message: error.to_string(),
            })?;
        check(&description)?;
        let crc32 = files.crc32();
        let session = |file: &str, bytes: Cow<'static, [u8]>| {
            backend
                .session(bytes)
                .map_err(|message| ModelError::Network {
                    file: file.into(),
                    message,
                })
        };
        Ok(Self {
            crc32,
            description,
            text_projection: session("text_projection.onnx", files.text_projection)?,
            ar_decoder: session("ar_decoder.onnx", files.ar_decoder)?,
            tap_decoder: session("tap_decoder.onnx", files.tap_decoder)?,
            encoder: OnceLock::new(),
            encoder_bytes: files.encoder,
            backend: *backend,
        })
    }

    /// CRC-32 of its files.
    #[must_use]
    pub fn crc32(&self) -> u32 {
        self.crc32
    }

    /// The description of the model.
    #[must_use]
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }

    /// The latent of a text vector.
    ///
    /// # Errors
    /// [`ModelError`] for a vector of another width, or when the network fails.
    pub fn project(&self, vector: &[f32]) -> Result<Projected, ModelError> {
        let expected = self.description.text_encoder.width;
        if vector.len() != expected {
            return Err(ModelError::Width {
                expected,
                found: vector.len(),
            });
        }
        const FILE: &str = "text_projection.onnx";
        let outputs = run(
            FILE,
            self.text_projection.as_ref(),
            &[("embedding", &[1, expected], vector)],
        )?;
        Ok(Projected {
            z: latent(&take(FILE, &outputs, "z", LATENT)?),
            similarity: take(FILE, &outputs, "similarity", self.description.anchors.len())?,
            familiarity: take(FILE, &outputs, "familiarity", 1)?[0],
        })
    }

    /// The parameters that a latent decodes to. Components beyond ±10³ are clamped and NaN becomes
    /// zero, so that the decoders' bounds hold.
    ///
    /// # Errors
    /// [`ModelError::Network`] when a network fails.
    pub fn decode(&self, z: &Latent) -> Result<Decoded, ModelError> {
        let z = z.map(|x| if x.is_nan() { 0.0 } else { x.clamp(-1e3, 1e3) });
        let grid = &self.description.grid;
        let bins = grid.speeds_mm_s.len();
        let (file, shape) = ("ar_decoder.onnx", [1, LATENT]);
        let outputs = run(file, self.ar_decoder.as_ref(), &[("z", &shape, &z)])?;
        let lsf_rad = take(file, &outputs, "lsf_rad", bins * grid.order)?;
        let level_db = take(file, &outputs, "level_db", bins)?;
        let taps = &self.description.taps;
        let file = "tap_decoder.onnx";
        let outputs = run(file, self.tap_decoder.as_ref(), &[("z", &shape, &z)])?;
        let taps_m_s2 = take(
            file,
            &outputs,
            "taps_m_s2",
            taps.speeds_m_s.len() * taps.samples,
        )?;
        Ok(Decoded {
            lsf_rad,
            level_db,
            taps_m_s2,
        })
    }

    /// The mean of the posterior, given the modalities that are present.
    ///
    /// # Errors
    /// [`ModelError::Network`] when the network fails.
    pub fn encode(&self, known: Present<'_>) -> Result<Latent, ModelError> {
        const FILE: &str = "encoder.onnx";
        let grid = &self.description.grid;
        let taps = &self.description.taps;
        let bins = grid.speeds_mm_s.len();
        let (traces, samples) = (taps.speeds_m_s.len(), taps.samples);
        let (no_ar, no_taps) = (
            vec![0.0; bins * (grid.order + 1)],
            vec![0.0; traces * samples],
        );
        let (ar, bank, present): (&[f32], &[f32], [f32; 2]) = match known {
            Present::Ar(ar) => (ar, &no_taps, [1.0, 0.0]),
            Present::Taps(bank) => (&no_ar, bank, [0.0, 1.0]),
            Present::Both(ar, bank) => (ar, bank, [1.0, 1.0]),
        };
        let encoder = self.encoder()?;
        let outputs = run(
            FILE,
            encoder,
            &[
                ("ar", &[1, bins, grid.order + 1], ar),
                ("taps_m_s2", &[1, traces, samples], bank),
                ("present", &[1, 2], &present),
            ],
        )?;
        Ok(latent(&take(FILE, &outputs, "mean", LATENT)?))
    }

    fn encoder(&self) -> Result<&dyn Session, ModelError> {
        if let Some(encoder) = self.encoder.get() {
            return Ok(encoder.as_ref());
        }
        let session = self
            .backend
            .session(self.encoder_bytes.clone())
            .map_err(|message| ModelError::Network {
                file: "encoder.onnx".into(),
                message,
            })?;
        Ok(self.encoder.get_or_init(|| session).as_ref())
    }
}

fn latent(values: &[f32]) -> Latent {
    std::array::from_fn(|k| values[k])
}
