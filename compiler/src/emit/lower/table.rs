//! The distinct models of a grid in the codes of the format.

use super::error::LowerError;
use asperity_formats::{LsfCode, limits};
use asperity_texture::{
    model::{GridVertex, ModelGrid, Numerator},
    signal::{
        lsf,
        spectrum::{ArmaModel, ERROR_POINTS, ErrorBand},
    },
};

/// The distinct models of a grid, in order of first use.
pub(super) struct ModelTable {
    pub(super) entries: Vec<Entry>,
    /// Entry of every vertex.
    pub(super) model_of: Vec<usize>,
    pub(super) ma_order: usize,
    /// Log-spectral error of LSF quantisation at every vertex, dB.
    pub(super) errors_db: Vec<f64>,
}

/// A model as an asset stores it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Entry {
    pub(super) lsf: Vec<LsfCode>,
    pub(super) ma_lsf: Vec<LsfCode>,
    pub(super) gain_bits: u32,
}

impl ModelTable {
    /// The models of all vertices.
    ///
    /// # Errors
    /// [`LowerError`] for frequencies that an asset cannot hold.
    pub(super) fn of(grid: &ModelGrid) -> Result<Self, LowerError> {
        let mut table = Self {
            entries: Vec::new(),
            model_of: Vec::new(),
            ma_order: 0,
            errors_db: Vec::new(),
        };
        let band = ErrorBand::new(grid.sample_rate_hz, ERROR_POINTS);
        for (index, vertex) in grid.vertices.iter().enumerate() {
            let has_numerator = grid.numerator == Numerator::Lsf;
            let ma_lsf = vertex.ma_lsf_rad.as_deref().filter(|_| has_numerator);
            let entry = Entry {
                lsf: codes(index, "lsf_rad", &vertex.lsf_rad)?,
                ma_lsf: codes(index, "ma_lsf_rad", ma_lsf.unwrap_or_default())?,
                gain_bits: if has_numerator {
                    vertex.gain as f32
                } else {
                    1.0
                }
                .to_bits(),
            };
            check_gap(index, &entry.lsf)?;
            table.ma_order = table.ma_order.max(entry.ma_lsf.len());
            // An edge model has the frequencies of the vertex that it continues, hence its error.
            let twin = grid.vertices[..index].iter().position(|other| {
                other.lsf_rad == vertex.lsf_rad && other.ma_lsf_rad == vertex.ma_lsf_rad
            });
            table.errors_db.push(match twin {
                Some(twin) => table.errors_db[twin],
                None => quantisation_error_db(&band, grid, vertex, &entry),
            });
            let known = table.entries.iter().position(|other| *other == entry);
            table.model_of.push(known.unwrap_or(table.entries.len()));
            if known.is_none() {
                table.entries.push(entry);
            }
        }
        Ok(table)
    }
}

fn codes(vertex: usize, field: &'static str, lsf_rad: &[f64]) -> Result<Vec<LsfCode>, LowerError> {
    lsf_rad
        .iter()
        .enumerate()
        .map(|(index, &value)| {
            LsfCode::from_rad(value).ok_or(LowerError::Frequency {
                vertex,
                field,
                index,
                value,
            })
        })
        .collect()
}

fn check_gap(vertex: usize, lsf: &[LsfCode]) -> Result<(), LowerError> {
    let step = std::f64::consts::PI / 65536.0;
    let least = i32::from(limits::MIN_LSF_GAP_CODES);
    let bits = lsf.iter().map(|code| i32::from(code.to_bits()));
    let mut previous = 0;
    for code in bits.chain([65536]) {
        if code - previous < least {
            return Err(LowerError::Gap {
                vertex,
                gap_rad: f64::from(code - previous) * step,
                least_rad: f64::from(least) * step,
            });
        }
        previous = code;
    }
    Ok(())
}

/// Distance of a vertex's spectrum from that of its codes, at equal level.
fn quantisation_error_db(
    band: &ErrorBand,
    grid: &ModelGrid,
    vertex: &GridVertex,
    entry: &Entry,
) -> f64 {
    let angles = |codes: &[LsfCode]| codes.iter().map(|c| c.to_rad()).collect::<Vec<_>>();
    let mut exact = ArmaModel::at_vertex(grid, vertex);
    exact.level_m_s2 = 1.0;
    let mut rounded = exact.clone();
    rounded.a = lsf::to_polynomial(&angles(&entry.lsf));
    if grid.numerator == Numerator::Lsf {
        rounded.b = lsf::to_polynomial(&angles(&entry.ma_lsf));
    }
    band.distance_db(&exact, &rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_measured_between_neighbours_and_at_both_ends() {
        let step = std::f64::consts::PI / 65536.0;
        let codes = |codes: &[u32]| -> Vec<LsfCode> {
            let lsf_rad = codes.iter().map(|&code| f64::from(code) * step);
            lsf_rad.map(|x| LsfCode::from_rad(x).unwrap()).collect()
        };
        let least = u32::from(limits::MIN_LSF_GAP_CODES);
        let top = 65536 - least;
        assert!(check_gap(0, &codes(&[least, 2 * least, top])).is_ok());
        for (fault, gap) in [
            ([least - 1, 20_000, top], least - 1),
            ([20_000, 20_000 + least - 2, top], least - 2),
            ([least, 20_000, top + 1], least - 1),
        ] {
            let error = check_gap(7, &codes(&fault)).unwrap_err();
            let LowerError::Gap {
                vertex,
                gap_rad,
                least_rad,
            } = error
            else {
                panic!("{error}");
            };
            assert_eq!(vertex, 7);
            assert!((gap_rad - f64::from(gap) * step).abs() < 1e-12, "{gap_rad}");
            assert!((least_rad - f64::from(least) * step).abs() < 1e-12);
        }
    }
}
