//! Ribs, a grain, a nap: speed, level and μ follow the angle of a stroke to an axis.
//!
//! The grid of a texture is that of strokes across its axis. With s² the squared sine of the angle from there, c² = 1 − s²,
//! P the power of the relief along the axis over that across it and r the speed across that sounds like one along:
//!
//! ```text
//! s²      = ((t̂·a)² + ε/2)/(1 − (n̂·a)² + ε)
//! v_grid² = v²·(c⁴ + P·r²·s⁴)/(c² + P·s²)
//! gain²   = (c² + P·s²)²/(c⁴ + P·r²·s⁴)
//! μ       = μ·(c² + m·s²)
//! ```
//!
//! A relief is met at v·c across and at v·s along. Its power grows with the square of that speed, so the shares of both are
//! c² and P·s²; v_grid is the mean of their speeds, weighted by power, and gain what the level at that speed lacks.
//!
//! Both t̂ and the projection of a lie in the tangent plane, so t̂·a over the length of the projection is the sine. Where
//! the axis is normal to the surface, s² is ½. Everything is a function of squares but m, which has a value for each sense
//! along the axis and acts with s²: nothing jumps where a stroke reverses, and μ by less than a thousandth where it turns
//! across the axis, by the ε. All of it
//! is taken at queries; between them μ goes to it as a one-pole.

use crate::{
    arithmetic::{Arithmetic, Float},
    quantity::{
        Magnitudes, Quantity, StoredVector, Vector,
        unit::{DirectionFactor, Fraction},
    },
    stage::contact::{FLATTEST, unit},
};
use asperity_formats as formats;

/// ε: the sine is half wrong where the axis is 1.8° from the normal.
const POLE: f32 = 1.0 / 1024.0;

/// The axis of a texture, and how strokes along it differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Axis<A: Arithmetic = Float> {
    axis: StoredVector<A, Fraction>,
    /// P.
    power: Quantity<A, DirectionFactor>,
    /// P·r².
    fast_power: Quantity<A, DirectionFactor>,
    /// m − 1 towards the axis.
    forward: Quantity<A, DirectionFactor>,
    /// m − 1 against it.
    backward: Quantity<A, DirectionFactor>,
}

/// What the direction of the last query asks for, and the factor of μ that follows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Heading<A: Arithmetic> {
    /// v_grid/v.
    pub(crate) speed: Quantity<A, DirectionFactor>,
    /// The gain.
    pub(crate) level: Quantity<A, DirectionFactor>,
    /// The factor of μ.
    mu: Quantity<A, DirectionFactor>,
    /// The factor of μ that is rendered.
    rendered_mu: Quantity<A, DirectionFactor>,
}

impl<A: Arithmetic> Heading<A> {
    /// The same in every direction.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        let one = Quantity::whole(1);
        Self {
            speed: one,
            level: one,
            mu: one,
            rendered_mu: one,
        }
    }

    /// The factor of μ a tick later, which goes a `fraction` of the way. It never decays towards zero, so that nothing
    /// becomes a denormal.
    #[inline(always)]
    pub(crate) fn follow(
        &mut self,
        fraction: Quantity<A, Fraction>,
    ) -> Quantity<A, DirectionFactor> {
        let left = Quantity::whole(1) - fraction;
        self.rendered_mu = self.mu - left * (self.mu - self.rendered_mu);
        self.rendered_mu
    }
}

impl<A: Arithmetic> Axis<A> {
    /// The same in every direction.
    pub(crate) const NONE: Self = Self {
        axis: StoredVector::ZERO,
        power: Quantity::ZERO,
        fast_power: Quantity::ZERO,
        forward: Quantity::ZERO,
        backward: Quantity::ZERO,
    };

    /// Takes the direction of an asset, in place.
    pub(crate) fn load(&mut self, direction: Option<&formats::Direction>) {
        *self = direction.map_or(Self::NONE, |direction| {
            let (power, speed) = (direction.power_ratio, direction.speed_ratio);
            Self {
                axis: Vector::of(unit(direction.axis)).into(),
                power: Quantity::of(power).settled(),
                fast_power: Quantity::of(power * (speed * speed)).settled(),
                forward: Quantity::of(direction.mu_forward - 1.0).settled(),
                backward: Quantity::of(direction.mu_backward - 1.0).settled(),
            }
        });
    }
}

impl<A: Magnitudes> Axis<A> {
    /// Takes a stroke of direction t̂ on a surface of normal n̂. A function of its own: it is called at queries, and only
    /// where there is an axis.
    #[cold]
    #[inline(never)]
    pub(crate) fn turn(
        &self,
        heading: &mut Heading<A>,
        stroke: Vector<A, Fraction>,
        normal: Vector<A, Fraction>,
    ) {
        let axis = self.axis.get();
        let along = stroke.dot(axis).settled_within(FLATTEST);
        let upright = normal.dot(axis).settled_within(FLATTEST);
        let half = Quantity::<A, Fraction>::of(0.5 * POLE);
        let one = Quantity::<A, Fraction>::of(1.0 + POLE);
        let sine = (along * along + half).over(one - upright * upright);
        // A direction that is kept at rest may point out of the plane.
        let sine = sine.min(Quantity::whole(1));
        let beyond = if along > Quantity::ZERO {
            self.forward
        } else {
            self.backward
        };
        heading.mu = Quantity::whole(1) + beyond * sine;
        let cosine = Quantity::whole(1) - sine;
        let power = cosine + self.power * sine;
        let root = (cosine * cosine + self.fast_power * (sine * sine)).root();
        heading.speed = root.over(power.root());
        heading.level = power.over(root);
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::Fixed;

    const RIBS: formats::Direction = formats::Direction {
        axis: [0.0, 1.0, 0.0],
        power_ratio: 0.25,
        speed_ratio: 0.5,
        mu_forward: 0.75,
        mu_backward: 1.5,
    };

    fn axis<A: Arithmetic>(direction: &formats::Direction) -> Axis<A> {
        let mut axis = Axis::NONE;
        axis.load(Some(direction));
        axis
    }

    /// Factors of μ, of speed and of level of a stroke, in f64.
    fn exact(direction: &formats::Direction, stroke: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        let axis = direction.axis.map(f64::from);
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let pole = f64::from(POLE);
        let along = dot(stroke, axis);
        let s2 = ((along * along + pole / 2.0) / (1.0 - dot(normal, axis).powi(2) + pole)).min(1.0);
        let c2 = 1.0 - s2;
        let (p, r2) = (
            f64::from(direction.power_ratio),
            f64::from(direction.speed_ratio).powi(2),
        );
        // At right angles rounding decides on the sense.
        let m = if along > 1e-9 {
            direction.mu_forward
        } else {
            direction.mu_backward
        };
        let (power, sum) = (c2 + p * s2, c2 * c2 + p * r2 * s2 * s2);
        [
            c2 + f64::from(m) * s2,
            (sum / power).sqrt(),
            power / sum.sqrt(),
        ]
    }

    fn found<A: Magnitudes>(
        direction: &formats::Direction,
        stroke: [f64; 3],
        normal: [f64; 3],
    ) -> [f64; 3] {
        let vector = |v: [f64; 3]| Vector::<A, Fraction>::of(v.map(|x| x as f32));
        let axis = axis::<A>(direction);
        let mut heading = Heading::none();
        axis.turn(&mut heading, vector(stroke), vector(normal));
        [heading.mu, heading.speed, heading.level].map(|factor| factor.value().into())
    }

    /// Strokes over planes that lean any way, at angles a degree apart.
    #[test]
    fn every_factor_is_that_of_the_formulas_in_both_arithmetics() {
        let directions = [
            RIBS,
            formats::Direction {
                power_ratio: 0.0,
                ..RIBS
            },
            formats::Direction {
                axis: [0.6, 0.0, 0.8],
                power_ratio: 2.0,
                speed_ratio: 2.0,
                mu_forward: 0.0625,
                mu_backward: 4.0,
            },
            formats::Direction {
                power_ratio: 1.0,
                speed_ratio: 0.125,
                ..RIBS
            },
        ];
        let normals = [
            [0.0, 0.0, 1.0],
            [0.6, 0.8, 0.0],
            [0.0, 0.96, 0.28],
            [0.0, 1.0, 0.0],
        ];
        for direction in &directions {
            for n in normals {
                // Two directions of the plane.
                let flat = if n[2] == 1.0 {
                    [1.0, 0.0, 0.0]
                } else {
                    let length = f64::hypot(n[0], n[1]);
                    [-n[1] / length, n[0] / length, 0.0]
                };
                let other = [
                    n[1] * flat[2] - n[2] * flat[1],
                    n[2] * flat[0] - n[0] * flat[2],
                    n[0] * flat[1] - n[1] * flat[0],
                ];
                for degrees in 0..360 {
                    let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
                    let t = [0, 1, 2].map(|k| cos * flat[k] + sin * other[k]);
                    let exact = exact(direction, t, n);
                    for (found, within) in [
                        (found::<Float>(direction, t, n), 2e-4),
                        (found::<Fixed>(direction, t, n), 2e-3),
                    ] {
                        for (found, exact) in found.into_iter().zip(exact) {
                            let error = (found - exact).abs();
                            assert!(
                                error < within * exact.max(0.1),
                                "{direction:?} {n:?} {degrees}: {found} {exact}"
                            );
                        }
                    }
                }
            }
        }
    }

    /// Nothing along the ribs: they are met at v·|cos θ|, with the level of that speed.
    #[test]
    fn bare_ribs_are_crossed_at_the_cosine() {
        let bare = formats::Direction {
            power_ratio: 0.0,
            ..RIBS
        };
        for degrees in 0..=80 {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let [_, speed, level] = found::<Float>(&bare, [cos, sin, 0.0], [0.0, 0.0, 1.0]);
            assert!((speed / cos - 1.0).abs() < 0.02, "{degrees}: {speed} {cos}");
            assert!((level - 1.0).abs() < 1e-3, "{degrees}: {level}");
        }
        let [_, speed, _] = found::<Float>(&bare, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        assert!(speed < 0.03, "{speed}");
    }

    #[test]
    fn an_axis_that_is_normal_to_the_surface_gives_the_mean_of_both() {
        for degrees in 0..360 {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let [mu, ..] = found::<Float>(&RIBS, [cos, 0.0, sin], [0.0, 1.0, 0.0]);
            assert!((mu - 1.25).abs() < 1e-3, "{degrees}: {mu}");
        }
        // A direction that is kept from another place.
        for kept in [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
            for factors in [
                found::<Float>(&RIBS, kept, [0.0, 1.0, 0.0]),
                found::<Fixed>(&RIBS, kept, [0.0, 1.0, 0.0]),
            ] {
                let within = (0.5..=1.5).contains(&factors[0]) && factors[1] > 0.4;
                assert!(within, "{factors:?}");
            }
        }
    }
}
