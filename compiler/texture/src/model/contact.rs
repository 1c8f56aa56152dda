//! The contact law of a material that gives way, in SI units: what takes the linear wall's place.

use serde::{Deserialize, Serialize};

/// A sum of parts, each absent by default; `formats/SPEC.md` states the equations.
///
/// With a spring the wall's stiffness is the slope of the spring at 1 N
/// ([`ContactLaw::stiffness_n_m`]).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactLaw {
    /// Force over elastic depth: straight lines from the origin through 1 to 6 points, ascending in
    /// depth and never falling in force; the last line goes on. Without points the wall's stiffness
    /// holds.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spring: Vec<SpringPoint>,
    /// λ of Hunt and Crossley: the share of the load that a metre per second inwards adds, s/m.
    #[serde(skip_serializing_if = "is_zero")]
    pub damping_s_m: f64,
    /// A Maxwell branch beside the spring.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relaxation: Option<Relaxation>,
    /// What yields and does not spring back.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub imprint: Option<Imprint>,
    /// What grows with depth along the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag: Option<Drag>,
    /// A pull at release.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<Adhesion>,
}

/// A point of a spring.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpringPoint {
    /// Elastic depth, mm.
    pub depth_mm: f64,
    /// Force, N.
    pub force_n: f64,
}

/// A Maxwell branch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Relaxation {
    /// Stiffness k₁, N/m, above 0.
    pub stiffness_n_m: f64,
    /// Time constant τ, s, 0.005 to 20.
    pub time_s: f64,
}

/// A surface that yields.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Imprint {
    /// Elastic depth at which it yields, mm.
    pub yield_mm: f64,
    /// Part of each further millimetre of depth that stays, above 0, at most 1.
    pub share: f64,
    /// Metres of imprint lost per metre of slip along the surface, 0 to 1.
    #[serde(default)]
    pub heal: f64,
    /// Time constant of recovery in the open, s; 0 for never.
    #[serde(default)]
    pub recovery_s: f64,
}

/// Resistance along the surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// c, N·s/m²: times speed and depth.
    #[serde(default)]
    pub viscous_n_s_m2: f64,
    /// w, N/m: times depth.
    #[serde(default)]
    pub plough_n_m: f64,
}

/// A pull against a motion outwards.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adhesion {
    /// The largest pull, N, above 0.
    pub pull_n: f64,
    /// Its stiffness, and its limit over elastic depth, N/m, above 0.
    pub stiffness_n_m: f64,
}

// serde hands the field over by reference.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

impl ContactLaw {
    /// The slope of each line of the spring, N/m, with the depth where it begins, mm, and the force
    /// there, N.
    fn lines(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        let mut from = SpringPoint {
            depth_mm: 0.0,
            force_n: 0.0,
        };
        self.spring.iter().map(move |&to| {
            let slope = 1000.0 * (to.force_n - from.force_n) / (to.depth_mm - from.depth_mm);
            let line = (from.depth_mm, from.force_n, slope);
            from = to;
            line
        })
    }

    /// The slope of the spring at 1 N, N/m; `None` without a spring.
    #[must_use]
    pub fn stiffness_n_m(&self) -> Option<f64> {
        let below = self.lines().take_while(|&(_, force_n, _)| force_n < 1.0);
        below.last().map(|(.., slope)| slope)
    }

    /// The steepest slope of the spring, N/m; `None` without a spring.
    #[must_use]
    pub fn steepest_n_m(&self) -> Option<f64> {
        self.lines().map(|(.., slope)| slope).reduce(f64::max)
    }

    /// The force of the spring at an elastic depth, mm, on a wall of `stiffness_n_m`, N.
    #[must_use]
    pub fn spring_n(&self, depth_mm: f64, stiffness_n_m: f64) -> f64 {
        let before = self.lines().take_while(|&(from, ..)| from <= depth_mm);
        before.last().map_or(
            stiffness_n_m * depth_mm.max(0.0) / 1000.0,
            |(from, force_n, slope)| force_n + slope * (depth_mm - from) / 1000.0,
        )
    }

    /// The elastic depth at which the spring bears a force, mm: the least one.
    #[must_use]
    pub fn depth_mm(&self, force_n: f64, stiffness_n_m: f64) -> f64 {
        let mut last = None;
        for (from, low_n, slope) in self.lines() {
            if low_n >= force_n {
                break;
            }
            last = Some((from, low_n, slope));
        }
        let (from, low_n, slope) = last.unwrap_or((0.0, 0.0, stiffness_n_m));
        from + 1000.0 * (force_n - low_n) / slope.max(1e-9)
    }

    /// The force at a depth that nothing pressed before, mm, slowly: [`ContactLaw::spring_n`] less
    /// what has yielded, N.
    #[must_use]
    pub fn pressed_n(&self, depth_mm: f64, stiffness_n_m: f64) -> f64 {
        let stays_mm = self.imprint.map_or(0.0, |imprint| {
            imprint.share * (depth_mm - imprint.yield_mm).max(0.0)
        });
        self.spring_n(depth_mm - stays_mm, stiffness_n_m)
    }

    /// The depth at which the surface bears a force once it has yielded, mm: the inverse of
    /// [`ContactLaw::pressed_n`]. Where all that is deeper stays, a hundredth of it springs back.
    #[must_use]
    pub fn pressed_mm(&self, force_n: f64, stiffness_n_m: f64) -> f64 {
        let elastic_mm = self.depth_mm(force_n, stiffness_n_m);
        let stays_mm = self.imprint.map_or(0.0, |imprint| {
            let beyond_mm = (elastic_mm - imprint.yield_mm).max(0.0);
            imprint.share * beyond_mm / (1.0 - imprint.share).max(0.01)
        });
        elastic_mm + stays_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_is_straight_between_its_points_and_goes_on() {
        let point = |depth_mm, force_n| SpringPoint { depth_mm, force_n };
        let law = ContactLaw {
            spring: vec![point(10.0, 0.5), point(20.0, 0.8), point(22.0, 1.8)],
            ..ContactLaw::default()
        };
        for (depth, force) in [
            (0.0, 0.0),
            (5.0, 0.25),
            (15.0, 0.65),
            (21.0, 1.3),
            (24.0, 2.8),
        ] {
            assert!((law.spring_n(depth, 0.0) - force).abs() < 1e-12, "{depth}");
            assert!((law.depth_mm(force, 0.0) - depth).abs() < 1e-9, "{force}");
        }
        assert_eq!(law.stiffness_n_m(), Some(500.0));
        assert_eq!(law.steepest_n_m(), Some(500.0));
        let yielding = ContactLaw {
            imprint: Some(Imprint {
                yield_mm: 4.0,
                share: 0.75,
                heal: 0.0,
                recovery_s: 0.0,
            }),
            ..law.clone()
        };
        for (depth, elastic) in [(3.0, 3.0), (4.0, 4.0), (28.0, 10.0), (68.0, 20.0)] {
            let force = law.spring_n(elastic, 0.0);
            assert!((yielding.pressed_n(depth, 0.0) - force).abs() < 1e-12);
            assert!((yielding.pressed_mm(force, 0.0) - depth).abs() < 1e-9);
        }
        let wall = ContactLaw::default();
        assert_eq!(
            (wall.stiffness_n_m(), wall.spring_n(2.0, 500.0)),
            (None, 1.0)
        );
        assert_eq!(wall.depth_mm(1.0, 500.0), 2.0);
    }
}
