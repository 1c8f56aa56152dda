//! Progress and interruption of a run.

use serde::{Deserialize, Serialize};

/// Means over the steps of an epoch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct EpochLoss {
    /// The objective.
    pub total: f32,
    /// Smooth L1 of the normalised LSFs and excitations, weighted.
    pub ar: f32,
    /// Smooth L1 of the normalised excitations alone.
    pub excitation: f32,
    /// Smooth L1 of the normalised tap samples.
    pub taps: f32,
    /// Divergence from the standard normal, nats.
    pub kl: f32,
    /// InfoNCE.
    pub contrastive: f32,
    /// Mean square of μ̂ − μ.
    pub alignment: f32,
    /// Mean square of μ − c.
    pub compactness: f32,
    /// Mean square error of friction's logarithm, standardised.
    pub friction: f32,
}

impl EpochLoss {
    pub(crate) fn add(&mut self, other: Self, share: f32) {
        self.total += share * other.total;
        self.ar += share * other.ar;
        self.excitation += share * other.excitation;
        self.taps += share * other.taps;
        self.kl += share * other.kl;
        self.contrastive += share * other.contrastive;
        self.alignment += share * other.alignment;
        self.compactness += share * other.compactness;
        self.friction += share * other.friction;
    }
}

/// A listener to a run.
pub trait Progress {
    /// An epoch of the first stage is done; `epoch` counts from 1.
    fn epoch(&mut self, epoch: usize, epochs: usize, loss: &EpochLoss);
    /// An epoch of the text stage is done; `epoch` counts from 1.
    fn text_epoch(&mut self, epoch: usize, epochs: usize, loss: f32);
    /// Returns true to stop after this epoch.
    fn interrupted(&self) -> bool {
        false
    }
}
