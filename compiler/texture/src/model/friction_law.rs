//! Friction law: factors of μ over speed, as an asset carries them.

use asperity_formats::limits::{MAX_LAW_POINTS, MAX_MU, MIN_LAW_POINTS};
use serde::{Deserialize, Serialize};

/// Below this factor a distance is no longer relative.
const LEAST_FACTOR: f64 = 0.01;

/// A law of friction over speed: `μ(v) = μ·f(v)` with f on straight lines between the points,
/// constant below the first and above the last one. Speeds ascend.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct FrictionLaw {
    /// 2 to 8 points.
    pub points: Vec<LawPoint>,
}

/// A point of a law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawPoint {
    /// Tangential speed, mm/s.
    pub speed_mm_s: f64,
    /// Factor of μ, ≥ 0.
    pub factor: f64,
}

impl FrictionLaw {
    /// The law through points of ascending speed and factors above 0. Of more than 8, those speeds
    /// stay between which straight lines are nearest to the points, and their factors are the best
    /// in the sense of least squares, both relative. `None` for fewer than 2 points.
    #[must_use]
    pub fn through(points: Vec<LawPoint>) -> Option<Self> {
        if points.len() < MIN_LAW_POINTS {
            return None;
        }
        if points.len() <= MAX_LAW_POINTS {
            return Some(Self { points });
        }
        let knots = knots(&points);
        Some(Self {
            points: fitted(&points, &knots),
        })
    }

    /// The factor at a speed, mm/s.
    #[must_use]
    pub fn factor_at(&self, speed_mm_s: f64) -> f64 {
        let above = self.points.partition_point(|p| p.speed_mm_s <= speed_mm_s);
        let at = |index: usize| self.points.get(index);
        match (above.checked_sub(1).and_then(at), at(above)) {
            (Some(low), Some(high)) => {
                let part = (speed_mm_s - low.speed_mm_s) / (high.speed_mm_s - low.speed_mm_s);
                low.factor + (high.factor - low.factor) * part
            }
            (Some(end), None) | (None, Some(end)) => end.factor,
            (None, None) => 1.0,
        }
    }

    /// The factor of a law at a speed, mm/s; 1 without a law.
    #[must_use]
    pub fn factor_of(law: Option<&Self>, speed_mm_s: f64) -> f64 {
        law.map_or(1.0, |law| law.factor_at(speed_mm_s))
    }

    /// The law with factors that an asset holds beside this μ: what is beyond its largest μ is cut.
    #[must_use]
    pub fn beside(mut self, mu: f64) -> Self {
        // A code of room for rounding.
        let highest = f64::from(MAX_MU) / mu - 1.0 / 8192.0;
        for point in &mut self.points {
            point.factor = point.factor.min(highest.max(0.0));
        }
        self
    }

    /// The law a fraction `t` of the way from one to another; no law has the factor 1 everywhere.
    #[must_use]
    pub fn between(a: Option<&Self>, b: Option<&Self>, t: f64) -> Option<Self> {
        let mut speeds: Vec<f64> = [a, b]
            .into_iter()
            .flatten()
            .flat_map(|law| law.points.iter().map(|p| p.speed_mm_s))
            .collect();
        speeds.sort_by(f64::total_cmp);
        speeds.dedup();
        let mixed = |speed_mm_s: f64| LawPoint {
            speed_mm_s,
            factor: (1.0 - t) * Self::factor_of(a, speed_mm_s) + t * Self::factor_of(b, speed_mm_s),
        };
        let law = Self::through(speeds.into_iter().map(mixed).collect())?;
        // At an end that has no law there is none.
        law.points.iter().any(|p| p.factor != 1.0).then_some(law)
    }
}

/// The largest relative distance of points from the straight line between the first and the last.
fn bend(points: &[LawPoint]) -> f64 {
    let (Some(low), Some(high)) = (points.first(), points.last()) else {
        return 0.0;
    };
    let slope = (high.factor - low.factor) / (high.speed_mm_s - low.speed_mm_s);
    let miss = |p: &LawPoint| {
        let straight = low.factor + slope * (p.speed_mm_s - low.speed_mm_s);
        (straight - p.factor).abs() / p.factor.max(LEAST_FACTOR)
    };
    let inner = points.get(1..points.len() - 1).unwrap_or_default();
    inner.iter().map(miss).fold(0.0, f64::max)
}

/// Indices of the 8 points between which the worst straight line is best, the ends among them: by
/// dynamic programming over the number of lines and the point that they reach.
fn knots(points: &[LawPoint]) -> Vec<usize> {
    let lines = MAX_LAW_POINTS - 1;
    // The worst line so far, and where the last one begins.
    let mut reached = vec![(f64::INFINITY, 0); points.len()];
    reached[0].0 = 0.0;
    let mut begun = Vec::with_capacity(lines);
    for _ in 0..lines {
        let further = |end: usize| {
            let from = |start: usize| (reached[start].0.max(bend(&points[start..=end])), start);
            let best = (0..end).map(from).min_by(|a, b| a.0.total_cmp(&b.0));
            best.unwrap_or((f64::INFINITY, 0))
        };
        let next: Vec<(f64, usize)> = (0..points.len()).map(further).collect();
        begun.push(next.iter().map(|at| at.1).collect::<Vec<_>>());
        reached = next;
    }
    let mut knots = vec![points.len() - 1];
    for starts in begun.iter().rev() {
        let end = knots[knots.len() - 1];
        knots.push(starts[end]);
    }
    knots.reverse();
    knots
}

/// Factors at the knots that are nearest to all points: the normal equations of hat functions, which
/// have three diagonals.
fn fitted(points: &[LawPoint], knots: &[usize]) -> Vec<LawPoint> {
    let count = knots.len();
    let (mut diagonal, mut beside) = (vec![0.0; count], vec![0.0; count]);
    let mut right = vec![0.0; count];
    for (index, point) in points.iter().enumerate() {
        let at = knots.partition_point(|&k| k <= index).clamp(1, count - 1) - 1;
        let (low, high) = (
            points[knots[at]].speed_mm_s,
            points[knots[at + 1]].speed_mm_s,
        );
        let above = (point.speed_mm_s - low) / (high - low);
        let weight = 1.0 / point.factor.max(LEAST_FACTOR).powi(2);
        for (knot, hat) in [(at, 1.0 - above), (at + 1, above)] {
            diagonal[knot] += weight * hat * hat;
            right[knot] += weight * hat * point.factor;
        }
        beside[at] += weight * above * (1.0 - above);
    }
    for knot in 1..count {
        let ratio = beside[knot - 1] / diagonal[knot - 1];
        diagonal[knot] -= ratio * beside[knot - 1];
        right[knot] -= ratio * right[knot - 1];
    }
    let mut factor = 0.0;
    let mut fitted: Vec<LawPoint> = Vec::with_capacity(count);
    for knot in (0..count).rev() {
        factor = (right[knot] - beside[knot] * factor) / diagonal[knot];
        fitted.push(LawPoint {
            speed_mm_s: points[knots[knot]].speed_mm_s,
            factor: factor.max(0.0),
        });
    }
    fitted.reverse();
    fitted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64) -> f64) -> FrictionLaw {
        let point = |n: i32| {
            let speed_mm_s = 20.0 * libm::pow(15.0, f64::from(n) / 256.0);
            LawPoint {
                speed_mm_s,
                factor: f(speed_mm_s),
            }
        };
        FrictionLaw::through((0..=256).map(point).collect()).unwrap()
    }

    #[test]
    fn eight_points_hold_the_laws_that_recordings_follow_within_one_per_cent() {
        let stribeck = |v: f64| 0.7 + 1.3 * libm::exp(-v / 40.0);
        let falling = |v: f64| libm::pow(v / 100.0, -0.3);
        let rising = |v: f64| libm::pow(v / 100.0, 0.25);
        let laws: [&dyn Fn(f64) -> f64; 3] = [&stribeck, &falling, &rising];
        for f in laws {
            let law = sampled(f);
            assert_eq!(law.points.len(), 8);
            for n in 0..=1000 {
                let v = 20.0 + 280.0 * f64::from(n) / 1000.0;
                let off = law.factor_at(v) / f(v) - 1.0;
                assert!(off.abs() < 0.01, "{v} mm/s: {off}");
            }
            assert_eq!(law.factor_at(0.0), law.points[0].factor, "constant below");
            assert_eq!(law.factor_at(1e4), law.points[7].factor, "constant above");
        }
    }

    #[test]
    fn a_mixture_has_both_laws_at_its_ends_and_their_mean_between() {
        let (a, b) = (sampled(|v| 100.0 / (v + 50.0)), sampled(|v| v / 100.0));
        for v in [10.0, 25.0, 60.0, 130.0, 290.0, 400.0] {
            for (t, within) in [(0.0, 1e-9), (0.5, 0.02), (1.0, 1e-9)] {
                let mixed = FrictionLaw::between(Some(&a), Some(&b), t).unwrap();
                let exact = (1.0 - t) * a.factor_at(v) + t * b.factor_at(v);
                assert!(
                    (mixed.factor_at(v) / exact - 1.0).abs() <= within,
                    "{v} {t}"
                );
            }
        }
        let half = FrictionLaw::between(Some(&a), None, 0.5).unwrap();
        assert!((half.factor_at(100.0) - 0.5 * (1.0 + a.factor_at(100.0))).abs() < 1e-9);
        assert_eq!(FrictionLaw::between(None, None, 0.5), None);
        assert_eq!(FrictionLaw::between(Some(&a), None, 1.0), None);
    }
}
