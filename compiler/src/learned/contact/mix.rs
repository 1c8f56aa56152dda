//! Mixtures of contact laws: springs by their compliance, parts by their numbers.

use asperity_formats::limits;
use asperity_texture::model::{Adhesion, ContactLaw, Drag, Imprint, Relaxation, SpringPoint};

/// Part of a mixture that must give way, and part of what gives way that must have a part of a law.
const MOST: f64 = 0.5;
/// Weight from which a law counts alone.
pub(super) const ALONE: f64 = 0.95;
/// Forces at which springs are mixed, N.
const FORCES_N: [f64; 6] = [0.1, 0.3, 0.7, 1.3, 2.2, 4.0];
/// Steepest slope of a spring with relaxation and adhesion, N/m: the Touch bears them together.
const STEEPEST_N_M: f64 = 900.0;
/// Part of these that the spring keeps.
const LEAST_ROOM: f64 = 0.4;
/// Part of a pull that a spring leaves at some depth.
const FELT: f64 = 0.5;
/// Part of a pull that a film bears.
const FILM: f64 = 0.1;
/// Deepest point of a spring, mm.
const DEEPEST_MM: f64 = 60.0;
/// Steps between points, mm and N, below which they are one.
const LEAST_STEP: f64 = 0.002;
/// Distance from a straight line, as a part of the depth, below which a point says nothing.
const STRAIGHT: f64 = 0.01;

/// A part of a mixture.
#[derive(Debug, Clone, Copy)]
pub struct Share<'a> {
    /// Its weight; those of all parts sum to one.
    pub weight: f64,
    /// Its contact law.
    pub law: Option<&'a ContactLaw>,
    /// Stiffness of its wall, N/m, for a law without a spring.
    pub stiffness_n_m: f64,
}

/// The mixture of laws; `None` where those without one weigh more.
#[must_use]
pub fn mixed(shares: &[Share<'_>]) -> Option<ContactLaw> {
    let lawful = shares
        .iter()
        .filter_map(|share| Some((share.weight, share.law?, share.stiffness_n_m)));
    let mut laws: Vec<(f64, &ContactLaw, f64)> =
        lawful.filter(|(weight, ..)| *weight > 0.0).collect();
    let sum: f64 = laws.iter().map(|(weight, ..)| weight).sum();
    // Weights are sums of rounded numbers.
    if sum < MOST - 1e-9 {
        return None;
    }
    laws.iter_mut().for_each(|(weight, ..)| *weight /= sum);
    if let Some((_, law, _)) = laws.iter().find(|(weight, ..)| *weight > ALONE) {
        return Some((*law).clone());
    }
    let parts = Parts(laws.iter().map(|&(weight, law, _)| (weight, law)).collect());
    Some(tidied(ContactLaw {
        spring: spring(&laws),
        damping_s_m: parts.level(|law| Some(law.damping_s_m)),
        relaxation: parts.of(|law| law.relaxation).map(|parts| Relaxation {
            stiffness_n_m: parts.geometric(|part| part.stiffness_n_m),
            time_s: parts.geometric(|part| part.time_s),
        }),
        imprint: parts.of(|law| law.imprint).map(|parts| Imprint {
            yield_mm: parts.mean(|part| part.yield_mm),
            share: parts.geometric(|part| part.share),
            heal: parts.mean(|part| part.heal),
            recovery_s: recovery_s(parts.mean(|part| rate(part.recovery_s))),
        }),
        drag: parts.of(|law| law.drag).map(|parts| Drag {
            viscous_n_s_m2: parts.level(|part| Some(part.viscous_n_s_m2)),
            plough_n_m: parts.mean(|part| part.plough_n_m),
        }),
        adhesion: parts.of(|law| law.adhesion).map(|parts| Adhesion {
            pull_n: parts.geometric(|part| part.pull_n),
            stiffness_n_m: parts.geometric(|part| part.stiffness_n_m),
        }),
    }))
}

/// A law whose spring leaves relaxation and adhesion their room, in as few points as tell it.
pub(super) fn tidied(law: ContactLaw) -> ContactLaw {
    let relaxing = law.relaxation.map_or(0.0, |part| part.stiffness_n_m);
    let sticking = law.adhesion.map_or(0.0, |part| part.stiffness_n_m);
    let room = STEEPEST_N_M - relaxing - sticking;
    ContactLaw {
        spring: tidy(filmed(&law), room.max(LEAST_ROOM * STEEPEST_N_M)),
        ..law
    }
}

/// The spring of a law below a soft film where its pull would be lost in it: a pull reaches no deeper than its limit over
/// its stiffness.
fn filmed(law: &ContactLaw) -> Vec<SpringPoint> {
    let spring = law.spring.clone();
    let Some(Adhesion {
        pull_n,
        stiffness_n_m,
    }) = law.adhesion
    else {
        return spring;
    };
    let film_mm = 1000.0 * pull_n / stiffness_n_m;
    let net_n =
        |depth_mm: f64| pull_n.min(stiffness_n_m * depth_mm / 1000.0) - law.spring_n(depth_mm, 0.0);
    let depths = spring.iter().map(|point| point.depth_mm);
    let felt_n = depths.map(net_n).fold(net_n(film_mm), f64::max);
    if spring.is_empty() || felt_n >= FELT * pull_n {
        return spring;
    }
    let film = SpringPoint {
        depth_mm: film_mm,
        force_n: FILM * pull_n,
    };
    let below = spring
        .into_iter()
        .filter(|point| point.force_n > film.force_n);
    let below = below.map(|point| SpringPoint {
        depth_mm: point.depth_mm + film_mm,
        ..point
    });
    std::iter::once(film).chain(below).collect()
}

/// Rate of a recovery, 1/s; a time of 0 is none.
fn rate(recovery_s: f64) -> f64 {
    if recovery_s > 0.0 {
        1.0 / recovery_s
    } else {
        0.0
    }
}

/// Time of a recovery of this rate, s; 0 where an asset can hold no such time.
fn recovery_s(rate: f64) -> f64 {
    if rate * f64::from(limits::MAX_RECOVERY_S) >= 1.0 {
        1.0 / rate
    } else {
        0.0
    }
}

/// Parts of laws with their weights, which sum to one.
struct Parts<T>(Vec<(f64, T)>);

impl<T: Copy> Parts<T> {
    /// The parts that some have; `None` where these weigh less than the others.
    fn of<U>(&self, part: impl Fn(T) -> Option<U>) -> Option<Parts<U>> {
        let found = self.0.iter();
        let found = found.filter_map(|&(weight, of)| Some((weight, part(of)?)));
        let mut found: Vec<(f64, U)> = found.collect();
        let sum: f64 = found.iter().map(|(weight, _)| weight).sum();
        found.iter_mut().for_each(|(weight, _)| *weight /= sum);
        (sum >= MOST - 1e-9).then_some(Parts(found))
    }

    /// Mean of a number.
    fn mean(&self, number: impl Fn(T) -> f64) -> f64 {
        let terms = self.0.iter();
        terms.map(|&(weight, part)| weight * number(part)).sum()
    }

    /// Geometric mean of a number above 0.
    fn geometric(&self, number: impl Fn(T) -> f64) -> f64 {
        libm::exp(self.mean(|part| libm::log(number(part))))
    }

    /// Geometric mean of a number among those where it is above 0; 0 where these weigh less than the others.
    fn level(&self, number: impl Fn(T) -> Option<f64>) -> f64 {
        let some = self.of(|part| number(part).filter(|number| *number > 0.0));
        some.map_or(0.0, |some| some.geometric(|number| number))
    }
}

/// The spring whose depth is the mean depth at every force.
fn spring(laws: &[(f64, &ContactLaw, f64)]) -> Vec<SpringPoint> {
    if laws.iter().all(|(_, law, _)| law.spring.is_empty()) {
        return Vec::new();
    }
    let depth_mm = |force_n: f64| {
        let depths = laws.iter();
        depths
            .map(|(weight, law, stiffness_n_m)| weight * law.depth_mm(force_n, *stiffness_n_m))
            .sum()
    };
    let points = FORCES_N.map(|force_n| SpringPoint {
        depth_mm: depth_mm(force_n),
        force_n,
    });
    points.into()
}

/// Points of a spring within a slope and depths, without those on a straight line between others.
fn tidy(points: impl IntoIterator<Item = SpringPoint>, steepest_n_m: f64) -> Vec<SpringPoint> {
    let origin = SpringPoint {
        depth_mm: 0.0,
        force_n: 0.0,
    };
    let mut kept = vec![origin];
    let mut last = origin;
    for point in points {
        let steepest_mm = last.depth_mm + 1000.0 * (point.force_n - last.force_n) / steepest_n_m;
        let depth_mm = point.depth_mm.max(steepest_mm);
        let step = (depth_mm - last.depth_mm).min(point.force_n - last.force_n);
        if step < LEAST_STEP {
            continue;
        }
        if depth_mm > DEEPEST_MM {
            // The line on which it lies ends at the deepest point.
            let part = (DEEPEST_MM - last.depth_mm) / (depth_mm - last.depth_mm);
            kept.push(SpringPoint {
                depth_mm: DEEPEST_MM,
                force_n: last.force_n + part * (point.force_n - last.force_n),
            });
            break;
        }
        last = SpringPoint { depth_mm, ..point };
        kept.push(last);
    }
    loop {
        let bends = kept.windows(3).map(bend).enumerate();
        let straightest = bends.min_by(|a, b| a.1.total_cmp(&b.1));
        match straightest {
            Some((n, bend)) if bend <= STRAIGHT || kept.len() > limits::MAX_SPRING_POINTS + 1 => {
                kept.remove(n + 1);
            }
            _ => break,
        }
    }
    kept.remove(0);
    kept
}

/// Distance of the middle of three points from the line through the others, as a part of its depth.
fn bend(points: &[SpringPoint]) -> f64 {
    let [a, b, c] = points else {
        return f64::INFINITY;
    };
    let part = (b.force_n - a.force_n) / (c.force_n - a.force_n);
    let depth_mm = a.depth_mm + part * (c.depth_mm - a.depth_mm);
    (depth_mm - b.depth_mm).abs() / b.depth_mm
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(points: &[(f64, f64)]) -> ContactLaw {
        let points = points.iter();
        ContactLaw {
            spring: points
                .map(|&(depth_mm, force_n)| SpringPoint { depth_mm, force_n })
                .collect(),
            ..ContactLaw::default()
        }
    }

    fn half<'a>(weight: f64, law: &'a ContactLaw) -> Share<'a> {
        Share {
            weight,
            law: Some(law),
            stiffness_n_m: 300.0,
        }
    }

    #[test]
    fn compliances_add_and_a_straight_spring_is_one_point() {
        let (soft, stiff) = (law(&[(20.0, 2.0)]), law(&[(5.0, 2.0)]));
        let found = mixed(&[half(0.5, &soft), half(0.5, &stiff)]).unwrap();
        let [point] = found.spring[..] else {
            panic!("{found:?}")
        };
        assert!((1000.0 * point.force_n / point.depth_mm - 160.0).abs() < 1e-9);
        assert_eq!(
            mixed(&[half(0.96, &soft), half(0.04, &stiff)]),
            Some(soft.clone())
        );
        assert_eq!(mixed(&[half(0.49, &soft)]), None);
    }

    #[test]
    fn a_spring_stays_within_its_slopes_and_depths() {
        let steep = tidied(law(&[(0.1, 1.0), (80.0, 2.0)])).spring;
        let tidied = ContactLaw {
            spring: steep,
            ..ContactLaw::default()
        };
        assert!(tidied.steepest_n_m().unwrap() <= STEEPEST_N_M + 1e-9);
        assert_eq!(tidied.spring.last().unwrap().depth_mm, DEEPEST_MM);
    }

    #[test]
    fn a_part_stays_where_most_have_it_and_never_is_the_slowest_recovery() {
        let imprint = |recovery_s| {
            Some(Imprint {
                yield_mm: 1.0,
                share: 0.5,
                heal: 0.0,
                recovery_s,
            })
        };
        let mut never = law(&[(5.0, 2.0)]);
        never.imprint = imprint(0.0);
        let mut soon = never.clone();
        (soon.imprint, soon.damping_s_m) = (imprint(6.0), 1.0);
        let found = mixed(&[half(0.5, &never), half(0.5, &soon)]).unwrap();
        assert!((found.imprint.unwrap().recovery_s - 12.0).abs() < 1e-9);
        assert!((found.damping_s_m - 1.0).abs() < 1e-12);
        let found = mixed(&[half(0.6, &never), half(0.4, &soon)]).unwrap();
        assert_eq!(found.damping_s_m, 0.0);
    }
}
