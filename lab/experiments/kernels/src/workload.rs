//! The same work for every design: a made-up texture, a path through its triangle, and an
//! excitation.
//!
//! The cost of a tick hardly depends on the values it computes with, so one texture stands for
//! all textures of its orders.

use crate::design::{Design, Order};
use crate::kernel::{Rendering, kernel};
use crate::texture::{BarycentricPoint, Numerator, Texture, Vertex};
use alloc::{boxed::Box, vec::Vec};
use core::{f64::consts::PI, hint::black_box};

/// Ticks of a counted run: a multiple of every update interval.
pub const TICKS: usize = 1632;

/// The orders of a filter, which its cost depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Orders {
    /// Poles.
    pub poles: usize,
    /// Zeros, where the numerator is a polynomial of its own.
    pub zeros: usize,
    /// True if the numerator is 1 + z⁻¹.
    pub nyquist: bool,
}

impl Orders {
    /// The orders that remain after a reduction to `order`; `None` for [`Order::Auto`], which
    /// depends on the texture.
    #[must_use]
    pub fn reduced(self, order: Order) -> Option<Self> {
        let of = |poles: usize, nyquist| Self {
            poles: poles.min(self.poles),
            zeros: 0,
            nyquist,
        };
        match order {
            Order::Full => Some(self),
            Order::WithZero(poles) => Some(of(poles, true)),
            Order::AllPole(poles) => Some(of(poles, false)),
            Order::Auto => None,
        }
    }

    fn numerator(self) -> Numerator {
        match (self.zeros, self.nyquist) {
            (0, false) => Numerator::None,
            (0, true) => Numerator::Nyquist,
            _ => Numerator::Lsf,
        }
    }
}

/// The kernel of a design for a texture of given orders; `None` where the design has none.
#[must_use]
pub fn kernel_of(design: &Design, orders: Orders) -> Option<Box<dyn Rendering>> {
    let lsf_rad = [0, 1, 2].map(|vertex| spread(orders.poles, vertex));
    let ma_lsf_rad = [7, 8, 9].map(|vertex| spread(orders.zeros, vertex));
    let vertices = [0, 1, 2].map(|vertex| Vertex {
        lsf_rad: &lsf_rad[vertex],
        ma_lsf_rad: &ma_lsf_rad[vertex],
        level_m_s2: 0.1 * (vertex + 1) as f64,
    });
    let texture = Texture {
        sample_rate_hz: 1000.0,
        numerator: orders.numerator(),
        vertices: &vertices,
    };
    kernel(design, &texture)
}

/// LSFs spread evenly, then each moved a little.
fn spread(order: usize, seed: usize) -> Vec<f64> {
    let step = PI / (order + 1) as f64;
    (1..=order)
        .map(|k| step * (k as f64 + 0.3 * libm::sin((k * 37 + seed * 101) as f64)))
        .collect()
}

/// Queries and an excitation.
#[derive(Debug, Clone)]
pub struct Workload {
    places: Vec<BarycentricPoint>,
    epsilon: Vec<f64>,
}

impl Default for Workload {
    fn default() -> Self {
        let place = |n: usize| {
            let t = n as f64 / TICKS as f64;
            BarycentricPoint {
                vertices: [0, 1, 2],
                weights: [0.5 - 0.3 * t, 0.2 + 0.5 * t, 0.3 - 0.2 * t],
            }
        };
        Self {
            places: (0..TICKS).map(place).collect(),
            epsilon: (0..TICKS).map(|n| libm::sin((n * n) as f64)).collect(),
        }
    }
}

impl Workload {
    /// Renders `ticks` ticks from silence and returns the last sample, in units of the kernel's
    /// signal.
    ///
    /// All work besides the ticks themselves costs the same for any number of ticks.
    pub fn run(&self, kernel: &mut dyn Rendering, ticks: usize) -> f64 {
        kernel.settle(&self.places[0]);
        black_box(kernel.repeat(&self.places, &self.epsilon, black_box(ticks)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Transition, variants};

    #[test]
    fn a_counted_run_is_whole_cycles_of_every_design() {
        for variant in variants() {
            assert_eq!(TICKS % variant.design.update_ticks, 0, "{}", variant.name);
        }
    }

    /// The counted run renders the kernel's output in its own unit: no design leaves out work.
    #[test]
    fn a_counted_run_renders_every_tick_of_every_kernel() {
        let workload = Workload::default();
        for variant in variants() {
            for (zeros, nyquist) in [(18, false), (0, true), (0, false)] {
                let orders = Orders {
                    poles: 20,
                    zeros,
                    nyquist,
                };
                let mut kernel = kernel_of(&variant.design, orders).expect("it has a filter");
                kernel.settle(&workload.places[0]);
                let rendered = kernel.render(&workload.places[..32], &workload.epsilon[..32]);
                let units = [2, 17, 31, 32].map(|ticks| {
                    let last = workload.run(kernel.as_mut(), ticks);
                    assert!(last.is_finite() && last != 0.0, "{}: {last}", variant.name);
                    rendered[ticks - 1] / last
                });
                let off = units.map(|unit| (unit / units[0] - 1.0).abs());
                assert!(
                    off.iter().all(|off| *off < 1e-9),
                    "{}: {units:?}",
                    variant.name
                );
            }
        }
    }

    #[test]
    fn a_crossfade_ends_on_what_is_held() {
        let at = |transition, update_ticks| {
            let design = Design {
                transition,
                update_ticks,
                ..Design::DEFAULT
            };
            let orders = Orders {
                poles: 4,
                zeros: 0,
                nyquist: true,
            };
            let mut kernel = kernel_of(&design, orders).expect("it has a filter");
            // Two cycles: the first begins where it settled.
            Workload::default().run(kernel.as_mut(), 2 * update_ticks);
            kernel.filter().a
        };
        let (faded, held) = (at(Transition::Crossfade, 8), at(Transition::Hold, 8));
        for (x, y) in faded.iter().zip(&held) {
            assert!((x - y).abs() < 2e-6, "{faded:?}, {held:?}");
        }
    }
}
