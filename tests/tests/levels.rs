//! In a steady stroke of 60 s the third octaves of the vibration are those of the model, but for chance,
//! at vertices and between them, for the built-in texture and HaTT materials.

use crate::support;
use asperity::passes::reduce::Fidelity;
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use asperity_tests::{
    figures, hatt,
    oracle::{Texture, polynomial},
    size::sized,
    spectrum::{band_levels_db, model_power, periodogram, third_octaves},
    trajectory::steady,
};
use rayon::prelude::*;

const SECONDS: usize = 60;
/// Below this frequency 60 s of a band hold too few independent samples to tell 1 dB from
/// chance.
const LOW_HZ: f64 = 25.0;
/// Largest deviation of a band beyond chance, dB.
const MOST_DB: f64 = 0.15;
/// Standard deviations of a band's level that chance may take. The worst of the 2·10⁴ bands that are compared
/// lies at some four.
const SIGMAS: f64 = 4.5;

/// Largest difference over the bands, dB.
fn difference_db(name: &str, bytes: &[u8], speed_mm_s: f64, force_n: f64, seed: u64) -> f64 {
    let asset = Asset::parse(bytes).unwrap();
    let rate_hz = asset.grid().sample_rate_hz();
    assert_eq!(rate_hz, 1000.0, "the trajectory is at 1 kHz");
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, rate_hz).unwrap();
    let renderer = Renderer::new(&Config::default()).unwrap();
    let mut state = State::new(seed);
    let depth_m = force_n / f64::from(asset.coupling().stiffness_n_m);
    let settle = 500;
    let signal: Vec<f64> = steady(speed_mm_s, depth_m, settle + SECONDS * 1000)
        .map(|p| {
            renderer
                .tick(&slot, &mut state, &Sample::at(p))
                .vib_m_s2
                .into()
        })
        .skip(settle)
        .collect();

    let oracle = Texture::new(&asset);
    let model = oracle.model(speed_mm_s, force_n);
    let exact = model_power(
        &polynomial(&model.cosines),
        &oracle.numerator(&model),
        model.level_m_s2,
    );
    let bands = third_octaves(LOW_HZ, rate_hz.into());
    let rendered = band_levels_db(&periodogram(&signal), rate_hz.into(), &bands);
    let expected = band_levels_db(&exact, rate_hz.into(), &bands);
    rendered
        .iter()
        .zip(&expected)
        .zip(&bands)
        .map(|((a, b), &(centre_hz, low_hz, high_hz))| {
            let most_db = (MOST_DB + SIGMAS * deviation_db(high_hz - low_hz)).min(1.0);
            let db = (a - b).abs();
            assert!(
                db < most_db,
                "{name} at {speed_mm_s} mm/s, {force_n} N: {db:.2} dB in the band around {centre_hz:.0} Hz, \
                 {most_db:.2} at most"
            );
            db
        })
        .fold(0.0, f64::max)
}

/// Standard deviation of the level of noise in a band over [`SECONDS`], dB: its power has twice bandwidth times
/// duration degrees of freedom (Bendat and Piersol, Random Data, section 8.5).
fn deviation_db(bandwidth_hz: f64) -> f64 {
    10.0 / std::f64::consts::LN_10 / (bandwidth_hz * SECONDS as f64).sqrt()
}

/// Sounding vertices, and centroids of triangles that sound.
fn places(bytes: &[u8]) -> [Vec<(f64, f64)>; 2] {
    let oracle = Texture::new(&Asset::parse(bytes).unwrap());
    let sounds = |v: usize| oracle.vertices[v].level_m_s2 > 0.0;
    let at = |v: usize| (oracle.vertices[v].speed_mm_s, oracle.vertices[v].force_n);
    let vertices = (0..oracle.vertices.len())
        .filter(|&v| sounds(v))
        .map(at)
        .collect();
    let centroids = oracle
        .triangles
        .iter()
        .filter(|triangle| triangle.iter().any(|&v| sounds(v)))
        .map(|triangle| {
            let mean =
                |f: fn((f64, f64)) -> f64| triangle.iter().map(|&v| f(at(v))).sum::<f64>() / 3.0;
            (mean(|p| p.0), mean(|p| p.1))
        })
        .collect();
    [vertices, centroids]
}

/// The worst difference over every `stride`th place of each kind.
fn check(name: &str, bytes: &[u8], places_a_kind: usize) -> f64 {
    let [vertices, centroids] = places(bytes);
    let some = |places: Vec<(f64, f64)>| {
        let stride = places.len().div_ceil(places_a_kind).max(1);
        places.into_iter().step_by(stride).collect::<Vec<_>>()
    };
    let chosen = [some(vertices), some(centroids)].concat();
    let worst = chosen
        .par_iter()
        .enumerate()
        .map(|(seed, &(speed, force))| {
            // Noise of each material's own, which does not follow the bytes.
            let seed = u64::from(crc32fast::hash(name.as_bytes())) + seed as u64;
            difference_db(name, bytes, speed, force, seed)
        })
        .reduce(|| 0.0, f64::max);
    println!("{name}: {} places, within {worst:.2} dB", chosen.len());
    worst
}

#[test]
fn the_builtin_texture() {
    let all = sized("places of a kind", 10, usize::MAX);
    check("builtin", &support::builtin(), all);
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn every_hatt_material() {
    let files = hatt::some_materials(sized("every so many materials", 3, 1));
    let each = sized("places of a kind for each material", 1, 6);
    let worst = files
        .par_iter()
        .map(|file| {
            let material = support::material(file, Fidelity::Full);
            check(&material.texture.name, &material.lowered.bytes, each)
        })
        .reduce(|| 0.0, f64::max);
    println!("{} materials: within {worst:.2} dB", files.len());
    if files.len() == hatt::PUBLISHED {
        figures::hold_at_full(
            "levels",
            "-p asperity-tests --test it levels",
            [
                ("worst_db", figures::within(worst, 2)),
                ("materials", files.len().to_string()),
            ],
        );
    }
}
