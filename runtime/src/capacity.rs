//! Capacities of a texture slot: vertices, triangles, filter orders and tap samples.

use crate::arithmetic::Zero;
use core::fmt::Debug;

/// The capacities of a slot; [`Capacities`] is the only kind.
///
/// An associated array has as many elements as the slot has room for.
pub trait Capacity: sealed::Sealed + Copy + Debug + Default + PartialEq + 'static {
    /// Vertices of the grid.
    const VERTICES: usize;
    /// Triangles of the grid, a multiple of 4.
    const TRIANGLES: usize;
    /// Largest order of A(z), a multiple of 4, at most 24.
    const AR_ORDER: usize;
    /// Largest order of B(z), a multiple of 4, at most 24.
    const MA_ORDER: usize;
    /// Tap samples at the servo rate, all traces together.
    const TAP_SAMPLES: usize;

    /// Array with an element per vertex.
    type Vertices<X: Zero>: Array<X>;
    /// Array with an element per triangle.
    type Triangles<X: Zero>: Array<X>;
    /// Array with an element per lag of A(z).
    type ArOrder<X: Zero>: Array<X>;
    /// Array with an element per lag of B(z).
    type MaOrder<X: Zero>: Array<X>;
    /// Array with an element per tap sample.
    type TapSamples<X: Zero>: Array<X>;
}

/// An array of a capacity.
pub trait Array<X>: Zero + AsRef<[X]> + AsMut<[X]> {}

impl<X: Zero, const N: usize> Array<X> for [X; N] {}

/// Capacities in numbers: `V` vertices, `T` triangles, `P` and `Q` the orders of A(z) and B(z)
/// (`T`, `P` and `Q` multiples of 4, orders at most 24), `K` tap samples at the servo rate, all
/// traces together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Capacities<
    const V: usize,
    const T: usize,
    const P: usize,
    const Q: usize,
    const K: usize,
>;

impl<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize> Capacity
    for Capacities<V, T, P, Q, K>
{
    const VERTICES: usize = V;
    const TRIANGLES: usize = T - T % 4;
    const AR_ORDER: usize = P - P % 4;
    const MA_ORDER: usize = Q - Q % 4;
    const TAP_SAMPLES: usize = K;

    type Vertices<X: Zero> = [X; V];
    type Triangles<X: Zero> = [X; T];
    type ArOrder<X: Zero> = [X; P];
    type MaOrder<X: Zero> = [X; Q];
    type TapSamples<X: Zero> = [X; K];
}

/// Room for the largest grid, and for 16 taps of 256 ticks: 13 taps of 100 samples at 10 kHz
/// fit at servo rates up to 10 kHz.
pub type HostCapacities = Capacities<64, 128, 24, 24, 4096>;

mod sealed {
    /// Nobody else implements [`Capacity`](super::Capacity).
    pub trait Sealed {}

    impl<const V: usize, const T: usize, const P: usize, const Q: usize, const K: usize> Sealed
        for super::Capacities<V, T, P, Q, K>
    {
    }
}
