//! A learned model: its networks, loaded once, and what they are asked.

use super::{
    check::check,
    description::{LATENT, ModelDescription},
    files::{Files, wrong_file, wrong_width},
    inference::Backend,
    network::{Input, Network},
};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::Provenance;
use std::{borrow::Cow, sync::OnceLock};

/// Rows of a batch at most: what they come to in the networks stays in the second-level cache.
const BATCH: usize = 16;

/// Roughness, slipperiness and hardness of words.
const FELT: usize = 3;

/// A latent code.
pub type Latent = [f32; LATENT];

/// The latent of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Projected {
    /// The latent.
    pub z: Latent,
    /// Roughness in dB, slipperiness as −ln μ and hardness as ln Hz of the words; `None` from a projection without that
    /// output.
    pub felt: Option<[f32; FELT]>,
    /// Cosine of the text with the mean caption of every anchor, in their order.
    pub similarity: Vec<f32>,
    /// A soft maximum of its cosines with the examples of the projection: 1 and more for what the
    /// model was trained on.
    pub familiarity: f32,
}

/// A decoded latent.
#[derive(Debug, Clone, PartialEq)]
pub struct Decoded {
    /// Sliding.
    pub grid: DecodedGrid,
    /// Traces, m/s², `speeds × samples`, in the order of the description.
    pub taps_m_s2: Vec<f32>,
}

/// Decoded sliding, bins in the order of the description.
#[derive(Debug, Clone, PartialEq)]
pub struct DecodedGrid {
    /// LSFs, rad, `bins × order`.
    pub lsf_rad: Vec<f32>,
    /// RMS of the vibration in every bin, dB re 1 m/s².
    pub level_db: Vec<f32>,
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
    text_projection: Network,
    ar_decoder: Network,
    tap_decoder: Network,
    /// Loaded on first use, because a prompt needs no encoder.
    encoder: OnceLock<Network>,
    encoder_bytes: Cow<'static, [u8]>,
    backend: Backend,
}

impl LearnedModel {
    /// Loads the networks that a prompt needs.
    ///
    /// # Errors
    /// [`Fault`] with the file and what is wrong in it.
    pub fn load(files: Files, backend: &Backend) -> Result<Self, Fault> {
        let description: ModelDescription = serde_json::from_str(&files.description)
            .map_err(|error| wrong_file("model.json", error))?;
        check(&description)?;
        let crc32 = files.crc32();
        let network = |file, bytes| Network::load(file, bytes, backend);
        Ok(Self {
            crc32,
            description,
            text_projection: network("text_projection.onnx", files.text_projection)?,
            ar_decoder: network("ar_decoder.onnx", files.ar_decoder)?,
            tap_decoder: network("tap_decoder.onnx", files.tap_decoder)?,
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

    /// Returns true if latents of the model with this CRC-32 are valid for this one.
    #[must_use]
    pub fn has_latent_of(&self, crc32: u32) -> bool {
        crc32 == self.crc32 || self.description.same_latent.contains(&crc32)
    }

    /// The description of the model.
    #[must_use]
    pub fn description(&self) -> &ModelDescription {
        &self.description
    }

    /// Where a texture of the model comes from, which a command made.
    #[must_use]
    pub fn provenance(&self, command: &str) -> Provenance {
        let description = &self.description;
        let synthetic = if description.corpus.taps_synthetic {
            "Trained on synthetic taps. "
        } else {
            ""
        };
        Provenance {
            generator: format!("asperity {} {command}", env!("CARGO_PKG_VERSION")),
            source: format!("model {}", description.name),
            source_crc32: description.corpus.crc32,
            taps_synthetic: true,
            notes: format!(
                "Decoded from a learned model of the {} corpus, text encoder {}. {synthetic}Gains and wall are unconfirmed defaults.",
                description.corpus.name, description.text_encoder.name
            ),
            ..Provenance::default()
        }
    }

    /// The latent of a text vector.
    ///
    /// # Errors
    /// [`Fault`] for a vector of another width, or when the network fails.
    pub fn project(&self, vector: &[f32]) -> Result<Projected, Fault> {
        self.projected(&[vector]).map(|mut all| all.remove(0))
    }

    /// The latents of several text vectors, a batch at a time.
    ///
    /// # Errors
    /// As [`project`](Self::project).
    pub fn project_all(&self, vectors: &[&[f32]]) -> Result<Vec<Projected>, Fault> {
        let mut all = Vec::with_capacity(vectors.len());
        for batch in vectors.chunks(BATCH) {
            all.extend(self.projected(batch)?);
        }
        Ok(all)
    }

    fn projected(&self, vectors: &[&[f32]]) -> Result<Vec<Projected>, Fault> {
        let expected = self.description.text_encoder.width;
        if let Some(other) = vectors.iter().find(|vector| vector.len() != expected) {
            return Err(wrong_width(expected, other.len()));
        }
        let (count, anchors) = (vectors.len(), self.description.anchors.len());
        let vectors = vectors.concat();
        let inputs: [Input<'_>; 1] = [("embedding", &[count, expected], &vectors)];
        let outputs = self.text_projection.run(&inputs)?;
        let z = outputs.take("z", count * LATENT)?;
        let felt = if outputs.has("felt") {
            Some(outputs.take("felt", count * FELT)?)
        } else {
            None
        };
        let similarity = outputs.take("similarity", count * anchors)?;
        let familiarity = outputs.take("familiarity", count)?;
        let row = |n: usize| Projected {
            z: latent(&z[n * LATENT..]),
            felt: felt
                .as_ref()
                .map(|felt| std::array::from_fn(|k| felt[n * FELT + k])),
            similarity: similarity[n * anchors..(n + 1) * anchors].to_vec(),
            familiarity: familiarity[n],
        };
        Ok((0..count).map(row).collect())
    }

    /// The parameters that a latent decodes to. Components beyond ±10³ are clamped and NaN becomes
    /// zero, so that the decoders' bounds hold.
    ///
    /// # Errors
    /// [`Fault`] when a network fails.
    pub fn decode(&self, z: &Latent) -> Result<Decoded, Fault> {
        self.decoded(std::slice::from_ref(z))
            .map(|mut all| all.remove(0))
    }

    /// The parameters that several latents decode to, a batch at a time.
    ///
    /// # Errors
    /// As [`decode`](Self::decode).
    pub fn decode_all(&self, latents: &[Latent]) -> Result<Vec<Decoded>, Fault> {
        let mut all = Vec::with_capacity(latents.len());
        for batch in latents.chunks(BATCH) {
            all.extend(self.decoded(batch)?);
        }
        Ok(all)
    }

    /// Returns the sliding part of [`decode`](Self::decode).
    ///
    /// # Errors
    /// As [`decode`](Self::decode).
    pub fn decode_grid(&self, z: &Latent) -> Result<DecodedGrid, Fault> {
        self.decoded_grids(&bounded(std::slice::from_ref(z)))
            .map(|mut all| all.remove(0))
    }

    /// Returns the tapping part of [`decode`](Self::decode): traces, m/s², `speeds × samples`.
    ///
    /// # Errors
    /// As [`decode`](Self::decode).
    pub fn decode_taps(&self, z: &Latent) -> Result<Vec<f32>, Fault> {
        self.decoded_taps(&bounded(std::slice::from_ref(z)))
            .map(|mut all| all.remove(0))
    }

    fn decoded(&self, latents: &[Latent]) -> Result<Vec<Decoded>, Fault> {
        let z = bounded(latents);
        let grids = self.decoded_grids(&z)?.into_iter();
        let decoded = grids.zip(self.decoded_taps(&z)?);
        Ok(decoded
            .map(|(grid, taps_m_s2)| Decoded { grid, taps_m_s2 })
            .collect())
    }

    fn decoded_grids(&self, z: &[f32]) -> Result<Vec<DecodedGrid>, Fault> {
        let grid = &self.description.grid;
        let (count, bins) = (z.len() / LATENT, grid.speeds_mm_s.len());
        let inputs: [Input<'_>; 1] = [("z", &[count, LATENT], z)];
        let outputs = self.ar_decoder.run(&inputs)?;
        let lsf_rad = outputs.take("lsf_rad", count * bins * grid.order)?;
        let level_db = outputs.take("level_db", count * bins)?;
        let rows = rows(&lsf_rad, count).zip(rows(&level_db, count));
        Ok(rows
            .map(|(lsf_rad, level_db)| DecodedGrid { lsf_rad, level_db })
            .collect())
    }

    fn decoded_taps(&self, z: &[f32]) -> Result<Vec<Vec<f32>>, Fault> {
        let taps = &self.description.taps;
        let (count, samples) = (z.len() / LATENT, taps.speeds_m_s.len() * taps.samples);
        let inputs: [Input<'_>; 1] = [("z", &[count, LATENT], z)];
        let outputs = self.tap_decoder.run(&inputs)?;
        let taps_m_s2 = outputs.take("taps_m_s2", count * samples)?;
        Ok(rows(&taps_m_s2, count).collect())
    }

    /// The mean of the posterior, given the modalities that are present.
    ///
    /// # Errors
    /// [`Fault`] when the network fails.
    pub fn encode(&self, known: Present<'_>) -> Result<Latent, Fault> {
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
        let outputs = self.encoder()?.run(&[
            ("ar", &[1, bins, grid.order + 1], ar),
            ("taps_m_s2", &[1, traces, samples], bank),
            ("present", &[1, 2], &present),
        ])?;
        Ok(latent(&outputs.take("mean", LATENT)?))
    }

    fn encoder(&self) -> Result<&Network, Fault> {
        if let Some(encoder) = self.encoder.get() {
            return Ok(encoder);
        }
        let network = Network::load("encoder.onnx", self.encoder_bytes.clone(), &self.backend)?;
        Ok(self.encoder.get_or_init(|| network))
    }
}

fn latent(values: &[f32]) -> Latent {
    std::array::from_fn(|k| values[k])
}

/// Latents one after the other, as decoders are given them.
fn bounded(latents: &[Latent]) -> Vec<f32> {
    let values = latents.as_flattened().iter();
    values
        .map(|x| if x.is_nan() { 0.0 } else { x.clamp(-1e3, 1e3) })
        .collect()
}

/// The equal parts of a batch.
fn rows(values: &[f32], count: usize) -> impl Iterator<Item = Vec<f32>> {
    let size = values.len() / count.max(1);
    (0..count).map(move |n| values[n * size..(n + 1) * size].to_vec())
}
