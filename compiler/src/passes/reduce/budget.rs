//! Error budget of a reduced grid, and its distance from the whole grid.

use asperity_texture::{
    model::{
        GridVertex, ModelGrid, Numerator,
        mixture::{BarycentricPoint, Field, Mixture, places},
    },
    signal::spectrum::{Angles, ErrorBand, rms_db},
};

/// Largest RMS log-spectral distance over 10–450 Hz, level included, that `auto` accepts, dB:
/// at 95 % of the places, and at the worst place. Silent places count as without error. The best
/// observers tell two amplitudes apart at 1.6 dB, most at 2.2 to 2.5 dB.
pub const BUDGET_DB: (f64, f64) = (0.5, 1.0);
/// Part of the budget that is left for rounding in the back end, dB.
const ROOM_DB: f64 = 0.01;
/// Frequencies at which spectra are compared: four hertz apart.
const POINTS: usize = 111;
/// A place is silent if its level, relative to the loudest vertex, is below this: 40 dB down.
const SILENT: f64 = 0.01;

/// Where a grid is compared with another.
#[derive(Debug, Clone)]
struct Compared {
    /// mm/s and N.
    at: (f64, f64),
    /// Where that is in the whole grid.
    place: BarycentricPoint,
    /// Power spectrum, where it sounds.
    power: Option<Vec<f64>>,
}

/// The whole grid, at all places where another is compared with it.
#[derive(Debug, Clone)]
pub struct Reference<'a> {
    grid: &'a ModelGrid,
    band: Band,
    places: Vec<Compared>,
}

/// The frequencies at which spectra are compared.
#[derive(Debug, Clone)]
struct Band {
    angles: Angles,
    /// 1/|1 + z⁻¹|² there.
    inverse_nyquist: Vec<f64>,
}

/// Distances of a grid from the whole one, dB, one for each place. A distance is infinite where
/// the grid is not stable, or sounds where the whole one is silent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Distances(pub(super) Vec<f64>);

impl Distances {
    /// The 95 % quantile and the largest of the distances, dB.
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

    /// Those of the places where both grids sound, if there are such, and the number of the others.
    #[must_use]
    pub fn sounding(self) -> (Option<Self>, usize) {
        let all = self.0.len();
        let finite: Vec<f64> = self.0.into_iter().filter(|db| db.is_finite()).collect();
        let silent = all - finite.len();
        ((!finite.is_empty()).then_some(Self(finite)), silent)
    }

    /// Returns true if the distances are within [`BUDGET_DB`], with room for rounding.
    #[must_use]
    pub fn are_within_budget(&self) -> bool {
        let mut tally = Tally::of(self.0.len());
        self.0.iter().all(|&distance_db| tally.admits(distance_db))
    }

    /// The distances, one a place.
    #[must_use]
    pub fn into_inner(self) -> Vec<f64> {
        self.0
    }
}

/// Counts the places beyond the 95 % budget, which at most one place in twenty may be.
pub(super) struct Tally {
    may_exceed: usize,
}

impl Tally {
    /// A tally for this many places.
    pub(super) fn of(places: usize) -> Self {
        Self {
            may_exceed: places - (0.95 * places as f64).ceil() as usize,
        }
    }

    /// Returns true if the budget still allows another place at this distance, with room for rounding.
    pub(super) fn admits(&mut self, distance_db: f64) -> bool {
        if distance_db <= BUDGET_DB.0 - ROOM_DB {
            return true;
        }
        let admitted = distance_db <= BUDGET_DB.1 - ROOM_DB && self.may_exceed > 0;
        self.may_exceed = self.may_exceed.saturating_sub(1);
        admitted
    }
}

impl<'a> Reference<'a> {
    /// Prepares a grid. `None` for a grid without area.
    #[must_use]
    pub fn new(grid: &'a ModelGrid) -> Option<Self> {
        let angles = ErrorBand::new(grid.sample_rate_hz, POINTS).angles().clone();
        let nyquist = angles.squared_magnitudes(&[1.0, 1.0]);
        let band = Band {
            inverse_nyquist: nyquist.into_iter().map(|zero| 1.0 / zero).collect(),
            angles,
        };
        let field = Field::new(grid);
        let silent_m_s2 = SILENT * field.loudest_m_s2();
        let places = places(grid)
            .into_iter()
            .map(|at| {
                let place = field.locate(at.0, at.1)?;
                let mixture = field.mixture(&place);
                let sounds = mixture.level_m_s2 > silent_m_s2;
                let power = || {
                    let inverse = band.inverse_power(&mixture, grid.numerator);
                    inverse.into_iter().map(|inverse| 1.0 / inverse).collect()
                };
                Some(Compared {
                    at,
                    place,
                    power: sounds.then(power),
                })
            })
            .collect::<Option<_>>()?;
        Some(Self { grid, band, places })
    }

    /// The triangle and the weights of every place in a grid. They are known where the grid has
    /// the triangles of the whole one.
    pub(super) fn located(
        &self,
        grid: &ModelGrid,
        field: &Field<'_>,
    ) -> Option<Vec<BarycentricPoint>> {
        let positions = |grid: &ModelGrid| -> Vec<(f64, f64)> {
            let at = |vertex: &GridVertex| (vertex.speed_mm_s, vertex.force_n);
            grid.vertices.iter().map(at).collect()
        };
        let known =
            grid.triangles == self.grid.triangles && positions(grid) == positions(self.grid);
        let locate = |compared: &Compared| {
            if known {
                Some(compared.place)
            } else {
                field.locate(compared.at.0, compared.at.1)
            }
        };
        self.places.iter().map(locate).collect()
    }

    /// Speed and force of every place.
    pub(super) fn at(&self) -> impl Iterator<Item = (f64, f64)> {
        self.places.iter().map(|place| place.at)
    }

    /// Distance of a mixture from the whole grid at a place, dB.
    pub(super) fn distance(
        &self,
        index: usize,
        field: &Field<'_>,
        place: &BarycentricPoint,
    ) -> f64 {
        let mixture = field.mixture(place);
        match &self.places[index].power {
            // Only ordered frequencies give a stable filter.
            Some(power) if is_ordered(&mixture.ar_cosines) => {
                let mut ratios = self.band.inverse_power(&mixture, field.numerator());
                for (ratio, power) in ratios.iter_mut().zip(power) {
                    *ratio *= power;
                }
                rms_db(&ratios)
            }
            Some(_) => f64::INFINITY,
            // A level is compared with the levels of its own grid, because the same vibration has
            // another level under another numerator.
            None if mixture.level_m_s2 <= 2.0 * SILENT * field.loudest_m_s2() => 0.0,
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

    /// Returns true if a grid with the same vertices and triangles stays within the budget. The search stops at the
    /// first place that decides against it.
    #[must_use]
    pub fn is_within_budget(&self, grid: &ModelGrid) -> bool {
        debug_assert_eq!(grid.triangles, self.grid.triangles);
        let field = Field::new(grid);
        let mut tally = Tally::of(self.places.len());
        let mut places = self.places.iter().enumerate();
        places.all(|(index, compared)| tally.admits(self.distance(index, &field, &compared.place)))
    }
}

/// Returns true if the cosines are of frequencies that ascend strictly inside (0, π).
fn is_ordered(cosines: &[f64]) -> bool {
    let inside = cosines.iter().all(|c| (-1.0..=1.0).contains(c));
    inside && cosines.windows(2).all(|pair| pair[0] > pair[1])
}

impl Band {
    /// The reciprocal power spectrum of a mixture, which takes no division unless the mixture has
    /// zeros of its own.
    fn inverse_power(&self, mixture: &Mixture, numerator: Numerator) -> Vec<f64> {
        let inverse_square = 1.0 / (mixture.level_m_s2 * mixture.level_m_s2);
        let mut inverse = self.angles.squared_magnitudes_of_lsf(&mixture.ar_cosines);
        match numerator {
            Numerator::None => {
                for inverse in &mut inverse {
                    *inverse *= inverse_square;
                }
            }
            Numerator::Nyquist => {
                for (inverse, zero) in inverse.iter_mut().zip(&self.inverse_nyquist) {
                    *inverse *= inverse_square * zero;
                }
            }
            Numerator::Lsf => {
                let zeros = self.angles.squared_magnitudes_of_lsf(&mixture.ma_cosines);
                for (inverse, zero) in inverse.iter_mut().zip(zeros) {
                    *inverse *= inverse_square / zero;
                }
            }
        }
        inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_where_one_grid_alone_sounds_has_no_distance_and_is_counted() {
        let all = Distances(vec![0.25, f64::INFINITY, 0.5, f64::INFINITY]);
        let (sounding, others) = all.clone().sounding();
        assert_eq!((sounding, others), (Some(Distances(vec![0.25, 0.5])), 2));
        assert_eq!(all.summary().1, f64::INFINITY);
        let silent = Distances(vec![f64::INFINITY; 3]);
        assert_eq!(silent.sounding(), (None, 3));
    }

    #[test]
    fn one_place_in_twenty_may_lie_beyond_the_first_budget_and_none_beyond_the_second() {
        let (most, worst) = (BUDGET_DB.0 - ROOM_DB, BUDGET_DB.1 - ROOM_DB);
        let with = |places: usize, beyond: usize, db: f64| {
            let mut all = vec![most; places - beyond];
            all.extend(vec![db; beyond]);
            Distances(all).are_within_budget()
        };
        assert!(with(40, 2, worst) && !with(40, 3, worst));
        assert!(with(39, 1, worst) && !with(39, 2, worst));
        assert!(!with(40, 1, worst + 1e-9) && !with(40, 1, f64::INFINITY));
        assert!(with(40, 0, 0.0) && with(1, 0, 0.0));
    }

    #[test]
    fn frequencies_are_ordered_if_they_ascend_inside_the_circle() {
        assert!(is_ordered(&[]) && is_ordered(&[0.3]) && is_ordered(&[0.9, 0.1, -0.8]));
        assert!(!is_ordered(&[0.5, 0.5]), "two at one place");
        assert!(!is_ordered(&[0.1, 0.9]) && !is_ordered(&[1.1, 0.0]));
        assert!(!is_ordered(&[f64::NAN]));
    }
}
