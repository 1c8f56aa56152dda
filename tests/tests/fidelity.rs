//! HaTT materials reduced by `--fidelity auto` render like the whole material. The oracle compares mixtures over the
//! grid, independently of the reducer's own measure.

use crate::support;
use asperity::passes::reduce::Fidelity;
use asperity_formats::Asset;
use asperity_tests::{
    hatt,
    oracle::{Model, Texture, polynomial},
};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Log spectrum at 10, 12, … 450 Hz, dB.
fn log_spectrum(texture: &Texture, model: &Model) -> Vec<f64> {
    let (a, b) = (polynomial(&model.cosines), texture.numerator(model));
    let size = |c: &[f64], omega: f64| {
        let (mut re, mut im) = (1.0, 0.0);
        for (k, c) in (1..).zip(c) {
            re += c * (omega * f64::from(k)).cos();
            im -= c * (omega * f64::from(k)).sin();
        }
        re * re + im * im
    };
    (5..=225)
        .map(|n| {
            let omega = TAU * 2.0 * f64::from(n) / texture.sample_rate_hz;
            let power = model.level_m_s2.powi(2) * size(&b, omega) / size(&a, omega);
            10.0 * power.log10()
        })
        .collect()
}

/// Vertices, midpoints of edges, and centroids.
fn places(texture: &Texture) -> Vec<(f64, f64)> {
    let at = |v: usize| (texture.vertices[v].speed_mm_s, texture.vertices[v].force_n);
    let mean = |points: &[(f64, f64)]| {
        let count = points.len() as f64;
        let sum = points
            .iter()
            .fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
        (sum.0 / count, sum.1 / count)
    };
    let mut all: Vec<_> = (0..texture.vertices.len()).map(at).collect();
    let mut edges = std::collections::BTreeSet::new();
    for &[a, b, c] in &texture.triangles {
        edges.extend([(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b))));
        all.push(mean(&[at(a), at(b), at(c)]));
    }
    all.extend(edges.into_iter().map(|(a, b)| mean(&[at(a), at(b)])));
    all
}

/// Returns true if the cosines are ordered, the condition for a stable filter.
fn is_stable(model: &Model) -> bool {
    model.cosines.iter().all(|x| x.abs() < 1.0) && model.cosines.windows(2).all(|p| p[0] > p[1])
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn what_auto_keeps_is_within_its_budget_for_every_material() {
    let files = hatt::materials();
    let smaller: Vec<bool> = files
        .par_iter()
        .map(|file| {
            let read = |fidelity| {
                let material = support::material(file, fidelity);
                let asset = Asset::parse(&material.lowered.bytes).unwrap();
                (Texture::new(&asset), material)
            };
            let ((full, whole), (kept, material)) = (read(Fidelity::Full), read(Fidelity::Auto));
            let loudest = full
                .vertices
                .iter()
                .map(|v| v.level_m_s2)
                .fold(0.0, f64::max);
            let mut distances = Vec::new();
            for (speed, force) in places(&full) {
                let (exact, found) = (full.model(speed, force), kept.model(speed, force));
                assert!(
                    is_stable(&found),
                    "{}: {speed}, {force}",
                    material.texture.name
                );
                // A place 40 dB below the loudest vertex counts as silence, and as free of error.
                if exact.level_m_s2 > 0.01 * loudest {
                    let (x, y) = (log_spectrum(&full, &exact), log_spectrum(&kept, &found));
                    let squares: f64 = x.iter().zip(&y).map(|(x, y)| (x - y).powi(2)).sum();
                    distances.push((squares / x.len() as f64).sqrt());
                } else {
                    distances.push(0.0);
                }
            }
            distances.sort_by(f64::total_cmp);
            let rank = (0.95 * distances.len() as f64).ceil() as usize;
            let (p95, worst) = (distances[rank - 1], distances[distances.len() - 1]);
            // The frequencies differ from those of the reducer.
            assert!(p95 <= 0.51, "{}: {p95} dB at 95 %", material.texture.name);
            assert!(
                worst <= 1.01,
                "{}: {worst} dB at worst",
                material.texture.name
            );
            assert!(material.lowered.haptic_bytes < whole.lowered.haptic_bytes);
            kept.vertices[0].cosines.len() + kept.vertices[0].ma_cosines.len() <= 10
        })
        .collect();
    let (count, all) = (smaller.iter().filter(|s| **s).count(), smaller.len());
    println!("{count} of {all} materials at 10 poles or fewer");
    assert!(10 * count >= 7 * all, "{count} of {all}");
}
