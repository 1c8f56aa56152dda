//! Tests of a whole evaluation, on a corpus that takes seconds.

use super::*;
use crate::{
    export, fit_on, measure, synthetic,
    synthetic::{Silent, Unwatched, WordBag},
};
use std::fs;

const MATERIALS: usize = 12;

fn config() -> Config {
    let mut config = Config::find("reference").unwrap();
    config.network.decoder = vec![32, 64];
    config.network.ar_encoder = vec![64, 32];
    config.network.tap_encoder = vec![32, 32];
    config.optimiser.epochs = 10;
    config.optimiser.batch = 16;
    config.loss.kl_from_epoch = 2;
    config.loss.kl_to_epoch = 6;
    config
}

/// A model of the synthetic corpus, and all it is asked with.
fn bench(report: &Path) -> Bench<'static> {
    let (corpus, config) = (synthetic::corpus(MATERIALS, 6), config());
    let captions = Captions::encode(&corpus, &[], &WordBag).unwrap();
    let all: Vec<usize> = (0..MATERIALS).collect();
    let trained = fit_on(&corpus, &all, &captions, &config, &mut Silent).unwrap();
    let metrics = measure(&trained, &corpus, &captions);
    let model = report.join("model");
    let files = export(&trained, &corpus, &captions, &metrics).unwrap();
    files.write(&model).unwrap();
    assert_eq!(data::config_of(&model).unwrap(), config);
    let subject = Subject::open(&model, &Backend::Portable).unwrap();
    let layout = Layout::of(&corpus);
    let signature = |m: &asperity_corpus::Material| Signature::of(&m.prototype, &layout, m.mu);
    Bench {
        materials: data::materials(&subject, &corpus).unwrap(),
        signatures: corpus.materials.iter().map(signature).collect(),
        texts: Texts::open(&WordBag, report).unwrap(),
        subject,
        captions,
        config,
        corpus,
    }
}

fn measured(bench: &Bench<'_>, folder: &Path, watch: &mut dyn Watch) -> Report {
    let cache = cache::Cache::open(folder, "test").unwrap();
    let mut report = Report::new(bench);
    let (subject, materials) = (&bench.subject, bench.materials.as_slice());
    let (corpus, signatures) = (&bench.corpus, &bench.signatures);
    report.clustering = clustering::measure(subject, corpus, corpus, materials, 1, watch).ok();
    report.retrieval = retrieval::measure(subject, corpus, &bench.captions, materials).ok();
    let inputs = held_out::Inputs {
        corpus,
        captions: &bench.captions,
        materials,
        signatures,
        config: &bench.config,
        folds: 3,
    };
    report.held_out = held_out::measure(&inputs, &cache, true, watch).unwrap();
    let known = probes::Known {
        materials: signatures,
        lexicon: &bench.captions.lexicon,
    };
    report.probes = probes::measure(subject, &known, &bench.texts, watch).ok();
    report.midpoints = midpoints::measure(subject, signatures).ok();
    let (captions, config) = (&bench.captions, &bench.config);
    report.names = names::measure(subject, corpus, captions, materials, config, watch).ok();
    report.completion = held_out::completion::measure(&inputs, &cache, true, watch).unwrap();
    report
}

/// Panics when a fold is trained.
struct NoTraining;

impl Watch for NoTraining {
    fn begin(&mut self, what: &str, _: usize) {
        let trains = what.starts_with("without") || what.starts_with("completion");
        assert!(!trains, "{what}");
    }
    fn done(&mut self, _: usize) {}
}

#[test]
fn every_part_is_measured_written_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let bench = bench(folder.path());
    let report = measured(&bench, folder.path(), &mut Unwatched);
    report.write(folder.path()).unwrap();

    let clustering = report.clustering.as_ref().unwrap();
    assert_eq!(clustering.rows.len(), 6);
    // The same instances stand for both.
    assert_eq!(clustering.rows[0].indices, clustering.rows[3].indices);
    let retrieval = report.retrieval.as_ref().unwrap();
    assert_eq!(
        (retrieval.materials, retrieval.captions),
        (MATERIALS, MATERIALS)
    );
    let held_out = report.held_out.as_ref().unwrap();
    for folds in [&held_out.materials, &held_out.families] {
        let count: usize = folds.folds.iter().map(|fold| fold.materials.len()).sum();
        assert_eq!((folds.folds.len(), count), (3, MATERIALS));
        for metric in &folds.metrics {
            assert!(
                metric
                    .errors
                    .iter()
                    .all(|e| e.mean.is_finite() && e.mean >= 0.0)
            );
        }
        // The mean texture says the same of everything.
        assert!(folds.ranks.iter().all(|r| r.spearman[1].is_none()));
    }
    let curve = &held_out.certainty;
    assert!(curve.certainty.windows(2).all(|pair| pair[0] <= pair[1]));
    // The ends are materials of other corpora.
    assert!(report.midpoints.as_ref().unwrap().pairs.is_empty());

    for file in ["held_out.png", "probes.png"] {
        assert!(
            fs::read(folder.path().join(file))
                .unwrap()
                .starts_with(b"\x89PNG")
        );
    }
    let text = fs::read_to_string(folder.path().join("report.md")).unwrap();
    for section in [1, 2, 3, 4, 5, 7, 8] {
        assert!(
            text.contains(&format!("\n## {section}. ")),
            "section {section}"
        );
    }
    let json = fs::read_to_string(folder.path().join("report.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["conditions"]["corpus_crc32"], "12345678");
    let certainty = fs::read_to_string(folder.path().join("certainty.json")).unwrap();
    assert!(serde_json::from_str::<serde_json::Value>(&certainty).is_ok());

    let again = measured(&bench, folder.path(), &mut NoTraining);
    assert!(again == report, "a kept fold differs from the measured one");
}

/// Asks to stop at once.
struct Stopped;

impl Watch for Stopped {
    fn begin(&mut self, _: &str, _: usize) {}
    fn done(&mut self, _: usize) {}
    fn interrupted(&self) -> bool {
        true
    }
}

#[test]
fn an_interrupt_is_named_and_a_foreign_corpus_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let bench = bench(folder.path());
    let materials = &bench.materials;
    let stopped = clustering::measure(
        &bench.subject,
        &bench.corpus,
        &bench.corpus,
        materials,
        1,
        &mut Stopped,
    );
    assert!(matches!(stopped, Err(EvaluateError::Interrupted { .. })));
    let mut other = bench.corpus.clone();
    other.crc32 ^= 1;
    let refused = data::materials(&bench.subject, &other)
        .unwrap_err()
        .to_string();
    assert!(refused.contains("corpus.crc32"), "{refused}");
}

#[test]
fn parts_and_corpora_are_read_as_they_are_written() {
    assert_eq!("3".parse(), Ok(Part::HeldOut));
    assert_eq!("8".parse(), Ok(Part::Completion));
    assert!(["0", "6", "9"].iter().all(|n| n.parse::<Part>().is_err()));
    assert_eq!("hatt:x".parse(), Ok(CorpusSource::Hatt("x".into())));
    assert_eq!("reference".parse(), Ok(CorpusSource::Reference(None)));
    assert!("hatt".parse::<CorpusSource>().is_err());
}
