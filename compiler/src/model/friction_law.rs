//! How friction depends on speed: factors of μ, as an asset carries them.

use asperity_formats::limits::{MAX_LAW_POINTS, MAX_MU, MIN_LAW_POINTS};
use serde::{Deserialize, Serialize};

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
    /// The law through points of ascending speed. Of more than 8, those stay that are missed most.
    /// `None` for fewer than 2.
    #[must_use]
    pub fn through(mut points: Vec<LawPoint>) -> Option<Self> {
        if points.len() < MIN_LAW_POINTS {
            return None;
        }
        while points.len() > MAX_LAW_POINTS {
            let miss = |at: usize| bend(&points[at - 1..=at + 1]);
            let least = (1..points.len() - 1).min_by(|&a, &b| miss(a).total_cmp(&miss(b)))?;
            points.remove(least);
        }
        Some(Self { points })
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
        let factor = |law: Option<&Self>, speed| law.map_or(1.0, |law| law.factor_at(speed));
        let mixed = |speed_mm_s: f64| LawPoint {
            speed_mm_s,
            factor: (1.0 - t) * factor(a, speed_mm_s) + t * factor(b, speed_mm_s),
        };
        let law = Self::through(speeds.into_iter().map(mixed).collect())?;
        // At an end that has no law there is none.
        law.points.iter().any(|p| p.factor != 1.0).then_some(law)
    }
}

/// By how much the straight line between the outer two of three points misses the middle one, times
/// the distance over which it does.
fn bend(three: &[LawPoint]) -> f64 {
    let [low, middle, high] = three else {
        return 0.0;
    };
    let span = high.speed_mm_s - low.speed_mm_s;
    let part = (middle.speed_mm_s - low.speed_mm_s) / span;
    let straight = low.factor + (high.factor - low.factor) * part;
    // Over the logarithm of speed: a hand is slow as often as fast.
    let decades = libm::log(high.speed_mm_s.max(1.0) / low.speed_mm_s.max(1.0));
    (straight / middle.factor.max(1e-9) - 1.0).abs() * decades
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
            assert_eq!(law.factor_at(0.0), f(20.0), "constant below");
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
                // Points that bend nothing are those that go.
                assert!((mixed.factor_at(v) / exact - 1.0).abs() <= within, "{v} {t}");
            }
        }
        let half = FrictionLaw::between(Some(&a), None, 0.5).unwrap();
        assert!((half.factor_at(100.0) - 0.5 * (1.0 + a.factor_at(100.0))).abs() < 1e-9);
        assert_eq!(FrictionLaw::between(None, None, 0.5), None);
        assert_eq!(FrictionLaw::between(Some(&a), None, 1.0), None);
    }
}
