//! The slot: one texture, decoded and prepared for the tick.

use crate::{
    Filter,
    locate::{Barycentric, Locator},
    lsf,
    math::cos_pi,
    tap::TapBank,
};
use asperity_formats::{Asset, FormatError, LsfCode, Numerator, Surface, limits};
use thiserror::Error;

/// A texture slot in caller-provided memory.
///
/// Capacities: `V` vertices, `T` triangles (a multiple of 8), `P` the AR order and `Q` the
/// MA order (even, at most 24), `K` tap samples at the servo rate, all traces together. One slot drives any
/// number of [`State`](crate::State)s; a texture that does not fit is refused.
#[derive(Debug, Clone)]
pub struct Texture<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize> {
    pub(crate) locator: Locator<T>,
    pub(crate) taps: TapBank<K>,
    pub(crate) surface: Surface,
    pub(crate) mu: f32,
    ar_order: usize,
    ma_order: usize,
    numerator: Numerator,
    servo_rate_hz: f32,
    /// cos ω of A(z)'s LSFs in [`lsf::stage`] order, one row a vertex.
    ar_cosines: [[f32; P]; V],
    /// cos ω of B(z)'s LSFs.
    ma_cosines: [[f32; Q]; V],
    /// gain·σ, m/s²: mixed linearly. Mixing σ² would be 9 dB too loud near rest.
    levels_m_s2: [f32; V],
}

/// Room for the largest grid, and for 16 taps of 256 ticks: 13 taps of 100 samples at 10 kHz
/// fit at servo rates up to 10 kHz. 32 KiB, better boxed or static than on a stack.
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
    /// The models run at another rate than the servo loop.
    #[error(
        "grid.sample_rate_hz: models run at {model_hz} Hz, the servo at {servo_hz} Hz; convert the texture"
    )]
    Rate {
        /// Rate of the models, Hz.
        model_hz: f32,
        /// Rate of the servo loop, Hz.
        servo_hz: f32,
    },
}

/// The mixed parameters of one query: cosines of LSFs and a level.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parameters {
    pub(crate) ar_cosines: [f32; limits::MAX_ORDER],
    pub(crate) ma_cosines: [f32; limits::MAX_ORDER],
    pub(crate) level_m_s2: f32,
}

impl Parameters {
    pub(crate) const SILENT: Self = Self {
        ar_cosines: [0.0; limits::MAX_ORDER],
        ma_cosines: [0.0; limits::MAX_ORDER],
        level_m_s2: 0.0,
    };

    /// Moves the shape towards `target` by `share` of the way; takes its level.
    #[inline]
    pub(crate) fn follow(&mut self, target: &Self, share: f32) {
        for (x, t) in self.ar_cosines.iter_mut().zip(&target.ar_cosines) {
            *x += share * (t - *x);
        }
        for (x, t) in self.ma_cosines.iter_mut().zip(&target.ma_cosines) {
            *x += share * (t - *x);
        }
        self.level_m_s2 = target.level_m_s2;
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
            ar_order: 0,
            ma_order: 0,
            numerator: Numerator::None,
            servo_rate_hz: 0.0,
            ar_cosines: [[0.0; P]; V],
            ma_cosines: [[0.0; Q]; V],
            levels_m_s2: [0.0; V],
        }
    }

    /// Prepares a validated asset for a servo rate; allocates nothing. A slot that
    /// refuses keeps what it had.
    ///
    /// # Errors
    /// [`LoadError::Capacity`] and [`LoadError::Rate`].
    pub fn load(&mut self, asset: &Asset<'_>, servo_rate_hz: f32) -> Result<(), LoadError> {
        let grid = asset.grid();
        // Exact: a rate is a number that both sides were given, not one they measured.
        if grid.sample_rate_hz() != servo_rate_hz {
            return Err(LoadError::Rate {
                model_hz: grid.sample_rate_hz(),
                servo_hz: servo_rate_hz,
            });
        }
        let triangle_room = T - T % 8;
        let tap_samples = TapBank::<K>::needed(asset.taps(), servo_rate_hz);
        for (field, found, capacity) in [
            ("vertices", grid.vertices().len(), V),
            ("triangles", grid.triangles().len(), triangle_room),
            ("ar_order", grid.ar_order(), P),
            ("ma_order", grid.ma_order(), Q),
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
        self.ar_order = grid.ar_order();
        self.ma_order = grid.ma_order();
        self.numerator = grid.numerator();
        self.servo_rate_hz = servo_rate_hz;
        self.surface = *asset.surface();
        self.mu = asset.friction().mu();
        self.ar_cosines = [[0.0; P]; V];
        self.ma_cosines = [[0.0; Q]; V];
        self.levels_m_s2 = [0.0; V];
        for (index, vertex) in grid.vertices().enumerate().take(V) {
            if let Some(model) = grid.models().nth(usize::from(vertex.model)) {
                to_cosines(&mut self.ar_cosines[index], model.lsf());
                to_cosines(&mut self.ma_cosines[index], model.ma_lsf());
                self.levels_m_s2[index] = model.gain * vertex.sigma_m_s2;
            }
        }
        let corner = |v: u8| {
            grid.vertices()
                .nth(usize::from(v))
                .map_or((0.0, 0.0), |vertex| (vertex.speed_mm_s, vertex.force_n))
        };
        self.locator.load(
            grid.triangles(),
            corner,
            grid.max_speed_mm_s(),
            grid.max_force_n(),
        );
        self.taps.load(asset.taps(), servo_rate_hz);
        Ok(())
    }

    /// Rate that the slot was loaded for, Hz; 0 for an empty slot.
    #[must_use]
    pub const fn servo_rate_hz(&self) -> f32 {
        self.servo_rate_hz
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
        self.filter(&self.mix(&self.weights_at(speed_mm_s, force_n)))
    }

    /// Mixes cosines and levels of three vertices.
    #[inline]
    pub(crate) fn mix(&self, query: &Barycentric) -> Parameters {
        let [i, j, k] = query.vertices.map(|v| usize::from(v) % V);
        let [wi, wj, wk] = query.weights;
        let mut mixed = Parameters::SILENT;
        for (n, x) in mixed.ar_cosines.iter_mut().enumerate().take(P) {
            *x = wi * self.ar_cosines[i][n]
                + wj * self.ar_cosines[j][n]
                + wk * self.ar_cosines[k][n];
        }
        for (n, x) in mixed.ma_cosines.iter_mut().enumerate().take(Q) {
            *x = wi * self.ma_cosines[i][n]
                + wj * self.ma_cosines[j][n]
                + wk * self.ma_cosines[k][n];
        }
        mixed.level_m_s2 =
            wi * self.levels_m_s2[i] + wj * self.levels_m_s2[j] + wk * self.levels_m_s2[k];
        mixed
    }

    /// Direct-form coefficients of mixed parameters.
    #[inline]
    pub(crate) fn filter(&self, parameters: &Parameters) -> Filter {
        let (a, mut b) = lsf::polynomials(
            &parameters.ar_cosines,
            self.ar_order,
            &parameters.ma_cosines,
            self.ma_order,
        );
        if self.numerator == Numerator::Nyquist {
            b[0] = 1.0;
        }
        Filter {
            a,
            b,
            level_m_s2: parameters.level_m_s2,
        }
    }
}

/// The cosines of a model, in the order in which the conversion takes them.
fn to_cosines(row: &mut [f32], codes: impl ExactSizeIterator<Item = LsfCode>) {
    let order = codes.len();
    for (index, code) in codes.enumerate() {
        if let Some(x) = row.get_mut(lsf::stage(index, order)) {
            *x = cos_pi(code.half_turns());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_as_stated() {
        assert!(size_of::<HostTexture>() <= 32 * 1024);
        assert!(size_of::<crate::State>() <= 1024);
    }
}
