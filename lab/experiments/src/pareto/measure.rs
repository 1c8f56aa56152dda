//! Every variant on every material, measured in parallel, and the summaries.

use super::{
    accuracy::{Errors, Truth},
    contact::{self, ContactSummary},
    cost::{self, CountError, Counter},
    direction::{self, DirectionSummary},
    reduced_material::ReducedMaterial,
    summary::{Measurement, VariantSummary, summarised},
};
use asperity::{
    model::{ModelGrid, Numerator, TextureModel},
    passes::reduce::{self, Fidelity, Reference, order::Fits},
};
use asperity_corpus::CorpusError;
use asperity_kernels::{
    design::{Design, Order, Variant, variants},
    workload::Orders,
};
use rayon::prelude::*;
use std::collections::HashMap;

/// Selection and length of the measurements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Seed of motions, excitations and pairs.
    pub seed: u64,
    /// Length of the motion that each design renders on each material, s.
    pub seconds: f64,
    /// True to count instructions.
    pub instructions: bool,
}

/// Everything that was measured.
pub struct Results {
    /// Names of the materials.
    pub materials: Vec<String>,
    /// Every variant over all materials, in the order of [`variants`].
    pub summaries: Vec<VariantSummary>,
    /// Each material as `auto` reduces it.
    pub kept: Vec<ReducedMaterial>,
    /// Contact laws with a part left out.
    pub contact: Vec<ContactSummary>,
    /// Ways to follow the direction of a stroke.
    pub direction: Vec<DirectionSummary>,
    /// The orders that instructions were counted at.
    pub common: Orders,
    /// Why instructions were not counted although they were wanted.
    pub not_counted: Option<String>,
}

/// Returns the number of times that [`measure`] calls `done`.
#[must_use]
pub fn steps(materials: usize) -> usize {
    materials + variants().len() + 2
}

/// Measures every variant on every texture.
///
/// `done` is called once for each material, for each variant, for all contact laws and for all directions, from
/// any thread.
///
/// # Errors
/// [`CorpusError`] of the committed corpus.
pub fn measure(
    textures: &[TextureModel],
    options: &Options,
    done: impl Fn() + Sync,
) -> Result<Results, CorpusError> {
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
            let mine: Vec<&Measurement> = measured.iter().map(|m| &m.rows[index]).collect();
            let instructions = instructions(variant, &mine, common, &mut count);
            done();
            summarised(variant.clone(), &mine, instructions)
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
    let contact = contact::measure(|numbers| {
        wanted?;
        let counted = cost::per_tick(numbers);
        counted
            .map_err(|error| failed.get_or_insert(error.to_string()))
            .ok()
    });
    done();
    let direction = direction::measure()?;
    done();
    Ok(Results {
        contact,
        direction,
        materials: textures.iter().map(|t| t.name.clone()).collect(),
        summaries,
        kept,
        common,
        not_counted: failed,
    })
}

/// Measurements on a material.
struct Measured {
    /// A row for each variant.
    rows: Vec<Measurement>,
    kept: ReducedMaterial,
}

impl Measured {
    fn of(index: usize, texture: &TextureModel, variants: &[Variant], options: &Options) -> Self {
        let seed = options.seed.wrapping_add(index as u64);
        let truth = Truth::new(&texture.grid, options.seconds, seed);
        let grids = Grids::of(&texture.grid);
        let rows = variants
            .iter()
            .map(|Variant { design, .. }| {
                let grid = grids.at(design.order);
                let errors = match (&truth, &grid) {
                    (Some(truth), Some(grid)) => truth.errors(design, grid),
                    _ => Errors::default(),
                };
                let grid = grid.unwrap_or_else(|| texture.grid.clone());
                Measurement {
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
            kept: ReducedMaterial {
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

/// The orders that most materials have; where several are equally common, the largest.
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
fn costed(variant: &Variant, row: &Measurement, common: Orders) -> Orders {
    match variant.design.order {
        Order::Full => common,
        Order::WithZero(_) | Order::AllPole(_) | Order::Auto => row.orders,
    }
}

fn instructions(
    variant: &Variant,
    rows: &[&Measurement],
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

// A grid at every order that is compared.

/// A grid, prepared for every order.
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

    /// The grid at an order; `None` where it has no such form. An order above the grid's own
    /// gives the grid's own.
    fn at(&self, order: Order) -> Option<ModelGrid> {
        match order {
            Order::Full => Some(self.full.clone()),
            Order::Auto => Some(self.auto.clone()),
            Order::WithZero(order) => self.with_zero.as_ref()?.at(order),
            Order::AllPole(order) => self.all_pole.as_ref()?.at(order),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::sources::builtin;

    #[test]
    fn the_same_seed_gives_the_same_errors_whatever_the_threads() {
        let textures = [builtin::texture(), builtin::texture()];
        let options = Options {
            seed: 5,
            seconds: 0.2,
            instructions: false,
        };
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap()
                .install(|| measure(&textures, &options, || ()))
                .unwrap()
        };
        let (one, two) = (run(1), run(2));
        assert_eq!(one.summaries, two.summaries);
        assert_eq!(one.summaries.len(), variants().len());
    }
}
