//! A run from corpus to trained model.

use crate::{
    attribute_regression::{self, AttributeRegression, AttributeValues},
    attributes::Layout,
    batch::Instances,
    captions::Captions,
    config::Config,
    error::FitError,
    kernel_ridge::KernelRidge,
    lda_retrieval::LdaRetrieval,
    material::MaterialLatent,
    network::Network,
    normaliser::{Coded, Normaliser, check},
    parameters::Parameters,
    progress::Progress,
    rng::{Purpose, Stream},
    text_stage,
    trained::{Modalities, Trained, posteriors},
    vae::{Run, State},
};
use asperity::learned::description::LATENT;
use asperity_corpus::{Corpus, Rating};

/// Trains on some materials of a corpus, given as indices; `captions` are those of the
/// whole corpus. The same arguments give the same model, whatever the thread count.
///
/// # Errors
/// [`FitError`].
pub fn fit_on(
    corpus: &Corpus,
    materials: &[usize],
    captions: &Captions,
    config: &Config,
    progress: &mut dyn Progress,
) -> Result<Trained, FitError> {
    let mut session = TrainingRun::new(corpus, materials, captions, config)?;
    while !session.is_done() {
        session.epoch(progress)?;
        if progress.interrupted() && !session.is_done() {
            let epoch = session.state.history.len();
            return Err(FitError::Interrupted { epoch });
        }
    }
    Ok(session.finish(progress))
}

/// Runs `work` on a pool of so many threads, all that the trainer uses.
///
/// # Errors
/// [`FitError::Threads`] when the system refuses them.
pub fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, FitError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| FitError::Threads {
        threads,
        message: error.to_string(),
    })?;
    Ok(pool.install(work))
}

/// A run under way.
struct TrainingRun<'a> {
    config: &'a Config,
    captions: &'a Captions,
    materials: Vec<usize>,
    normaliser: Normaliser,
    network: Network,
    instances: Instances,
    ratings: Vec<Option<Rating>>,
    felt: Vec<AttributeValues>,
    state: State,
}

impl<'a> TrainingRun<'a> {
    /// Prepares data and network.
    fn new(
        corpus: &Corpus,
        materials: &[usize],
        captions: &'a Captions,
        config: &'a Config,
    ) -> Result<Self, FitError> {
        check(corpus, materials)?;
        let chosen = || {
            materials
                .iter()
                .map(|&index| (index, &corpus.materials[index]))
        };
        let all = || chosen().flat_map(|(_, material)| &material.instances);
        let mut coded = Coded::of(config.coding, all());
        let levels = all().flat_map(|instance| instance.level_db);
        let normaliser = Normaliser::of(config.coding, &coded, levels);
        normaliser.normalise(&mut coded);
        let material: Vec<usize> = chosen()
            .flat_map(|(index, material)| vec![index; material.instances.len()])
            .collect();
        let friction = standardised_log_friction(corpus, &material);
        let layout = Layout::of(corpus);
        let mut stream = Stream::new(config.seed, Purpose::Initialisation, 0);
        let (network, parameters) = Network::new(
            &config.network,
            captions.width,
            corpus.materials.len(),
            &normaliser,
            &mut stream,
        );
        Ok(Self {
            config,
            captions,
            materials: materials.to_vec(),
            normaliser,
            network,
            instances: Instances {
                coded,
                material,
                friction,
            },
            ratings: chosen().map(|(_, material)| material.rating).collect(),
            felt: chosen()
                .map(|(_, material)| attribute_regression::of(material, &layout))
                .collect(),
            state: State::new(parameters),
        })
    }

    /// Returns true if the first stage is over.
    fn is_done(&self) -> bool {
        self.state.history.len() >= self.config.optimiser.epochs
    }

    /// Trains an epoch of the first stage.
    fn epoch(&mut self, progress: &mut dyn Progress) -> Result<(), FitError> {
        let loss = self.state.epoch(&Run {
            config: self.config,
            network: &self.network,
            normaliser: &self.normaliser,
            instances: &self.instances,
            captions: self.captions,
        })?;
        progress.epoch(
            self.state.history.len(),
            self.config.optimiser.epochs,
            &loss,
        );
        Ok(())
    }

    /// The latents of the materials, the second stage, and the model.
    fn finish(self, progress: &mut dyn Progress) -> Trained {
        let State {
            parameters,
            history,
            ..
        } = self.state;
        let (materials, spread) = locate(
            &self.materials,
            &self.network,
            &parameters,
            &self.instances,
            self.captions,
        );
        let mut trained = Trained {
            config: self.config.clone(),
            network: self.network,
            parameters,
            normaliser: self.normaliser,
            encoder: self.captions.encoder.clone(),
            width: self.captions.width,
            materials,
            spread,
            history,
            memory: None,
            recall: None,
            feel: None,
        };
        if let Some(stage) = &self.config.text_stage {
            let examples =
                text_stage::Examples::new(&trained.materials, &self.ratings, self.captions, stage);
            let how = &stage.memory;
            let (vectors, targets, weights) = examples.all();
            let memory = KernelRidge::fit(&vectors, &targets, &weights, how, |step, of, left| {
                progress.text_epoch(step, of, left)
            });
            let (materials, captions) = (&trained.materials, self.captions);
            let recall = how.recall.as_ref();
            trained.recall = recall.map(|how| LdaRetrieval::new(&memory, materials, captions, how));
            let felt = (self.felt.as_slice(), self.ratings.as_slice());
            trained.feel = AttributeRegression::fit(
                &memory,
                materials,
                felt,
                captions,
                how,
                |step, of, left| progress.text_epoch(step, of, left),
            );
            trained.memory = Some(memory);
        }
        trained
    }
}

/// ln μ of the material of each instance, mean zero and deviation one.
fn standardised_log_friction(corpus: &Corpus, material: &[usize]) -> Vec<f32> {
    let logs = || {
        let of = material.iter();
        of.map(|&index| libm::log(corpus.materials[index].mu.max(f64::MIN_POSITIVE)))
    };
    let count = material.len().max(1) as f64;
    let mean = logs().sum::<f64>() / count;
    let variance = logs().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
    let scale = libm::sqrt(variance).max(1e-6);
    logs().map(|x| ((x - mean) / scale) as f32).collect()
}

/// Mean latent of each material, and the spread of instances about them.
fn locate(
    materials: &[usize],
    network: &Network,
    parameters: &Parameters,
    instances: &Instances,
    captions: &Captions,
) -> (Vec<MaterialLatent>, [f32; LATENT]) {
    let posteriors = posteriors(network, parameters, &instances.coded, Modalities::Both);
    let mut square = [0.0_f64; LATENT];
    let located: Vec<MaterialLatent> = materials
        .iter()
        .map(|&material| {
            let own = || {
                let pairs = instances.material.iter().zip(&posteriors);
                pairs
                    .filter(|(of, _)| **of == material)
                    .map(|(_, posterior)| &posterior.mean)
            };
            let count = own().count() as f64;
            let mut mean = [0.0_f64; LATENT];
            for z in own() {
                for (sum, &x) in mean.iter_mut().zip(z) {
                    *sum += f64::from(x) / count;
                }
            }
            for z in own() {
                for ((sum, &x), mean) in square.iter_mut().zip(z).zip(&mean) {
                    *sum += (f64::from(x) - mean) * (f64::from(x) - mean);
                }
            }
            MaterialLatent {
                material,
                mean: mean.map(|x| x as f32),
                caption: captions.mean(material),
            }
        })
        .collect();
    let count = posteriors.len() as f64;
    (located, square.map(|sum| libm::sqrt(sum / count) as f32))
}
