//! The mixture of three vertices: line spectra and levels.
//!
//! −2 cos ω and gain·σ are mixed linearly with the barycentric weights. A convex mixture of ordered
//! LSFs is ordered, so its filter is stable. Levels are mixed as RMS: mixing σ² would be 9 dB
//! (median) too loud near zero speed or force, where the edge models are silent.

use super::{
    barycentric::Barycentric,
    lsf_to_ar::LineSpectrum,
    row::{LANES, PaddedRow},
};
use crate::{
    arithmetic::{Arithmetic, Cut, Fixed, Float, Zero as _},
    capacity::Capacity,
    quantity::{
        Four, Quantity, Raw,
        unit::{ExcitationLevel, Fraction, LineCosine},
    },
};
use core::hint::black_box;

/// A level up to this, m/s², is silence; fixed point has no such level.
const SILENT_M_S2: f32 = 1.0e-9;
/// No −2 cos ω is larger.
const WIDEST: Cut = Cut::At(2.0);

/// A row in blocks of four lanes.
type Blocks<A> = [[Raw<A, LineCosine>; LANES]];

/// Mixing three rows into a fourth.
pub trait RowMixture: Arithmetic {
    /// Σ wᵢ·rowᵢ over the three rows and the row itself, which has the last weight. Ends with the
    /// shortest.
    fn mix(
        row: &mut Blocks<Self>,
        rows: [&Blocks<Self>; 3],
        weights: &[Quantity<Self, Fraction>; 4],
    );
}

impl RowMixture for Float {
    #[inline(always)]
    fn mix(
        row: &mut Blocks<Self>,
        [i, j, k]: [&Blocks<Self>; 3],
        weights: &[Quantity<Self, Fraction>; 4],
    ) {
        let [wi, wj, wk, kept] = weights.map(Four::splat);
        for (block, ((i, j), k)) in row.iter_mut().zip(i.iter().zip(j).zip(k)) {
            let [i, j, k, before] = [i, j, k, &*block].map(Four::<Self, LineCosine>::load);
            let terms = [(i, wi), (j, wj), (k, wk), (before, kept)];
            *block = Four::<Self, LineCosine>::sum_of_products(terms, WIDEST).to_array();
        }
    }
}

impl RowMixture for Fixed {
    #[inline(always)]
    fn mix(
        row: &mut Blocks<Self>,
        [i, j, k]: [&Blocks<Self>; 3],
        weights: &[Quantity<Self, Fraction>; 4],
    ) {
        let pairs = row
            .chunks_mut(2)
            .zip(i.chunks(2).zip(j.chunks(2)).zip(k.chunks(2)));
        for (blocks, ((i, j), k)) in pairs {
            // The compiler would widen weights that it sees before the loop, and a product of 64 by
            // 64 bits costs three of 32 by 32. Reading them anew costs five instructions, hence once
            // for two blocks.
            let [wi, wj, wk, kept] = *black_box(weights);
            for (block, ((i, j), k)) in blocks.iter_mut().zip(i.iter().zip(j).zip(k)) {
                for (lane, before) in block.iter_mut().enumerate() {
                    let [i, j, k] =
                        [i, j, k].map(|block| Quantity::<Self, LineCosine>(block[lane]));
                    let terms = [(i, wi), (j, wj), (k, wk), (Quantity(*before), kept)];
                    *before = Quantity::<Self, LineCosine>::sum_of_products(terms, WIDEST).0;
                }
            }
        }
    }
}

/// Model parameters to mix, a row per vertex.
#[derive(Debug, Clone)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
pub(crate) struct Vertices<S: Capacity, A: Arithmetic> {
    /// −2 cos ω of A(z)'s LSFs in the order of [`place`](super::lsf_to_ar::place).
    pub(crate) ar: S::Vertices<S::ArOrder<Raw<A, LineCosine>>>,
    /// −2 cos ω of B(z)'s LSFs.
    pub(crate) ma: S::Vertices<S::MaOrder<Raw<A, LineCosine>>>,
    /// gain·σ, m/s².
    pub(crate) levels: S::Vertices<Raw<A, ExcitationLevel>>,
}

impl<S: Capacity, A: RowMixture> Vertices<S, A> {
    /// No vertices.
    pub(crate) const EMPTY: Self = Self {
        ar: S::Vertices::ZERO,
        ma: S::Vertices::ZERO,
        levels: S::Vertices::ZERO,
    };

    /// Moves a line spectrum a `fraction` of the way to a mixture. B(z) is included where there is
    /// one.
    #[inline]
    pub(crate) fn follow(
        &self,
        spectrum: &mut LineSpectrum<A>,
        mixture: &Barycentric<A>,
        fraction: Quantity<A, Fraction>,
        has_ma: bool,
    ) {
        follow(self.ar.as_ref(), &mut spectrum.ar, mixture, fraction);
        if S::MA_ORDER > 0 && has_ma {
            follow(self.ma.as_ref(), &mut spectrum.ma, mixture, fraction);
        }
    }

    /// gain·σ of a mixture, m/s².
    #[inline]
    pub(crate) fn level(&self, mixture: &Barycentric<A>) -> Quantity<A, ExcitationLevel> {
        let level = |corner: usize| {
            let vertex = usize::from(mixture.vertices[corner]);
            let level = self.levels.as_ref().get(vertex).copied();
            mixture.weights[corner] * Quantity(level.unwrap_or_default())
        };
        (level(0) + level(1) + level(2)).above(Quantity::of(SILENT_M_S2))
    }
}

/// Moves a row a `fraction` of the way to the mixture of three rows.
#[inline(always)]
fn follow<A: RowMixture, R: AsRef<[Raw<A, LineCosine>]>>(
    rows: &[R],
    row: &mut PaddedRow<A, LineCosine>,
    mixture: &Barycentric<A>,
    fraction: Quantity<A, Fraction>,
) {
    // A triangle's corners are vertices.
    let [Some(i), Some(j), Some(k)] = mixture.vertices.map(|v| rows.get(usize::from(v))) else {
        return;
    };
    let [i, j, k] = [i, j, k].map(|row| row.as_ref().as_chunks::<4>().0);
    let [wi, wj, wk] = mixture.weights.map(|weight| fraction * weight);
    let weights = [wi, wj, wk, Quantity::whole(1) - fraction];
    // Rows are zero beyond the order: a loop of constant length costs less than a shorter one.
    A::mix(&mut row.0, [i, j, k], &weights);
}
