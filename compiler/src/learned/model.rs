//! The networks of a model folder, loaded once and asked often.

use super::description::{FORMAT, LATENT, ModelDescription};
use crate::{diagnostic::Diagnostic, inference::Backend};
use asperity_nn::{Session, Tensor};
use std::{borrow::Cow, path::PathBuf, sync::OnceLock};
use thiserror::Error;

/// A latent code.
pub type Latent = [f32; LATENT];

/// Why a learned model cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A file of the folder cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The description is no description.
    #[error("{file}: {message}")]
    Description {
        /// The file.
        file: String,
        /// Field and fault.
        message: String,
    },
    /// A network cannot be loaded or run, or has another signature.
    #[error("{file}: {message}")]
    Network {
        /// The file.
        file: String,
        /// What happened.
        message: String,
    },
    /// A text vector of another width than the projection takes.
    #[error(
        "text_projection.onnx takes vectors of {expected} numbers, the text encoder gives {found}"
    )]
    Width {
        /// What the projection takes.
        expected: usize,
        /// What was given.
        found: usize,
    },
}

impl Diagnostic for ModelError {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable { .. } => "give a folder that `asperity-train fit` wrote".into(),
            Self::Description { .. } | Self::Network { .. } => {
                "write the folder anew with `asperity-train fit`, or leave --model out for the embedded model".into()
            }
            Self::Width { .. } => {
                "train a projection for this encoder: asperity-train fit --text-encoder clip:DIR".into()
            }
        }
    }
}

/// The files of a model folder, embedded or read.
#[derive(Debug, Clone)]
pub struct Files {
    /// `model.json`.
    pub description: Cow<'static, str>,
    /// `text_projection.onnx`.
    pub text_projection: Cow<'static, [u8]>,
    /// `ar_decoder.onnx`.
    pub ar_decoder: Cow<'static, [u8]>,
    /// `tap_decoder.onnx`.
    pub tap_decoder: Cow<'static, [u8]>,
    /// `encoder.onnx`.
    pub encoder: Cow<'static, [u8]>,
}

impl Files {
    /// Reads a model folder.
    ///
    /// # Errors
    /// [`ModelError::Unreadable`] with the file.
    pub fn read(folder: &std::path::Path) -> Result<Self, ModelError> {
        let bytes = |name: &str| {
            let path = folder.join(name);
            std::fs::read(&path).map_err(|source| ModelError::Unreadable { path, source })
        };
        let path = folder.join("model.json");
        let description = std::fs::read_to_string(&path)
            .map_err(|source| ModelError::Unreadable { path, source })?;
        Ok(Self {
            description: description.into(),
            text_projection: bytes("text_projection.onnx")?.into(),
            ar_decoder: bytes("ar_decoder.onnx")?.into(),
            tap_decoder: bytes("tap_decoder.onnx")?.into(),
            encoder: bytes("encoder.onnx")?.into(),
        })
    }
}

/// What the text says of the latent.
#[derive(Debug, Clone, PartialEq)]
pub struct Projected {
    /// The latent.
    pub z: Latent,
    /// Cosine of the text with the mean caption of every anchor, in their order.
    pub similarity: Vec<f32>,
}

/// What a latent decodes to, bins and traces in the order of the description.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded {
    /// LSFs, rad, `bins × order`.
    pub lsf_rad: Vec<f32>,
    /// RMS of the vibration, dB re 1 m/s², one a bin.
    pub level_db: Vec<f32>,
    /// Traces, m/s², `speeds × samples`.
    pub taps_m_s2: Vec<f32>,
}

/// Which modalities an encoder is given; the other is decoded from the latent.
#[derive(Debug, Clone, Copy)]
pub enum Present<'a> {
    /// LSFs and levels a bin: `bins × (order + 1)`, LSFs in rad, then dB.
    Ar(&'a [f32]),
    /// Traces, m/s², `speeds × samples`.
    Taps(&'a [f32]),
    /// Both.
    Both(&'a [f32], &'a [f32]),
}

/// A learned model on a back end.
pub struct LearnedModel {
    description: ModelDescription,
    text_projection: Box<dyn Session>,
    ar_decoder: Box<dyn Session>,
    tap_decoder: Box<dyn Session>,
    /// Loaded when first asked: a prompt needs no encoder.
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
        let session = |file: &str, bytes: Cow<'static, [u8]>| {
            backend
                .session(bytes)
                .map_err(|message| ModelError::Network {
                    file: file.into(),
                    message,
                })
        };
        Ok(Self {
            description,
            text_projection: session("text_projection.onnx", files.text_projection)?,
            ar_decoder: session("ar_decoder.onnx", files.ar_decoder)?,
            tap_decoder: session("tap_decoder.onnx", files.tap_decoder)?,
            encoder: OnceLock::new(),
            encoder_bytes: files.encoder,
            backend: *backend,
        })
    }

    /// What the model says of itself.
    #[must_use]
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }

    /// A text vector to a latent.
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
        })
    }

    /// A latent to parameters. Latents beyond ±10³ are clamped, NaN becomes zero: the
    /// decoders' bounds hold for whatever is left.
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

    /// The mean of the posterior of what is known of a texture.
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

fn check(description: &ModelDescription) -> Result<(), ModelError> {
    let fault = |message: String| {
        Err(ModelError::Description {
            file: "model.json".into(),
            message,
        })
    };
    if description.format != FORMAT {
        return fault(format!(
            "format: {}, this version reads {FORMAT}",
            description.format
        ));
    }
    let grid = &description.grid;
    if grid.speeds_mm_s.len() != grid.forces_n.len() || grid.speeds_mm_s.len() < 3 {
        return fault("grid: at least three bins with a speed and a force each".into());
    }
    let inside = |values: &[f64], border: f64| {
        values.iter().all(|x| *x > 0.0 && *x < border) && border.is_finite()
    };
    if !inside(&grid.speeds_mm_s, grid.max_speed_mm_s) || !inside(&grid.forces_n, grid.max_force_n)
    {
        return fault("grid: a bin outside the borders".into());
    }
    if description.taps.speeds_m_s.is_empty() || description.taps.samples == 0 {
        return fault("taps: no trace".into());
    }
    if description.anchors.is_empty() {
        return fault("anchors: none, friction needs one at least".into());
    }
    for anchor in &description.anchors {
        if anchor.z.len() != LATENT || !anchor.z.iter().all(|x| x.is_finite()) {
            return fault(format!(
                "anchors: {}: z: {LATENT} finite numbers wanted",
                anchor.name
            ));
        }
        if !(anchor.mu >= 0.0 && anchor.mu.is_finite() && anchor.stiffness_n_m > 0.0) {
            return fault(format!(
                "anchors: {}: mu or stiffness_n_m is no such value",
                anchor.name
            ));
        }
    }
    if description.spread.len() != LATENT || !description.spread.iter().all(|x| x.is_finite()) {
        return fault(format!("spread: {LATENT} finite numbers wanted"));
    }
    if description.friction.temperature.is_nan() || description.friction.temperature <= 0.0 {
        return fault("friction.temperature: not above 0".into());
    }
    let curve = &description.certainty;
    if curve.similarity.is_empty() || curve.similarity.len() != curve.certainty.len() {
        return fault("certainty: as many similarities as certainties, one at least".into());
    }
    Ok(())
}

fn run(
    file: &str,
    session: &dyn Session,
    inputs: &[(&str, &[usize], &[f32])],
) -> Result<Vec<(String, Tensor)>, ModelError> {
    let tensors: Vec<(&str, Tensor)> = inputs
        .iter()
        .map(|(name, shape, data)| {
            let tensor = Tensor::F32 {
                shape: shape.to_vec(),
                data: data.to_vec(),
            };
            (*name, tensor)
        })
        .collect();
    let inputs: Vec<(&str, &Tensor)> = tensors.iter().map(|(name, t)| (*name, t)).collect();
    session.run(&inputs).map_err(|error| ModelError::Network {
        file: file.into(),
        message: error.to_string(),
    })
}

/// The output of a name, all finite and as long as it should be.
fn take(
    file: &str,
    outputs: &[(String, Tensor)],
    name: &str,
    length: usize,
) -> Result<Vec<f32>, ModelError> {
    let fault = |message: String| ModelError::Network {
        file: file.into(),
        message,
    };
    match outputs.iter().find(|(output, _)| output == name) {
        Some((_, Tensor::F32 { data, .. })) if data.len() == length => {
            if data.iter().all(|x| x.is_finite()) {
                Ok(data.clone())
            } else {
                Err(fault(format!("output {name} is not finite")))
            }
        }
        Some((_, other)) => Err(fault(format!(
            "output {name} has shape {:?}, {length} numbers wanted",
            other.shape()
        ))),
        None => Err(fault(format!("no output {name}"))),
    }
}

fn latent(values: &[f32]) -> Latent {
    std::array::from_fn(|k| values[k])
}
