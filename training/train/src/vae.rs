//! The first stage: the whole network at once.

use crate::{
    adam::{Adam, Step},
    batch::{Batch, Instances},
    captions::Captions,
    config::{Config, Loss},
    error::FitError,
    loss::{info_nce, smooth_l1},
    network::{Decoded, Mode, Network, matrix},
    normaliser::{LSFS, Normaliser},
    parameters::{Bound, Parameters},
    progress::EpochLoss,
    rng::{Purpose, Stream},
};
use asperity_corpus::BINS;
use burn_tensor::{Device, Tensor};
use std::f64::consts::PI;

/// A run between two epochs.
pub(crate) struct State {
    /// Learned parameters.
    pub(crate) parameters: Parameters,
    /// The optimiser's memory.
    adam: Adam,
    /// Losses of the epochs done.
    pub(crate) history: Vec<EpochLoss>,
}

/// Constants of a run.
pub(crate) struct Run<'a> {
    pub(crate) config: &'a Config,
    pub(crate) network: &'a Network,
    pub(crate) normaliser: &'a Normaliser,
    pub(crate) instances: &'a Instances,
    pub(crate) captions: &'a Captions,
}

impl State {
    /// Before the first epoch.
    pub(crate) fn new(parameters: Parameters) -> Self {
        Self {
            adam: Adam::new(&parameters),
            parameters,
            history: Vec::new(),
        }
    }

    /// Trains for one pass over the instances.
    pub(crate) fn epoch(&mut self, run: &Run<'_>) -> Result<EpochLoss, FitError> {
        let epoch = self.history.len();
        let optimiser = &run.config.optimiser;
        let device = Device::flex().autodiff();
        let mut stream = Stream::new(run.config.seed, Purpose::Epoch, epoch);
        let mut order: Vec<usize> = (0..run.instances.material.len()).collect();
        stream.shuffle(&mut order);
        let batches = batches(&order, optimiser.batch);
        let kl = kl_weight(&run.config.loss, epoch);
        let mut mean = EpochLoss::default();
        for (index, chosen) in batches.iter().enumerate() {
            let augmentation = &run.config.augmentation;
            let batch = Batch::draw(
                run.instances,
                run.captions,
                chosen,
                augmentation,
                &mut stream,
                &device,
            );
            let progress =
                (epoch as f64 + index as f64 / batches.len() as f64) / optimiser.epochs as f64;
            let step = Step {
                learning_rate: learning_rate(
                    optimiser.learning_rate,
                    optimiser.final_learning_rate,
                    progress,
                ),
                weight_decay: optimiser.weight_decay,
                clip_norm: optimiser.clip_norm,
            };
            let loss = self.step(run, batch, kl, step, &mut stream);
            if !loss.total.is_finite() {
                return Err(FitError::Diverged {
                    epoch: epoch + 1,
                    loss: loss.total,
                });
            }
            mean.add(loss, chosen.len() as f32 / order.len() as f32);
        }
        self.history.push(mean);
        Ok(mean)
    }

    fn step(
        &mut self,
        run: &Run<'_>,
        batch: Batch,
        kl_weight: f64,
        step: Step,
        stream: &mut Stream,
    ) -> EpochLoss {
        let (network, weights) = (run.network, &run.config.loss);
        let device = Device::flex().autodiff();
        let bound = self.parameters.bind(&device);
        let mut mode = Mode::Train(stream, run.config.network.dropout);
        let (ar, taps) = (batch.ar, batch.taps);
        let posterior = network
            .encoder
            .forward(&bound, ar.clone(), taps.clone(), batch.present);
        let z = posterior.sample(batch.epsilon);
        let mixed = |x: Tensor<2>| match &batch.mixing {
            Some(shares) => shares.clone().matmul(x),
            None => x,
        };
        let ar = mixed(ar);
        let latents = [mixed(z.clone()), z.clone()];
        let decoded = decode(network, &bound, run.normaliser, latents, &mut mode);
        let said = normalised(run.normaliser, decoded);
        let lsf = smooth_l1(said.lsf_rad, ar.clone().narrow(1, 0, LSFS));
        let excitation = smooth_l1(said.excitation, ar.narrow(1, LSFS, BINS));
        let share = weights.excitation_share;
        let ar = lsf * (1.0 - share) + excitation.clone() * share;
        let taps = smooth_l1(said.taps_m_s2, taps);
        let kl = posterior.divergence();
        let predicted = network
            .text
            .forward(&bound, batch.text, &mut Mode::Evaluate);
        let (projected, statistics) = network.latent.forward(&bound, z, &mut mode);
        let contrastive = info_nce(
            projected,
            predicted.clone(),
            weights.temperature,
            &batch.pairing,
        );
        let alignment = (predicted - posterior.mean.clone()).square().mean();
        let centres = bound.get(network.centres).select(0, batch.material);
        let compactness = (posterior.mean.clone() - centres).square().mean();
        let friction = network.friction.forward(&bound, posterior.mean.clone()) - batch.friction;
        let friction = friction.square().mean();
        let reconstruction = ar.clone() * weights.ar + taps.clone() * weights.taps;
        let total = reconstruction * weights.reconstruction
            + kl.clone() * kl_weight
            + contrastive.clone() * weights.contrastive
            + alignment.clone() * weights.alignment
            + compactness.clone() * weights.compactness
            + friction.clone() * weights.friction;
        let gradients = bound.gradients(total.backward());
        self.adam.step(&mut self.parameters, &gradients, step);
        network.latent.observe(&mut self.parameters, statistics);
        let value = |term: Tensor<1>| term.inner().into_scalar();
        EpochLoss {
            total: value(total),
            ar: value(ar),
            excitation: value(excitation),
            taps: value(taps),
            kl: value(kl),
            contrastive: value(contrastive),
            alignment: value(alignment),
            compactness: value(compactness),
            friction: value(friction),
        }
    }
}

/// Both decoders, each of its own latents.
pub(crate) fn decode(
    network: &Network,
    bound: &Bound,
    normaliser: &Normaliser,
    [ar, taps]: [Tensor<2>; 2],
    mode: &mut Mode<'_>,
) -> Decoded {
    let (lsf_rad, excitation) = network.ar_decoder.forward(bound, normaliser, ar, mode);
    Decoded {
        lsf_rad,
        excitation,
        taps_m_s2: network.tap_decoder.forward(bound, normaliser, taps, mode),
    }
}

/// The same with mean zero and deviation one, as the encoders see it.
fn normalised(normaliser: &Normaliser, decoded: Decoded) -> Decoded {
    let normal = |x: Tensor<2>, mean: &[f32], deviation: &[f32]| {
        let device = x.device();
        let row = |values: &[f32]| matrix(values.to_vec(), values.len(), &device);
        (x - row(mean)) / row(deviation)
    };
    let (mean, deviation) = (&normaliser.ar_mean, &normaliser.ar_deviation);
    Decoded {
        lsf_rad: normal(decoded.lsf_rad, &mean[..LSFS], &deviation[..LSFS]),
        excitation: normal(decoded.excitation, &mean[LSFS..], &deviation[LSFS..]),
        taps_m_s2: normal(
            decoded.taps_m_s2,
            &normaliser.tap_mean,
            &normaliser.tap_deviation,
        ),
    }
}

/// Batches of `size`; a last one of a single instance joins its predecessor, since
/// one row has no batch statistics.
fn batches(order: &[usize], size: usize) -> Vec<&[usize]> {
    let mut batches: Vec<&[usize]> = order.chunks(size).collect();
    if batches.len() > 1 && batches.last().is_some_and(|last| last.len() == 1) {
        batches.pop();
        let start = (batches.len() - 1) * size;
        if let Some(last) = batches.last_mut() {
            *last = &order[start..];
        }
    }
    batches
}

/// β in an epoch, counted from 0.
fn kl_weight(loss: &Loss, epoch: usize) -> f64 {
    let (from, to) = (loss.kl_from_epoch, loss.kl_to_epoch);
    if epoch >= to {
        loss.kl
    } else {
        let done = epoch.saturating_sub(from) as f64 / (to - from).max(1) as f64;
        loss.kl * done
    }
}

/// Step size when this share of a run is done: constant, or half a cosine.
pub(crate) fn learning_rate(start: f64, end: Option<f64>, done: f64) -> f64 {
    end.map_or(start, |end| {
        end + 0.5 * (start - end) * (1.0 + libm::cos(PI * done))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_divergence_fades_in_as_in_the_paper() {
        let loss = Config::find("paper").unwrap().loss;
        let beta = |epoch| kl_weight(&loss, epoch);
        assert_eq!(
            (beta(0), beta(20), beta(120), beta(199)),
            (0.0, 0.0, 0.001, 0.001)
        );
        assert!((beta(70) - 0.0005).abs() < 1e-12);
    }

    #[test]
    fn the_cosine_ends_where_it_should() {
        assert_eq!(learning_rate(1e-3, Some(1e-5), 0.0), 1e-3);
        assert!((learning_rate(1e-3, Some(1e-5), 1.0) - 1e-5).abs() < 1e-15);
        assert_eq!(learning_rate(1e-4, None, 0.5), 1e-4);
    }

    #[test]
    fn no_batch_has_a_single_row() {
        let order: Vec<usize> = (0..9).collect();
        let sizes = |size| {
            batches(&order, size)
                .iter()
                .map(|b| b.len())
                .collect::<Vec<_>>()
        };
        assert_eq!(sizes(4), [4, 5]);
        assert_eq!(sizes(5), [5, 4]);
        assert_eq!(sizes(20), [9]);
    }
}
