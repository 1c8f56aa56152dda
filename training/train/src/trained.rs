//! A trained model, before it is a folder: encode, decode, project.

use crate::{
    attribute_regression::{AttributeRegression, AttributeValues},
    coding,
    config::{Config, Excitation},
    kernel_ridge::KernelRidge,
    lda_retrieval::LdaRetrieval,
    material::MaterialLatent,
    network::{Mode, Network, matrix},
    normaliser::{AR, Coded, LSFS, Normaliser, TAP_VALUES},
    parameters::{Bound, Parameters, numbers},
    progress::EpochLoss,
    vae::decode,
};
use asperity::learned::description::LATENT;
use asperity_corpus::{BINS, Instance, ORDER, TAP_SAMPLES, TAPS};
use burn_tensor::Device;

/// Rows that go through the network at once.
const CHUNK: usize = 256;

/// Modalities of an instance that an encoder sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Modalities {
    /// AR models and traces.
    Both,
    /// AR models alone.
    Ar,
    /// Traces alone.
    Taps,
}

/// A Gaussian over the latent.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Gaussian {
    /// μ.
    pub(crate) mean: [f32; LATENT],
    /// log σ².
    pub(crate) log_variance: [f32; LATENT],
}

/// A trained model.
#[derive(Debug, Clone)]
pub struct Trained {
    pub(crate) config: Config,
    pub(crate) network: Network,
    pub(crate) parameters: Parameters,
    pub(crate) normaliser: Normaliser,
    pub(crate) encoder: String,
    pub(crate) width: usize,
    pub(crate) materials: Vec<MaterialLatent>,
    /// Standard deviation of posterior means about the mean of their material.
    pub(crate) spread: [f32; LATENT],
    /// Losses of the first stage, an epoch each.
    pub(crate) history: Vec<EpochLoss>,
    /// Projects in place of the network where there is one.
    pub(crate) memory: Option<KernelRidge>,
    /// Draws what the memory says to a material.
    pub(crate) recall: Option<LdaRetrieval>,
    /// Regression of roughness, slipperiness and hardness, beside the memory.
    pub(crate) feel: Option<AttributeRegression>,
}

impl Trained {
    /// Posteriors of instances, of which the encoders see these `modalities`.
    pub(crate) fn encode(&self, instances: &[&Instance], modalities: Modalities) -> Vec<Gaussian> {
        let coding = self.normaliser.coding;
        let mut coded = Coded::of(coding, instances.iter().copied());
        self.normaliser.normalise(&mut coded);
        posteriors(&self.network, &self.parameters, &coded, modalities)
    }

    /// The instances that latents decode to: ordered LSFs, levels and samples within
    /// bounds, whatever the latents.
    pub(crate) fn decode(&self, latents: &[[f32; LATENT]]) -> Vec<Instance> {
        let device = Device::flex();
        let bound = self.parameters.bind(&device);
        let mut instances = Vec::with_capacity(latents.len());
        for chunk in latents.chunks(CHUNK) {
            let z = matrix(chunk.concat(), LATENT, &device);
            let (network, normaliser) = (&self.network, &self.normaliser);
            let decoded = decode(
                network,
                &bound,
                normaliser,
                [z.clone(), z],
                &mut Mode::Evaluate,
            );
            let (lsf_rad, excitation, taps) = (
                numbers(decoded.lsf_rad),
                numbers(decoded.excitation),
                numbers(decoded.taps_m_s2),
            );
            for row in 0..chunk.len() {
                instances.push(self.instance(
                    &lsf_rad[row * LSFS..(row + 1) * LSFS],
                    &excitation[row * BINS..(row + 1) * BINS],
                    &taps[row * TAP_VALUES..(row + 1) * TAP_VALUES],
                ));
            }
        }
        instances
    }

    fn instance(&self, lsf_rad: &[f32], excitation: &[f32], taps: &[f32]) -> Instance {
        let mut instance = Instance {
            lsf_rad: [[0.0; ORDER]; BINS],
            level_db: [0.0; BINS],
            taps_m_s2: [[0.0; TAP_SAMPLES]; TAPS],
        };
        let (low, high) = self.normaliser.level_bounds_db;
        let (least, most) = self.normaliser.excitation_bounds;
        for (bin, lsf_rad) in lsf_rad.chunks(ORDER).enumerate() {
            instance.lsf_rad[bin].copy_from_slice(lsf_rad);
            let coding = self.normaliser.coding.excitation;
            let code = match coding {
                // Rounding may reach a variance of zero, and LSFs pressed together an infinite
                // gain: their product would be no number.
                Excitation::Variance => excitation[bin].clamp(least, most),
                Excitation::Level => excitation[bin],
            };
            let level_db = coding::decode(coding, lsf_rad, code);
            instance.level_db[bin] = level_db.clamp(low, high);
        }
        for (trace, samples) in instance.taps_m_s2.iter_mut().zip(taps.chunks(TAP_SAMPLES)) {
            trace.copy_from_slice(samples);
        }
        instance
    }

    /// Returns the roughness, slipperiness and hardness that text vectors ask for; empty from a model without that
    /// regression.
    pub(crate) fn feel(&self, vectors: &[&[f32]]) -> Vec<AttributeValues> {
        match (&self.feel, &self.memory) {
            (Some(feel), Some(memory)) => {
                let chunks = vectors.chunks(CHUNK);
                chunks.flat_map(|chunk| feel.ask(memory, chunk)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The latents that text vectors project to.
    pub(crate) fn project(&self, vectors: &[&[f32]]) -> Vec<[f32; LATENT]> {
        if let Some(memory) = &self.memory {
            let means: Vec<_> = self.materials.iter().map(|m| m.mean).collect();
            let projected = vectors.chunks(CHUNK).flat_map(|chunk| {
                let mut latents = memory.project(chunk);
                if let Some(recall) = &self.recall {
                    let directions = memory.directions(chunk);
                    recall.draw(&means, &directions, &mut latents);
                }
                latents
            });
            return projected.collect();
        }
        let device = Device::flex();
        let bound = self.parameters.bind(&device);
        let mut latents = Vec::with_capacity(vectors.len());
        for chunk in vectors.chunks(CHUNK) {
            let x = matrix(chunk.concat(), self.width, &device);
            let z = self.network.text.forward(&bound, x, &mut Mode::Evaluate);
            latents.extend(rows(&numbers(z)));
        }
        latents
    }
}

/// Posteriors of coded, normalised instances.
pub(crate) fn posteriors(
    network: &Network,
    parameters: &Parameters,
    coded: &Coded,
    modalities: Modalities,
) -> Vec<Gaussian> {
    let device = Device::flex();
    let bound = parameters.bind(&device);
    let mut all = Vec::with_capacity(coded.len());
    for (ar, taps) in coded
        .ar
        .chunks(CHUNK * AR)
        .zip(coded.taps.chunks(CHUNK * TAP_VALUES))
    {
        all.extend(posterior_chunk(
            network, &bound, ar, taps, modalities, &device,
        ));
    }
    all
}

fn posterior_chunk(
    network: &Network,
    bound: &Bound,
    ar: &[f32],
    taps: &[f32],
    modalities: Modalities,
    device: &Device,
) -> Vec<Gaussian> {
    let present = match modalities {
        Modalities::Both => [1.0, 1.0],
        Modalities::Ar => [1.0, 0.0],
        Modalities::Taps => [0.0, 1.0],
    };
    let count = ar.len() / AR;
    let posterior = network.encoder.forward(
        bound,
        matrix(ar.to_vec(), AR, device),
        matrix(taps.to_vec(), TAP_VALUES, device),
        matrix(present.repeat(count), 2, device),
    );
    let means = rows(&numbers(posterior.mean));
    let log_variances = rows(&numbers(posterior.log_variance));
    let pairs = means.into_iter().zip(log_variances);
    pairs
        .map(|(mean, log_variance)| Gaussian { mean, log_variance })
        .collect()
}

fn rows(values: &[f32]) -> Vec<[f32; LATENT]> {
    values.as_chunks::<LATENT>().0.to_vec()
}
