use super::*;
use asperity::{
    model::attributes::Meter,
    signal::{quantile::rank_correlation, spectrum::trace_centroid_hz},
};

fn load_plain() -> (Corpus, Vec<LexiconEntry>) {
    load(&ReferenceOptions {
        instances: 2,
        ..ReferenceOptions::default()
    })
    .unwrap()
}

#[test]
fn the_committed_corpus_keeps_its_rules() {
    let (corpus, lexicon) = load_plain();
    assert!(corpus.materials.len() >= 320 && lexicon.len() >= 10_000);
    let families: std::collections::BTreeSet<_> =
        corpus.materials.iter().map(|m| m.family.as_str()).collect();
    assert!(families.len() >= 30);
}

#[test]
fn what_people_say_and_what_the_textures_do_agree_in_order() {
    assert_in_order(&load_plain().0);
}

/// Claim: the shipped moduli are those of the corpus.
/// `ASPERITY_BLESS=1 cargo test -p asperity-corpus --lib the_shipped_moduli` writes them.
#[test]
fn the_shipped_moduli_are_those_of_the_corpus() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../compiler/model/moduli.tsv"
    );
    let all = physical().unwrap().into_iter();
    let text: String = all
        .map(|(name, physical)| format!("{name}\t{}\n", physical.modulus_mpa))
        .collect();
    if std::env::var_os("ASPERITY_BLESS").is_some() {
        std::fs::write(file, &text).unwrap();
    }
    assert_eq!(asperity::learned::modulus::TABLE, text);
}

/// A difference of ratings that nearly anyone would feel.
const CLEAR: f64 = 30.0;

/// Asserts that the ratings of all materials and their textures are in the same order.
fn assert_in_order(corpus: &Corpus) {
    let ratings: Vec<_> = corpus.materials.iter().map(|m| m.rating.unwrap()).collect();
    let column = |of: fn(&crate::Rating) -> f64| ratings.iter().map(of).collect::<Vec<_>>();
    let grid = corpus.grid.description();
    let levels: Vec<f64> = (corpus.materials.iter())
        .map(|m| {
            Meter::default()
                .vibration(&m.prototype.grid(&grid))
                .unwrap()
                .power
        })
        .collect();
    let hardness: Vec<f64> = corpus
        .materials
        .iter()
        .map(|m| {
            let trace: Vec<f64> = m.prototype.taps_m_s2[12]
                .iter()
                .map(|&a| f64::from(a))
                .collect();
            trace_centroid_hz(&trace, crate::TAP_RATE_HZ).unwrap()
        })
        .collect();
    let slip: Vec<f64> = corpus.materials.iter().map(|m| -m.mu).collect();
    // What measured materials say: among equally deep reliefs a harder one vibrates more, and a softer one rubs more.
    for (what, rated, found, least) in [
        ("roughness", column(|r| r.rough), levels, 0.85),
        ("hardness", column(|r| r.hard), hardness, 0.95),
        ("slipperiness", column(|r| r.slippery), slip, 0.85),
    ] {
        let correlation = rank_correlation(&rated, &found).unwrap();
        let both = || rated.iter().zip(&found);
        let in_order: Vec<bool> = both()
            .flat_map(|(x, a)| {
                let below = both().filter(move |(y, _)| x - **y > CLEAR);
                below.map(move |(_, b)| a > b)
            })
            .collect();
        let right = in_order.iter().filter(|right| **right).count();
        let share = right as f64 / in_order.len() as f64;
        println!("{what}: {correlation:.3}, {share:.4} of the clear pairs");
        assert!(
            correlation > least && share > 0.98,
            "{what}: {correlation:.3}, {share:.4}"
        );
    }
}

#[test]
fn a_name_belongs_to_one_material_and_is_a_synonym_of_no_other() {
    let entries = |file: &str, text: &str| schema::parse(file, text).unwrap().material;
    let all: Vec<schema::MaterialEntry> = EMBEDDED
        .iter()
        .flat_map(|(file, text)| entries(file, text))
        .collect();
    let mut shared = Vec::new();
    for (entry, other) in all.iter().flat_map(|x| all.iter().map(move |y| (x, y))) {
        if entry.name != other.name && words_of(other).contains(&entry.name.to_lowercase()) {
            shared.push(format!("{}: {}", entry.name, other.name));
        }
    }
    assert!(shared.is_empty(), "{shared:#?}");
}

/// The name of a material and its synonyms, in lower case, each once.
fn words_of(entry: &schema::MaterialEntry) -> std::collections::BTreeSet<String> {
    let synonyms = entry.synonyms.iter().map(|word| word.to_lowercase());
    synonyms.chain([entry.name.to_lowercase()]).collect()
}

#[test]
fn the_same_seed_gives_the_same_instances_and_another_seed_others() {
    let options = |seed| ReferenceOptions {
        instances: 1,
        seed,
        ..ReferenceOptions::default()
    };
    let first = |seed| load(&options(seed)).unwrap().0.materials[7].instances[0].clone();
    assert_eq!(first(1), first(1));
    assert_ne!(first(1), first(2));
}

#[test]
fn every_instance_is_stable_and_its_taps_follow_the_speed() {
    assert_stable(&load_plain().0);
}

/// Asserts that every filter is stable with a margin and that peaks of taps grow as v^(6/5), as
/// Hertz's do.
fn assert_stable(corpus: &Corpus) {
    for material in &corpus.materials {
        for lsf in &material.prototype.lsf_rad {
            let lsf: Vec<f64> = lsf.iter().map(|&x| f64::from(x)).collect();
            assert!(
                asperity::signal::lsf::smallest_gap(&lsf) > 0.012,
                "{}",
                material.name
            );
        }
        let taps = &material.prototype.taps_m_s2;
        let peak = |trace: &[f32]| trace.iter().fold(0.0_f32, |p, a| p.max(a.abs()));
        let exponent = (peak(&taps[12]) / peak(&taps[0])).ln() / 13.0_f32.ln();
        assert!(
            (exponent - 1.2).abs() < 0.08,
            "{}: {exponent}",
            material.name
        );
    }
}

#[test]
fn faults_are_told_by_file_material_and_field() {
    let folder = std::env::temp_dir().join(format!("asperity-corpus-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let text = EMBEDDED[0]
        .1
        .replacen("wavelength_mm  =", "wavelength_mm =", 1);
    let broken = text.replacen("hard = ", "hard = 9", 1);
    std::fs::write(folder.join("abrasives.toml"), broken).unwrap();
    let options = ReferenceOptions {
        folder: Some(folder.clone()),
        ..ReferenceOptions::default()
    };
    let message = load(&options).unwrap_err().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(message.contains("abrasives.toml: "), "{message}");
    assert!(message.contains("attributes.hard"), "{message}");
    assert!(message.contains("corpus: 10 materials"), "{message}");
}
