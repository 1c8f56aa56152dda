//! Predictions of one method in one region, over all materials.

use super::method::{Exponents, Method, Prediction, Region};
use crate::pareto::difference::Difference;
use crate::pareto::statistics::{Spread, percentile};
use asperity_kernels::design::{Level, Shape};

/// A method in one region over all materials.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodSummary {
    /// The prediction method.
    pub method: Method,
    /// Where they lie.
    pub region: Region,
    /// Models that were predicted.
    pub models: usize,
    /// Predictions without a stable filter or without a level.
    pub refused: usize,
    /// Distortion, level included.
    pub distortion_db: Option<Spread>,
    /// Distortion of the shape alone.
    pub shape_db: Option<Spread>,
    /// Absolute level error.
    pub level_db: Option<Spread>,
    /// Median of the signed level error.
    pub bias_db: Option<f64>,
    /// Fraction of the models to which this method comes nearer than the product's method does.
    /// The shape is compared where the method varies it, else the level. Ties count half.
    pub nearer: Option<f64>,
}

/// Predictions by method and region, in the order in which they first appear.
#[must_use]
pub fn summaries(predictions: &[Vec<Prediction>]) -> Vec<MethodSummary> {
    let mut groups: Vec<(Method, Region, Vec<&Prediction>)> = Vec::new();
    for prediction in predictions.iter().flatten() {
        let known = groups
            .iter_mut()
            .find(|(m, r, _)| (*m, *r) == (prediction.method, prediction.region));
        match known {
            Some((_, _, group)) => group.push(prediction),
            None => groups.push((prediction.method, prediction.region, vec![prediction])),
        }
    }
    groups
        .into_iter()
        .map(|(method, region, group)| {
            let list = |value: fn(&Difference) -> f64| -> Vec<f64> {
                let found = group.iter().filter_map(|p| p.difference.as_ref());
                found.map(value).collect()
            };
            let signed = list(|d| d.level_db);
            MethodSummary {
                method,
                region,
                models: group.len(),
                refused: group.len() - signed.len(),
                distortion_db: Spread::of(&list(|d| d.distortion_db)),
                shape_db: Spread::of(&list(|d| d.shape_db)),
                level_db: Spread::of(&list(|d| d.level_db.abs())),
                bias_db: percentile(&signed, 0.5),
                nearer: nearer(predictions, method, region),
            }
        })
        .collect()
}

/// The product's method, which another one is compared with.
fn chosen(method: Method, region: Region) -> Method {
    match (method, region) {
        (Method::Powers(_), _) | (_, Region::Beyond) => Method::Powers(Exponents::Fitted),
        (Method::Shape(_), _) => Method::Shape(Shape::LsfCosine),
        (Method::Level(_) | Method::Nearest, _) => Method::Level(Level::Rms),
    }
}

fn nearer(predictions: &[Vec<Prediction>], method: Method, region: Region) -> Option<f64> {
    let error = |prediction: &Prediction| {
        prediction.difference.map(|d| match method {
            Method::Shape(_) => d.shape_db,
            _ => d.level_db.abs(),
        })
    };
    let other = chosen(method, region);
    let (mut won, mut count) = (0.0, 0.0);
    for material in predictions {
        let of = |method| {
            material
                .iter()
                .filter(move |p| (p.method, p.region) == (method, region))
        };
        for (mine, theirs) in of(method).zip(of(other)) {
            debug_assert_eq!(mine.model, theirs.model);
            if let (Some(mine), Some(theirs)) = (error(mine), error(theirs)) {
                won += match mine.total_cmp(&theirs) {
                    std::cmp::Ordering::Less => 1.0,
                    std::cmp::Ordering::Equal => 0.5,
                    std::cmp::Ordering::Greater => 0.0,
                };
                count += 1.0;
            }
        }
    }
    (count > 0.0).then(|| won / count)
}
