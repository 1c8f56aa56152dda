//! How a texture may follow the direction of a stroke: factors on the grid across, or a second grid along.
//!
//! A relief is stroked at an angle θ from across its axis. The corpus's generator gives the spectra of two kinds, by the
//! physical parameters across and along: **ribs** with a relief of their own along them, which meet the tip at v·|cos θ| and
//! v·|sin θ| and whose powers add, and a **grain**, one field that is stretched along the axis, of the wavelength
//! 1/√(cos²θ/λ₁² + sin²θ/λ₂²) and a height between both.

use super::statistics::Spread;
use crate::signal::rms;
use asperity::signal::lsf::to_polynomial;
use asperity_corpus::{
    Bin, CorpusError,
    generator::{
        Physical,
        constants::{ConstantSet, Constants},
        level, transfer,
    },
    reference,
};
use asperity_surface::{
    direction::{self, SILENT_DB},
    vibration::{POINTS, Spectrum, bands_db, lsf},
};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Speeds of the strokes, mm/s, their force, N, and their angles from across the axis, degrees.
const SPEEDS_MM_S: [f64; 3] = [60.0, 120.0, 200.0];
const FORCE_N: f64 = 1.0;
const ANGLES_DEG: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];
/// An error that is larger than a second grid's by this is a loss, dB.
const LOST_DB: f64 = 2.0;
/// Slowest speed at which a relief is stroked, mm/s: below it, it is silent.
const SLOWEST_MM_S: f64 = 1.0;

/// A way to follow the direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Design {
    /// One grid, whatever the direction.
    None,
    /// Speed and level as ellipses of θ.
    Ellipses,
    /// Speed and level of the stronger of two reliefs, weighted by their powers.
    Powers,
    /// A second grid at the speed of the stroke, mixed by cos²θ and sin²θ.
    SecondGrid,
    /// A second grid, each at the speed that crosses it, mixed by their powers.
    TwoQueries,
}

/// Every design.
pub const DESIGNS: [Design; 5] = [
    Design::None,
    Design::Ellipses,
    Design::Powers,
    Design::SecondGrid,
    Design::TwoQueries,
];

impl Design {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "no direction",
            Self::Ellipses => "factors, ellipses",
            Self::Powers => "factors, weighted by power",
            Self::SecondGrid => "a second grid",
            Self::TwoQueries => "a second grid, two queries",
        }
    }
}

/// A design over all materials.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionSummary {
    /// The design.
    pub design: Design,
    /// RMS error of third octaves of each material as ribs, over speeds and angles, dB.
    pub ribs_db: Spread,
    /// The same as a grain.
    pub grain_db: Spread,
    /// RMS error of ribs at the worst angle, dB.
    pub worst_db: Spread,
    /// Materials that lose more than 2 dB against the second grid at the worst angle of either, as ribs or as a grain.
    pub lose: usize,
    /// Number of materials.
    pub materials: usize,
}

/// A relief across and along its axis.
struct Relief<'a> {
    constants: &'a Constants,
    across: Physical,
    along: Physical,
    /// Spectrum along over that across at the same speed, and the speed across that is heard along.
    power: f64,
    speed: f64,
}

impl<'a> Relief<'a> {
    /// With the factors that render it best along the axis.
    fn new(constants: &'a Constants, across: Physical, along: Physical) -> Self {
        let mut relief = Self {
            constants,
            across,
            along,
            power: 1.0,
            speed: 1.0,
        };
        let ratios = direction::fit(
            &SPEEDS_MM_S,
            |v| relief.crossed(&across, v),
            |v| relief.crossed(&along, v),
        );
        (relief.speed, relief.power) = (ratios.speed, ratios.power);
        relief
    }

    fn level_db(&self, physical: &Physical, speed_mm_s: f64) -> f64 {
        level::rms_db(self.constants, physical, stroke(speed_mm_s))
    }

    /// The vibration of one of its reliefs that is crossed at a speed.
    fn crossed(&self, physical: &Physical, speed_mm_s: f64) -> Spectrum {
        if speed_mm_s < SLOWEST_MM_S {
            return [0.0; POINTS];
        }
        let level = libm::exp10(self.level_db(physical, speed_mm_s) / 10.0);
        transfer::spectrum(self.constants, physical, stroke(speed_mm_s)).map(|power| level * power)
    }

    fn ribs(&self, v: f64, (c2, s2): (f64, f64)) -> Spectrum {
        sum(
            &self.crossed(&self.across, v * c2.sqrt()),
            &self.crossed(&self.along, v * s2.sqrt()),
        )
    }

    fn grain(&self, v: f64, (c2, s2): (f64, f64)) -> Spectrum {
        let geometric =
            |across: f64, along: f64| libm::exp(c2 * libm::log(across) + s2 * libm::log(along));
        let (across, along) = (&self.across, &self.along);
        let per_mm = |physical: &Physical| 1.0 / (physical.wavelength_mm * physical.wavelength_mm);
        let field = Physical {
            wavelength_mm: 1.0 / (c2 * per_mm(across) + s2 * per_mm(along)).sqrt(),
            height_um: geometric(across.height_um, along.height_um),
            spread_octaves: c2 * across.spread_octaves + s2 * along.spread_octaves,
            ..*across
        };
        self.crossed(&field, v)
    }

    fn rendered(&self, design: Design, v: f64, (c2, s2): (f64, f64)) -> Spectrum {
        let at = |factor: f64, gain: f64| self.crossed(&self.across, v * factor).map(|p| gain * p);
        let (e, r2) = (self.power, self.speed * self.speed);
        match design {
            Design::None => at(1.0, 1.0),
            Design::Ellipses => {
                let factor2 = c2 + r2 * s2;
                at(factor2.sqrt(), (c2 + e * s2) / factor2)
            }
            Design::Powers => {
                let power = c2 + e * s2;
                let factor2 = (c2 * c2 + e * r2 * s2 * s2) / power;
                at(factor2.sqrt(), power / factor2)
            }
            Design::SecondGrid => self.mixed((v, v), (c2, s2)),
            Design::TwoQueries => {
                let (across, along) = (v * c2.sqrt(), v * s2.sqrt());
                self.mixed(
                    (across.max(SLOWEST_MM_S), along.max(SLOWEST_MM_S)),
                    (1.0, 1.0),
                )
            }
        }
    }

    /// The LSFs of both reliefs, each crossed at a speed, mixed in cos ω by shares of their powers, and the sum of these.
    fn mixed(&self, (across, along): (f64, f64), (c2, s2): (f64, f64)) -> Spectrum {
        let model = |physical: &Physical, speed_mm_s: f64| {
            let shape = transfer::spectrum(self.constants, physical, stroke(speed_mm_s));
            (
                lsf(&shape),
                libm::exp10(self.level_db(physical, speed_mm_s) / 10.0),
            )
        };
        let ((one, a), (two, b)) = (model(&self.across, across), model(&self.along, along));
        let (a, b) = (c2 * a, s2 * b);
        let share = b / (a + b);
        let mixed: Vec<f64> = one
            .iter()
            .zip(&two)
            .map(|(&x, &y)| {
                let cos = |w: f32| libm::cos(f64::from(w));
                libm::acos(cos(x) + share * (cos(y) - cos(x)))
            })
            .collect();
        let monic = to_polynomial(&mixed);
        let shape: Spectrum = std::array::from_fn(|point| {
            let w = (point as f64 + 0.5) * PI / POINTS as f64;
            let (mut re, mut im) = (0.0, 0.0);
            for (lag, a) in monic.iter().enumerate() {
                re += a * libm::cos(lag as f64 * w);
                im -= a * libm::sin(lag as f64 * w);
            }
            1.0 / (re * re + im * im)
        });
        let mean = shape.iter().sum::<f64>() / POINTS as f64;
        shape.map(|power| (a + b) * power / mean)
    }
}

fn stroke(speed_mm_s: f64) -> Bin {
    Bin {
        speed_mm_s,
        force_n: FORCE_N,
    }
}

fn sum(a: &Spectrum, b: &Spectrum) -> Spectrum {
    std::array::from_fn(|n| a[n] + b[n])
}

/// Third octaves at each angle and speed, dB: [angle][speed][band].
type Bands = Vec<Vec<Vec<f64>>>;

fn bands(power: impl Fn(f64, (f64, f64)) -> Spectrum) -> Bands {
    let at = |degrees: f64| {
        let c = libm::cos(TAU * degrees / 360.0);
        let angle = (c * c, 1.0 - c * c);
        SPEEDS_MM_S.map(|v| bands_db(&power(v, angle))).to_vec()
    };
    ANGLES_DEG.map(at).to_vec()
}

/// Errors of what was found at each angle: RMS over speeds and third octaves, dB.
fn errors_db(truth: &Bands, found: &Bands) -> Vec<f64> {
    let across = &truth[0];
    let at = |(truth, found): (&Vec<Vec<f64>>, &Vec<Vec<f64>>)| {
        let speeds = truth.iter().zip(found).zip(across);
        let apart = speeds.flat_map(|((truth, found), across)| {
            let least = across.iter().copied().fold(f64::MIN, f64::max) - SILENT_DB;
            let pairs = truth.iter().zip(found);
            pairs.map(move |(truth, found)| found.max(least) - truth.max(least))
        });
        rms(&apart.collect::<Vec<_>>())
    };
    truth.iter().zip(found).map(at).collect()
}

/// Measures every design on every material of the corpus that has a direction.
///
/// # Errors
/// [`CorpusError`] of the committed corpus.
pub fn measure() -> Result<Vec<DirectionSummary>, CorpusError> {
    let constants = Constants::embedded(ConstantSet::Calibrated)?;
    let physical = reference::physical()?;
    let directions = reference::directions()?;
    let errors: Vec<Vec<[Vec<f64>; 2]>> = directions
        .par_iter()
        .filter_map(|direction| {
            let across = *physical.get(&direction.name)?;
            let relief = Relief::new(&constants, across, direction.along(&across));
            let ribs = bands(|v, angle| relief.ribs(v, angle));
            let grain = bands(|v, angle| relief.grain(v, angle));
            let of = |design| {
                let found = bands(|v, angle| relief.rendered(design, v, angle));
                [errors_db(&ribs, &found), errors_db(&grain, &found)]
            };
            Some(DESIGNS.map(of).to_vec())
        })
        .collect();
    let second = DESIGNS
        .iter()
        .position(|design| *design == Design::SecondGrid)
        .unwrap_or(0);
    let worst = |angles: &[f64]| angles.iter().copied().fold(0.0, f64::max);
    Ok(DESIGNS
        .iter()
        .enumerate()
        .filter_map(|(n, &design)| {
            let spread = |kind: usize, of: &dyn Fn(&[f64]) -> f64| {
                Spread::of(&errors.iter().map(|e| of(&e[n][kind])).collect::<Vec<_>>())
            };
            let loses = |e: &&Vec<[Vec<f64>; 2]>| {
                let lost = |kind: usize| worst(&e[n][kind]) - worst(&e[second][kind]);
                lost(0).max(lost(1)) > LOST_DB
            };
            let lose = errors.iter().filter(loses).count();
            Some(DirectionSummary {
                design,
                ribs_db: spread(0, &rms)?,
                grain_db: spread(1, &rms)?,
                worst_db: spread(0, &worst)?,
                lose,
                materials: errors.len(),
            })
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write as _;

    /// Claim: the compiler's table holds the factors of the committed corpus. To write it anew:
    /// `ASPERITY_BLESS=1 cargo test -p asperity-experiments --lib the_table_of_directions`.
    #[test]
    fn the_table_of_directions_is_that_of_the_corpus() {
        let constants = Constants::embedded(ConstantSet::Calibrated).unwrap();
        let physical = reference::physical().unwrap();
        let mut directions = reference::directions().unwrap();
        directions.sort_by(|a, b| a.name.cmp(&b.name));
        let mut text = String::from(HEAD);
        for direction in directions {
            let across = physical[&direction.name];
            let relief = Relief::new(&constants, across, direction.along(&across));
            let with = 2.0 * direction.mu_ratio / (1.0 + direction.nap);
            writeln!(
                text,
                "\n[[material]]\nname = {:?} # {}\n[material.direction]\npower_ratio = {:.3}\n\
                 speed_ratio = {:.3}\nmu_forward = {with:.3}\nmu_backward = {:.3}",
                direction.name,
                direction.axis,
                relief.power,
                relief.speed,
                with * direction.nap
            )
            .unwrap();
        }
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../compiler/model/directions.toml"
        );
        if std::env::var_os("ASPERITY_BLESS").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        let committed = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            committed == text,
            "directions.toml is not that of the corpus"
        );
    }

    const HEAD: &str = "\
# How strokes along an axis of a material differ from those across, in the names of `Direction`; what lies along the axis
# stands behind the name. Fitted to the corpus's generator with the relief that `training/corpora/directions.toml` states
# along the axis; all heights along are estimates. Written by `the_table_of_directions_is_that_of_the_corpus`.
";

    fn relief(constants: &Constants, along: Physical) -> Relief<'_> {
        let across = Physical {
            wavelength_mm: 1.0,
            spread_octaves: 0.3,
            height_um: 50.0,
            modulus_mpa: 10.0,
            loss_factor: 0.1,
            mu: 0.4,
        };
        Relief::new(constants, across, along)
    }

    /// Claim: where nothing is along them, ribs are met at v·|cos θ|, with the level of that speed.
    #[test]
    fn ribs_are_crossed_at_the_cosine() {
        let constants = Constants::embedded(ConstantSet::Calibrated).unwrap();
        let smooth = Physical {
            wavelength_mm: 0.05,
            spread_octaves: 1.0,
            height_um: 0.05,
            modulus_mpa: 10.0,
            loss_factor: 0.1,
            mu: 0.4,
        };
        let relief = relief(&constants, smooth);
        for degrees in [0.0, 30.0, 45.0, 60.0] {
            let c = libm::cos(TAU * degrees / 360.0);
            let angle = (c * c, 1.0 - c * c);
            let (truth, found) = (
                relief.ribs(120.0, angle),
                relief.rendered(Design::Powers, 120.0, angle),
            );
            let peak = |power: &Spectrum| {
                (0..POINTS)
                    .max_by(|&a, &b| power[a].total_cmp(&power[b]))
                    .unwrap()
            };
            let ratio = peak(&found) as f64 / peak(&truth) as f64;
            assert!((ratio - 1.0).abs() < 0.05, "{degrees}: {ratio}");
        }
    }

    /// Claim: factors lose no more than 2 dB against a second grid on any material, and far less than no direction does.
    #[test]
    fn a_second_grid_is_not_worth_its_cost() {
        let summaries = measure().unwrap();
        let of = |design| {
            summaries
                .iter()
                .find(|summary| summary.design == design)
                .unwrap()
        };
        let (none, powers) = (of(Design::None), of(Design::Powers));
        assert_eq!((powers.lose, powers.materials), (0, 83));
        assert!(none.lose > 8 && none.ribs_db.p95 > 3.0 * powers.ribs_db.p95);
        assert!(powers.ribs_db.median < of(Design::Ellipses).ribs_db.median);
    }
}
