//! A seeded script: the motions of a user who explores a surface.

use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::motion::Motion;
use crate::random::unit;

/// Height at which the hand hovers, m.
pub const HOVER_M: f64 = 0.012;

/// A sequence of motions.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    motions: Vec<Motion>,
}

impl Script {
    /// A script of the given motions.
    #[must_use]
    pub fn new(motions: Vec<Motion>) -> Self {
        Self { motions }
    }

    /// An exploration of about eleven seconds, repeated `cycles` times: approach, four taps, a
    /// press, a rest, strokes at four speeds and forces, a scrub, a rest, a lift.
    ///
    /// The seed varies speeds, forces and places by up to a tenth. Every point lies within
    /// `half_extents_m` of the origin, with a margin for the lag of the hand.
    #[must_use]
    pub fn exploration(seed: u64, cycles: usize, half_extents_m: [f64; 3]) -> Self {
        let mut vary = Vary(Xoshiro256PlusPlus::seed_from_u64(seed));
        let reach_m = half_extents_m.map(|half_m| 0.8 * half_m);
        let mut motions = Vec::new();
        for _ in 0..cycles {
            explore(&mut vary, reach_m, &mut motions);
        }
        Self { motions }
    }

    /// The motions, in order.
    #[must_use]
    pub fn motions(&self) -> &[Motion] {
        &self.motions
    }
}

/// Small seeded variations.
struct Vary(Xoshiro256PlusPlus);

impl Vary {
    /// Uniform in −1..1.
    fn signed(&mut self) -> f64 {
        2.0 * unit(&mut self.0) - 1.0
    }

    /// `value` within ± 10 %.
    fn around(&mut self, value: f64) -> f64 {
        value * (1.0 + 0.1 * self.signed())
    }
}

fn explore(vary: &mut Vary, reach_m: [f64; 3], motions: &mut Vec<Motion>) {
    // The strokes use 0.8 of the reach, which leaves room for the variation of 10 %.
    let far_m = 0.8 * reach_m[0].min(0.07);
    let side_m = 0.5 * reach_m[1];
    let hover_m = HOVER_M.min(reach_m[2]);
    let left_m = -vary.around(far_m);
    let line_m = side_m * 0.5 * vary.signed();
    motions.push(Motion::Approach {
        to_m: [left_m, line_m, hover_m],
        duration_s: 0.6,
    });
    for speed_m_s in [0.05, 0.1, 0.2, 0.3] {
        motions.push(Motion::Tap {
            speed_m_s: vary.around(speed_m_s),
        });
    }
    motions.push(Motion::Press {
        force_n: vary.around(2.0),
        duration_s: 1.2,
    });
    motions.push(Motion::Rest {
        force_n: vary.around(0.5),
        duration_s: 0.4,
    });
    for (side, end, speed_m_s, force_n) in [
        (0.0, 1.0, 0.08, 0.6),
        (0.3, -1.0, 0.14, 1.0),
        (-0.3, 1.0, 0.2, 1.4),
        (0.0, 0.0, 0.1, 0.8),
    ] {
        motions.push(Motion::Stroke {
            to_m: [
                vary.around(end * far_m),
                line_m + vary.around(side * side_m),
            ],
            speed_m_s: vary.around(speed_m_s),
            force_n: vary.around(force_n),
        });
    }
    motions.push(Motion::Scrub {
        amplitude_m: vary.around(0.45 * far_m),
        frequency_hz: vary.around(1.4),
        cycles: 3.0,
        force_n: vary.around(0.8),
    });
    motions.push(Motion::Rest {
        force_n: vary.around(0.5),
        duration_s: 0.4,
    });
    motions.push(Motion::Lift {
        height_m: hover_m,
        duration_s: 0.4,
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOUCH_M: [f64; 3] = [0.08, 0.06, 0.035];

    #[test]
    fn the_same_seed_gives_the_same_script_and_others_differ() {
        let script = |seed| Script::exploration(seed, 2, TOUCH_M);
        assert_eq!(script(1), script(1));
        assert_ne!(script(1), script(2));
    }

    #[test]
    fn every_point_stays_in_the_workspace() {
        for seed in 0..500 {
            for extents_m in [TOUCH_M, [0.02, 0.01, 0.006]] {
                let inside =
                    |to_m: [f64; 2]| to_m[0].abs() < extents_m[0] && to_m[1].abs() < extents_m[1];
                for motion in Script::exploration(seed, 2, extents_m).motions() {
                    let ok = match *motion {
                        Motion::Approach { to_m, .. } => {
                            inside([to_m[0], to_m[1]]) && to_m[2] < extents_m[2]
                        }
                        Motion::Stroke { to_m, .. } => inside(to_m),
                        Motion::Lift { height_m, .. } => height_m < extents_m[2],
                        Motion::Scrub { amplitude_m, .. } => amplitude_m < 0.5 * extents_m[0],
                        _ => true,
                    };
                    assert!(ok, "seed {seed}: {motion:?}");
                }
            }
        }
    }
}
