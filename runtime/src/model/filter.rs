//! The filter at a speed and a force: the whole way in one function.

use super::{
    assembly,
    barycentric::{Barycentric, Grid, WeightSearch},
    lsf_to_ar::LineSpectrum,
    mixture::{RowMixture, Vertices},
    orders::Orders,
    row::PaddedRow,
    scratch::Scratch,
    section_pair::SectionProduct,
};
use crate::{
    arithmetic::{Arithmetic, Scalar as _},
    capacity::Capacity,
    quantity::{
        Quantity,
        unit::{Coefficient, ExcitationLevel, Fraction, MillimetrePerSecond, Newton},
    },
};
use asperity_formats::limits::MAX_ORDER;

/// The models of a texture, prepared for queries.
#[derive(Debug, Clone)]
pub(crate) struct Models<S: Capacity, A: WeightSearch> {
    pub(crate) grid: Grid<S, A>,
    pub(crate) vertices: Vertices<S, A>,
    pub(crate) orders: Orders,
    /// b_1 of a numerator that every model shares.
    pub(crate) b1: Quantity<A, Coefficient>,
}

/// Coefficients and level at work.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Model<A: Arithmetic> {
    /// a_1, a_2, … of A(z) = 1 + Σ a_k z⁻ᵏ.
    pub(crate) a: PaddedRow<A>,
    /// b_1, b_2, … of B(z) = 1 + Σ b_k z⁻ᵏ.
    pub(crate) b: PaddedRow<A>,
    /// gain·σ, m/s².
    pub(crate) level: Quantity<A, ExcitationLevel>,
}

impl<A: Arithmetic> Model<A> {
    /// No filter, no sound.
    pub(crate) const SILENT: Self = Self {
        a: PaddedRow::ZERO,
        b: PaddedRow::ZERO,
        level: Quantity::ZERO,
    };
}

/// An ARMA model at a speed and a force, as [`Texture::filter_at`](crate::Texture::filter_at) returns it.
#[derive(Debug, Clone, PartialEq)]
pub struct Filter {
    /// a_1..a_24 of A(z) = 1 + Σ a_k z⁻ᵏ, zeros above the order.
    pub a: [f32; MAX_ORDER],
    /// b_1..b_24 of B(z) = 1 + Σ b_k z⁻ᵏ, zeros above the order.
    pub b: [f32; MAX_ORDER],
    /// gain·σ, m/s².
    pub level_m_s2: f32,
}

// Where flash is scarce, both callers of a slice share one copy of its code.
impl<S: Capacity, A: WeightSearch + RowMixture + SectionProduct> Models<S, A> {
    /// No models.
    pub(crate) const EMPTY: Self = Self {
        grid: Grid::EMPTY,
        vertices: Vertices::EMPTY,
        orders: Orders::NONE,
        b1: Quantity::ZERO,
    };

    /// The model of a query: weights, mixture, conversion.
    pub(crate) fn model_at(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) -> Model<A> {
        self.model_of(&self.grid.locate(speed, force))
    }

    /// The model of a mixture.
    pub(crate) fn model_of(&self, mixture: &Barycentric<A>) -> Model<A> {
        let (mut spectrum, mut scratch) = (LineSpectrum::ZERO, Scratch::IDLE);
        self.follow(&mut spectrum, mixture, Quantity::whole(1));
        for part in 0..self.orders.section_pairs() * self.orders.parts::<A>() {
            self.multiply(&mut scratch, &spectrum, part);
        }
        let mut model = Model::SILENT;
        self.coefficients(&scratch, &mut model);
        model.level = self.vertices.level(mixture);
        model
    }

    /// Moves a line spectrum a `fraction` of the way to a mixture.
    #[cfg_attr(target_arch = "arm", inline(never))]
    #[cfg_attr(not(target_arch = "arm"), inline)]
    pub(crate) fn follow(
        &self,
        spectrum: &mut LineSpectrum<A>,
        mixture: &Barycentric<A>,
        fraction: Quantity<A, Fraction>,
    ) {
        let has_ma = self.orders.ma() > 0;
        self.vertices.follow(spectrum, mixture, fraction, has_ma);
    }

    /// Multiplies one part of a section pair of a line spectrum into the products.
    #[cfg_attr(target_arch = "arm", inline(never))]
    #[cfg_attr(not(target_arch = "arm"), inline)]
    pub(crate) fn multiply(&self, products: &mut Scratch, spectrum: &LineSpectrum<A>, part: usize) {
        spectrum.multiply(&self.orders, products, part);
    }

    /// Coefficients of A(z) and B(z), all section pairs multiplied in.
    #[cfg_attr(target_arch = "arm", inline(never))]
    #[cfg_attr(not(target_arch = "arm"), inline)]
    pub(crate) fn coefficients(&self, products: &Scratch, model: &mut Model<A>) {
        assembly::ar(&self.orders, products, &mut model.a);
        if S::MA_ORDER > 0 && self.orders.ma() > 0 {
            assembly::ma(&self.orders, products, &mut model.b);
        } else {
            model.b.0[0][0] = self.b1.0;
        }
    }
}

impl<A: Arithmetic> From<Model<A>> for Filter {
    fn from(model: Model<A>) -> Self {
        Self {
            a: model.a.to_array().map(|a| a.value()),
            b: model.b.to_array().map(|b| b.value()),
            level_m_s2: model.level.value(),
        }
    }
}
