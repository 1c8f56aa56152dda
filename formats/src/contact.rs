//! CONT, in version 3: the contact law of a material that gives way.

use crate::{
    error::{FormatError, in_range},
    limits,
    wire::{Reader, u16_at},
};

/// Codes of a metre: depths are whole micrometres.
const PER_M: f64 = 1e6;
/// Bytes of a point.
const POINT_LEN: usize = 4;

/// The contact law: a sum of parts, each absent where its numbers are 0.
///
/// With δ the depth below the undeformed surface, p the imprint, e = δ − p ≥ 0 the elastic depth, v
/// the tangential speed and k, b the wall of `SURF`:
///
/// ```text
/// F_el = k·s(e) + q                    load: spring and relaxation, ≥ 0
/// q̇ = k₁·ė − q/τ                       Maxwell branch
/// p ← max(p, share·(δ − e_y))          imprint
/// F_n = F_el − (b + λ·F_el)·δ̇ − g      damping (Hunt and Crossley), ≥ 0 before the pull g
/// F_t ≤ μ(v)·F_el + (c·v + w)·δ        drag raises the limit of friction
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw<'a> {
    /// λ, s/m: the share of the load that a metre per second adds.
    pub damping_s_m: f32,
    /// The Maxwell branch.
    pub relaxation: Relaxation,
    /// What does not spring back.
    pub imprint: Imprint,
    /// What raises the limit of friction.
    pub drag: Drag,
    /// The pull at release.
    pub adhesion: Adhesion,
    points: &'a [u8],
}

/// A Maxwell branch beside the spring.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Relaxation {
    /// k₁, N/m; 0 for none.
    pub stiffness_n_m: f32,
    /// τ, s.
    pub time_s: f32,
}

/// A surface that yields: `p ← max(p, share·(δ − e_y))`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Imprint {
    /// e_y, m: the elastic depth at which it yields.
    pub yield_m: f32,
    /// The part of each further metre of depth that stays, 0 to 1; 0 for none.
    pub share: f32,
    /// Metres by which p is less after a metre of slip.
    pub heal: f32,
    /// Time constant with which p recovers where nothing presses, s; 0 for never.
    pub recovery_s: f32,
}

/// Resistance to a motion along the surface that grows with depth.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Drag {
    /// c, N·s/m², times speed and depth.
    pub viscous_n_s_m2: f32,
    /// w, N/m, times depth.
    pub plough_n_m: f32,
}

/// A pull against a motion outwards, at most the smaller of both limits.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Adhesion {
    /// The largest pull, N; 0 for none.
    pub pull_n: f32,
    /// Its stiffness, N/m, and its limit over elastic depth.
    pub stiffness_n_m: f32,
}

/// A point of the spring's shape, as it is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SpringPoint {
    /// Elastic depth e, µm.
    pub depth_code: u16,
    /// s(e), µm.
    pub shape_code: u16,
}

impl SpringPoint {
    /// The point nearest to a depth and a shape, m, each 0 to 0.0655. `None` outside this range and
    /// for values that are not finite.
    #[must_use]
    pub fn nearest(depth_m: f64, shape_m: f64) -> Option<Self> {
        let code = |value: f64| {
            let rounded = value * PER_M + 0.5;
            // A cast truncates.
            (value >= 0.0 && rounded < 65536.0).then_some(rounded as u16)
        };
        Some(Self {
            depth_code: code(depth_m)?,
            shape_code: code(shape_m)?,
        })
    }

    /// Elastic depth, m.
    #[must_use]
    pub fn depth_m(self) -> f64 {
        f64::from(self.depth_code) / PER_M
    }

    /// s at this depth, m.
    #[must_use]
    pub fn shape_m(self) -> f64 {
        f64::from(self.shape_code) / PER_M
    }
}

impl<'a> ContactLaw<'a> {
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let mut number = |field| reader.f32(field);
        let law = Self {
            damping_s_m: number("contact.damping_s_m")?,
            relaxation: Relaxation {
                stiffness_n_m: number("contact.relaxation.stiffness_n_m")?,
                time_s: number("contact.relaxation.time_s")?,
            },
            imprint: Imprint {
                yield_m: number("contact.imprint.yield_m")?,
                share: number("contact.imprint.share")?,
                heal: number("contact.imprint.heal")?,
                recovery_s: number("contact.imprint.recovery_s")?,
            },
            drag: Drag {
                viscous_n_s_m2: number("contact.drag.viscous_n_s_m2")?,
                plough_n_m: number("contact.drag.plough_n_m")?,
            },
            adhesion: Adhesion {
                pull_n: number("contact.adhesion.pull_n")?,
                stiffness_n_m: number("contact.adhesion.stiffness_n_m")?,
            },
            points: {
                let count = usize::from(reader.u8("contact.spring.count")?);
                if count > limits::MAX_SPRING_POINTS {
                    return Err(FormatError::invalid(
                        "contact.spring.count",
                        0,
                        count as f64,
                        "at most 6",
                    ));
                }
                reader.bytes("contact.spring.points", POINT_LEN * count)?
            },
        };
        reader.finish("contact")?;
        law.check_numbers()?;
        law.check_spring()?;
        Ok(law)
    }

    /// Ranges: a part that is absent is 0 in all its numbers.
    fn check_numbers(&self) -> Result<(), FormatError> {
        let tiny = f32::MIN_POSITIVE;
        let (relaxation, imprint, drag, adhesion) =
            (&self.relaxation, &self.imprint, &self.drag, &self.adhesion);
        /// The range of a number whose part is there, else 0 alone.
        fn of(there: f32, range: (f32, f32)) -> (f32, f32) {
            if there > 0.0 { range } else { (0.0, 0.0) }
        }
        let stiffness = (tiny, limits::MAX_STIFFNESS_N_M);
        for (field, value, range, rule) in [
            (
                "contact.damping_s_m",
                self.damping_s_m,
                (0.0, limits::MAX_LOAD_DAMPING_S_M),
                "0 to 100 s/m",
            ),
            (
                "contact.relaxation.stiffness_n_m",
                relaxation.stiffness_n_m,
                (0.0, limits::MAX_STIFFNESS_N_M),
                "0 to 1e5 N/m",
            ),
            (
                "contact.relaxation.time_s",
                relaxation.time_s,
                of(relaxation.stiffness_n_m, limits::RELAXATION_S),
                "0.005 to 20 s, 0 without a stiffness",
            ),
            ("contact.imprint.share", imprint.share, (0.0, 1.0), "0 to 1"),
            (
                "contact.imprint.yield_m",
                imprint.yield_m,
                of(imprint.share, (0.0, limits::MAX_YIELD_M)),
                "0 to 0.05 m, 0 without a share",
            ),
            (
                "contact.imprint.heal",
                imprint.heal,
                of(imprint.share, (0.0, 1.0)),
                "0 to 1, 0 without a share",
            ),
            (
                "contact.imprint.recovery_s",
                imprint.recovery_s,
                of(imprint.share, (0.0, limits::MAX_RECOVERY_S)),
                "0 to 60 s, 0 without a share",
            ),
            (
                "contact.drag.viscous_n_s_m2",
                drag.viscous_n_s_m2,
                (0.0, limits::MAX_VISCOUS_N_S_M2),
                "0 to 1e5 N·s/m²",
            ),
            (
                "contact.drag.plough_n_m",
                drag.plough_n_m,
                (0.0, limits::MAX_PLOUGH_N_M),
                "0 to 1e4 N/m",
            ),
            (
                "contact.adhesion.pull_n",
                adhesion.pull_n,
                (0.0, limits::MAX_PULL_N),
                "0 to 100 N",
            ),
            (
                "contact.adhesion.stiffness_n_m",
                adhesion.stiffness_n_m,
                of(adhesion.pull_n, stiffness),
                "above 0, at most 1e5 N/m, 0 without a pull",
            ),
        ] {
            in_range(field, 0, value, range, rule)?;
        }
        Ok(())
    }

    /// Depths ascend; s does not fall, and nowhere faster than e.
    fn check_spring(&self) -> Result<(), FormatError> {
        let mut last = SpringPoint::default();
        for (index, point) in self.points().enumerate() {
            if point.depth_code <= last.depth_code {
                return Err(FormatError::invalid(
                    "contact.spring.depth_m",
                    index,
                    point.depth_m(),
                    "depths must ascend from 0",
                ));
            }
            let rises = u32::from(point.depth_code - last.depth_code);
            let shape = i64::from(point.shape_code) - i64::from(last.shape_code);
            if !(0..=i64::from(rises)).contains(&shape) {
                return Err(FormatError::invalid(
                    "contact.spring.shape_m",
                    index,
                    point.shape_m(),
                    "must not fall, nor rise faster than the depth",
                ));
            }
            last = point;
        }
        Ok(())
    }

    /// The points of the shape s, 0 to 6, in ascending order of depth. The first straight line comes
    /// from (0, 0), and the last one goes on. Without points s(e) = e.
    pub fn points(&self) -> impl ExactSizeIterator<Item = SpringPoint> + use<'a> {
        self.points
            .chunks_exact(POINT_LEN)
            .map(|point| SpringPoint {
                depth_code: u16_at(point, 0),
                shape_code: u16_at(point, 2),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_within_half_a_micrometre_and_the_ends_are_refused() {
        for step in 0..4000 {
            let (depth_m, shape_m) = (f64::from(step) * 1.634e-5, f64::from(step) * 3.1e-6);
            let point = SpringPoint::nearest(depth_m, shape_m).unwrap();
            assert!((point.depth_m() - depth_m).abs() <= 0.501e-6);
            assert!((point.shape_m() - shape_m).abs() <= 0.501e-6);
        }
        for (depth_m, shape_m) in [
            (-1e-9, 0.0),
            (0.06554, 0.0),
            (f64::NAN, 0.0),
            (0.0, f64::INFINITY),
        ] {
            assert_eq!(
                SpringPoint::nearest(depth_m, shape_m),
                None,
                "{depth_m} {shape_m}"
            );
        }
    }
}
