//! Fidelity: how much of a texture an asset keeps.
//!
//! `auto` leaves out what cannot be told apart by spectrum. It takes the smallest order with the
//! cheapest numerator ([`order`]), the fewest vertices ([`vertices`]), and the part of the taps that
//! a hand can feel ([`taps`]). The measure is what the grid renders at every vertex and in the
//! middle of every edge and triangle, compared with the whole texture.
//!
//! ```
//! use asperity::{sources::builtin, passes::reduce::{BUDGET_DB, Fidelity, reduce}};
//!
//! let whole = builtin::texture();
//! let report = reduce(&whole, Fidelity::Auto).report;
//! assert!(report.order.kept < report.order.full);
//! assert!(report.p95_db <= BUDGET_DB.0 && report.worst_db <= BUDGET_DB.1);
//! assert_eq!(reduce(&whole, Fidelity::Full).texture, whole);
//! ```

mod budget;
pub mod order;
pub mod taps;
pub mod vertices;

pub use budget::{BUDGET_DB, Reference};

use asperity_texture::model::{ModelGrid, Numerator, TapBank, TextureModel};
use order::Fits;
use serde::Serialize;
use std::{fmt, str::FromStr};

/// Fidelity of an asset to its model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fidelity {
    /// Everything.
    Full,
    /// As little as stays within [`BUDGET_DB`].
    Auto,
    /// This AR order. Where the order is lowered, a numerator of the models' own becomes 1 + z⁻¹.
    Order(usize),
}

impl FromStr for Fidelity {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const MAX: usize = asperity_formats::limits::MAX_ORDER;
        match text {
            "full" => Ok(Self::Full),
            "auto" => Ok(Self::Auto),
            _ => match text.parse() {
                Ok(order) if (1..=MAX).contains(&order) => Ok(Self::Order(order)),
                _ => Err(format!("`full`, `auto` or an order from 1 to {MAX}")),
            },
        }
    }
}

impl fmt::Display for Fidelity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full => f.write_str("full"),
            Self::Auto => f.write_str("auto"),
            Self::Order(order) => write!(f, "{order}"),
        }
    }
}

/// A count before and after.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Change {
    /// In the whole texture.
    pub full: usize,
    /// In the reduced texture.
    pub kept: usize,
}

/// Reduction report: omissions and their error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Report {
    /// Poles.
    pub order: Change,
    /// Zeros that are mixed and converted; 1 + z⁻¹ counts as none.
    pub zeros: Change,
    /// Vertices of the grid.
    pub vertices: Change,
    /// Triangles of the grid.
    pub triangles: Change,
    /// Samples of a tap trace.
    pub tap_samples: Change,
    /// 95 % quantile, over the places, of the RMS log-spectral distance from the whole texture
    /// over 10–450 Hz, level included, dB.
    pub p95_db: f64,
    /// The largest, dB.
    pub worst_db: f64,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut first = true;
        for (what, change) in [
            ("poles", self.order),
            ("zeros", self.zeros),
            ("vertices", self.vertices),
            ("triangles", self.triangles),
            ("tap samples", self.tap_samples),
        ] {
            if change.full != change.kept {
                let comma = if first { "" } else { ", " };
                write!(f, "{comma}{} of {} {what}", change.kept, change.full)?;
                first = false;
            }
        }
        if first {
            return f.write_str("everything");
        }
        write!(
            f,
            "; spectra within {:.2} dB at 95 % of the grid, {:.2} dB at worst",
            self.p95_db, self.worst_db
        )
    }
}

/// A texture at some fidelity.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// The texture.
    pub texture: TextureModel,
    /// Omissions and their error.
    pub report: Report,
}

/// The texture at a fidelity. Its grid must be tiled: a grid that is not comes back whole, and
/// lowering refuses it.
#[must_use]
pub fn reduce(texture: &TextureModel, fidelity: Fidelity) -> Reduction {
    let mut kept = texture.clone();
    let mut distance = (0.0, 0.0);
    if let Some(reference) = reference(&texture.grid, fidelity) {
        kept.grid = kept_grid(&texture.grid, &reference, fidelity);
        kept.taps = reduce_taps(&texture.taps, fidelity);
        distance = reference
            .distances(&kept.grid)
            .map_or(distance, |d| d.summary());
    }
    let report = report(texture, &kept, distance);
    Reduction {
        texture: kept,
        report,
    }
}

/// The grid that [`reduce`] keeps, whatever its taps.
#[must_use]
pub fn reduce_grid(grid: &ModelGrid, fidelity: Fidelity) -> ModelGrid {
    reference(grid, fidelity).map_or_else(
        || grid.clone(),
        |reference| kept_grid(grid, &reference, fidelity),
    )
}

/// The taps that [`reduce`] keeps of a texture whose grid is tiled.
#[must_use]
pub fn reduce_taps(bank: &TapBank, fidelity: Fidelity) -> TapBank {
    match fidelity {
        Fidelity::Full | Fidelity::Order(_) => bank.clone(),
        Fidelity::Auto => taps::audible(bank),
    }
}

/// Returns the reference for a reduced grid; `None` at full fidelity.
fn reference(grid: &ModelGrid, fidelity: Fidelity) -> Option<Reference<'_>> {
    (fidelity != Fidelity::Full)
        .then(|| Reference::new(grid))
        .flatten()
}

fn kept_grid(grid: &ModelGrid, reference: &Reference<'_>, fidelity: Fidelity) -> ModelGrid {
    match fidelity {
        Fidelity::Full => grid.clone(),
        Fidelity::Order(order) => with_order(grid, order).unwrap_or_else(|| grid.clone()),
        Fidelity::Auto => vertices::fewest(&least_order(grid, reference), reference),
    }
}

/// The grid with the fewest poles that stays within the budget, and with the cheapest numerator
/// among those. Where no such grid does, it is the grid itself.
#[must_use]
pub fn least_order(grid: &ModelGrid, reference: &Reference<'_>) -> ModelGrid {
    // A zero at half the rate replaces eight poles, so giving it up would cost more than it saves.
    let numerators: &[Numerator] = match grid.numerator {
        Numerator::Nyquist => &[Numerator::Nyquist],
        Numerator::None | Numerator::Lsf => &[Numerator::None, Numerator::Nyquist],
    };
    let within = |fits: &Fits<'_>, order: usize| {
        fits.at(order)
            .filter(|reduced| reference.is_within_budget(reduced))
    };
    let mut best: Option<ModelGrid> = None;
    for fits in numerators.iter().filter_map(|&n| Fits::new(grid, n)) {
        let largest = if fits.numerator() == grid.numerator {
            grid.order - 1
        } else {
            grid.order
        };
        // The next numerator must need fewer poles than the one before.
        let largest = best.as_ref().map_or(largest, |found| found.order - 1);
        let (mut low, mut high) = (1, largest.min(fits.largest()) + 1);
        while low < high {
            let order = low.midpoint(high);
            match within(&fits, order) {
                Some(found) => {
                    best = Some(found);
                    high = order;
                }
                None => low = order + 1,
            }
        }
    }
    best.unwrap_or_else(|| grid.clone())
}

fn with_order(grid: &ModelGrid, order: usize) -> Option<ModelGrid> {
    if order >= grid.order {
        return None;
    }
    let numerator = match grid.numerator {
        Numerator::Lsf => Numerator::Nyquist,
        other => other,
    };
    Fits::new(grid, numerator)?.at(order)
}

fn report(full: &TextureModel, kept: &TextureModel, (p95_db, worst_db): (f64, f64)) -> Report {
    let change = |count: fn(&TextureModel) -> usize| Change {
        full: count(full),
        kept: count(kept),
    };
    Report {
        order: change(|t| t.grid.order),
        zeros: change(|t| match (t.grid.numerator, t.grid.vertices.first()) {
            (Numerator::Lsf, Some(vertex)) => vertex.ma_lsf_rad.as_ref().map_or(0, Vec::len),
            _ => 0,
        }),
        vertices: change(|t| t.grid.vertices.len()),
        triangles: change(|t| t.grid.triangles.len()),
        tap_samples: change(|t| {
            t.taps
                .traces
                .first()
                .map_or(0, |trace| trace.accel_m_s2.len())
        }),
        p95_db,
        worst_db,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        emit::{lower, verify},
        sources::builtin,
    };
    use asperity_texture::model::mesh;

    #[test]
    fn a_fidelity_is_read_as_it_is_printed() {
        for text in ["full", "auto", "1", "24"] {
            assert_eq!(
                text.parse::<Fidelity>().map(|f| f.to_string()).as_deref(),
                Ok(text)
            );
        }
        assert!("25".parse::<Fidelity>().is_err() && "0".parse::<Fidelity>().is_err());
    }

    #[test]
    fn auto_is_within_its_budget_tiled_and_renders() {
        let full = builtin::texture();
        let Reduction { texture, report } = reduce(&full, Fidelity::Auto);
        assert!(report.p95_db <= BUDGET_DB.0 && report.worst_db <= BUDGET_DB.1);
        assert!(report.order.kept < report.order.full, "{report}");
        assert_eq!(mesh::check(&texture.grid), Ok(()));
        let lowered = lower::lower(&texture, None).unwrap();
        verify::verify(&texture, &lowered.bytes).unwrap();
    }

    #[test]
    fn no_smaller_order_is_within_the_budget() {
        let full = builtin::texture().grid;
        let reference = Reference::new(&full).unwrap();
        let least = least_order(&full, &reference);
        for numerator in [Numerator::None, Numerator::Nyquist] {
            let fits = Fits::new(&full, numerator).unwrap();
            for order in 1..least.order {
                let reduced = fits.at(order).unwrap();
                assert!(
                    !reference.is_within_budget(&reduced),
                    "order {order} would do"
                );
            }
        }
    }

    #[test]
    fn full_is_the_texture_itself_and_a_number_is_that_order() {
        let full = builtin::texture();
        let same = reduce(&full, Fidelity::Full);
        assert_eq!(same.texture, full);
        assert_eq!(same.report.to_string(), "everything");
        let five = reduce(&full, Fidelity::Order(5));
        assert_eq!(five.texture.grid.order, 5);
        assert_eq!(five.texture.taps, full.taps);
        assert!(five.report.worst_db > 0.0);
    }

    /// Claim: zeros that do nothing go even where no pole can.
    #[test]
    fn a_numerator_of_its_own_goes_where_every_pole_is_needed() {
        let mut grid = builtin::texture().grid;
        grid.order = 2;
        grid.numerator = Numerator::Lsf;
        for vertex in &mut grid.vertices {
            // One resonance, and the frequencies of 1.
            vertex.lsf_rad = vec![0.9, 1.1];
            vertex.ma_lsf_rad = Some(vec![
                std::f64::consts::PI / 3.0,
                2.0 * std::f64::consts::PI / 3.0,
            ]);
        }
        let least = least_order(&grid, &Reference::new(&grid).unwrap());
        assert_eq!((least.numerator, least.order), (Numerator::None, 2));
        assert!(least.vertices.iter().all(|v| v.ma_lsf_rad.is_none()));
    }

    /// Claim: frequencies out of order, which no stable filter has, are as far as can be.
    #[test]
    fn disordered_frequencies_are_in_no_budget() {
        let grid = builtin::texture().grid;
        let reference = Reference::new(&grid).unwrap();
        assert!(reference.is_within_budget(&grid));
        let mut disordered = grid.clone();
        for vertex in &mut disordered.vertices {
            vertex.lsf_rad.swap(3, 4);
        }
        let distances = reference.distances(&disordered).expect("tiled as before");
        assert_eq!(distances.summary().1, f64::INFINITY);
        assert!(!reference.is_within_budget(&disordered));
    }
}
