//! How far a reduced grid may be from the whole one, and how far it is.

use crate::{
    interpolate::{Field, Place, places},
    model::ModelGrid,
    reflection,
    spectrum::{Angles, ArmaModel, ERROR_BAND_HZ},
};
use std::f64::consts::TAU;

/// Largest RMS log-spectral distance over 10–450 Hz, level included, that `auto` accepts,
/// dB: at 95 % of the places, and at the worst. Silent places count as without error. An amplitude is told from another at 1.6 dB
/// by the best of observers, and at 2.2 to 2.5 dB by most.
pub const BUDGET_DB: (f64, f64) = (0.5, 1.0);
/// Kept below the budget for what lowering rounds, dB.
const ROOM_DB: f64 = 0.01;
/// Frequencies at which spectra are compared: four hertz apart.
const POINTS: usize = 111;
/// Quieter than the loudest vertex by this, a place is silent: 40 dB.
const SILENT: f64 = 0.01;

/// Where a grid is compared with another.
#[derive(Debug, Clone)]
struct Compared {
    /// mm/s and N.
    at: (f64, f64),
    /// dB, where it sounds.
    log_spectrum: Option<Vec<f64>>,
}

/// The whole grid, at all places where another is compared with it.
#[derive(Debug, Clone)]
pub struct Reference<'a> {
    grid: &'a ModelGrid,
    angles: Angles,
    places: Vec<Compared>,
}

/// Distances of a grid, one a place, dB; infinite where it is not stable or sounds where
/// there is silence.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Distances(pub(super) Vec<f64>);

impl Distances {
    /// The distance that 95 % of the places keep, and the largest, dB.
    #[must_use]
    pub fn summary(&self) -> (f64, f64) {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let rank = (share * sorted.len() as f64).ceil() as usize;
            sorted.get(rank.max(1) - 1).copied().unwrap_or(0.0)
        };
        (at(0.95), at(1.0))
    }

    /// Whether they leave room within [`BUDGET_DB`] for rounding.
    #[must_use]
    pub fn are_within_budget(&self) -> bool {
        let (p95_db, worst_db) = self.summary();
        p95_db <= BUDGET_DB.0 - ROOM_DB && worst_db <= BUDGET_DB.1 - ROOM_DB
    }

    /// The distances, one a place.
    #[must_use]
    pub fn into_inner(self) -> Vec<f64> {
        self.0
    }
}

impl<'a> Reference<'a> {
    /// Prepares a grid; `None` for one without area.
    #[must_use]
    pub fn new(grid: &'a ModelGrid) -> Option<Self> {
        let rate_hz = grid.sample_rate_hz;
        let (low, high) = ERROR_BAND_HZ;
        let high = high.min(0.45 * rate_hz);
        let step = (high - low) / (POINTS - 1) as f64;
        let angles = Angles::new((0..POINTS).map(|n| TAU * (low + n as f64 * step) / rate_hz));
        let field = Field::new(grid);
        let silent_m_s2 = SILENT * field.loudest_m_s2();
        let places = places(grid)
            .into_iter()
            .map(|at| {
                let model = field.mixture(&field.locate(at.0, at.1)?);
                let sounds = model.level_m_s2 > silent_m_s2;
                Some(Compared {
                    at,
                    log_spectrum: sounds.then(|| log_spectrum(&angles, &model)),
                })
            })
            .collect::<Option<_>>()?;
        Some(Self {
            grid,
            angles,
            places,
        })
    }

    /// Speed and force of every place.
    pub(super) fn at(&self) -> impl Iterator<Item = (f64, f64)> {
        self.places.iter().map(|place| place.at)
    }

    /// Distance of a mixture from the whole grid at a place, dB.
    pub(super) fn distance(&self, index: usize, field: &Field<'_>, place: &Place) -> f64 {
        let model = field.mixture(place);
        match &self.places[index].log_spectrum {
            Some(truth) if reflection::is_stable(&model.a) => {
                let found = log_spectrum(&self.angles, &model);
                let squares = truth.iter().zip(&found).map(|(x, y)| (x - y) * (x - y));
                let rms = (squares.sum::<f64>() / truth.len() as f64).sqrt();
                // Of silence there is no spectrum.
                if rms.is_nan() { f64::INFINITY } else { rms }
            }
            Some(_) => f64::INFINITY,
            // A level counts relative to its own grid: under another numerator the same
            // vibration has another.
            None if model.level_m_s2 <= 2.0 * SILENT * field.loudest_m_s2() => 0.0,
            None => f64::INFINITY,
        }
    }

    /// Distances at all places; `None` for a grid without area.
    #[must_use]
    pub fn distances(&self, grid: &ModelGrid) -> Option<Distances> {
        let field = Field::new(grid);
        self.places
            .iter()
            .enumerate()
            .map(
                |(
                    index,
                    &Compared {
                        at: (speed, force), ..
                    },
                )| {
                    Some(self.distance(index, &field, &field.locate(speed, force)?))
                },
            )
            .collect::<Option<_>>()
            .map(Distances)
    }

    /// Whether a grid with the same vertices and triangles stays within the budget; gives up
    /// at the first place that decides against it.
    #[must_use]
    pub fn is_within_budget(&self, grid: &ModelGrid) -> bool {
        debug_assert_eq!(grid.triangles, self.grid.triangles);
        let count = self.places.len();
        let mut may_exceed = count - (0.95 * count as f64).ceil() as usize;
        let field = Field::new(grid);
        for (index, compared) in self.places.iter().enumerate() {
            let (speed, force) = compared.at;
            let Some(place) = field.locate(speed, force) else {
                return false;
            };
            let distance_db = self.distance(index, &field, &place);
            if distance_db > BUDGET_DB.0 - ROOM_DB {
                if distance_db > BUDGET_DB.1 - ROOM_DB || may_exceed == 0 {
                    return false;
                }
                may_exceed -= 1;
            }
        }
        true
    }
}

fn log_spectrum(angles: &Angles, model: &ArmaModel) -> Vec<f64> {
    let level_db = 20.0 * libm::log10(model.level_m_s2);
    angles
        .squared_magnitudes(&model.b)
        .into_iter()
        .zip(angles.squared_magnitudes(&model.a))
        .map(|(b, a)| level_db + 10.0 * libm::log10(b / a))
        .collect()
}
