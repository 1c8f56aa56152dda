//! μ(v): friction that falls or rises with speed, where an asset says so.
//!
//! ```text
//! μ(v) = μ·f(v)
//! ```
//!
//! with the factor f a table over the tangential speed v that also looks up the grid: straight lines
//! between its points, constant below the first and above the last one. The lookup is in integers in
//! both arithmetics, in steps of 1/4096 mm/s, so that it gives the same factor in both. Its work is
//! the same at every speed, and a convex mixture of two factors is never outside them.
//!
//! **It only takes energy.** μ is nothing but the limit at which the bristle slips
//! ([`friction`](super::friction)). Whatever the limit does from tick to tick, lowering it shortens
//! the deflection, which loses stored energy, and raising it changes nothing by itself. **It does
//! not act at rest**, where the deflection is inside the dead zone, whatever the limit.
//!
//! A law that falls is negative damping of −F_n·dμ/dv beside the hand's own. So a hand may stick
//! and slip on it, as on the surface. Two things bound that: the speed is low-passed
//! ([`velocity_cutoff_hz`](crate::Config::velocity_cutoff_hz)), and below μ(v)·v_c the leak of the
//! bristle makes steady friction grow with speed.

use super::table::Table;
use crate::{
    arithmetic::{Arithmetic, Fixed, Float, Scalar as _},
    quantity::{
        Quantity,
        unit::{Fraction, FrictionCoefficient, FrictionFactor, MillimetrePerSecond},
    },
};
use asperity_formats as formats;

/// A difference of factors below this is none: 10 µN at 10 N.
const SMALLEST_REMAINDER: f32 = 1e-6;

/// The table of factors over speeds, 1/16 mm/s and 1/8192, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrictionLaw(Table);

impl FrictionLaw {
    /// Friction that does not depend on speed.
    pub(crate) const NONE: Self = Self(Table::NONE);

    /// Takes the law of an asset, in place.
    pub(crate) fn load(&mut self, law: Option<formats::FrictionLaw<'_>>) {
        let points = law.into_iter().flat_map(|law| law.points());
        self.0
            .load(points.map(|point| (point.speed_code, point.factor_code)));
    }

    /// Returns true if there is a law.
    #[inline(always)]
    pub(crate) const fn is_some(&self) -> bool {
        self.0.is_some()
    }

    /// The factor at a speed; 1 without a law.
    #[cold]
    #[inline(never)]
    pub(crate) fn factor<A: FactorLookup>(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
    ) -> Quantity<A, FrictionFactor> {
        if self.is_some() {
            A::factor(self.0.at(A::fine_speed(speed)))
        } else {
            Quantity::whole(1)
        }
    }
}

/// The factor while one texture follows another: what remains of the old one fades.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FactorCrossing<A: Arithmetic> {
    /// The last factor, less 1.
    rendered: Quantity<A, FrictionFactor>,
    way: Way<A>,
}

/// Where a crossing is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way<A: Arithmetic> {
    /// The factor is that of the texture.
    Arrived,
    /// The texture has changed since the last tick.
    Begun,
    /// So much remains of the difference between the old factor and the new one.
    Remains(Quantity<A, FrictionFactor>),
}

impl<A: Arithmetic> FactorCrossing<A> {
    /// Nothing was touched yet.
    pub(crate) const START: Self = Self {
        rendered: Quantity::ZERO,
        way: Way::Arrived,
    };

    /// The texture has changed.
    pub(crate) const fn begin(&mut self) {
        self.way = Way::Begun;
    }
}

impl<A: FactorLookup> FactorCrossing<A> {
    /// μ where the texture says `mu`; a tick goes a `fraction` of the way to its `factor`, if it has one.
    #[inline(always)]
    pub(crate) fn of(
        &mut self,
        mu: Quantity<A, FrictionCoefficient>,
        factor: Option<Quantity<A, FrictionFactor>>,
        fraction: Quantity<A, Fraction>,
    ) -> Quantity<A, FrictionCoefficient> {
        if factor.is_some() | !matches!(self.way, Way::Arrived) {
            mu * self.step(factor, fraction)
        } else {
            mu
        }
    }

    #[cold]
    #[inline(never)]
    fn step(
        &mut self,
        factor: Option<Quantity<A, FrictionFactor>>,
        fraction: Quantity<A, Fraction>,
    ) -> Quantity<A, FrictionFactor> {
        let one = Quantity::whole(1);
        let factor = factor.unwrap_or(one);
        let before = match self.way {
            Way::Arrived => return self.arrive(factor),
            Way::Begun => self.rendered + one - factor,
            Way::Remains(remainder) => remainder,
        };
        let remainder = (Quantity::whole(1) - fraction) * before;
        if remainder.max(-remainder) < Quantity::of(SMALLEST_REMAINDER) {
            return self.arrive(factor);
        }
        self.way = Way::Remains(remainder);
        self.rendered = factor + remainder - one;
        factor + remainder
    }

    fn arrive(&mut self, factor: Quantity<A, FrictionFactor>) -> Quantity<A, FrictionFactor> {
        self.way = Way::Arrived;
        self.rendered = factor - Quantity::whole(1);
        factor
    }
}

/// Conversions between an arithmetic and the integers of the table.
pub trait FactorLookup: Arithmetic {
    /// A speed in 1/4096 mm/s; 0 for NaN and below 0, the end of the range beyond it.
    fn fine_speed(speed: Quantity<Self, MillimetrePerSecond>) -> u32;
    /// A factor from units of 2⁻²⁹.
    fn factor(fine: u32) -> Quantity<Self, FrictionFactor>;
}

impl FactorLookup for Float {
    #[inline(always)]
    fn fine_speed(speed: Quantity<Self, MillimetrePerSecond>) -> u32 {
        // A cast truncates and saturates, and gives 0 for NaN.
        (speed.0 * 4096.0) as u32
    }

    #[inline(always)]
    fn factor(fine: u32) -> Quantity<Self, FrictionFactor> {
        Quantity(fine as f32 * (1.0 / (1_u32 << 29) as f32))
    }
}

impl FactorLookup for Fixed {
    #[inline(always)]
    fn fine_speed(speed: Quantity<Self, MillimetrePerSecond>) -> u32 {
        // 15 bits stand behind the point of a speed, 12 are asked for.
        speed.max(Quantity::ZERO).0.bits() >> 3
    }

    #[inline(always)]
    fn factor(fine: u32) -> Quantity<Self, FrictionFactor> {
        // 28 bits stand behind the point of a factor, and half a bit is added before the cut.
        let rounded = (fine >> 1) + (fine & 1);
        Quantity(fixed::FixedI32::from_bits(rounded as i32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(points: &[(u16, u16)]) -> FrictionLaw {
        let mut law = FrictionLaw::NONE;
        law.0.load(points.iter().copied());
        law
    }

    /// Straight lines in f64.
    fn straight(points: &[(u16, u16)], speed_mm_s: f64) -> f64 {
        let at =
            |(speed, factor): (u16, u16)| (f64::from(speed) / 16.0, f64::from(factor) / 8192.0);
        let (first, last) = (at(points[0]), at(points[points.len() - 1]));
        if speed_mm_s <= first.0 {
            return first.1;
        }
        for pair in points.windows(2) {
            let ((v0, f0), (v1, f1)) = (at(pair[0]), at(pair[1]));
            if speed_mm_s <= v1 {
                return f0 + (f1 - f0) * (speed_mm_s - v0) / (v1 - v0);
            }
        }
        last.1
    }

    const LAWS: [&[(u16, u16)]; 5] = [
        &[(320, 12_288), (960, 8192), (3208, 5120)],
        &[(0, 0), (1, 65_535)],
        &[(0, 65_535), (65_535, 0)],
        &[(16, 9000), (65_534, 1), (65_535, 65_535)],
        &[
            (0, 1),
            (1, 2),
            (2, 3),
            (3, 65_535),
            (65_532, 0),
            (65_533, 7),
            (65_534, 65_535),
            (65_535, 3),
        ],
    ];

    /// Both arithmetics, at the points, between them and beyond them.
    #[test]
    fn a_factor_lies_on_the_straight_line_between_its_points() {
        for points in LAWS {
            let law = law(points);
            assert!(law.is_some());
            for step in 0..200_000_u32 {
                let speed_mm_s = f64::from(step) * 0.021_3;
                let exact = straight(points, (speed_mm_s * 4096.0).floor() / 4096.0);
                let float = Quantity::<Float, MillimetrePerSecond>::of(speed_mm_s as f32);
                let fixed = Quantity::<Fixed, MillimetrePerSecond>::of(speed_mm_s as f32);
                let found = [law.factor(float).value(), law.factor(fixed).value()];
                // Steep lines: half a thousandth of a mm/s of rounding.
                let steepest = points
                    .windows(2)
                    .map(|p| {
                        f64::from(p[0].1.abs_diff(p[1].1)) / f64::from(p[1].0 - p[0].0) / 512.0
                    })
                    .fold(0.0, f64::max);
                for found in found {
                    let error = (f64::from(found) - exact).abs();
                    let allowed = steepest * 5e-4 + 2e-4;
                    assert!(error <= allowed, "{points:?} {speed_mm_s}: {found} {exact}");
                }
            }
        }
    }

    #[test]
    fn every_speed_gives_a_factor_between_the_lowest_and_the_highest() {
        for points in LAWS {
            let law = law(points);
            let factors = || points.iter().map(|p| f32::from(p.1) / 8192.0);
            let (low, high) = (
                factors().fold(f32::INFINITY, |a, b| if a < b { a } else { b }),
                factors().fold(0.0, |a, b| if a > b { a } else { b }),
            );
            for speed in [
                f32::NAN,
                -1.0,
                -0.0,
                f32::MIN_POSITIVE,
                4095.9,
                4096.0,
                1e9,
                f32::INFINITY,
                f32::NEG_INFINITY,
            ] {
                let factor = law.factor(Quantity::<Float, _>::of(speed)).value();
                assert!((low..=high).contains(&factor), "{speed}: {factor}");
                let factor = law.factor(Quantity::<Fixed, _>::of(speed)).value();
                assert!((low..=high).contains(&factor), "{speed}: {factor}");
            }
        }
    }

    #[test]
    fn without_a_law_there_is_none() {
        let mut law = law(LAWS[0]);
        law.load(None);
        assert!(!law.is_some());
    }

    /// From one law to another, what remains of the old factor fades by the same share in each tick.
    #[test]
    fn a_factor_goes_to_that_of_another_law_little_by_little() {
        fn check<A: FactorLookup>(within: f64) {
            let (old, new) = (
                law(&[(0, 16_384), (16, 16_384)]),
                law(&[(0, 4096), (16, 4096)]),
            );
            let speed = Quantity::<A, MillimetrePerSecond>::of(50.0);
            let mut crossing = FactorCrossing::<A>::START;
            let step = |crossing: &mut FactorCrossing<A>, law: &FrictionLaw, fraction: f32| {
                let factor = law.is_some().then(|| law.factor(speed));
                let mu = crossing.of(Quantity::of(0.5), factor, Quantity::of(fraction));
                f64::from(mu.value()) / 0.5
            };
            // Without a change a law acts at once, and 1 where there is none.
            assert_eq!(step(&mut crossing, &FrictionLaw::NONE, 0.25), 1.0);
            assert!((step(&mut crossing, &old, 0.25) - 2.0).abs() < within);
            crossing.begin();
            let mut exact = 2.0;
            for to in [new; 40].into_iter().chain([FrictionLaw::NONE; 80]) {
                let target = if to.is_some() { 0.5 } else { 1.0 };
                if !to.is_some() && matches!(crossing.way, Way::Remains(_)) && exact < 0.51 {
                    crossing.begin();
                }
                exact = target + 0.75 * (exact - target);
                let found = step(&mut crossing, &to, 0.25);
                assert!((found - exact).abs() < within, "{found} {exact}");
            }
            assert!(matches!(crossing.way, Way::Arrived));
            crossing.begin();
            assert!(
                (step(&mut crossing, &old, 1.0) - 2.0).abs() < within,
                "at once"
            );
            assert!(matches!(crossing.way, Way::Arrived));
        }
        check::<Float>(1e-5);
        check::<Fixed>(2e-5);
    }
}
