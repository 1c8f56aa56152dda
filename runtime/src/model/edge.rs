//! Edge models, which answer queries outside the measured range.
//!
//! A query outside the grid is moved to the nearest point of its border, where edge models are
//! mixed. This extrapolation is constant, and continuous with the inside. LSFs are never
//! extrapolated; weights outside a triangle would make unstable filters.

use crate::{
    arithmetic::Arithmetic,
    quantity::{
        Quantity,
        unit::{Coordinate, MillimetrePerSecond, Newton},
    },
};

/// The measured range: speeds and forces from 0 to these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent<A: Arithmetic> {
    max_speed: Quantity<A, MillimetrePerSecond>,
    max_force: Quantity<A, Newton>,
}

impl<A: Arithmetic> Extent<A> {
    /// No range.
    pub(crate) const NONE: Self = Self {
        max_speed: Quantity::ZERO,
        max_force: Quantity::ZERO,
    };

    /// The range of a grid up to a speed, mm/s, and a force, N.
    pub(crate) fn new(max_speed_mm_s: f32, max_force_n: f32) -> Self {
        Self {
            max_speed: Quantity::of(max_speed_mm_s),
            max_force: Quantity::of(max_force_n),
        }
    }

    /// The largest speed, mm/s, and force, N, as the arithmetic holds them.
    pub(crate) fn values(&self) -> [f32; 2] {
        [self.max_speed.value(), self.max_force.value()]
    }

    /// Returns true if a query lies outside, or is NaN.
    #[inline]
    pub(crate) fn is_outside(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) -> bool {
        !(speed <= self.max_speed && force <= self.max_force)
    }

    /// The nearest point of the range, as coordinates of the grid.
    #[inline(always)]
    pub(crate) fn nearest(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) -> [Quantity<A, Coordinate>; 2] {
        [
            speed.clamp_from_zero(self.max_speed).to(),
            force.clamp_from_zero(self.max_force).to(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Fixed, Float};

    #[test]
    fn a_query_is_outside_where_either_number_is_beyond_its_most() {
        fn check<A: Arithmetic>() {
            let extent = Extent::<A>::new(200.0, 4.0);
            assert_eq!(extent.values(), [200.0, 4.0]);
            for (speed, force, outside) in [
                (0.0, 0.0, false),
                (200.0, 4.0, false),
                (200.1, 4.0, true),
                (200.0, 4.1, true),
                (200.1, 4.1, true),
            ] {
                let (v, f) = (Quantity::of(speed), Quantity::of(force));
                assert_eq!(extent.is_outside(v, f), outside, "{speed} {force}");
                let near = extent.nearest(v, f).map(Quantity::value);
                assert_eq!(
                    near,
                    [
                        if speed > 200.0 { 200.0 } else { speed },
                        if force > 4.0 { 4.0 } else { force }
                    ]
                );
            }
            let below = extent.nearest(Quantity::of(-1.0), Quantity::of(-1.0));
            assert_eq!(below.map(Quantity::value), [0.0; 2]);
        }
        check::<Float>();
        check::<Fixed>();
        let extent = Extent::<Float>::new(200.0, 4.0);
        assert!(extent.is_outside(Quantity(f32::NAN), Quantity(1.0)));
        assert!(extent.is_outside(Quantity(1.0), Quantity(f32::NAN)));
    }
}
