//! What strokes over a field of heights meet, as a grid of models with a direction.

use crate::learned::{DecodedGrid, description::GridDescription, texture};
use asperity_surface::{
    contact::{Contact, Tip},
    direction,
    stroke::Strokes,
    stylus::Support,
    vibration::{self, FLOOR, ORDER, POINTS, SAMPLE_RATE_HZ, Spectrum},
    wave_spectrum::{LineSpectrum, WaveSpectrum},
};
use asperity_texture::model::{Direction, ModelGrid};
use std::f64::consts::FRAC_PI_2;

/// Speeds, mm/s, and forces, N, of the models.
const SPEEDS_MM_S: [f64; 16] = [
    20.0, 23.5, 27.5, 32.3, 38.0, 44.6, 52.4, 61.5, 72.2, 84.8, 99.6, 117.0, 137.4, 161.4, 189.5,
    222.5,
];
const FORCES_N: [f64; 3] = [0.4, 1.0, 2.4];
const MAX_SPEED_MM_S: f64 = 240.0;
const MAX_FORCE_N: f64 = 3.2;
/// The stroke by which levels and direction are said, mm/s and N, and which of the forces it has.
pub(super) const STROKE: (f64, f64) = (100.0, FORCES_N[STROKED]);
const STROKED: usize = 1;
/// Loss factor, of which neither a map nor words say anything.
const LOSS_FACTOR: f64 = 0.1;
/// Levels of a surface without relief, and the largest that a model has, dB re 1 m/s².
const SILENT_DB: f64 = texture::LEVEL_RANGE_DB.0;
const LOUDEST_DB: f64 = texture::LEVEL_RANGE_DB.1;
/// A direction is felt from this difference of the level, dB, and this factor of the speed.
const FELT: (f64, f64) = (1.5, 1.5);
/// Difference of the level that noise has on a map of one point, dB; it falls with the root of their number.
const CHANCE_DB: f64 = 64.0;
/// Speeds that are compared for it, over that at which the vibration has this centroid, Hz.
const SPREAD: [f64; 3] = [0.6, 1.0, 1.6];
const CENTRE_HZ: f64 = 120.0;
/// Crest factor of a vibration, and the mass of a stylus, kg, that is thrown off: it is that of the calibrated resonance on
/// Hertz's contact of 10 MPa at 1 N, 10 N/mm.
const CREST: f64 = 3.0;
const STYLUS_KG: f64 = 0.005;

/// What strokes over a field meet.
#[derive(Debug, Clone)]
pub struct Survey {
    /// The models.
    pub grid: ModelGrid,
    /// How strokes along the axis differ; `None` where nobody would feel it.
    pub direction: Option<Direction>,
    /// Level of strokes of 100 mm/s under 1 N across the axis, dB re 1 m/s².
    pub level_db: f64,
    /// The same over that along the axis, dB.
    pub anisotropy_db: f64,
    /// Spatial frequency from which spectra are continued, 1/mm.
    pub measured_to_per_mm: f64,
    /// Heights of the map across and along the axis, and those that the tip follows under 1 N.
    pub bare: [LineSpectrum; 2],
    /// As `bare`, under the tip.
    pub followed: [LineSpectrum; 2],
    /// The modulus that was taken, MPa.
    pub modulus_mpa: f64,
    /// Slowest stroke, under 0.4 N, that throws the stylus off, mm/s.
    pub thrown_mm_s: Option<f64>,
    /// Slowest stroke of the grid whose level was lowered to the largest that a model has, mm/s.
    pub limited_mm_s: Option<f64>,
}

/// A field under a tip.
pub(super) struct Stroked<'a> {
    contact: &'a Contact,
    tip: Tip,
    modulus_mpa: f64,
}

impl<'a> Stroked<'a> {
    /// A field of something of this modulus, MPa, under a tip.
    pub(super) fn new(contact: &'a Contact, tip: Tip, modulus_mpa: f64) -> Self {
        Self {
            contact,
            tip,
            modulus_mpa,
        }
    }

    fn support(&self, force_n: f64) -> Support {
        support(self.modulus_mpa, force_n)
    }

    /// Power of the heights that the tip follows under a force.
    fn waves(&self, force_n: f64) -> WaveSpectrum {
        WaveSpectrum::of(&self.contact.followed(&self.tip, &self.support(force_n)))
    }

    /// Level of a stroke of 100 mm/s under 1 N across the axis, dB re 1 m/s².
    pub(super) fn level_db(&self) -> f64 {
        let waves = self.waves(STROKE.1);
        let across = Strokes::over(&waves.along(waves.across_rad()));
        level_db(&across.power(STROKE.0, &self.support(STROKE.1)))
    }

    /// What strokes over it meet.
    pub(super) fn survey(&self, is_profile: bool) -> Survey {
        let support = self.support(STROKE.1);
        let waves = FORCES_N.map(|force_n| self.waves(force_n));
        let across_rad = waves[STROKED].across_rad();
        let turns = [0.0, FRAC_PI_2];
        let followed = turns.map(|turn| waves[STROKED].along(across_rad + turn));
        let strokes = followed.each_ref().map(Strokes::over);
        let bare = self.contact.bare();
        let [across, along] = strokes.each_ref().map(|s| s.power(STROKE.0, &support));
        let anisotropy_db = match is_profile {
            true => 0.0,
            false => level_db(&across) - level_db(&along),
        };
        let power = |n: usize| {
            let strokes = &strokes[n];
            move |speed_mm_s| strokes.power(speed_mm_s, &support)
        };
        // Where what is felt across the axis lies in the middle of the band.
        let centre_mm_s = CENTRE_HZ * STROKE.0 / centroid_hz(&across);
        let speeds =
            SPREAD.map(|factor| (factor * centre_mm_s).clamp(SPEEDS_MM_S[0], MAX_SPEED_MM_S));
        let ratios = direction::fit(&speeds, power(0), power(1));
        let felt_db = FELT.0 + CHANCE_DB / self.contact.points().sqrt();
        let turned = ratios.speed.max(1.0 / ratios.speed) > FELT.1;
        let sounds = level_db(&across) > SILENT_DB;
        let is_directed = sounds && !is_profile && (anisotropy_db > felt_db || turned);
        let axis = across_rad + FRAC_PI_2;
        let direction = is_directed.then(|| Direction {
            axis: [libm::cos(axis), libm::sin(axis), 0.0],
            power_ratio: ratios.power.min(2.0),
            speed_ratio: ratios.speed,
            ..Direction::NONE
        });
        // Across the axis; in any direction where there is none.
        let strokes_of = |waves: &WaveSpectrum| {
            let across = waves.along(across_rad);
            if is_directed || is_profile {
                return Strokes::over(&across);
            }
            Strokes::over(&across.mean(&waves.along(across_rad + FRAC_PI_2)))
        };
        let by_force = waves.each_ref().map(strokes_of);
        let (grid, limited_mm_s) = self.grid(&by_force);
        Survey {
            grid,
            direction,
            level_db: level_db(&across),
            anisotropy_db,
            measured_to_per_mm: strokes[0].measured_to_per_mm(),
            thrown_mm_s: self.thrown_mm_s(&by_force[0]),
            bare: turns.map(|turn| bare.along(across_rad + turn)),
            followed,
            modulus_mpa: self.modulus_mpa,
            limited_mm_s,
        }
    }

    /// The grid, and the slowest stroke whose level is limited, mm/s.
    fn grid(&self, by_force: &[Strokes]) -> (ModelGrid, Option<f64>) {
        let mut description = GridDescription {
            order: ORDER,
            sample_rate_hz: SAMPLE_RATE_HZ,
            speeds_mm_s: Vec::new(),
            forces_n: Vec::new(),
            max_speed_mm_s: MAX_SPEED_MM_S,
            max_force_n: MAX_FORCE_N,
        };
        let mut decoded = DecodedGrid {
            lsf_rad: Vec::new(),
            level_db: Vec::new(),
        };
        let mut limited_mm_s: Option<f64> = None;
        for (force_n, strokes) in FORCES_N.into_iter().zip(by_force) {
            for speed_mm_s in SPEEDS_MM_S {
                let power = strokes.power(speed_mm_s, &self.support(force_n));
                if level_db(&power) > LOUDEST_DB {
                    limited_mm_s = Some(limited_mm_s.map_or(speed_mm_s, |v| v.min(speed_mm_s)));
                }
                description.speeds_mm_s.push(speed_mm_s);
                description.forces_n.push(force_n);
                decoded.lsf_rad.extend(shape(&power));
                decoded.level_db.push(level_db(&power) as f32);
            }
        }
        (texture::grid(&description, &decoded), limited_mm_s)
    }

    /// Slowest speed of the grid at which an acceleration under the least force throws a stylus off.
    fn thrown_mm_s(&self, strokes: &Strokes) -> Option<f64> {
        let force_n = FORCES_N[0];
        let thrown = |speed_mm_s: &f64| {
            let level = level_db(&strokes.power(*speed_mm_s, &self.support(force_n)));
            CREST * libm::exp10(level / 20.0) > force_n / STYLUS_KG
        };
        SPEEDS_MM_S.into_iter().find(thrown)
    }
}

impl Survey {
    /// The surface as it carries the stylus in the stroke of which it tells.
    pub(super) fn support(&self) -> Support {
        support(self.modulus_mpa, STROKE.1)
    }
}

fn support(modulus_mpa: f64, force_n: f64) -> Support {
    Support {
        modulus_mpa,
        loss_factor: LOSS_FACTOR,
        force_n,
    }
}

/// LSFs of a vibration under the numerator 1 + z⁻¹.
fn shape(power: &Spectrum) -> [f32; ORDER] {
    if power.iter().sum::<f64>() <= 0.0 {
        return vibration::lsf(&[1.0; POINTS]);
    }
    let shape = vibration::without_nyquist(&vibration::normalised(power, FLOOR));
    vibration::lsf(&vibration::normalised(&shape, 0.0))
}

/// RMS of a vibration of this power, (m/s²)²/Hz, dB re 1 m/s².
fn level_db(power: &Spectrum) -> f64 {
    let width_hz = 0.5 * SAMPLE_RATE_HZ / POINTS as f64;
    let square = width_hz * power.iter().sum::<f64>();
    (10.0 * libm::log10(square.max(f64::MIN_POSITIVE))).max(SILENT_DB)
}

/// Centroid of a spectrum, Hz; that of white noise for silence.
fn centroid_hz(power: &Spectrum) -> f64 {
    let weighted = power.iter().enumerate();
    let sum: f64 = weighted.map(|(n, p)| p * vibration::freq_hz(n)).sum();
    let total: f64 = power.iter().sum();
    if total > 0.0 {
        sum / total
    } else {
        0.25 * SAMPLE_RATE_HZ
    }
}
