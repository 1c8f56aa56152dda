//! Part 1: how tightly the instances of a material lie together in the latent, and what
//! that tightness is worth.

mod agreement;
mod collapse;
mod indices;
mod kmeans;

pub(super) use collapse::Collapse;

use super::{EvaluateError, Watch, data, subject::Subject, watch::pause};
use crate::trained::Modalities;
use asperity::learned::Latent;
use asperity_corpus::Corpus;
use serde::{Deserialize, Serialize};

/// Starts of k-means.
const RESTARTS: usize = 4;

/// The paper's silhouette, Calinski–Harabasz, Davies–Bouldin, ARI and NMI, on 2,000
/// latents of 100 materials.
pub(super) const PAPER: Indices = Indices {
    silhouette: 0.96,
    calinski_harabasz: 2.3e4,
    davies_bouldin: 0.14,
    adjusted_rand: 0.97,
    mutual_information: 0.99,
};

/// Separation of materials in the latent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Indices {
    /// −1 to 1, more is better.
    pub silhouette: f64,
    /// More is better; grows with the number of instances.
    pub calinski_harabasz: f64,
    /// Less is better.
    pub davies_bouldin: f64,
    /// Adjusted Rand index between materials and k-means.
    pub adjusted_rand: f64,
    /// Normalised mutual information between them.
    pub mutual_information: f64,
}

/// Indices of some instances through some encoders.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EncoderIndices {
    /// `training` or `unseen`.
    pub instances: String,
    /// `AR + taps`, `AR` or `taps`.
    pub encoder: String,
    /// The indices.
    pub indices: Indices,
}

/// Part 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Clustering {
    /// Materials.
    pub materials: usize,
    /// Instances a row.
    pub instances: usize,
    /// True if the taps of the corpus were synthesised.
    pub taps_synthetic: bool,
    /// All combinations.
    pub rows: Vec<EncoderIndices>,
    /// On training instances, through both encoders.
    pub collapse: Collapse,
    /// On unseen ones.
    pub collapse_unseen: Collapse,
}

/// Measures.
pub(super) fn measure(
    subject: &Subject,
    training: &Corpus,
    unseen: &Corpus,
    materials: &[usize],
    seed: u64,
    watch: &mut dyn Watch,
) -> Result<Clustering, EvaluateError> {
    const WHAT: &str = "clustering";
    watch.begin(WHAT, 6);
    let mut rows = Vec::new();
    let mut collapses = Vec::new();
    let mut count = 0;
    for (name, corpus) in [("training", training), ("unseen", unseen)] {
        let (instances, labels) = data::labelled(corpus, materials);
        count = instances.len();
        for (encoder, modalities) in [
            ("AR + taps", Modalities::Both),
            ("AR", Modalities::Ar),
            ("taps", Modalities::Taps),
        ] {
            pause(watch, WHAT)?;
            let latents = subject.encode(&instances, modalities)?;
            rows.push(EncoderIndices {
                instances: name.into(),
                encoder: encoder.into(),
                indices: indices(&latents, &labels, seed),
            });
            if modalities == Modalities::Both {
                let decoded = subject.decode(&latents)?;
                let decoded: Vec<_> = decoded.iter().map(|t| &t.instance).collect();
                collapses.push(Collapse::of(&instances, &decoded, &latents, &labels));
            }
            watch.done(rows.len());
        }
    }
    let mut collapses = collapses.into_iter();
    let mut next = || collapses.next().unwrap_or_default();
    Ok(Clustering {
        materials: materials.len(),
        instances: count,
        taps_synthetic: training.taps_synthetic,
        rows,
        collapse: next(),
        collapse_unseen: next(),
    })
}

fn indices(latents: &[Latent], labels: &[usize], seed: u64) -> Indices {
    let k = labels.iter().max().map_or(1, |most| most + 1);
    let found = kmeans::cluster(latents, k, RESTARTS, seed);
    Indices {
        silhouette: indices::silhouette(latents, labels),
        calinski_harabasz: indices::calinski_harabasz(latents, labels),
        davies_bouldin: indices::davies_bouldin(latents, labels),
        adjusted_rand: agreement::adjusted_rand(labels, &found),
        mutual_information: agreement::normalised_mutual_information(labels, &found),
    }
}
