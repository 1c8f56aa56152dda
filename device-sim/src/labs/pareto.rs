//! Every variant on every material, in parallel, and what that amounts to.

use super::accuracy::{Errors, Truth};
use super::cost::{self, CountError, Counter};
use super::held_out::{self, Prediction};
use super::statistics::{Spread, percentile};
use asperity::{
    model::{ModelGrid, Numerator, TextureModel},
    reduce::{self, BUDGET_DB, Fidelity, Reference, order::Fits},
};
use asperity_kernels::{
    design::{Design, Order, Variant, variants},
    workload::Orders,
};
use rayon::prelude::*;
use std::collections::HashMap;

/// What to measure, and how thoroughly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Seed of motions, excitations and pairs.
    pub seed: u64,
    /// Motion a material and design, s.
    pub seconds: f64,
    /// Whether instructions are counted.
    pub instructions: bool,
    /// Whether kernels are timed beside the default.
    pub time: bool,
}

/// One variant on one material.
#[derive(Debug, Clone)]
pub struct Row {
    /// Index of the material.
    pub material: usize,
    /// Index of the variant.
    pub variant: usize,
    /// Orders of its filter.
    pub orders: Orders,
    /// Bytes of the asset.
    pub bytes: Option<usize>,
    /// Its errors.
    pub errors: Errors,
}

/// One variant over all materials.
#[derive(Debug, Clone)]
pub struct Summary {
    /// The variant.
    pub variant: Variant,
    /// Executed instructions a tick of mixing, conversion and synthesis: at the commonest
    /// orders, of `auto` the mean over the materials.
    pub instructions: Option<f64>,
    /// Time over that of the default.
    pub time_ratio: Option<f64>,
    /// Bytes of an asset, the median.
    pub bytes: Option<usize>,
    /// RMS log-spectral distortion at rest, dB.
    pub distortion_db: Option<Spread>,
    /// Absolute level error at rest, dB.
    pub level_db: Option<Spread>,
    /// Absolute level error of blocks while moving, dB.
    pub moving_level_db: Option<Spread>,
    /// Difference of samples while moving, relative, dB; over the materials.
    pub moving_error_db: Option<Spread>,
    /// RMS under alternation above the louder model, dB.
    pub alternation_db: Option<Spread>,
    /// Share of places whose filter is not stable.
    pub unstable: f64,
    /// Materials with such a place.
    pub unstable_materials: usize,
}

impl Summary {
    /// Whether it stays within the budget at rest: stable everywhere, and 95 % of all
    /// places within 0.5 dB.
    #[must_use]
    pub fn is_within_budget(&self) -> bool {
        self.unstable == 0.0 && self.distortion_db.is_some_and(|d| d.p95 <= BUDGET_DB.0)
    }
}

/// What `--fidelity auto` makes of one material.
#[derive(Debug, Clone)]
pub struct Kept {
    /// What was dropped, and what that costs.
    pub report: reduce::Report,
    /// Orders of the whole texture and of what is kept.
    pub orders: (Orders, Orders),
    /// Instructions of the default kernel on both.
    pub instructions: Option<(f64, f64)>,
    /// Bytes of both.
    pub bytes: Option<(usize, usize)>,
}

impl Kept {
    /// Instructions of what is kept over those of the whole texture.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.instructions.map(|(full, kept)| kept / full)
    }

    /// Whether it is within the budget.
    #[must_use]
    pub fn is_within_budget(&self) -> bool {
        self.report.p95_db <= BUDGET_DB.0 && self.report.worst_db <= BUDGET_DB.1
    }
}

/// All of it.
pub struct Results {
    /// Names of the materials.
    pub materials: Vec<String>,
    /// Every variant on every material.
    pub rows: Vec<Row>,
    /// Every variant over all materials, in the order of [`variants`].
    pub summaries: Vec<Summary>,
    /// Predictions of held-out models, a list a material.
    pub held_out: Vec<Vec<Prediction>>,
    /// Exponents of speed and force, one pair a material.
    pub exponents: Vec<(f64, f64)>,
    /// What `auto` keeps, one a material.
    pub kept: Vec<Kept>,
    /// The orders that instructions were counted at.
    pub common: Orders,
    /// Why no instructions were counted, where they were wanted.
    pub not_counted: Option<String>,
}

/// How many times `done` is called by [`measure`].
#[must_use]
pub fn steps(materials: usize) -> usize {
    materials + variants().len()
}

/// Measures every variant on every texture; `done` is called once a material and once a
/// variant, from any thread.
#[must_use]
pub fn measure(textures: &[TextureModel], options: &Options, done: impl Fn() + Sync) -> Results {
    let variants = variants();
    let measured: Vec<Measured> = textures
        .par_iter()
        .enumerate()
        .map(|(index, texture)| {
            let one = Measured::of(index, texture, &variants, options);
            done();
            one
        })
        .collect();
    let common = commonest(textures);
    let counter = Counter::default();
    let wanted = options.instructions.then_some(&counter);
    let rows: Vec<Row> = measured.iter().flat_map(|m| m.rows.clone()).collect();
    let mut failed = None;
    let mut count = |design: &Design, orders: Orders| {
        let counted = wanted?.instructions(design, orders);
        counted.unwrap_or_else(|error: CountError| {
            failed.get_or_insert(error.to_string());
            None
        })
    };
    let summaries = variants
        .iter()
        .enumerate()
        .map(|(index, variant)| {
            let mine: Vec<&Row> = rows.iter().filter(|row| row.variant == index).collect();
            let instructions = instructions(variant, &mine, common, &mut count);
            let mut summary = summarised(variant.clone(), &mine);
            summary.instructions = instructions;
            if options.time {
                let orders = mine
                    .first()
                    .map_or(common, |row| costed(variant, row, common));
                summary.time_ratio = cost::time_ratio(&variant.design, orders);
            }
            done();
            summary
        })
        .collect();
    let kept = measured
        .iter()
        .map(|m| {
            let mut kept = m.kept.clone();
            kept.instructions =
                count(&Design::DEFAULT, kept.orders.0).zip(count(&Design::DEFAULT, kept.orders.1));
            kept
        })
        .collect();
    Results {
        materials: textures.iter().map(|t| t.name.clone()).collect(),
        rows,
        summaries,
        exponents: measured.iter().map(|m| m.exponents).collect(),
        kept,
        held_out: measured.into_iter().map(|m| m.held_out).collect(),
        common,
        not_counted: failed,
    }
}

/// Of one material.
struct Measured {
    rows: Vec<Row>,
    held_out: Vec<Prediction>,
    exponents: (f64, f64),
    kept: Kept,
}

impl Measured {
    fn of(index: usize, texture: &TextureModel, variants: &[Variant], options: &Options) -> Self {
        let seed = options.seed.wrapping_add(index as u64);
        let truth = Truth::new(&texture.grid, options.seconds, seed);
        let grids = Grids::of(&texture.grid);
        let rows = variants
            .iter()
            .enumerate()
            .map(|(variant, Variant { design, .. })| {
                let grid = grids.at(design.order);
                let errors = match (&truth, &grid) {
                    (Some(truth), Some(grid)) => truth.errors(design, grid),
                    _ => Errors::default(),
                };
                let grid = grid.unwrap_or_else(|| texture.grid.clone());
                Row {
                    material: index,
                    variant,
                    orders: cost::orders(&grid),
                    bytes: cost::bytes(texture, &grid, design.lsf_bits),
                    errors,
                }
            })
            .collect();
        let reduction = reduce::reduce(texture, Fidelity::Auto);
        let bytes = |texture: &TextureModel| cost::bytes(texture, &texture.grid, 16);
        Self {
            rows,
            held_out: held_out::predictions(&texture.grid),
            exponents: held_out::exponents(&texture.grid),
            kept: Kept {
                report: reduction.report,
                orders: (
                    cost::orders(&texture.grid),
                    cost::orders(&reduction.texture.grid),
                ),
                instructions: None,
                bytes: bytes(texture).zip(bytes(&reduction.texture)),
            },
        }
    }
}

/// A grid at every order that is compared.
struct Grids<'a> {
    full: &'a ModelGrid,
    with_zero: Option<Fits<'a>>,
    all_pole: Option<Fits<'a>>,
    auto: ModelGrid,
}

impl<'a> Grids<'a> {
    fn of(full: &'a ModelGrid) -> Self {
        Self {
            full,
            with_zero: Fits::new(full, Numerator::Nyquist),
            all_pole: Fits::new(full, Numerator::None),
            auto: Reference::new(full).map_or_else(
                || full.clone(),
                |reference| reduce::least_order(full, &reference),
            ),
        }
    }

    /// `None` where the grid has no such form; an order above its own is its own.
    fn at(&self, order: Order) -> Option<ModelGrid> {
        match order {
            Order::Full => Some(self.full.clone()),
            Order::Auto => Some(self.auto.clone()),
            Order::WithZero(order) => self.with_zero.as_ref()?.at(order),
            Order::AllPole(order) => self.all_pole.as_ref()?.at(order),
        }
    }
}

/// Orders that most materials have; of several such, the largest.
fn commonest(textures: &[TextureModel]) -> Orders {
    let mut counts: HashMap<Orders, usize> = HashMap::new();
    for texture in textures {
        *counts.entry(cost::orders(&texture.grid)).or_default() += 1;
    }
    counts
        .into_iter()
        .max_by_key(|&(orders, count)| (count, orders))
        .map_or(
            Orders {
                poles: 20,
                zeros: 0,
                nyquist: true,
            },
            |(orders, _)| orders,
        )
}

/// Orders at which a variant's cost is counted.
fn costed(variant: &Variant, row: &Row, common: Orders) -> Orders {
    match variant.design.order {
        Order::Full => common,
        Order::WithZero(_) | Order::AllPole(_) | Order::Auto => row.orders,
    }
}

fn instructions(
    variant: &Variant,
    rows: &[&Row],
    common: Orders,
    count: &mut impl FnMut(&Design, Orders) -> Option<f64>,
) -> Option<f64> {
    if variant.design.order != Order::Auto {
        return count(&variant.design, costed(variant, rows.first()?, common));
    }
    let counts: Vec<f64> = rows
        .iter()
        .map(|row| count(&variant.design, row.orders))
        .collect::<Option<_>>()?;
    Some(counts.iter().sum::<f64>() / counts.len() as f64)
}

fn summarised(variant: Variant, rows: &[&Row]) -> Summary {
    let all = |list: fn(&Errors) -> &Vec<f64>| -> Option<Spread> {
        let values: Vec<f64> = rows
            .iter()
            .flat_map(|row| list(&row.errors).iter().map(|v| v.abs()))
            .collect();
        Spread::of(&values)
    };
    let signed = |list: fn(&Errors) -> &Vec<f64>| -> Option<Spread> {
        let values: Vec<f64> = rows
            .iter()
            .flat_map(|row| list(&row.errors).iter().copied())
            .collect();
        Spread::of(&values)
    };
    let moving: Vec<f64> = rows.iter().map(|row| row.errors.moving_error_db).collect();
    let places: usize = rows.iter().map(|row| row.errors.places).sum();
    let unstable: usize = rows.iter().map(|row| row.errors.unstable).sum();
    let bytes: Vec<f64> = rows
        .iter()
        .filter_map(|row| row.bytes.map(|b| b as f64))
        .collect();
    Summary {
        variant,
        instructions: None,
        time_ratio: None,
        bytes: percentile(&bytes, 0.5).map(|b| b as usize),
        distortion_db: all(|e| &e.distortion_db),
        level_db: all(|e| &e.level_db),
        moving_level_db: all(|e| &e.moving_level_db),
        moving_error_db: Spread::of(&moving),
        alternation_db: signed(|e| &e.alternation_db),
        unstable: unstable as f64 / places.max(1) as f64,
        unstable_materials: rows.iter().filter(|row| row.errors.unstable > 0).count(),
    }
}

/// Smaller differences are none: 2 %.
const TIE: f64 = 1.02;

/// Whether no other point is as small in both coordinates and smaller in one, ties within
/// 2 % apart.
#[must_use]
pub fn on_front(points: &[(f64, f64)], index: usize) -> bool {
    let (x, y) = points[index];
    !points
        .iter()
        .any(|&(a, b)| a <= x * TIE && b <= y * TIE && (a * TIE < x || b * TIE < y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::builtin;

    #[test]
    fn the_same_seed_gives_the_same_errors_whatever_the_threads() {
        let textures = [builtin::texture(), builtin::texture()];
        let options = Options {
            seed: 5,
            seconds: 0.2,
            instructions: false,
            time: false,
        };
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap()
                .install(|| measure(&textures, &options, || ()))
        };
        let (one, two) = (run(1), run(2));
        for (x, y) in one.rows.iter().zip(&two.rows) {
            assert_eq!(x.errors, y.errors);
        }
        assert_eq!(one.rows.len(), 2 * variants().len());
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points = [
            (1.0, 5.0),
            (2.0, 2.0),
            (3.0, 1.99),
            (4.0, 1.0),
            (4.01, 1.01),
        ];
        let found: Vec<bool> = (0..5).map(|i| on_front(&points, i)).collect();
        assert_eq!(found, [true, true, false, true, true]);
    }
}
