//! Figures of a user's own copy, from the folder in `ASPERITY_HATT` or from `../shared/hatt/models`
//! beside the workspace; without one, of materials made up. Only aggregates are printed.

use super::made_up::{Folder, MADE_UP, options};
use crate::{
    BINS,
    hatt::{ar, bins::Bins, load, pool::Pool, source},
};
use asperity::{
    model::{ModelGrid, mixture::Field},
    signal::{
        level::nyquist_rms,
        lsf,
        quantile::quantile,
        spectrum::{ArmaModel, log_spectral_distance_db},
    },
    sources::hatt,
};
use std::{
    path::{Path, PathBuf},
    time::Instant,
};

/// A copy of the HaTT, or a folder of materials made up.
enum Materials {
    Real(PathBuf),
    MadeUp(Folder),
}

impl Materials {
    fn found() -> Self {
        let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/hatt/models");
        let folder = std::env::var_os("ASPERITY_HATT").map_or(beside, PathBuf::from);
        if hatt::files(&folder).is_ok() {
            return Self::Real(folder);
        }
        println!("no HaTT materials in {}: made up", folder.display());
        Self::MadeUp(Folder::of(&MADE_UP))
    }

    fn folder(&self) -> &Path {
        match self {
            Self::Real(path) => path,
            Self::MadeUp(folder) => &folder.0,
        }
    }
}

fn deviation(values: impl Iterator<Item = f32> + Clone) -> f64 {
    let values = values.map(f64::from);
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    (values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / count).sqrt()
}

/// Median, 95th percentile and maximum.
fn three(values: &[f64]) -> [f64; 3] {
    [0.5, 0.95, 1.0].map(|share| quantile(values.iter().copied(), share))
}

/// Mean level, dB, and centroid, Hz, over strokes of 50, 100, 150 mm/s and 0.5, 1, 2 N.
fn level_and_centroid(grid: &ModelGrid) -> [f64; 2] {
    let field = Field::new(grid);
    let strokes = [50.0, 100.0, 150.0].map(|speed| [0.5, 1.0, 2.0].map(|force| (speed, force)));
    let mut mean = [0.0; 2];
    for &(speed_mm_s, force_n) in strokes.as_flattened() {
        let model = field.model(&field.locate(speed_mm_s, force_n).unwrap());
        let vibration = model.vibration().unwrap();
        mean[0] += 10.0 * libm::log10(vibration.power) / 9.0;
        mean[1] += vibration.centroid_hz / 9.0;
    }
    mean
}

#[test]
fn conversion_keeps_spectra_and_levels() {
    let materials = Materials::found();
    let folder = materials.folder();
    let (mut with_level, mut level_free) = (Vec::new(), Vec::new());
    let mut gap = f64::INFINITY;
    for file in hatt::files(folder).unwrap() {
        let material = hatt::parse(&file, &std::fs::read(&file).unwrap()).unwrap();
        for model in material.models.iter().filter(|model| ar::sounds(model)) {
            let truth = ArmaModel {
                sample_rate_hz: material.sample_rate_hz,
                a: model.ar.monic.clone(),
                b: model.ma.monic.clone(),
                level_m_s2: model.gain * model.variance.sqrt(),
            };
            let found = ar::convert(model).unwrap();
            gap = gap.min(lsf::smallest_gap(&found.lsf_rad));
            let mut converted = ArmaModel {
                sample_rate_hz: material.sample_rate_hz,
                a: lsf::to_polynomial(&found.lsf_rad),
                b: vec![1.0, 1.0],
                level_m_s2: libm::exp10(found.level_db / 20.0) / nyquist_rms(&found.lsf_rad),
            };
            with_level.push(log_spectral_distance_db(&truth, &converted));
            let offset_db: f64 = (0..881)
                .map(|n| 10.0 + 0.5 * f64::from(n))
                .map(|hz| 10.0 * libm::log10(truth.power(hz) / converted.power(hz)))
                .sum::<f64>()
                / 881.0;
            converted.level_m_s2 *= libm::exp10(offset_db / 20.0);
            level_free.push(log_spectral_distance_db(&truth, &converted));
        }
    }
    let (with, free) = (three(&with_level), three(&level_free));
    println!(
        "{} models, median / p95 / max dB: {with:.4?}; level free {free:.4?}; smallest gap {gap:.4}",
        with_level.len()
    );
    assert!(free[0] < 0.02 && free[1] < 0.1 && free[2] < 5.0, "{free:?}");
    assert!(with[0] < 0.05 && with[1] < 0.2 && with[2] < 6.0, "{with:?}");
}

#[test]
fn a_real_folder_becomes_a_corpus() {
    let materials = Materials::found();
    let folder = materials.folder();
    let start = Instant::now();
    let corpus = load(&options(folder)).unwrap();
    println!(
        "{} materials × 20 in {:?}",
        corpus.materials.len(),
        start.elapsed()
    );
    assert_eq!(corpus.grid.bins.len(), BINS);
    for material in &corpus.materials {
        for instance in material.instances.iter().chain([&material.prototype]) {
            for lsf_rad in &instance.lsf_rad {
                let lsf_rad = lsf_rad.map(f64::from);
                assert!(lsf::smallest_gap(&lsf_rad) > 1e-3, "{}", material.name);
            }
        }
    }
    // Prototypes against their sources, by means that share nothing with the conversion.
    let (mut levels, mut centroids) = (Vec::new(), Vec::new());
    let grid = corpus.grid.description();
    for file in hatt::files(folder).unwrap() {
        let source = hatt::parse(&file, &std::fs::read(&file).unwrap()).unwrap();
        let texture = hatt::to_model(&source, "", 0);
        let material = corpus
            .materials
            .iter()
            .find(|m| m.name == source.name)
            .unwrap();
        let ours = level_and_centroid(&material.prototype.grid(&grid));
        let theirs = level_and_centroid(&texture.grid);
        levels.push((ours[0] - theirs[0]).abs());
        centroids.push((ours[1] / theirs[1] - 1.0).abs());
    }
    let spread: Vec<f64> = corpus
        .materials
        .iter()
        .flat_map(|m| (0..BINS).map(|bin| deviation(m.instances.iter().map(|i| i.level_db[bin]))))
        .collect();
    println!(
        "deviation of a bin's level over instances {:.2?} dB",
        three(&spread)
    );
    let (levels, centroids) = (three(&levels), three(&centroids));
    println!("prototypes: mean level {levels:.2?} dB, centroid {centroids:.3?}");
    assert!(
        levels[0] < 1.0 && levels[1] < 4.0 && levels[2] < 7.0,
        "{levels:?}"
    );
    assert!(centroids[0] < 0.05, "{centroids:?}");
}

#[test]
fn every_material_has_more_instances_than_are_drawn() {
    let materials = Materials::found();
    let folder = materials.folder();
    let sources = source::read(folder).unwrap();
    let samples: Vec<_> = sources
        .iter()
        .flat_map(|source| source.own.samples())
        .map(|m| crate::Bin {
            speed_mm_s: m.speed_mm_s,
            force_n: m.force_n,
        })
        .collect();
    let bins = Bins::of(&samples);
    let ways: Vec<f64> = sources
        .iter()
        .map(|source| Pool::of(&source.own, &bins).bits())
        .collect();
    let (mut empty, mut beyond, mut all) = (0, 0, 0);
    for source in &sources {
        let mut sampled = [false; BINS];
        for model in source.own.samples() {
            sampled[bins.nearest(model.speed_mm_s, model.force_n)] = true;
        }
        for (bin, sampled) in bins.grid.bins.iter().zip(sampled) {
            let (speed_mm_s, force_n) = source.own.corner;
            all += 1;
            empty += usize::from(!sampled);
            beyond += usize::from(bin.speed_mm_s > speed_mm_s || bin.force_n > force_n);
        }
    }
    let few = quantile(ways.iter().copied(), 0.0);
    println!(
        "{} samples; of {all} bins {empty} have none of their material, {beyond} lie beyond its \
         grid; ways to draw, bits: least {few:.1}, {:.1?}",
        samples.len(),
        three(&ways)
    );
    // Seen and unseen ones, 20 each.
    assert!(few > libm::log2(40.0), "{few}");
}
