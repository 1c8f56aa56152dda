//! Errors of predictions, with intervals.

use super::{
    material::Material,
    prediction::Method,
    signature::{Difference, Signature},
};
use asperity::signal::quantile::{median, quantile};
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::Serialize;
use std::collections::BTreeMap;

/// Samples of the bootstrap.
const SAMPLES: usize = 1000;
/// Seed of the bootstrap.
const SEED: u64 = 1;
/// Ends of an interval.
const INTERVAL: [f64; 2] = [0.025, 0.975];

/// A figure over materials with its 95 % interval, by the bootstrap over names: specimens of one name are drawn together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Figure {
    /// Over all materials.
    pub value: f64,
    /// Lower and upper end.
    pub interval: [f64; 2],
}

/// A method over all materials that it predicts; medians.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Score {
    /// [`Method::name`].
    pub method: &'static str,
    /// Materials that it predicts.
    pub materials: usize,
    /// [`Difference::whole_db`].
    pub whole_db: Figure,
    /// [`Difference::level_db`].
    pub level_db: Figure,
    /// [`Difference::shape_db`].
    pub shape_db: Figure,
    /// Place of the material itself, 1 the nearest, among all measured ones by their distance from the prediction.
    pub rank: Figure,
}

/// A material's own errors by its prompt.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Own {
    /// The material.
    pub name: String,
    /// [`Difference::whole_db`].
    pub whole_db: f64,
    /// [`Difference::shape_db`].
    pub shape_db: f64,
    /// As [`Score::rank`].
    pub rank: usize,
}

/// A prediction held against all measured materials.
struct Judged {
    name: usize,
    difference: Difference,
    rank: usize,
}

/// The score of a method; `None` where it predicts no material.
#[must_use]
pub fn score(method: Method, materials: &[Material]) -> Option<Score> {
    let judged = judge(materials, &method.predict(materials));
    let of = |pick: fn(&Judged) -> f64| {
        figure(
            &judged,
            |j| j.name,
            |some| median(some.iter().map(|j| pick(j))),
        )
    };
    (!judged.is_empty()).then(|| Score {
        method: method.name(),
        materials: judged.len(),
        whole_db: of(|j| j.difference.whole_db),
        level_db: of(|j| j.difference.level_db),
        shape_db: of(|j| j.difference.shape_db),
        rank: of(|j| j.rank as f64),
    })
}

/// The errors of each material by its prompt.
#[must_use]
pub fn own(materials: &[Material]) -> Vec<Own> {
    let judged = judge(materials, &Method::Prompt.predict(materials));
    materials
        .iter()
        .zip(judged)
        .map(|(material, judged)| Own {
            name: material.name.clone(),
            whole_db: judged.difference.whole_db,
            shape_db: judged.difference.shape_db,
            rank: judged.rank,
        })
        .collect()
}

fn judge(materials: &[Material], predictions: &[Option<Signature>]) -> Vec<Judged> {
    let names = names(materials);
    let distances = |from: &Signature| -> Vec<Difference> {
        let to = materials
            .iter()
            .map(|m| from.difference(&m.measured.signature));
        to.collect()
    };
    (predictions.iter().enumerate())
        .filter_map(|(at, prediction)| {
            let distances = distances(prediction.as_ref()?);
            let own = distances[at];
            let nearer = distances.iter().filter(|d| d.whole_db < own.whole_db);
            Some(Judged {
                name: names[at],
                difference: own,
                rank: 1 + nearer.count(),
            })
        })
        .collect()
}

/// The number of each material's name.
pub(super) fn names(materials: &[Material]) -> Vec<usize> {
    let mut numbers = BTreeMap::new();
    let number = |material: &Material| {
        let next = numbers.len();
        *numbers.entry(material.prompt.clone()).or_insert(next)
    };
    materials.iter().map(number).collect()
}

/// A statistic over some items with its interval; `name` says which of them are drawn together.
pub(super) fn figure<T>(
    items: &[T],
    name: impl Fn(&T) -> usize,
    statistic: impl Fn(&[&T]) -> f64,
) -> Figure {
    let mut groups: BTreeMap<usize, Vec<&T>> = BTreeMap::new();
    for item in items {
        groups.entry(name(item)).or_default().push(item);
    }
    let groups: Vec<_> = groups.into_values().collect();
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(SEED);
    let mut draw = || {
        // The high half of a product is uniform below the count.
        let index = ((u128::from(rng.next_u64()) * groups.len() as u128) >> 64) as usize;
        groups[index].iter().copied()
    };
    let samples: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            let sample: Vec<&T> = (0..groups.len()).flat_map(|_| draw()).collect();
            statistic(&sample)
        })
        .collect();
    Figure {
        value: statistic(&items.iter().collect::<Vec<_>>()),
        interval: INTERVAL.map(|share| quantile(samples.iter().copied(), share)),
    }
}
