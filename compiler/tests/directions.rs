//! Directions of prompts: which materials have one, and how strokes along and across them feel as the runtime renders them.

use crate::prompts::{PROMPTS, compiled};
use asperity::{
    driver,
    edit_memory::Sliders,
    emit::{lower::lower, raise::raise},
    learned::direction,
    model::{TextureModel, attributes},
    sources::{
        Tools,
        latents::{Edit, LatentEditor, Mix, MixOptions, MixPreview},
        model_file,
    },
    views::inspect::Document,
};
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use rayon::prelude::*;
use std::collections::BTreeSet;

fn texture(prompt: &str) -> TextureModel {
    TextureModel {
        name: prompt.chars().take(60).collect(),
        ..PROMPTS.texture(prompt).unwrap()
    }
}

/// Level of the vibration, dB, and friction over load, of strokes at 100 mm/s and 1 N in a direction of the plane z = 0.
fn stroked(texture: &TextureModel, [x, y]: [f64; 2]) -> (f64, f64) {
    let mut texture = texture.clone();
    texture.taps.traces.clear();
    texture.contact = None;
    let bytes = lower(&texture, None).unwrap().bytes;
    let asset = Asset::parse(&bytes).unwrap();
    let config = Config::default();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, config.servo_rate_hz).unwrap();
    let renderer = Renderer::new(&config).unwrap();
    let mut state = State::new(1);
    let depth_m = 1.0 / renderer.wall(asset.coupling()).stiffness.value();
    let (mut power, mut friction, mut load, mut count) = (0.0, 0.0, 0.0, 0.0);
    for tick in 0..8000 {
        // Half a metre at a time.
        let along = 1e-4 * f64::from(tick % 5000) - 0.25;
        let sample = Sample::at([(along * x) as f32, (along * y) as f32, -depth_m]);
        let output = renderer.tick(&slot, &mut state, &sample);
        if (300..5000).contains(&tick) || tick > 5300 {
            power += f64::from(output.vib_m_s2).powi(2);
            friction += f64::from(output.friction_n);
            load += f64::from(output.normal_force_n);
            count += 1.0;
        }
    }
    (10.0 * f64::log10(power / count), friction / load)
}

/// Claim: 83 materials have a direction, by their own latents their own, and no other of the corpus has one.
#[test]
fn a_material_by_its_own_name_has_its_own_direction() {
    let description = PROMPTS.model().description();
    let table: BTreeSet<&str> = direction::materials().collect();
    assert_eq!(table.len(), 83);
    let anchors = description.anchors.par_iter();
    let found = anchors.filter(|anchor| {
        let at = direction::at(&anchor.z, description);
        let own = table.contains(anchor.name.as_str());
        assert_eq!(at.is_some(), own, "{}", anchor.name);
        own
    });
    assert_eq!(found.count(), 83);
}

/// Claim: at every row the first prompt is rougher, or its friction higher, than the second; `asperity` compiles both.
#[test]
fn strokes_along_and_across_are_ordered() {
    let rows: Vec<Vec<&str>> = include_str!("directions/orders.tsv")
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split('\t').collect())
        .collect();
    assert!(rows.len() >= 30);
    let wrong: Vec<String> = rows
        .par_iter()
        .filter_map(|row| {
            let [more, relation, less] = row[..3].try_into().ok()?;
            let [more_of, less_of] = [more, less].map(|prompt| attributes::of(&texture(prompt)));
            let holds = match relation {
                "rougher" => more_of.rough_db? > less_of.rough_db? + 0.5,
                "grippier" => more_of.mu > 1.02 * less_of.mu,
                _ => panic!("{relation}"),
            };
            (!holds).then(|| {
                format!(
                    "{more} not {relation} than {less}: {:?} {:?} dB, μ {:.3} {:.3}",
                    more_of.rough_db, less_of.rough_db, more_of.mu, less_of.mu
                )
            })
        })
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        rows.len(),
        wrong.join("\n")
    );
}

/// Claim: what a prompt with a bearing compiles to is what strokes of that bearing meet on the texture without it.
#[test]
fn strokes_in_x_cross_ribs_that_run_along_y() {
    for (name, ribs) in [
        ("corduroy", "the ribs"),
        ("corrugated cardboard", "the flutes"),
        ("brushed aluminium", "the brush marks"),
        ("rabbit fur", "the hair"),
    ] {
        let directed = texture(name);
        assert!(directed.direction.is_some(), "{name}");
        for (preposition, stroke) in [("across", [1.0, 0.0]), ("along", [0.0, 1.0])] {
            let prompt = format!("{name} {preposition} {ribs}");
            let alone = texture(&prompt);
            assert_eq!(alone.direction, None, "{prompt}");
            let (level_db, mu) = stroked(&directed, stroke);
            let (exact_db, exact_mu) = stroked(&alone, [1.0, 0.0]);
            assert!(
                (level_db - exact_db).abs() < 0.7,
                "{prompt}: {level_db} {exact_db} dB"
            );
            // A stroke along a nap goes one way here, and to and fro in the words.
            if preposition == "across" {
                assert!(
                    (mu / exact_mu - 1.0).abs() < 0.01,
                    "{prompt}: {mu} {exact_mu}"
                );
            }
        }
    }
    let fur = texture("rabbit fur");
    for (prompt, stroke) in [
        ("rabbit fur with the hair", [0.0, 1.0]),
        ("rabbit fur against the hair", [0.0, -1.0]),
    ] {
        let (_, mu) = stroked(&fur, stroke);
        let (_, exact) = stroked(&texture(prompt), [1.0, 0.0]);
        assert!((mu / exact - 1.0).abs() < 0.01, "{prompt}: {mu} {exact}");
    }
}

/// Claim: bytes and model files hold a direction as it is, and both refuse one that they could not hold.
#[test]
fn a_direction_reads_back_from_bytes_and_from_a_file() {
    let texture = texture("corduroy");
    let direction = texture.direction.unwrap();
    let bytes = lower(&texture, None).unwrap().bytes;
    let asset = Asset::parse(&bytes).unwrap();
    assert_eq!((asset.version(), asset.contact()), (3, None));
    let raised = raise(&asset).direction.unwrap();
    for (found, exact) in raised.ratios().into_iter().zip(direction.ratios()) {
        assert!((found - exact).abs() < 1e-6, "{found} {exact}");
    }
    let json = serde_json::to_value(Document::of(&asset)).unwrap();
    let axis: Vec<f64> = serde_json::from_value(json["direction"]["axis"].clone()).unwrap();
    assert_eq!(axis, [0.0, 1.0, 0.0]);
    let file = model_file::to_json(&texture);
    assert_eq!(
        model_file::from_json(&file).unwrap().direction,
        Some(direction)
    );
    for (key, value) in [
        ("axis", serde_json::json!([0.0, 0.0, 0.0])),
        ("axis", serde_json::json!([0.0, 1.0, 0.1])),
        ("power_ratio", serde_json::json!(-0.1)),
        ("power_ratio", serde_json::json!(2.1)),
        ("speed_ratio", serde_json::json!(0.1)),
        ("mu_forward", serde_json::json!(0.0)),
        ("mu_backward", serde_json::json!(4.1)),
    ] {
        let mut document: serde_json::Value = serde_json::from_slice(&file).unwrap();
        document["direction"][key] = value.clone();
        let text = serde_json::to_vec(&document).unwrap();
        let error = model_file::from_json(&text).unwrap_err().to_string();
        assert!(
            error.contains(&format!("direction.{key}")),
            "{key} {value}: {error}"
        );
    }
}

/// Claim: an edit keeps the direction, a blend has one between, and what was compiled along the ribs stays so.
#[test]
fn edits_and_blends_keep_the_direction() {
    let editor = LatentEditor::new(&PROMPTS);
    let options = MixOptions {
        preview: MixPreview::None,
        ..MixOptions::default()
    };
    let made = |mix: Mix| {
        let tools = Tools::of(&PROMPTS);
        let compiled = driver::compile(&mix.source, &mix.request, &tools).unwrap();
        raise(&Asset::parse(&compiled.lowered.bytes).unwrap())
    };
    let [plain, along, glass] = ["corduroy", "corduroy along the ribs", "glass"].map(compiled);
    let [plain, along, glass] = [&plain, &along, &glass].map(|bytes| Asset::parse(bytes).unwrap());
    let own = raise(&plain).direction.unwrap();
    let still = Edit::Steps(Sliders {
        rougher: 1.0,
        ..Sliders::default()
    });
    let edited = made(editor.change(&plain, Some(&still), &options).unwrap());
    assert_eq!(edited.direction, Some(own));
    let kept = made(editor.change(&along, Some(&still), &options).unwrap());
    let rough_db = |texture: &TextureModel| attributes::of(texture).rough_db.unwrap();
    assert_eq!(kept.direction, None);
    let apart = rough_db(&kept) - rough_db(&raise(&along));
    assert!(apart.abs() < 2.0, "{apart} dB");
    let half = made(editor.blend(&plain, &glass, 0.5, &options).unwrap())
        .direction
        .unwrap();
    let middle = own.power_ratio.sqrt();
    assert!((half.power_ratio - middle).abs() < 1e-3, "{half:?}");
    let slid = made(editor.compose(&glass, &plain, None, &options).unwrap());
    assert_eq!(slid.direction, Some(own));
}
