//! Every HaTT material is imported with every vertex and triangle. Every sounding vertex is
//! within 0.5 dB RMS (10–450 Hz, level included) of the coefficients in its file, which this
//! test reads without the importer.

use crate::support;
use asperity::{
    driver::compile_all,
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{Tools, hatt::Hatt},
};
use asperity_formats::Asset;
use asperity_tests::{
    figures,
    hatt::{self, Source},
    oracle::{Texture, polynomial},
};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// RMS difference of two log spectra from 10 to 450 Hz in steps of 1 Hz, dB.
fn rms_db(exact: impl Fn(f64) -> f64, found: impl Fn(f64) -> f64) -> f64 {
    let squares: f64 = (10..=450)
        .map(|hz| {
            let omega = TAU * f64::from(hz) / 1000.0;
            (10.0 * (found(omega) / exact(omega)).log10()).powi(2)
        })
        .sum();
    (squares / 441.0).sqrt()
}

fn power(a: &[f64], b: &[f64], level: f64, omega: f64) -> f64 {
    let size = |c: &[f64]| {
        let (re, im) = (1..).zip(c).fold((1.0, 0.0), |(re, im), (k, c)| {
            let angle = omega * f64::from(k);
            (re + c * angle.cos(), im - c * angle.sin())
        });
        re * re + im * im
    };
    level * level * size(b) / size(a)
}

/// Error of each sounding vertex, dB.
fn errors(source: &Source, asset: &Asset<'_>) -> Vec<f64> {
    let texture = Texture::new(asset);
    assert_eq!(asset.name(), source.name);
    assert_eq!(asset.friction().mu(), source.mu as f32);
    assert_eq!(texture.triangles, source.triangles, "{}", source.name);
    assert_eq!(
        texture.vertices.len(),
        source.models.len(),
        "{}",
        source.name
    );
    texture
        .vertices
        .iter()
        .zip(&source.models)
        .filter_map(|(vertex, model)| {
            assert_eq!(vertex.speed_mm_s, f64::from(model.speed_mm_s as f32));
            assert_eq!(vertex.force_n, f64::from(model.force_n as f32));
            if model.level_m_s2 == 0.0 {
                assert_eq!(vertex.level_m_s2, 0.0, "{}: silence sounds", source.name);
                return None;
            }
            let (a, b) = (polynomial(&vertex.cosines), polynomial(&vertex.ma_cosines));
            Some(rms_db(
                |omega| power(&model.a, &model.b, model.level_m_s2, omega),
                |omega| power(&a, &b, vertex.level_m_s2, omega),
            ))
        })
        .collect()
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn every_material_is_within_six_hundredths_of_a_decibel_of_its_file() {
    let files = hatt::materials();
    let mut all: Vec<f64> = files
        .par_iter()
        .flat_map(|file| {
            let source = hatt::read(file).expect("a file as HaTT writes it");
            let imported = support::material(file, Fidelity::Full);
            let asset = Asset::parse(&imported.lowered.bytes).unwrap();
            let errors = errors(&source, &asset);
            let worst = errors.iter().copied().fold(0.0, f64::max);
            assert!(worst < 0.06, "{}: {worst} dB", source.name);
            // The importer prints the error that is measured here, except for the different
            // frequencies near zeros of the numerator.
            let compared = imported.compared.expect("a source");
            assert!(
                (compared.error.max_db - worst).abs() < 0.05,
                "{}; measured here: {worst}",
                imported.text()
            );
            assert_eq!(compared.count, errors.len());
            errors
        })
        .collect();
    all.sort_by(f64::total_cmp);
    let at = |share: f64| all[((all.len() - 1) as f64 * share) as usize];
    println!(
        "{} materials, {} sounding vertices: median {:.4}, p95 {:.4}, max {:.4} dB",
        files.len(),
        all.len(),
        at(0.5),
        at(0.95),
        at(1.0)
    );
    assert!(all.len() > 10 * files.len());
    if files.len() == hatt::PUBLISHED {
        figures::hold(
            "imports",
            "-p asperity-tests --test it import_hatt",
            [
                ("materials", files.len().to_string()),
                ("vertices", figures::count(all.len() as u64)),
                ("median_db", format!("{:.4}", at(0.5))),
                ("p95_db", format!("{:.4}", at(0.95))),
                ("worst_db", figures::within(at(1.0), 3)),
            ],
        );
    }
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn the_same_file_gives_the_same_bytes_whatever_the_thread_count() {
    let files = hatt::materials();
    let few: Vec<Hatt> = files.into_iter().take(6).map(Hatt::new).collect();
    let with = |threads: usize| -> Vec<Vec<u8>> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| compile_all(&few, &Request::default(), &Tools::default(), || {}))
            .into_iter()
            .map(|imported| imported.unwrap().lowered.bytes)
            .collect()
    };
    assert_eq!(with(1), with(4));
}
