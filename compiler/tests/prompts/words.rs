//! Effects of the words of a prompt.

use super::PROMPTS;
use asperity::{
    driver::Stopped,
    learned::Certainty,
    model::attributes::{self, Attributes},
    passes::reduce::Fidelity,
    pipeline::{PipelineError, Request},
    sources::{
        latents::Scale,
        prompt::{CompiledPrompt, Options, PromptError},
    },
};
use asperity_formats::Asset;
use asperity_tests::{
    figures,
    size::{least, sized},
};
use rayon::prelude::*;
use serde_json::Value as Json;
use std::{collections::BTreeMap, error::Error};
use toml::Value;

/// Rightly ordered share of the committed pairs: rough, slippery, hard.
const LEAST_SHARES: [(&str, f64); 3] = [("rough", 0.95), ("slippery", 0.90), ("hard", 0.94)];

fn plain() -> Options {
    Options::default().without_preview()
}

/// Attributes of the decoder's own texture: neither reduced nor lowered.
fn attributes(prompt: &str) -> Attributes {
    attributes::of(&PROMPTS.texture(prompt).unwrap())
}

#[test]
fn an_abrasive_is_sharper_and_stronger_than_cork_and_cork_than_foam() {
    let [abrasive, cork, foam] = [
        "rough abrasive sheet with gritty particles",
        "cork",
        "soft foam",
    ]
    .map(attributes);
    assert!(abrasive.rough_db > cork.rough_db && cork.rough_db > foam.rough_db);
    assert!(abrasive.sharp_hz > cork.sharp_hz && cork.sharp_hz > foam.sharp_hz);
}

#[test]
fn everyday_words_are_ordered_as_any_person_would() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../training/corpora/pairs.toml"
    );
    let text = std::fs::read_to_string(file).unwrap();
    let pairs: toml::Table = text.parse().unwrap();
    let of = |attribute: &str, a: Attributes| match attribute {
        "rough" => a.rough_db.unwrap(),
        "slippery" => -a.mu,
        _ => a.hard_hz.unwrap(),
    };
    let stride = sized("every so many pairs", 12, 1);
    let (mut missed, mut table) = (Vec::new(), BTreeMap::new());
    for (attribute, least_share) in LEAST_SHARES {
        let rows = pairs[attribute].as_array().unwrap();
        assert!(rows.len() >= 100, "{attribute}");
        let rows: Vec<&Value> = rows.iter().step_by(stride).collect();
        let right = rows
            .par_iter()
            .filter(|row| {
                let [first, second] = [0, 1].map(|k| row[k].as_str().unwrap());
                let right = of(attribute, attributes(first)) > of(attribute, attributes(second));
                if !right {
                    let read = [first, second].map(|p| PROMPTS.read(p).text());
                    println!("{attribute}: {first} is not above {second}: {read:?}");
                }
                right
            })
            .count();
        println!("{attribute}: {right} of {}", rows.len());
        table.insert(attribute, [right, rows.len()]);
        if right < least(least_share, rows.len()) {
            missed.push(format!("{attribute}: {right} of {}", rows.len()));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
    let [rough, slippery, hard] = ["rough", "slippery", "hard"].map(|attribute| table[attribute]);
    figures::hold_at_full(
        "pairs",
        "-p asperity --test it everyday",
        [
            ("right", (rough[0] + slippery[0] + hard[0]).to_string()),
            ("of", (rough[1] + slippery[1] + hard[1]).to_string()),
            ("rough", rough[0].to_string()),
            ("rough_of", rough[1].to_string()),
            ("rough_percent", figures::percent(rough[0], rough[1])),
            ("slippery", slippery[0].to_string()),
            ("slippery_of", slippery[1].to_string()),
            (
                "slippery_percent",
                figures::percent(slippery[0], slippery[1]),
            ),
            ("hard", hard[0].to_string()),
            ("hard_of", hard[1].to_string()),
            ("hard_percent", figures::percent(hard[0], hard[1])),
        ],
    );
}

#[test]
fn the_same_prompt_gives_the_same_bytes_whatever_the_threads() {
    let prompt = "wet ice";
    let first = PROMPTS
        .compile(prompt, &Options::default())
        .unwrap()
        .lowered
        .bytes;
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let again = pool
            .unwrap()
            .install(|| PROMPTS.compile(prompt, &Options::default()).unwrap());
        assert_eq!(again.lowered.bytes, first);
    }
}

#[test]
fn a_texture_fits_four_kibibytes() {
    // Sizes as the bytes themselves state them.
    let haptic = |bytes: &[u8]| Asset::parse(bytes).unwrap().haptic_len();
    let first = "rough abrasive sheet with gritty particles";
    for prompt in [first, "velvet", "window glass"] {
        let lowered = PROMPTS.compile(prompt, &plain()).unwrap().lowered;
        assert_eq!(lowered.haptic_bytes, haptic(&lowered.bytes), "{prompt}");
        assert!(
            lowered.haptic_bytes <= 4096,
            "{prompt}: {}",
            lowered.haptic_bytes
        );
    }
    let [bare, whole] = [plain(), Options::default()].map(|options| {
        let compiled = PROMPTS.compile(first, &options).unwrap();
        compiled.lowered.bytes
    });
    let kilobytes = |bytes: usize| format!("{:.1}", bytes as f64 / 1000.0);
    figures::hold(
        "sizes",
        "-p asperity --test it four_kibibytes",
        [
            ("haptic", figures::count(haptic(&bare) as u64)),
            ("haptic_kb", kilobytes(haptic(&bare))),
            ("file_kb", kilobytes(bare.len())),
            ("with_preview_kb", kilobytes(whole.len())),
        ],
    );
}

#[test]
fn a_seed_varies_a_texture_without_leaving_the_material() {
    let with_seed = |seed| {
        PROMPTS
            .compile("cork", &Options { seed, ..plain() })
            .unwrap()
    };
    let (meant, varied) = (with_seed(0), with_seed(5));
    assert_ne!(meant.lowered.bytes, varied.lowered.bytes);
    let difference = meant.attributes().rough_db.unwrap() - varied.attributes().rough_db.unwrap();
    assert!(difference.abs() < 4.0, "{difference} dB");
}

#[test]
fn fidelity_sets_the_order_and_rate_the_clock() {
    let with = |fidelity, rate_hz| {
        let options = Options {
            seed: 0,
            request: Request {
                fidelity,
                rate_hz,
                ..Request::default()
            },
        };
        PROMPTS.compile("denim", &options).unwrap().texture.grid
    };
    assert_eq!(with(Fidelity::Full, None).order, 21);
    assert_eq!(with(Fidelity::Order(5), None).order, 5);
    assert!(with(Fidelity::Auto, None).order < 21);
    assert_eq!(with(Fidelity::Auto, Some(1500.0)).sample_rate_hz, 1500.0);
    let mut absurd = plain();
    absurd.request.rate_hz = Some(f64::NAN);
    let refused = PROMPTS.compile("denim", &absurd).unwrap_err();
    let refused: &dyn Error = &*refused;
    assert!(matches!(
        refused.downcast_ref::<Stopped>().unwrap().cause,
        PipelineError::Rate(_)
    ));
}

#[test]
fn long_prompts_are_cut_with_a_warning_and_empty_ones_refused() {
    // More than the encoder reads; as long with words that say nothing, of which nobody reads; more than
    // the reader reads; words that the encoder has no token for.
    for (long, cut) in [
        ("gritty ".repeat(400), "tokens after the first 128"),
        ("a ".repeat(60_000), "its last 58976 words"),
        ("my finger ".repeat(30_000), "its last "),
        ("木材 rough ".repeat(800), "its last "),
    ] {
        let compiled = PROMPTS.compile(&long, &plain()).unwrap();
        let too_long = |warning: &String| warning.contains("too long") && warning.contains(cut);
        assert!(
            compiled.warnings.iter().any(too_long),
            "{:?}",
            compiled.warnings
        );
        assert!(compiled.warnings.iter().all(|warning| warning.len() < 1000));
        let found: &CompiledPrompt = compiled.found().unwrap();
        let scale = Scale::of(PROMPTS.model().description());
        assert!(found.summary(&compiled, &scale).len() < 4000);
        assert!(compiled.texture.name.len() <= 64);
    }
    let refused = PROMPTS.compile(" \n", &plain()).unwrap_err();
    let refused: &dyn Error = &*refused;
    assert!(matches!(refused.downcast_ref(), Some(PromptError::Empty)));
}

#[test]
fn what_no_surface_is_like_is_told_apart_and_still_safe() {
    let far = PROMPTS
        .compile("the quarterly inflation report of a central bank", &plain())
        .unwrap();
    let near = PROMPTS.compile("coarse sandpaper", &plain()).unwrap();
    assert_eq!(far.certainty, Some(Certainty::NoContact));
    assert_eq!(near.certainty, Some(Certainty::Known));
    assert!(far.json()["low_certainty"] == Json::Bool(true));
}

#[test]
fn any_text_at_all_gives_a_texture() {
    for prompt in ["?", "ﷺ 🪨🧽", "a\u{0}b", "'; DROP TABLE--", "é́́́", "0"] {
        assert!(PROMPTS.compile(prompt, &plain()).is_ok(), "{prompt:?}");
    }
}
