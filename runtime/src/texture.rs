//! The slot: one texture, decoded and prepared for the tick.

use crate::{
    Filter,
    interpolate::{Interpolator, ticks_per_sample},
    lanes::F4,
    locate::{Barycentric, Locator},
    lsf::{self, Pairs, Products, Shape},
    math::cos_pi_four,
    schedule::{self, Share, Shares},
    synthesis::{Lags, Line},
    tap::TapBank,
    vibration::between::shares_of_cycle,
};
use asperity_formats::{Asset, FormatError, LsfCode, Numerator, Surface, limits::MAX_ORDER};
use thiserror::Error;

/// A texture slot in caller-provided memory.
///
/// Capacities: `V` vertices, `T` triangles, `P` the AR order and `Q` the MA order (`T`, `P` and
/// `Q` multiples of 4, orders at most 24), `K` tap samples at the servo rate, all traces together. One slot drives any
/// number of [`State`](crate::State)s; a texture that does not fit is refused.
#[derive(Debug, Clone)]
pub struct Texture<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize> {
    pub(crate) locator: Locator<T>,
    pub(crate) taps: TapBank<K>,
    pub(crate) surface: Surface,
    pub(crate) mu: f32,
    id: u32,
    shape: Shape,
    lags: Lags,
    shares: Shares,
    interpolator: Interpolator,
    servo_rate_hz: f32,
    /// b_1 of a numerator that every model shares.
    b1: f32,
    /// −2 cos ω of A(z)'s LSFs in [`lsf::stage`] order, one row a vertex.
    ar_pairs: Rows<P, V>,
    /// −2 cos ω of B(z)'s LSFs.
    ma_pairs: Rows<Q, V>,
    /// gain·σ, m/s²: mixed linearly. Mixing σ² would be 9 dB too loud near rest.
    levels_m_s2: [f32; V],
}

/// Room for the largest grid, and for 16 taps of 256 ticks: 13 taps of 100 samples at 10 kHz
/// fit at servo rates up to 10 kHz. 33 KiB, better boxed or static than on a stack.
pub type HostTexture = Texture<64, 128, 24, 24, 4096>;

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
}

/// −2 cos ω in [`lsf::stage`] order, one row a vertex.
#[derive(Debug, Clone)]
#[repr(align(16))]
struct Rows<const N: usize, const V: usize>([[f32; N]; V]);

impl<const N: usize, const V: usize> Rows<N, V> {
    /// Moves numbers `share` of the way to the mixture of three rows.
    #[inline(always)]
    fn follow(&self, line: &mut Line, query: &Barycentric, share: f32) {
        let row = |corner: usize| {
            let row = self.0.get(usize::from(query.vertices[corner]));
            row.unwrap_or(&[0.0; N]).as_chunks::<4>().0
        };
        let [wi, wj, wk] = query.weights.map(|weight| F4::splat(share * weight));
        let kept = F4::splat(1.0 - share);
        let rows = row(0).iter().zip(row(1)).zip(row(2));
        // Rows are zero beyond the order: a loop of constant length costs less than a shorter one.
        for (place, ((i, j), k)) in line.0.iter_mut().zip(rows) {
            let mixed = wi * F4::load(i) + wj * F4::load(j) + wk * F4::load(k);
            *place = (kept * F4::load(place) + mixed).to_array();
        }
    }
}

impl<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize> Default
    for Texture<V, T, P, Q, K>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize>
    Texture<V, T, P, Q, K>
{
    /// An empty slot: no wall, no sound.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            locator: Locator::EMPTY,
            taps: TapBank::EMPTY,
            surface: Surface {
                stiffness_n_m: 0.0,
                damping_n_s_m: 0.0,
                vib_s2_m: 0.0,
                effective_mass_kg: 0.0,
                f_max_n: 0.0,
            },
            mu: 0.0,
            id: 0,
            shape: Shape::new(0, 0),
            lags: Lags::new(0, 0),
            shares: Shares::NONE,
            interpolator: Interpolator::NONE,
            servo_rate_hz: 0.0,
            b1: 0.0,
            ar_pairs: Rows([[0.0; P]; V]),
            ma_pairs: Rows([[0.0; Q]; V]),
            levels_m_s2: [0.0; V],
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
        let tap_samples = TapBank::<K>::needed(asset.taps(), servo_rate_hz);
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
        // The checksums of all that is loaded.
        self.id = asset
            .sections()
            .fold(1, |id, section| id.rotate_left(5) ^ section.crc32);
        self.shape = Shape::new(grid.ar_order(), grid.ma_order());
        self.lags = Lags::new(grid.ar_order(), grid.ma_order());
        self.b1 = if grid.numerator() == Numerator::Nyquist {
            1.0
        } else {
            0.0
        };
        self.servo_rate_hz = servo_rate_hz;
        self.surface = *asset.surface();
        self.mu = asset.friction().mu();
        self.ar_pairs.0 = [[0.0; P]; V];
        self.ma_pairs.0 = [[0.0; Q]; V];
        self.levels_m_s2 = [0.0; V];
        let (ar, ma) = (stages(grid.ar_order()), stages(grid.ma_order()));
        for (index, vertex) in grid.vertices().enumerate().take(V) {
            if let Some(model) = grid.model(usize::from(vertex.model)) {
                to_pairs(&mut self.ar_pairs.0[index], model.lsf(), &ar);
                to_pairs(&mut self.ma_pairs.0[index], model.ma_lsf(), &ma);
                self.levels_m_s2[index] = model.gain * vertex.sigma_m_s2;
            }
        }
        let corner = |v: u8| grid.place(usize::from(v)).unwrap_or_default();
        self.locator.load(
            grid.triangles(),
            corner,
            grid.max_speed_mm_s(),
            grid.max_force_n(),
        );
        let count = shares_of_cycle(ticks);
        self.shares = schedule::shares(self.locator.blocks(), &self.shape, count);
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

    /// Wall and gains.
    #[must_use]
    pub const fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Coefficient of kinetic friction.
    #[must_use]
    pub const fn mu(&self) -> f32 {
        self.mu
    }

    /// The tap bank at the servo rate.
    #[must_use]
    pub const fn taps(&self) -> &TapBank<K> {
        &self.taps
    }

    /// Triangle and weights of a query; convex and finite for every input.
    #[must_use]
    pub fn weights_at(&self, speed_mm_s: f32, force_n: f32) -> Barycentric {
        self.locator.locate(speed_mm_s, force_n)
    }

    /// The steady model of a query: what the tick renders once speed and force rest.
    #[must_use]
    pub fn filter_at(&self, speed_mm_s: f32, force_n: f32) -> Filter {
        let query = self.weights_at(speed_mm_s, force_n);
        let (mut pairs, mut products) = (Pairs::ZERO, Products::ONE);
        self.follow(&mut pairs, &query, 1.0);
        for part in 0..self.shape.twos() * self.shape.parts() {
            self.multiply(&mut products, &pairs, part);
        }
        let (mut a, mut b) = (Line::ZERO, Line::ZERO);
        self.coefficients(&products, &mut a, &mut b);
        Filter {
            a: a.to_array(),
            b: b.to_array(),
            level_m_s2: self.level_m_s2(&query),
        }
    }

    /// Whether an edge model answers a query.
    #[inline]
    pub(crate) fn is_outside(&self, speed_mm_s: f32, force_n: f32) -> bool {
        !(speed_mm_s <= self.locator.max_speed_mm_s && force_n <= self.locator.max_force_n)
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
    pub(crate) const fn interpolator(&self) -> &Interpolator {
        &self.interpolator
    }

    /// The work of a tick of the cycle.
    #[inline]
    pub(crate) fn share(&self, phase: u8) -> &Share {
        self.shares.of(phase)
    }

    /// Moves parameters `share` of the way to a mixture.
    #[inline]
    pub(crate) fn follow(&self, pairs: &mut Pairs, query: &Barycentric, share: f32) {
        self.ar_pairs.follow(&mut pairs.ar, query, share);
        if Q > 0 && self.shape.ma_order > 0 {
            self.ma_pairs.follow(&mut pairs.ma, query, share);
        }
    }

    /// Multiplies one part of a two of pairs in.
    #[inline]
    pub(crate) fn multiply(&self, products: &mut Products, pairs: &Pairs, part: usize) {
        self.shape.multiply(products, pairs, part);
    }

    /// Coefficients of A(z) and B(z), all twos done.
    #[inline]
    pub(crate) fn coefficients(&self, products: &Products, a: &mut Line, b: &mut Line) {
        self.shape.ar(products, a);
        if Q > 0 && self.shape.ma_order > 0 {
            self.shape.ma(products, b);
        } else {
            b.0[0][0] = self.b1;
        }
    }

    /// gain·σ of a mixture, m/s².
    #[inline]
    pub(crate) fn level_m_s2(&self, query: &Barycentric) -> f32 {
        let level = |corner: usize| {
            let vertex = usize::from(query.vertices[corner]);
            query.weights[corner] * self.levels_m_s2.get(vertex).copied().unwrap_or_default()
        };
        level(0) + level(1) + level(2)
    }
}

/// Where each LSF of an order stands in a row.
fn stages(order: usize) -> [u8; MAX_ORDER] {
    let mut stages = [0; MAX_ORDER];
    for (index, stage) in stages.iter_mut().enumerate().take(order) {
        *stage = lsf::stage(index, order) as u8;
    }
    stages
}

/// −2 cos ω of a model, in the order in which the conversion takes them.
fn to_pairs(
    row: &mut [f32],
    codes: impl ExactSizeIterator<Item = LsfCode>,
    stages: &[u8; MAX_ORDER],
) {
    let order = codes.len();
    let mut numbers = [0.0; MAX_ORDER];
    for (number, code) in numbers.iter_mut().zip(codes) {
        *number = code.half_turns();
    }
    for four in numbers.as_chunks_mut::<4>().0 {
        *four = (F4::splat(-2.0) * cos_pi_four(F4::load(four))).to_array();
    }
    for (number, &stage) in numbers.iter().zip(stages).take(order) {
        if let Some(place) = row.get_mut(usize::from(stage)) {
            *place = *number;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_as_stated() {
        assert!(size_of::<HostTexture>() <= 33 * 1024);
        assert!(size_of::<crate::State>() <= 1136);
    }
}
