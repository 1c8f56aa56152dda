//! The model under evaluation, read from its folder: what is measured is what ships.

use super::{
    EvaluateError, cache,
    signature::{Objective, Signature},
};
use crate::{attributes::Layout, trained::Modalities};
use asperity::{
    learned::{
        Decoded, Files, Latent, LearnedModel, Present, Projected, description::ModelDescription,
        friction, inference::Backend, texture,
    },
    model::{Provenance, attributes, shift},
};
use asperity_corpus::{BINS, CHANNELS, Instance, ORDER, TAP_SAMPLES, TAPS};
use asperity_io::diagnostic::Fault;
use rayon::prelude::*;
use std::path::Path;

/// The level that stands for a texture that does not sound, dB.
const SILENT_DB: f64 = -100.0;

/// A model folder on a back end.
pub(super) struct Subject {
    model: LearnedModel,
    /// Checksum of its networks and its description, certainty apart.
    pub(super) crc32: u32,
    layout: Layout,
}

/// A texture that a latent decodes to.
pub(super) struct Texture {
    pub(super) instance: Instance,
    pub(super) signature: Signature,
}

impl Subject {
    /// Reads a folder.
    pub(super) fn open(folder: &Path, backend: &Backend) -> Result<Self, EvaluateError> {
        let files = Files::read(folder)?;
        let networks = [
            files.text_projection.to_vec(),
            files.ar_decoder.to_vec(),
            files.tap_decoder.to_vec(),
            files.encoder.to_vec(),
        ];
        let model = LearnedModel::load(files, backend)?;
        let crc32 = checksum(model.description(), &networks)?;
        let (grid, taps) = (&model.description().grid, &model.description().taps);
        let shape = [
            grid.order,
            grid.speeds_mm_s.len(),
            taps.speeds_m_s.len(),
            taps.samples,
        ];
        let expected = [ORDER, BINS, TAPS, TAP_SAMPLES];
        let speeds_m_s = taps.speeds_m_s.as_slice().try_into().ok();
        match speeds_m_s.filter(|_| shape == expected) {
            Some(speeds_m_s) => Ok(Self {
                layout: Layout::of_model(model.description(), speeds_m_s),
                model,
                crc32,
            }),
            None => Err(EvaluateError::Mismatch {
                field: "order, bins, traces, samples",
                model: format!("{shape:?}"),
                given: format!("{expected:?}"),
                remedy: "train a model with this version of `asperity-train fit`",
            }),
        }
    }

    pub(super) fn description(&self) -> &ModelDescription {
        self.model.description()
    }

    /// Latents of the anchors.
    pub(super) fn anchors(&self) -> Vec<Latent> {
        let anchors = &self.description().anchors;
        // Their width is checked when a model is loaded.
        let latent = |z: &Vec<f32>| std::array::from_fn(|k| z[k]);
        anchors.iter().map(|anchor| latent(&anchor.z)).collect()
    }

    /// Where text vectors land.
    pub(super) fn project(&self, vectors: &[Vec<f32>]) -> Result<Vec<Projected>, EvaluateError> {
        let projected = vectors.par_iter().map(|v| self.model.project(v));
        Ok(projected.collect::<Result<_, Fault>>()?)
    }

    /// Posterior means of instances.
    pub(super) fn encode(
        &self,
        instances: &[&Instance],
        modalities: Modalities,
    ) -> Result<Vec<Latent>, EvaluateError> {
        let means = instances.par_iter().map(|instance| {
            let ar = ar_input(instance);
            let taps = instance.taps_m_s2.as_flattened();
            self.model.encode(match modalities {
                Modalities::Both => Present::Both(&ar, taps),
                Modalities::Ar => Present::Ar(&ar),
                Modalities::Taps => Present::Taps(taps),
            })
        });
        Ok(means.collect::<Result<_, Fault>>()?)
    }

    /// Decodes latents, with the friction of their neighbours.
    pub(super) fn decode(&self, latents: &[Latent]) -> Result<Vec<Texture>, EvaluateError> {
        let textures = latents.par_iter().map(|z| {
            let instance = instance(&self.model.decode(z)?);
            let signature = Signature::of(&instance, &self.layout, self.mu(z));
            Ok(Texture {
                instance,
                signature,
            })
        });
        Ok(textures.collect::<Result<_, Fault>>()?)
    }

    /// Attributes of the textures of texts: what the latents decode to, moved to what the words ask
    /// for where the model says.
    pub(super) fn felt(&self, projected: &[Projected]) -> Result<Vec<Objective>, EvaluateError> {
        let felt = projected.par_iter().map(|said| {
            let decoded = self.model.decode(&said.z)?;
            let (name, provenance) = (String::new(), Provenance::default());
            let description = self.description();
            let (mut texture, _) = texture::build(description, &decoded, &said.z, name, provenance);
            if let Some(felt) = said.felt {
                let wanted = felt.map(|x| Some(f64::from(x)));
                let moved = shift::to(&wanted, &attributes::of(&texture));
                shift::adjust(&mut texture, &moved);
            }
            let attributes = attributes::of(&texture);
            Ok(Objective {
                rough_db: attributes.rough_db.unwrap_or(SILENT_DB),
                sharp_hz: attributes.sharp_hz.unwrap_or_default(),
                hard_hz: attributes.hard_hz.unwrap_or_default(),
                mu: attributes.mu,
            })
        });
        Ok(felt.collect::<Result<_, Fault>>()?)
    }

    /// μ from the neighbours of a latent.
    fn mu(&self, z: &Latent) -> f64 {
        let description = self.description();
        let near = friction::neighbours(z, &description.anchors, description.friction);
        friction::mu(&near, &description.anchors)
    }
}

fn checksum(description: &ModelDescription, networks: &[Vec<u8>; 4]) -> Result<u32, EvaluateError> {
    let json = serde_json::to_vec(description).map_err(|error| EvaluateError::Encode {
        file: "model.json".into(),
        message: error.to_string(),
    })?;
    let networks = networks.iter().map(Vec::as_slice);
    Ok(cache::checksum(networks.chain([json.as_slice()])))
}

fn ar_input(instance: &Instance) -> Vec<f32> {
    let mut ar = Vec::with_capacity(BINS * CHANNELS);
    for (lsf_rad, &level_db) in instance.lsf_rad.iter().zip(&instance.level_db) {
        ar.extend(lsf_rad);
        ar.push(level_db);
    }
    ar
}

/// Decoded numbers in the form of the corpus; their counts were checked.
fn instance(decoded: &Decoded) -> Instance {
    let mut instance = Instance {
        lsf_rad: [[0.0; ORDER]; BINS],
        level_db: [0.0; BINS],
        taps_m_s2: [[0.0; TAP_SAMPLES]; TAPS],
    };
    let fill = |to: &mut [f32], from: &[f32]| {
        to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
    };
    fill(instance.lsf_rad.as_flattened_mut(), &decoded.grid.lsf_rad);
    fill(&mut instance.level_db, &decoded.grid.level_db);
    fill(instance.taps_m_s2.as_flattened_mut(), &decoded.taps_m_s2);
    instance
}
