//! Tests of training runs.

use crate::{
    Captions, Config, FitError,
    captions::cosine,
    fit_on,
    rng::{Purpose, Stream},
    synthetic::{self, Silent, WordBag},
    trained::{Modalities, Trained},
};
use asperity::learned::description::LATENT;
use asperity_corpus::{BINS, Corpus, Instance};

pub(super) fn small() -> Config {
    let mut config = Config::find("reference").unwrap();
    config.network.decoder = vec![32, 64];
    config.network.ar_encoder = vec![64, 32];
    config.network.tap_encoder = vec![32, 32];
    config.optimiser.epochs = 40;
    config.optimiser.batch = 16;
    config.loss.kl_from_epoch = 2;
    config.loss.kl_to_epoch = 20;
    config
}

fn train(config: &Config) -> Trained {
    let corpus = synthetic::corpus(8, 8);
    let captions = Captions::encode(&corpus, &[], &WordBag).unwrap();
    let all: Vec<usize> = (0..8).collect();
    fit_on(&corpus, &all, &captions, config, &mut Silent).unwrap()
}

#[test]
fn the_loss_falls_and_the_same_seed_repeats_it() {
    let config = small();
    let (first, again) = (train(&config), train(&config));
    let history = &first.history;
    assert!(history[39].ar < 0.6 * history[0].ar, "{history:?}");
    assert!(history[39].taps < 0.6 * history[0].taps, "{history:?}");
    assert_eq!(history, &again.history);
    assert_eq!(first.materials, again.materials);
    let mut other = config;
    other.seed = 2;
    assert_ne!(&train(&other).history, history);
}

#[test]
fn any_latent_decodes_to_ordered_lsfs_and_bounded_vibration() {
    let mut config = small();
    config.optimiser.epochs = 1;
    config.text_stage = None;
    for excitation in ["level", "variance"] {
        let toml = format!("x = \"{excitation}\"");
        let parsed: std::collections::BTreeMap<String, crate::config::Excitation> =
            toml::from_str(&toml).unwrap();
        config.coding.excitation = parsed["x"];
        let trained = train(&config);
        let mut stream = Stream::new(3, Purpose::Epoch, 0);
        let latents: Vec<[f32; LATENT]> = [0.0, 1.0, 10.0, 1e4]
            .iter()
            .map(|scale| std::array::from_fn(|_| scale * stream.normal()))
            .collect();
        let (low, high) = trained.normaliser.level_bounds_db;
        for instance in trained.decode(&latents) {
            for bin in &instance.lsf_rad {
                assert!(bin[0] > 0.0119 && bin[20] < std::f32::consts::PI - 0.0119);
                assert!(bin.windows(2).all(|pair| pair[1] - pair[0] > 0.0119));
            }
            assert!(instance.level_db.iter().all(|x| (low..=high).contains(x)));
            let bound = &trained.normaliser.tap_bound;
            let taps = instance.taps_m_s2.iter().flatten();
            assert!(taps.zip(bound).all(|(x, bound)| x.abs() <= *bound));
        }
    }
}

#[test]
fn captions_find_their_material_and_so_do_those_left_out() {
    let trained = train(&small());
    let corpus = synthetic::corpus(8, 8);
    let captions = Captions::encode(&corpus, &[], &WordBag).unwrap();
    let hits = |captions: &[Vec<Vec<f32>>]| {
        let mut hits = 0;
        for (index, own) in captions.iter().enumerate() {
            let vectors: Vec<&[f32]> = own.iter().map(Vec::as_slice).collect();
            for z in trained.project(&vectors) {
                let best = trained
                    .materials
                    .iter()
                    .max_by(|a, b| cosine(&a.mean, &z).total_cmp(&cosine(&b.mean, &z)));
                hits += usize::from(best.unwrap().material == index);
            }
        }
        hits
    };
    let known = hits(&captions.training);
    assert!(known >= 20, "{known} of 24");
    // One in eight would by chance.
    let left_out = hits(&captions.held_out);
    assert!(left_out >= 4, "{left_out} of 8");
}

#[test]
fn what_is_held_out_has_no_part_in_training() {
    let config = small();
    let known: Vec<usize> = (0..7).collect();
    let fitted = |corpus: &Corpus| {
        let captions = Captions::encode(corpus, &[], &WordBag).unwrap();
        fit_on(corpus, &known, &captions, &config, &mut Silent).unwrap()
    };
    let corpus = synthetic::corpus(8, 8);
    let clean = fitted(&corpus);
    let mut poisoned = corpus.clone();
    for material in &mut poisoned.materials {
        material.held_out = vec!["rough0 hard9 name0".to_owned()];
    }
    let unknown = &mut poisoned.materials[7];
    unknown.mu = 9.0;
    unknown.training.truncate(1);
    unknown.training[0].text = "rough0 hard9 name1".to_owned();
    for instance in unknown.instances.iter_mut().chain([&mut unknown.prototype]) {
        instance.level_db = [55.0; BINS];
        instance
            .taps_m_s2
            .iter_mut()
            .flatten()
            .for_each(|x| *x *= -40.0);
    }
    let again = fitted(&poisoned);
    assert_eq!(clean.history, again.history);
    assert_eq!(clean.materials, again.materials);
    assert_eq!(clean.normaliser, again.normaliser);
    let z = [[0.3; LATENT]];
    assert_eq!(clean.decode(&z)[0].taps_m_s2, again.decode(&z)[0].taps_m_s2);
    assert_eq!(clean.decode(&z)[0].level_db, again.decode(&z)[0].level_db);
}

/// Pearson's.
fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let mean = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| -> f64 { pairs.iter().map(|p| of(p.0 - x, p.1 - y)).sum() };
    sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt()
}

#[test]
fn one_modality_is_enough_to_encode() {
    let mut config = small();
    // Half the rows are mixtures, which say less of single materials.
    config.optimiser.epochs *= 2;
    let trained = train(&config);
    let corpus = synthetic::corpus(8, 8);
    let instances: Vec<_> = corpus.materials.iter().map(|m| &m.prototype).collect();
    for modalities in [Modalities::Ar, Modalities::Taps, Modalities::Both] {
        let posteriors = trained.encode(&instances, modalities);
        assert_eq!(posteriors.len(), 8);
        let finite = |x: &[f32]| x.iter().all(|x| x.is_finite());
        assert!(posteriors.iter().all(|p| finite(&p.log_variance)));
        let means: Vec<[f32; LATENT]> = posteriors.iter().map(|p| p.mean).collect();
        let decoded = trained.decode(&means);
        // Loud materials come back louder than quiet ones, whatever was seen of them.
        let level = |instance: &Instance| f64::from(instance.level_db.iter().sum::<f32>());
        let pairs: Vec<(f64, f64)> = instances
            .iter()
            .zip(&decoded)
            .map(|(own, back)| (level(own), level(back)))
            .collect();
        let along = correlation(&pairs);
        println!("{modalities:?}: {along:.2}");
        assert!(along > 0.5, "{modalities:?}: {along}");
    }
    assert_ne!(
        trained.encode(&instances, Modalities::Ar),
        trained.encode(&instances, Modalities::Both)
    );
}

#[test]
fn a_corpus_that_cannot_be_trained_on_is_refused_by_name() {
    let mut corpus = synthetic::corpus(3, 2);
    let captions = Captions::encode(&corpus, &[], &WordBag).unwrap();
    let config = small();
    let too_few = fit_on(&corpus, &[0], &captions, &config, &mut Silent).unwrap_err();
    assert!(matches!(too_few, FitError::TooFewMaterials(1)));
    corpus.materials[1].instances[0].level_db[4] = f32::NAN;
    let fault = fit_on(&corpus, &[0, 1], &captions, &config, &mut Silent).unwrap_err();
    assert!(fault.to_string().contains("material 1") && fault.to_string().contains("level_db"));
}
