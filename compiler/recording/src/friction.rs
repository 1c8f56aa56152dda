//! Friction: μ with its spread, and how it depends on speed and load if the data ask for it.

use crate::{
    least_squares::solve,
    signal::quantile::{RMS_OF_MEDIAN, mean, median, quantile},
    timeline::{RATE_HZ, Timeline},
};
use serde::Serialize;

/// Samples of a block that counts once, 0.1 s.
const BLOCK: usize = 100;
/// Slowest sliding, mm/s: below, tool and skin stick.
const SLOWEST_MM_S: f64 = 20.0;
/// Way after a turn until friction opposes the motion fully, mm: up to there the contact is still stretched the
/// old way. Circles that are much smaller count as turning all the time.
const STRETCH_MM: f64 = 2.0;
/// Least cosine between headings that are no turn.
const LEAST_COSINE: f64 = 0.5;
/// Least load, N: below, the sensor's bias decides.
const LEAST_LOAD_N: f64 = 0.2;
/// Fewest blocks.
const FEWEST: usize = 10;
/// A law with more parameters must be better by this, in twice the log-likelihood.
const LEAST_GAIN: f64 = 12.0;
/// And it must change μ by this fraction over what was visited.
const LEAST_EFFECT: f64 = 0.05;
/// Neighbours in speed that a block is held against, and how many of their standard deviations it may be off.
const NEIGHBOURS: usize = 15;
const FAR: f64 = 5.0;

/// Friction of a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Friction {
    /// Median of drag over load.
    pub mu: f64,
    /// Half the distance between the 16 % and the 84 % quantile.
    pub spread: f64,
    /// Blocks of 0.1 s that it is made of.
    pub blocks: usize,
    /// The simplest law that the data ask for.
    pub law: Law,
    /// Speeds between which 96 % of the blocks lie, mm/s.
    pub speeds_mm_s: [f64; 2],
    /// Median load of the blocks, N.
    pub load_n: f64,
    /// Part of the sliding time in which the tool sticks and slips, 0..=1.
    pub stick_slip: f64,
}

impl Friction {
    /// μ at a speed, mm/s, and the median load, as the law has it.
    #[must_use]
    pub fn mu_at(&self, speed_mm_s: f64) -> f64 {
        match self.law {
            Law::Coulomb => self.mu,
            Law::Power {
                mu,
                of_speed,
                of_load,
            } => mu * libm::pow(speed_mm_s / 100.0, of_speed) * libm::pow(self.load_n, of_load),
            Law::Stribeck {
                sliding,
                rest,
                v_s_mm_s,
            } => sliding + (rest - sliding) * libm::exp(-speed_mm_s / v_s_mm_s),
        }
    }

    /// Returns true if speed changes μ by more than 5 % over the recorded speeds.
    #[must_use]
    pub fn depends_on_speed(&self) -> bool {
        let [slow, fast] = self.speeds_mm_s.map(|speed| self.mu_at(speed));
        (slow - fast).abs() > LEAST_EFFECT * self.mu
    }
}

/// Law of μ against speed and load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Law {
    /// It does not.
    Coulomb,
    /// `μ = c·(v/100 mm/s)^of_speed·(F/1 N)^of_load`.
    Power {
        /// Coefficient at 100 mm/s and 1 N.
        mu: f64,
        /// Exponent of speed.
        of_speed: f64,
        /// Exponent of load.
        of_load: f64,
    },
    /// `μ = sliding + (rest − sliding)·e^(−v/v_s)`.
    Stribeck {
        /// Fast.
        sliding: f64,
        /// Slow.
        rest: f64,
        /// Speed scale, mm/s.
        v_s_mm_s: f64,
    },
}

/// Mean speed, load and ratio of a block.
#[derive(Debug, Clone, Copy)]
struct Block {
    speed_mm_s: f64,
    load_n: f64,
    mu: f64,
}

/// The friction of a recording; `None` without a force against the motion or enough sliding.
#[must_use]
pub fn friction(timeline: &Timeline) -> Option<Friction> {
    let drag = timeline.drag_n.as_ref()?;
    let (mut blocks, mut sticking, mut sliding) = (Vec::new(), 0, 0);
    for block in 0..timeline.len() / BLOCK {
        let span = block * BLOCK..(block + 1) * BLOCK;
        if !timeline.contact[span.clone()]
            .iter()
            .zip(&timeline.good[span.clone()])
            .all(|(touches, good)| *touches && *good)
        {
            continue;
        }
        let speeds = &timeline.speed_mm_s[span.clone()];
        let (speed_mm_s, load_n, drag_n) = (
            mean(speeds),
            mean(&timeline.load_n[span.clone()]),
            mean(&drag[span.clone()]),
        );
        let slowest = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let fastest = speeds.iter().copied().fold(0.0, f64::max);
        if load_n < LEAST_LOAD_N || speed_mm_s < SLOWEST_MM_S {
            continue;
        }
        sliding += 1;
        if slowest < 0.1 * speed_mm_s && fastest > 2.0 * speed_mm_s {
            sticking += 1;
        }
        if slowest > 0.5 * SLOWEST_MM_S && span.clone().all(|sample| is_straight(timeline, sample))
        {
            blocks.push(Block {
                speed_mm_s,
                load_n,
                mu: drag_n / load_n,
            });
        }
    }
    if blocks.len() < FEWEST {
        return None;
    }
    let all = || blocks.iter().map(|block| block.mu);
    let mu = median(all());
    Some(Friction {
        mu,
        spread: 0.5 * (quantile(all(), 0.84) - quantile(all(), 0.16)),
        blocks: blocks.len(),
        law: law(&typical(&blocks), mu),
        speeds_mm_s: [0.02, 0.98].map(|q| quantile(blocks.iter().map(|b| b.speed_mm_s), q)),
        load_n: median(blocks.iter().map(|b| b.load_n)),
        stick_slip: f64::from(sticking) / f64::from(sliding.max(1)),
    })
}

/// Returns true if the tool reached a sample in contact and in a straight line, over the stretch of the contact.
fn is_straight(timeline: &Timeline, sample: usize) -> bool {
    let [x, y] = timeline.heading[sample];
    let mut way_mm = 0.0;
    for before in (0..sample).rev() {
        if way_mm >= STRETCH_MM {
            return true;
        }
        let [x_before, y_before] = timeline.heading[before];
        let cosine = x * x_before + y * y_before;
        if cosine < LEAST_COSINE || !timeline.contact[before] {
            return false;
        }
        way_mm += timeline.speed_mm_s[before] / RATE_HZ;
    }
    true
}

/// The blocks without those in which the tool caught or turned: far from the median of their neighbours in
/// speed. A regression would follow them.
fn typical(blocks: &[Block]) -> Vec<Block> {
    let mut blocks = blocks.to_vec();
    blocks.sort_by(|a, b| a.speed_mm_s.total_cmp(&b.speed_mm_s));
    let is_typical = |index: usize| {
        let first = index.saturating_sub(NEIGHBOURS / 2);
        let first = first.min(blocks.len().saturating_sub(NEIGHBOURS));
        let near = || blocks.iter().skip(first).take(NEIGHBOURS).map(|b| b.mu);
        let middle = median(near());
        let spread = RMS_OF_MEDIAN * median(near().map(|mu| (mu - middle).abs()));
        (blocks[index].mu - middle).abs() <= (FAR * spread).max(LEAST_EFFECT * middle)
    };
    let kept = (0..blocks.len()).filter(|&index| is_typical(index));
    kept.map(|index| blocks[index]).collect()
}

/// The law with the fewest parameters that no other beats clearly.
fn law(blocks: &[Block], mu: f64) -> Law {
    let error = |predict: &dyn Fn(&Block) -> f64| {
        // The median is robust against a block in which the tool caught.
        let squares = blocks
            .iter()
            .map(|block| (block.mu - predict(block)).powi(2));
        mean(&squares.map(|x| x.min(mu * mu)).collect::<Vec<_>>()).max(1e-12)
    };
    let gain = |better: f64| blocks.len() as f64 * libm::log(error(&|_| mu) / better);
    let speeds = || blocks.iter().map(|block| block.speed_mm_s);
    let loads = || blocks.iter().map(|block| block.load_n);
    let span = |low: f64, high: f64| (high / low.max(1e-9)).max(1.0);
    let speed_span = span(quantile(speeds(), 0.05), quantile(speeds(), 0.95));
    let load_span = span(quantile(loads(), 0.05), quantile(loads(), 0.95));
    let power = power_law(blocks).filter(|law| {
        let Law::Power {
            mu,
            of_speed,
            of_load,
        } = *law
        else {
            return false;
        };
        let effect =
            (of_speed.abs() * libm::log(speed_span)).max(of_load.abs() * libm::log(load_span));
        let better = error(&|b| {
            mu * libm::pow(b.speed_mm_s / 100.0, of_speed) * libm::pow(b.load_n, of_load)
        });
        effect > LEAST_EFFECT && gain(better) > LEAST_GAIN
    });
    let stribeck = stribeck(blocks).filter(|law| {
        let Law::Stribeck {
            sliding,
            rest,
            v_s_mm_s,
        } = *law
        else {
            return false;
        };
        let better = error(&|b| sliding + (rest - sliding) * libm::exp(-b.speed_mm_s / v_s_mm_s));
        let slow = libm::exp(-quantile(speeds(), 0.05) / v_s_mm_s);
        ((rest - sliding) * slow).abs() > LEAST_EFFECT * mu && gain(better) > LEAST_GAIN && {
            let of_power = power.map_or(0.0, |_| LEAST_GAIN);
            gain(better) > of_power
        }
    });
    match (power, stribeck) {
        (Some(power), Some(stribeck)) => {
            let of = |law: Law| match law {
                Law::Power {
                    mu,
                    of_speed,
                    of_load,
                } => error(&|b| {
                    mu * libm::pow(b.speed_mm_s / 100.0, of_speed) * libm::pow(b.load_n, of_load)
                }),
                Law::Stribeck {
                    sliding,
                    rest,
                    v_s_mm_s,
                } => error(&|b| sliding + (rest - sliding) * libm::exp(-b.speed_mm_s / v_s_mm_s)),
                Law::Coulomb => f64::INFINITY,
            };
            if of(stribeck) < of(power) {
                stribeck
            } else {
                power
            }
        }
        (Some(law), None) | (None, Some(law)) => law,
        (None, None) => Law::Coulomb,
    }
}

/// ln μ on ln v and ln F by least squares.
fn power_law(blocks: &[Block]) -> Option<Law> {
    let rows = blocks.iter().filter(|block| block.mu > 0.0).map(|block| {
        let row = [
            1.0,
            libm::log(block.speed_mm_s / 100.0),
            libm::log(block.load_n),
        ];
        (row, libm::log(block.mu))
    });
    let [c, of_speed, of_load] = regress(rows)?;
    Some(Law::Power {
        mu: libm::exp(c),
        of_speed,
        of_load,
    })
}

/// The best of a row of speed scales.
fn stribeck(blocks: &[Block]) -> Option<Law> {
    let fits = (0..12).filter_map(|step| {
        let v_s_mm_s = 5.0 * libm::pow(1.5, f64::from(step));
        let decay = |block: &Block| libm::exp(-block.speed_mm_s / v_s_mm_s);
        let [sliding, above] = regress(blocks.iter().map(|block| ([1.0, decay(block)], block.mu)))?;
        let error: f64 = blocks
            .iter()
            .map(|block| (block.mu - sliding - above * decay(block)).powi(2))
            .sum();
        // Friction does not push.
        (sliding > 0.0 && sliding + above >= 0.0).then_some((
            error,
            Law::Stribeck {
                sliding,
                rest: sliding + above,
                v_s_mm_s,
            },
        ))
    });
    fits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, law)| law)
}

fn regress<const N: usize>(rows: impl Iterator<Item = ([f64; N], f64)>) -> Option<[f64; N]> {
    let mut matrix = vec![vec![0.0; N]; N];
    let mut right = vec![0.0; N];
    for (row, y) in rows {
        for i in 0..N {
            right[i] += row[i] * y;
            for j in 0..N {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    solve(matrix, right)?.try_into().ok()
}

#[cfg(test)]
#[path = "friction_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;

    fn blocks(mu: impl Fn(f64, f64) -> f64) -> Vec<Block> {
        (0..200)
            .map(|n| {
                let (speed_mm_s, load_n) = (
                    25.0 + 1.1 * f64::from(n),
                    0.4 + 2.5 * (f64::from(n) * 0.618).fract(),
                );
                let noise = 0.02 * ((f64::from(n) * 0.414).fract() - 0.5);
                Block {
                    speed_mm_s,
                    load_n,
                    mu: mu(speed_mm_s, load_n) + noise,
                }
            })
            .collect()
    }

    #[test]
    fn the_simplest_law_that_the_data_ask_for_is_found() {
        assert_eq!(law(&blocks(|_, _| 0.4), 0.4), Law::Coulomb);
        match law(&blocks(|_, load| 0.5 * libm::pow(load, -0.25)), 0.45) {
            Law::Power {
                of_speed, of_load, ..
            } => assert!((of_load + 0.25).abs() < 0.05 && of_speed.abs() < 0.05),
            other => panic!("{other:?}"),
        }
        match law(
            &blocks(|speed, _| 0.3 + 0.4 * libm::exp(-speed / 40.0)),
            0.33,
        ) {
            Law::Stribeck {
                sliding, v_s_mm_s, ..
            } => assert!((sliding - 0.3).abs() < 0.02 && (20.0..80.0).contains(&v_s_mm_s)),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn blocks_in_which_the_tool_turned_tell_no_law() {
        let mut caught = blocks(|_, _| 0.7);
        for block in caught.iter_mut().take(30).step_by(4) {
            block.mu = 0.3;
        }
        assert_eq!(law(&typical(&caught), 0.7), Law::Coulomb);
        assert_ne!(
            law(&caught, 0.7),
            Law::Coulomb,
            "without the test of neighbours"
        );
    }
}
