//! The slot: one texture, decoded and prepared for the tick.

mod codes;

use self::codes::to_pairs;
use crate::{
    Filter,
    arithmetic::{
        Arithmetic, Float, Four, Number, Scalar, Zero as _,
        units::{
            Coefficient, Kilogram, Level, MillimetrePerSecond, Newton, NewtonPerMetre,
            NewtonSecondPerMetre, Pair, Ratio, Unit,
        },
    },
    cycle::Cycle,
    interpolate::{Interpolator, ticks_per_sample},
    locate::{Barycentric, Locator},
    lsf::{Pairs, Shape},
    schedule::{self, Share, Shares},
    synthesis::{Lags, Line},
    tap::TapBank,
    vibration::between::shares_of_cycle,
    workspace::Workspace,
};
use asperity_formats::{Asset, FormatError, Numerator, Surface};
use thiserror::Error;

/// A texture slot in caller-provided memory.
///
/// Capacities: `V` vertices, `T` triangles, `P` the AR order and `Q` the MA order (`T`, `P` and
/// `Q` multiples of 4, orders at most 24), `K` tap samples at the servo rate, all traces together. One slot drives any
/// number of [`State`](crate::State)s; a texture that does not fit is refused.
#[derive(Debug, Clone)]
pub struct Texture<
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
    A: Arithmetic = Float,
> {
    pub(crate) locator: Locator<T, A>,
    pub(crate) taps: TapBank<K, A>,
    pub(crate) feel: Feel<A>,
    id: u32,
    shape: Shape,
    lags: Lags,
    cycle: Cycle,
    shares: Shares,
    interpolator: Interpolator<A>,
    servo_rate_hz: f32,
    /// b_1 of a numerator that every model shares.
    b1: Number<A, Coefficient>,
    /// −2 cos ω of A(z)'s LSFs in [`crate::lsf::stage`] order, one row a vertex.
    ar_pairs: Rows<P, V, A>,
    /// −2 cos ω of B(z)'s LSFs.
    ma_pairs: Rows<Q, V, A>,
    /// gain·σ, m/s²: mixed linearly. Mixing σ² would be 9 dB too loud near rest.
    levels_m_s2: [A::Scalar<Level>; V],
}

/// Room for the largest grid, and for 16 taps of 256 ticks: 13 taps of 100 samples at 10 kHz
/// fit at servo rates up to 10 kHz. 33 KiB, better boxed or static than on a stack.
pub type HostTexture = Texture<64, 128, 24, 24, 4096>;

/// A gain of the vibration is no larger where numbers have a range, kg.
const HEAVIEST_KG: f32 = 127.0;

/// Wall, gains and friction, as a tick computes with them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Feel<A: Arithmetic> {
    pub(crate) stiffness_n_m: Number<A, NewtonPerMetre>,
    pub(crate) damping_n_s_m: Number<A, NewtonSecondPerMetre>,
    pub(crate) vib_s2_m: Number<A, Ratio>,
    pub(crate) effective_mass_kg: Number<A, Kilogram>,
    pub(crate) f_max_n: Number<A, Newton>,
    /// Of the vibration: the product of both.
    pub(crate) gain_kg: Number<A, Kilogram>,
    /// Coefficient of kinetic friction.
    pub(crate) mu: Number<A, Ratio>,
}

impl<A: Arithmetic> Feel<A> {
    /// No wall, no friction, silence.
    pub(crate) const NONE: Self = Self {
        stiffness_n_m: Number::ZERO,
        damping_n_s_m: Number::ZERO,
        vib_s2_m: Number::ZERO,
        effective_mass_kg: Number::ZERO,
        f_max_n: Number::ZERO,
        gain_kg: Number::ZERO,
        mu: Number::ZERO,
    };

    fn new(surface: &Surface, mu: f32) -> Self {
        let mut feel = Self {
            stiffness_n_m: Number::of(surface.stiffness_n_m),
            damping_n_s_m: Number::of(surface.damping_n_s_m),
            effective_mass_kg: Number::of(surface.effective_mass_kg),
            mu: Number::of(mu),
            ..Self::NONE
        };
        feel.set_gain(Number::of(surface.vib_s2_m), Number::of(surface.f_max_n));
        feel
    }

    /// The gain of the vibration, of two factors.
    #[inline]
    pub(crate) fn set_gain(&mut self, vib_s2_m: Number<A, Ratio>, f_max_n: Number<A, Newton>) {
        (self.vib_s2_m, self.f_max_n) = (vib_s2_m, f_max_n);
        self.gain_kg = vib_s2_m.times_within(f_max_n, HEAVIEST_KG);
    }

    fn surface(&self) -> Surface {
        Surface {
            stiffness_n_m: self.stiffness_n_m.value(),
            damping_n_s_m: self.damping_n_s_m.value(),
            vib_s2_m: self.vib_s2_m.value(),
            effective_mass_kg: self.effective_mass_kg.value(),
            f_max_n: self.f_max_n.value(),
        }
    }
}

/// Why a texture does not fit a slot.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The bytes are not a valid asset.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// More of something than the slot has room for.
    #[error("{field}: the texture has {found}, the slot has room for {capacity}")]
    Capacity {
        /// Which capacity.
        field: &'static str,
        /// What the texture needs.
        found: usize,
        /// What the slot has.
        capacity: usize,
    },
    /// The servo rate is no whole multiple of the models' rate, or more than 20 times it.
    #[error(
        "grid.sample_rate_hz: models run at {model_hz} Hz, the servo at {servo_hz} Hz, which must be 1 to 20 times as much, a whole number; convert the texture"
    )]
    Rate {
        /// Rate of the models, Hz.
        model_hz: f32,
        /// Rate of the servo loop, Hz.
        servo_hz: f32,
    },
    /// A number beyond what fixed point can hold.
    #[error("{field} = {value}: a tick in fixed point takes {least} to {most}")]
    Range {
        /// Which number.
        field: &'static str,
        /// Its value.
        value: f32,
        /// The smallest that fits.
        least: f32,
        /// The largest that fits.
        most: f32,
    },
}

/// No −2 cos ω is larger.
const WIDEST: f32 = 2.0;

/// −2 cos ω in [`crate::lsf::stage`] order, one row a vertex.
#[derive(Debug, Clone)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
struct Rows<const N: usize, const V: usize, A: Arithmetic>([[A::Scalar<Pair>; N]; V]);

impl<const N: usize, const V: usize, A: Arithmetic> Rows<N, V, A> {
    /// Moves numbers `share` of the way to the mixture of three rows.
    #[inline(always)]
    fn follow(&self, line: &mut Line<A, Pair>, query: &Barycentric<A>, share: Number<A, Unit>) {
        let row = |corner: usize| {
            let row = self.0.get(usize::from(query.vertices[corner]));
            row.map_or(&[][..], |row| row.as_chunks::<4>().0)
        };
        let weight = |weight| Four::splat(share.times::<Unit, Unit>(Number(weight)));
        let [wi, wj, wk] = query.weights.map(weight);
        let kept = Four::splat(Number::whole(1) - share);
        let rows = row(0).iter().zip(row(1)).zip(row(2));
        // Rows are zero beyond the order: a loop of constant length costs less than a shorter one.
        for (place, ((i, j), k)) in line.0.iter_mut().zip(rows) {
            let [i, j, k, before] = [i, j, k, &*place].map(Four::<A, Pair>::load);
            let terms = [(i, wi), (j, wj), (k, wk), (before, kept)];
            *place = Four::<A, Pair>::sum_within(terms, WIDEST).to_array();
        }
    }
}

impl<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize, A: Arithmetic>
    Default for Texture<V, T, P, Q, K, A>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize, A: Arithmetic>
    Texture<V, T, P, Q, K, A>
{
    /// An empty slot: no wall, no sound.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            locator: Locator::EMPTY,
            taps: TapBank::EMPTY,
            feel: Feel::NONE,
            id: 0,
            shape: Shape::NONE,
            lags: Lags::new(0, 0),
            cycle: Cycle::SLOWEST,
            shares: Shares::NONE,
            interpolator: Interpolator::NONE,
            servo_rate_hz: 0.0,
            b1: Number::ZERO,
            ar_pairs: Rows([[A::Scalar::ZERO; P]; V]),
            ma_pairs: Rows([[A::Scalar::ZERO; Q]; V]),
            levels_m_s2: [A::Scalar::ZERO; V],
        }
    }

    /// Prepares a validated asset for a servo rate of 1, 2, 3, … 20 times the models' rate;
    /// allocates nothing. A slot that refuses keeps what it had.
    ///
    /// # Errors
    /// [`LoadError::Capacity`] and [`LoadError::Rate`].
    pub fn load(&mut self, asset: &Asset<'_>, servo_rate_hz: f32) -> Result<(), LoadError> {
        let grid = asset.grid();
        // Exact: a rate is a number that both sides were given, not one they measured.
        let ticks = ticks_per_sample(grid.sample_rate_hz(), servo_rate_hz);
        let ticks = ticks.ok_or(LoadError::Rate {
            model_hz: grid.sample_rate_hz(),
            servo_hz: servo_rate_hz,
        })?;
        let triangle_room = T - T % 4;
        let tap_samples = TapBank::<K, A>::needed(asset.taps(), servo_rate_hz);
        for (field, found, capacity) in [
            ("vertices", grid.vertices().len(), V),
            ("triangles", grid.triangles().len(), triangle_room),
            ("ar_order", grid.ar_order(), P - P % 4),
            ("ma_order", grid.ma_order(), Q - Q % 4),
            ("tap samples", tap_samples, K),
        ] {
            if found > capacity {
                return Err(LoadError::Capacity {
                    field,
                    found,
                    capacity,
                });
            }
        }
        A::check(asset)?;
        // The checksums of all that is loaded, and how it is clocked.
        self.id = asset.sections().fold(ticks.into(), |id: u32, section| {
            id.rotate_left(5) ^ section.crc32
        });
        self.shape = Shape::new(grid.ar_order(), grid.ma_order());
        self.lags = Lags::new(grid.ar_order(), grid.ma_order());
        self.b1 = if grid.numerator() == Numerator::Nyquist {
            Number::whole(1)
        } else {
            Number::ZERO
        };
        self.servo_rate_hz = servo_rate_hz;
        self.feel = Feel::new(asset.surface(), asset.friction().mu());
        // No triangle has a corner in the rows behind the last vertex, so they may hold anything.
        for (index, vertex) in grid.vertices().enumerate().take(V) {
            if let Some(model) = grid.model(usize::from(vertex.model)) {
                to_pairs(&mut self.ar_pairs.0[index], model.stored_lsf());
                to_pairs(&mut self.ma_pairs.0[index], model.stored_ma_lsf());
                self.levels_m_s2[index] = A::Scalar::of(model.gain * vertex.sigma_m_s2);
            }
        }
        let corner = |v: u8| grid.place(usize::from(v)).unwrap_or_default();
        self.locator.load(
            grid.stored_triangles(),
            corner,
            grid.max_speed_mm_s(),
            grid.max_force_n(),
        );
        self.cycle = schedule::cycle(self.locator.blocks(), &self.shape);
        let count = shares_of_cycle(ticks, self.cycle);
        // Rows are mixed as a whole.
        let fours = P / 4 + if grid.ma_order() > 0 { Q / 4 } else { 0 };
        self.shares = schedule::shares::<A>(self.locator.blocks(), fours, &self.shape, count);
        self.interpolator = Interpolator::new(ticks);
        self.taps.load(asset.taps(), servo_rate_hz);
        Ok(())
    }

    /// Rate that the slot was loaded for, Hz; 0 for an empty slot.
    #[must_use]
    pub const fn servo_rate_hz(&self) -> f32 {
        self.servo_rate_hz
    }

    /// Ticks that a sample of the models lasts, 1 to 20: the servo rate over theirs.
    #[must_use]
    pub const fn ticks_per_sample(&self) -> u8 {
        self.interpolator.ticks()
    }

    /// Samples of the models from one query of speed and force to the next, 6 to 8: a larger
    /// texture takes more ticks to answer, and is asked more often.
    #[must_use]
    pub const fn cycle_samples(&self) -> u8 {
        self.cycle.ticks()
    }

    /// Wall and gains.
    #[must_use]
    pub fn surface(&self) -> Surface {
        self.feel.surface()
    }

    /// Coefficient of kinetic friction.
    #[must_use]
    pub fn mu(&self) -> f32 {
        self.feel.mu.value()
    }

    /// The tap bank at the servo rate.
    #[must_use]
    pub const fn taps(&self) -> &TapBank<K, A> {
        &self.taps
    }

    /// Triangle and weights of a query; convex and finite for every input.
    #[must_use]
    pub fn weights_at(&self, speed_mm_s: f32, force_n: f32) -> Barycentric<A> {
        let force_n = Number::of(force_n);
        self.locator.locate(Number::of(speed_mm_s), force_n)
    }

    /// The steady model of a query: what the tick renders once speed and force rest.
    #[must_use]
    pub fn filter_at(&self, speed_mm_s: f32, force_n: f32) -> Filter {
        self.filter_of(&self.weights_at(speed_mm_s, force_n))
    }

    /// [`filter_at`](Self::filter_at) of a query that was located in this texture.
    #[must_use]
    pub fn filter_of(&self, query: &Barycentric<A>) -> Filter {
        let (mut pairs, mut workspace) = (Pairs::ZERO, Workspace::IDLE);
        self.follow(&mut pairs, query, Number::whole(1));
        for part in 0..self.shape.twos() * self.shape.parts::<A>() {
            self.multiply(&mut workspace, &pairs, part);
        }
        let (mut a, mut b) = (Line::ZERO, Line::ZERO);
        self.coefficients(&workspace, &mut a, &mut b);
        Filter {
            a: a.to_array().map(|a| a.value()),
            b: b.to_array().map(|b| b.value()),
            level_m_s2: self.level_m_s2(query).value(),
        }
    }

    /// Whether an edge model answers a query.
    #[inline]
    pub(crate) fn is_outside(
        &self,
        speed_mm_s: Number<A, MillimetrePerSecond>,
        force_n: Number<A, Newton>,
    ) -> bool {
        self.locator.is_outside(speed_mm_s, force_n)
    }

    /// Checksum of what was loaded; 0 for an empty slot.
    #[inline]
    pub(crate) const fn id(&self) -> u32 {
        self.id
    }

    /// Lags of the recursion.
    #[inline]
    pub(crate) const fn lags(&self) -> Lags {
        self.lags
    }

    /// From samples of the models to ticks.
    #[inline]
    pub(crate) const fn interpolator(&self) -> &Interpolator<A> {
        &self.interpolator
    }

    /// How long a cycle lasts.
    #[inline]
    pub(crate) const fn cycle(&self) -> Cycle {
        self.cycle
    }

    /// The work of a tick of the cycle.
    #[inline]
    pub(crate) fn share(&self, phase: u8) -> &Share {
        self.shares.of(phase)
    }

    /// Moves parameters `share` of the way to a mixture.
    #[inline]
    pub(crate) fn follow(
        &self,
        pairs: &mut Pairs<A>,
        query: &Barycentric<A>,
        share: Number<A, Unit>,
    ) {
        self.ar_pairs.follow(&mut pairs.ar, query, share);
        if Q > 0 && self.shape.ma_order() > 0 {
            self.ma_pairs.follow(&mut pairs.ma, query, share);
        }
    }

    /// Multiplies one part of a two of pairs in.
    #[inline]
    pub(crate) fn multiply(&self, products: &mut Workspace, pairs: &Pairs<A>, part: usize) {
        self.shape.multiply(products, pairs, part);
    }

    /// Coefficients of A(z) and B(z), all twos done.
    #[inline]
    pub(crate) fn coefficients(&self, products: &Workspace, a: &mut Line<A>, b: &mut Line<A>) {
        self.shape.ar(products, a);
        if Q > 0 && self.shape.ma_order() > 0 {
            self.shape.ma(products, b);
        } else {
            b.0[0][0] = self.b1.0;
        }
    }

    /// gain·σ of a mixture, m/s².
    #[inline]
    pub(crate) fn level_m_s2(&self, query: &Barycentric<A>) -> Number<A, Level> {
        let level = |corner: usize| {
            let vertex = usize::from(query.vertices[corner]);
            let level = self.levels_m_s2.get(vertex).copied().unwrap_or_default();
            let weight = Number::<A, Unit>(query.weights[corner]);
            weight.times(Number::<A, Level>(level))
        };
        level(0) + level(1) + level(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_as_stated() {
        assert!(size_of::<HostTexture>() <= 33 * 1024);
        assert!(size_of::<crate::State>() <= 1056);
    }
}
