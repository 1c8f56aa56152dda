//! Error of a design against the f64 oracle: at rest over the whole grid, in motion, and while the query alternates
//! between two vertices.

use super::difference::{Band, distortion_db};
use super::kernel::Kernel;
use super::noise::{gaussian, uniform};
use super::statistics::model_rms;
use crate::signal::rms;
use asperity::{
    model::{
        ModelGrid,
        mixture::{BarycentricPoint, Field, places},
    },
    signal::{reflection, spectrum::ArmaModel},
};
use asperity_kernels::design::Design;
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

/// A place or a block counts as silent below this fraction of the loudest one: −40 dB.
const SILENT: f64 = 0.01;
/// Length of a block in the moving comparison, s. The hand does not resolve shorter times.
const BLOCK_S: f64 = 0.05;
/// Pairs of vertices drawn for the alternations, per material.
const PAIRS: usize = 8;
/// Samples of an alternation.
const ALTERNATIONS: usize = 1000;

/// Errors of one design on one material.
///
/// Lists have one entry for each place, block or pair. Values that are not finite are stored as
/// infinity.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Errors {
    /// RMS log-spectral distortion at rest, level included, dB.
    pub distortion_db: Vec<f64>,
    /// Absolute error of a block's level while the hand moves, dB.
    pub moving_level_db: Vec<f64>,
    /// RMS while every sample is queried at one of two vertices at random, relative to the
    /// louder of the two at rest, dB.
    pub alternation_db: Vec<f64>,
    /// Number of places whose filter is unstable or missing.
    pub unstable: usize,
    /// Number of places, silent ones included.
    pub places: usize,
}

/// A material, and what the oracle renders of it.
pub struct Truth {
    band: Band,
    still: Vec<Still>,
    /// Where the hand moves, and what the oracle renders there.
    motion: Vec<BarycentricPoint>,
    epsilon: Vec<f64>,
    moving: Vec<f64>,
    block: usize,
    pairs: Vec<Pair>,
}

struct Still {
    place: BarycentricPoint,
    /// `None` where the place is silent.
    powers: Option<Vec<f64>>,
}

struct Pair {
    /// Vertex for each sample, drawn at random from the two so that no update interval samples only one of them.
    places: Vec<BarycentricPoint>,
    louder_rms: f64,
}

impl Truth {
    /// Prepares a grid with `seconds` of motion. Everything random follows from `seed`.
    ///
    /// `None` for a grid that has no oracle because it has no area or an unstable model.
    #[must_use]
    pub fn new(grid: &ModelGrid, seconds: f64, seed: u64) -> Option<Self> {
        let field = Field::new(grid);
        let band = Band::new(grid.sample_rate_hz);
        let loudest = grid
            .vertices
            .iter()
            .map(|v| v.gain * v.sigma_m_s2)
            .fold(0.0, f64::max);
        let still = places(grid)
            .into_iter()
            .map(|(speed_mm_s, force_n)| {
                let place = field.locate(speed_mm_s, force_n)?;
                let model = field.model(&place);
                let sounds = model.level_m_s2 > SILENT * loudest;
                Some(Still {
                    place,
                    powers: sounds.then(|| band.powers(&model)),
                })
            })
            .collect::<Option<_>>()?;
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let ticks = (seconds * grid.sample_rate_hz) as usize;
        let motion = motion(grid, &field, ticks, &mut random)?;
        let epsilon = gaussian(&mut random, ticks.max(ALTERNATIONS));
        let mut oracle = Kernel::new(&Design::ORACLE, grid)?;
        oracle.settle(motion.first()?);
        let moving = oracle.render(&motion, &epsilon);
        Some(Self {
            band,
            still,
            moving,
            motion,
            epsilon,
            block: (BLOCK_S * grid.sample_rate_hz) as usize,
            pairs: pairs(grid, loudest, &mut random),
        })
    }

    /// Errors of a design on a grid with the same vertices and triangles as the truth's.
    #[must_use]
    pub fn errors(&self, design: &Design, grid: &ModelGrid) -> Errors {
        let mut errors = Errors {
            places: self.still.len(),
            ..Errors::default()
        };
        let Some(mut kernel) = Kernel::new(design, grid) else {
            errors.unstable = errors.places;
            return errors;
        };
        self.at_rest(&mut kernel, &mut errors);
        self.moving(&mut kernel, &mut errors);
        self.alternating(&mut kernel, &mut errors);
        errors
    }

    fn at_rest(&self, kernel: &mut Kernel, errors: &mut Errors) {
        for still in &self.still {
            kernel.settle(&still.place);
            let model = kernel.model();
            if !reflection::is_stable(&model.a) {
                errors.unstable += 1;
                continue;
            }
            if let Some(truth) = &still.powers {
                let found = self.band.powers(&model);
                errors.distortion_db.push(distortion_db(truth, &found));
            }
        }
    }

    fn moving(&self, kernel: &mut Kernel, errors: &mut Errors) {
        let Some(first) = self.motion.first() else {
            return;
        };
        kernel.settle(first);
        let rendered = kernel.render(&self.motion, &self.epsilon);
        let levels = |signal: &[f64]| signal.chunks(self.block).map(rms).collect::<Vec<_>>();
        let truth = levels(&self.moving);
        let loudest = truth.iter().copied().fold(0.0, f64::max);
        errors.moving_level_db = truth
            .iter()
            .zip(levels(&rendered))
            .filter(|(truth, _)| **truth > SILENT * loudest)
            .map(|(truth, found)| decibels(found / truth).abs())
            .collect();
    }

    fn alternating(&self, kernel: &mut Kernel, errors: &mut Errors) {
        for pair in &self.pairs {
            let places = &pair.places;
            kernel.settle(&places[0]);
            let rendered = kernel.render(places, &self.epsilon);
            errors
                .alternation_db
                .push(decibels(rms(&rendered) / pair.louder_rms));
        }
    }
}

/// The query at a vertex.
fn at(vertex: usize) -> BarycentricPoint {
    BarycentricPoint {
        vertices: [vertex; 3],
        weights: [1.0, 0.0, 0.0],
    }
}

/// Scrubbing as fast as people do: strokes at 1.5 Hz, up to nine tenths of the grid's speed,
/// while the force varies at 0.7 Hz.
fn motion(
    grid: &ModelGrid,
    field: &Field<'_>,
    ticks: usize,
    random: &mut Xoshiro256PlusPlus,
) -> Option<Vec<BarycentricPoint>> {
    let (max_speed, max_force) = asperity::model::mesh::corner(grid);
    let (stroke, press) = (uniform(random), uniform(random));
    (0..ticks)
        .map(|tick| {
            let t = tick as f64 / grid.sample_rate_hz;
            let speed = 0.9 * max_speed * libm::sin(TAU * (1.5 * t + stroke)).abs();
            let force = max_force * (0.5 + 0.4 * libm::sin(TAU * (0.7 * t + press)));
            field.locate(speed, force)
        })
        .collect()
}

/// Random pairs of vertices that vibrate and whose models differ.
fn pairs(grid: &ModelGrid, loudest: f64, random: &mut Xoshiro256PlusPlus) -> Vec<Pair> {
    let sounding: Vec<usize> = (0..grid.vertices.len())
        .filter(|&v| grid.vertices[v].gain * grid.vertices[v].sigma_m_s2 > SILENT * loudest)
        .collect();
    if sounding.is_empty() {
        return Vec::new();
    }
    let level = |v: usize| model_rms(&ArmaModel::at_vertex(grid, &grid.vertices[v]));
    let mut pairs = Vec::new();
    for _ in 0..PAIRS {
        let mut draw = || sounding[(random.next_u64() % sounding.len() as u64) as usize];
        let [a, b] = [draw(), draw()];
        if grid.vertices[a].lsf_rad != grid.vertices[b].lsf_rad {
            pairs.push(Pair {
                places: (0..ALTERNATIONS)
                    .map(|_| at(if uniform(random) < 0.5 { a } else { b }))
                    .collect(),
                louder_rms: level(a).max(level(b)),
            });
        }
    }
    pairs
}

/// Decibels of a ratio of amplitudes; infinite for a ratio that is not finite.
fn decibels(ratio: f64) -> f64 {
    if ratio.is_finite() {
        20.0 * libm::log10(ratio)
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pareto::statistics::Spread;
    use asperity::sources::builtin;
    use asperity_kernels::design::Shape;

    fn spread(values: &[f64]) -> Spread {
        Spread::of(values).expect("not empty")
    }

    #[test]
    fn the_oracle_has_no_error() {
        let grid = builtin::texture().grid;
        let truth = Truth::new(&grid, 0.5, 1).unwrap();
        let errors = truth.errors(&Design::ORACLE, &grid);
        assert_eq!(errors.unstable, 0);
        assert!(spread(&errors.distortion_db).max < 1e-9);
        assert_eq!(spread(&errors.moving_level_db).max, 0.0);
    }

    #[test]
    fn a_level_that_is_twice_too_high_is_six_decibels_everywhere() {
        let grid = builtin::texture().grid;
        let truth = Truth::new(&grid, 0.5, 1).unwrap();
        let mut louder = grid.clone();
        for vertex in &mut louder.vertices {
            vertex.sigma_m_s2 *= 2.0;
        }
        let errors = truth.errors(&Design::ORACLE, &louder);
        let twice = 20.0 * 2.0_f64.log10();
        for list in [&errors.distortion_db, &errors.moving_level_db] {
            assert!(list.iter().all(|db| (db - twice).abs() < 1e-9));
        }
    }

    #[test]
    fn an_unstable_mixture_is_counted_and_a_divergence_is_seen() {
        // Mixing the coefficients of two distant resonances moves poles out of the unit circle.
        let mut grid = builtin::texture().grid;
        let sharp = |centre: f64| {
            (0..grid.order)
                .map(|i| centre + 0.12 * (i as f64 - grid.order as f64 / 2.0))
                .collect::<Vec<f64>>()
        };
        let (low, high) = (sharp(1.3), sharp(1.8));
        for (index, vertex) in grid.vertices.iter_mut().enumerate() {
            vertex.lsf_rad = if index % 2 == 0 { &low } else { &high }.clone();
        }
        let truth = Truth::new(&grid, 0.1, 1).unwrap();
        let mixed = Design {
            shape: Shape::Coefficients,
            ..Design::ORACLE
        };
        let errors = truth.errors(&mixed, &grid);
        assert!(errors.unstable > 0 && errors.unstable < errors.places);
        // Alternating between such resonances grows; between ordinary models it does not.
        let sharp = spread(&truth.errors(&Design::DEFAULT, &grid).alternation_db).max;
        assert!(sharp > 100.0, "{sharp} dB");
        let ordinary = builtin::texture().grid;
        let truth = Truth::new(&ordinary, 0.1, 1).unwrap();
        let errors = truth.errors(&Design::DEFAULT, &ordinary);
        let bounded = spread(&errors.alternation_db).max;
        assert!(bounded < 12.0, "{bounded} dB");
    }
}
