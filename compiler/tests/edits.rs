//! Edits in the latent do what their sliders say, over random textures of the shipped model.

use asperity::{
    compiled::Compiled,
    driver,
    learned::{Latent, inference::Backend},
    model::{
        attributes::{self, Attributes},
        shift::Shift,
    },
    passes::reduce::{Fidelity, reduce},
    pipeline::{Pipeline, Request},
    sources::{
        Tools,
        latents::FromLatents,
        latents::{AXES, Axis, History, LatentEditor, Latents, Sliders},
        prompt::PromptCompiler,
    },
};
use asperity_formats::Asset;
use asperity_tests::{figures, oracle, size::sized_or};

use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::sync::LazyLock;

static PROMPTS: LazyLock<PromptCompiler> = LazyLock::new(|| {
    PromptCompiler::embedded(&Backend::Portable).expect("the shipped model loads")
});

/// Textures of the published table.
const PUBLISHED: usize = 200;
/// An edit hits within so much of its step of 10.
const TOLERANCE: f64 = 3.0;
/// Continuous force of a Touch over its peak force, N over N.
const CONTINUOUS_SHARE: f64 = 0.88 / 3.3;
/// Share of the edits of each slider that hit.
const LEAST_HIT: f64 = 0.95;

/// Textures between two random materials of the model. `ASPERITY_EDITS` asks for more.
fn textures() -> Vec<Latents> {
    let count = sized_or("ASPERITY_EDITS", "textures", 5, 12);
    let anchors = &PROMPTS.model().description().anchors;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut latent = || -> Latent {
        let anchor = &anchors[(random.next_u64() % anchors.len() as u64) as usize];
        std::array::from_fn(|k| anchor.z[k])
    };
    let pairs: Vec<(Latent, Latent)> = (0..count).map(|_| (latent(), latent())).collect();
    let mix = |(n, (a, b)): (usize, &(Latent, Latent))| {
        let t = (n % 5) as f64 / 4.0;
        Latents::between(&Latents::whole(*a), &Latents::whole(*b), t)
    };
    pairs.iter().enumerate().map(mix).collect()
}

fn compiled(latents: Latents, request: &Request) -> Compiled {
    let provenance = PROMPTS.model().provenance("test");
    let source = FromLatents::new(latents, "x".into(), provenance, History::default());
    driver::compile(&source, request, &Tools::of(&PROMPTS)).unwrap()
}

/// The attributes of an asset as the oracle computes them.
fn of_bytes(asset: &[u8]) -> Attributes {
    let found = oracle::attributes(&Asset::parse(asset).unwrap());
    Attributes {
        rough_db: Some(found.rough_db),
        sharp_hz: Some(found.sharp_hz),
        hard_hz: Some(found.hard_hz),
        mu: found.mu,
    }
}

/// A search looks at the parts of a texture one by one, and sees what the whole texture has, to the bit.
#[test]
fn attributes_of_parts_are_those_of_the_whole_texture() {
    let editor = LatentEditor::new(&PROMPTS);
    let textures = textures();
    let (a, b, c) = (textures[0], textures[1], textures[2]);
    let shift = Shift {
        rough_db: 4.0,
        slippery: 0.2,
        hard: -0.3,
    };
    for latents in [
        a,
        b.shifted(shift),
        Latents::composed(&a, &b, &c.shifted(shift)),
    ] {
        for fidelity in [Fidelity::Full, Fidelity::Auto, Fidelity::Order(9)] {
            for rate_hz in [None, Some(2000.0)] {
                let request = Request {
                    fidelity,
                    rate_hz,
                    ..Request::default()
                };
                let mut whole = editor.texture(&latents).unwrap();
                assert_eq!(editor.attributes(&latents).unwrap(), attributes::of(&whole));
                if let Some(rate_hz) = rate_hz {
                    whole.grid = Pipeline::default().rerate(&whole.grid, rate_hz).unwrap();
                }
                let kept = reduce(&whole, fidelity).texture;
                assert_eq!(
                    editor.kept_attributes(&latents, &request).unwrap(),
                    attributes::of(&kept),
                    "{fidelity} {rate_hz:?}"
                );
            }
        }
    }
}

/// A step of 10 up or down moves its attribute by 10 ± 3 in 95 % of the edits, and every other by at
/// most 3, wherever that stays on the slider: beyond 0 and 100 there may be no material to go by.
#[test]
fn a_step_of_ten_moves_its_attribute_by_ten_and_leaves_the_others() {
    let editor = LatentEditor::new(&PROMPTS);
    let request = Request {
        fidelity: Fidelity::Auto,
        ..Request::default()
    };
    let textures = textures();
    let cases: Vec<(usize, Axis, f64)> = (0..textures.len())
        .flat_map(|n| {
            AXES.into_iter()
                .flat_map(move |axis| [(n, axis, 10.0), (n, axis, -10.0)])
        })
        .collect();
    let moved: Vec<Option<[f64; 4]>> = cases
        .par_iter()
        .map(|&(n, axis, step)| {
            let place = |latents: &Latents| {
                let attributes = of_bytes(&compiled(*latents, &request).lowered.bytes);
                AXES.map(|axis| editor.scale().place(axis, &attributes).unwrap())
            };
            let before = place(&textures[n]);
            let there = before[axis as usize] + step;
            if !(0.0..=100.0).contains(&there) {
                return None;
            }
            let mut sliders = Sliders::default();
            match axis {
                Axis::Rough => sliders.rougher = step,
                Axis::Sharp => sliders.sharper = step,
                Axis::Hard => sliders.harder = step,
                Axis::Slippery => sliders.slipperier = step,
            }
            let after = place(&editor.edited(&textures[n], &sliders, &request).unwrap());
            Some(std::array::from_fn(|k| after[k] - before[k]))
        })
        .collect();
    let mut table = "| slider | edits | moved, mean | more than 3 off | worst miss | worst of another slider |\n\
                     |---|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for axis in AXES {
        let own: Vec<([f64; 4], f64)> = cases
            .iter()
            .zip(&moved)
            .filter(|((_, other, _), _)| *other == axis)
            .filter_map(|((_, _, step), moved)| Some(((*moved)?, *step)))
            .collect();
        let along = |(moved, step): &([f64; 4], f64)| moved[axis as usize] * step.signum();
        let mean = own.iter().map(along).sum::<f64>() / own.len().max(1) as f64;
        let off = own.iter().map(|case| (along(case) - 10.0).abs());
        let miss = off.clone().fold(0.0, f64::max);
        let missed = off.filter(|&off| off > TOLERANCE).count();
        let others = own.iter().flat_map(|(moved, _)| {
            let others = AXES.into_iter().filter(|other| *other != axis);
            others.map(|other| moved[other as usize].abs())
        });
        let other = others.fold(0.0, f64::max);
        let name = axis.name();
        table += &format!(
            "| {name} | {} | {mean:.2} | {missed} | {miss:.2} | {other:.2} |\n",
            own.len()
        );
        assert!(!own.is_empty());
        // What only the latent can move stays short where no material is like that.
        let most = ((1.0 - LEAST_HIT) * own.len() as f64).ceil();
        assert!(
            missed as f64 <= most,
            "{}: {missed} of {}",
            axis.name(),
            own.len()
        );
        assert!(
            other <= 3.0,
            "{}: another attribute moved by {other:.2}",
            axis.name()
        );
    }
    print!("{table}");
    if textures.len() == PUBLISHED {
        let command =
            format!("-p asperity --test it a_step_of_ten, with ASPERITY_EDITS={PUBLISHED}");
        figures::hold("edits", &command, [("table", table)]);
    }
}

/// Auto-gain: as the asset holds it, the vibration stays within the device's continuous force
/// everywhere on the grid, also of latents far from every material; and attributes do not know it.
#[test]
fn no_texture_vibrates_beyond_the_continuous_force() {
    // As loud as 1 N, more than the device holds.
    let request = Request {
        fidelity: Fidelity::Auto,
        loudness_db: Some(0.0),
        ..Request::default()
    };
    let far = |latents: &Latents, factor: f32| Latents::whole(latents.slide.map(|x| factor * x));
    let textures: Vec<Latents> = textures()
        .iter()
        .flat_map(|latents| [1.0, 3.0, 6.0].map(|factor| far(latents, factor)))
        .collect();
    let lowered: Vec<bool> = textures
        .par_iter()
        .map(|latents| {
            let made = compiled(*latents, &request);
            let asset = Asset::parse(&made.lowered.bytes).unwrap();
            let continuous_n = CONTINUOUS_SHARE * f64::from(asset.coupling().f_max_n);
            let rms_n = oracle::loudest_n(&asset);
            assert!(rms_n <= continuous_n, "{rms_n} N");
            made.texture.gains.vib_s2_m < made.whole.gains.vib_s2_m
        })
        .collect();
    let count = lowered.iter().filter(|lowered| **lowered).count();
    println!("auto-gain lowered {count} of {}", lowered.len());
    assert!(count > 0, "no texture was loud enough to try it");
}
