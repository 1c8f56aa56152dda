//! Tests of model folders.

use super::training::small;
use crate::{
    Captions, Config, ModelFiles,
    config::Excitation,
    export, fit_on, measure,
    rng::{Purpose, Stream},
    synthetic::{self, Silent, WordBag},
    trained::Trained,
};
use asperity::learned::{Files, LearnedModel, description::LATENT, inference::Backend};
use asperity_corpus::Corpus;

const MATERIALS: [usize; 6] = [0, 1, 2, 3, 4, 5];

fn data() -> (Corpus, Captions) {
    let corpus = synthetic::corpus(6, 6);
    let captions = Captions::encode(&corpus, &synthetic::lexicon(), &WordBag).unwrap();
    (corpus, captions)
}

fn short() -> Config {
    let mut config = small();
    config.optimiser.epochs = 6;
    config
}

fn exported(trained: &Trained) -> ModelFiles {
    let (corpus, captions) = data();
    exported_of(trained, &corpus, &captions)
}

pub(super) fn exported_of(trained: &Trained, corpus: &Corpus, captions: &Captions) -> ModelFiles {
    let metrics = measure(trained, corpus, captions);
    export(trained, corpus, captions, &metrics).unwrap()
}

#[test]
fn the_compiler_loads_what_is_written_and_decodes_the_same() {
    for excitation in [Excitation::Level, Excitation::Variance] {
        let mut config = short();
        config.coding.excitation = excitation;
        let (corpus, captions) = data();
        let trained = fit_on(&corpus, &MATERIALS, &captions, &config, &mut Silent).unwrap();
        // The export itself compares every network with the trained one.
        let files = exported(&trained);
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("model");
        files.write(&target).unwrap();
        let weights = std::fs::read(target.join("weights.safetensors")).unwrap();
        let weights = safetensors::SafeTensors::deserialize(&weights).unwrap();
        let kept = weights.tensor("memory.codes").is_ok();
        assert_eq!(
            kept,
            trained.memory.is_some(),
            "the memory is kept with the weights"
        );
        let read = Files::read(&target).unwrap();
        let model = LearnedModel::load(read, &Backend::Portable).unwrap();
        assert_eq!(model.description().anchors.len(), 6);
        assert_eq!(model.description().axes.len(), 4);
        let vector = &captions.training[2][0];
        let projected = model.project(vector).unwrap();
        assert_eq!(projected.similarity.len(), 6);
        let decoded = model.decode(&projected.z).unwrap();
        let expected = &trained.decode(&trained.project(&[vector]))[0];
        for (x, y) in decoded.grid.level_db.iter().zip(expected.level_db) {
            assert!((x - y).abs() < 1e-2, "{x} {y}");
        }
    }
}

#[test]
fn a_model_of_few_epochs_and_a_wide_range_of_variances_is_written() {
    let (mut corpus, captions) = data();
    // Smallest and largest variance lie further apart than the digits of an f32 reach.
    for (material, by_db) in corpus.materials.iter_mut().zip([-60.0, 40.0]) {
        for instance in material
            .instances
            .iter_mut()
            .chain([&mut material.prototype])
        {
            instance.level_db.iter_mut().for_each(|x| *x += by_db);
        }
    }
    let mut config = short();
    config.optimiser.epochs = 1;
    config.coding.excitation = Excitation::Variance;
    let trained = fit_on(&corpus, &MATERIALS, &captions, &config, &mut Silent).unwrap();
    let (low, high) = trained.normaliser.level_bounds_db;
    let mut stream = Stream::new(5, Purpose::Epoch, 0);
    for scale in [1.0, 30.0, 1e3, 1e4] {
        let latents: Vec<[f32; LATENT]> = (0..20)
            .map(|_| std::array::from_fn(|_| scale * stream.normal()))
            .collect();
        for instance in trained.decode(&latents) {
            let bounded = |x: &f32| (low..=high).contains(x);
            assert!(
                instance.level_db.iter().all(bounded),
                "{scale}: {:?}",
                instance.level_db
            );
        }
    }
    exported_of(&trained, &corpus, &captions);
}

#[test]
fn the_same_seed_writes_the_same_bytes() {
    let (corpus, captions) = data();
    let run = || fit_on(&corpus, &MATERIALS, &captions, &short(), &mut Silent).unwrap();
    let (first, again) = (exported(&run()), exported(&run()));
    for ((name, bytes), (_, others)) in first.iter().zip(again.iter()) {
        assert!(bytes == others, "{name} differs");
    }
}
